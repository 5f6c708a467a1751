//! Operators.

/// An operator before its operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "each variant is the operator of its name")]
pub enum Unary {
    Neg,
    Pos,
    Not,
    No,
    Becomes,
    After,
    Every,
    New,
}

/// An operator between its operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "each variant is the operator of its name")]
pub enum Binary {
    Else,
    Or,
    And,
    Eq,
    Ne,
    Le,
    Ge,
    Lt,
    Gt,
    Add,
    Sub,
    Toward,
    Mul,
    Div,
    Pow,
}

impl Binary {
    /// As it is written.
    pub fn symbol(self) -> &'static str {
        match self {
            Binary::Else => "else",
            Binary::Or => "or",
            Binary::And => "and",
            Binary::Eq => "==",
            Binary::Ne => "!=",
            Binary::Le => "<=",
            Binary::Ge => ">=",
            Binary::Lt => "<",
            Binary::Gt => ">",
            Binary::Add => "+",
            Binary::Sub => "-",
            Binary::Toward => "toward",
            Binary::Mul => "*",
            Binary::Div => "/",
            Binary::Pow => "^",
        }
    }

    /// Whether it compares.
    pub fn compares(self) -> bool {
        matches!(self, Binary::Eq | Binary::Ne | Binary::Le | Binary::Ge | Binary::Lt | Binary::Gt)
    }
}
