//! Expressions as they are written.

use super::{Arg, Binary, Block, Condition, Name, Unary};
use crate::source::{Span, Spanned};

/// An expression.
#[derive(Clone, Debug, PartialEq)]
pub struct Expr {
    /// What it is.
    pub kind: ExprKind,
    /// Where it stands.
    pub span: Span,
}

impl Expr {
    /// The list that this changes: `LIST.insert(x)`, `LIST.remove(x)` and `LIST.clear()` are statements.
    pub fn list_changed(&self) -> Option<&Expr> {
        let ExprKind::Call(callee, _) = &self.kind else { return None };
        let ExprKind::Member(list, change) = &callee.kind else { return None };
        matches!(change.node.as_str(), "insert" | "remove" | "clear").then_some(list)
    }
}

/// What an expression is.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "each variant is what it says")]
pub enum ExprKind {
    /// `whole` is the whole number that is written, however it is spelt and before it is rounded to `value`: `u64::MAX` stands for
    /// any that is larger, none for one with a fraction.
    Number {
        value: f64,
        whole: Option<u64>,
        /// It is spelt with digits alone: without a unit it counts something.
        is_counted: bool,
        unit: Option<Name>,
    },
    Geodetic {
        latitude_deg: f64,
        longitude_deg: f64,
    },
    /// Seconds since the beginning of 1970, UTC.
    Date(f64),
    Text(Vec<TextPart>),
    Bool(bool),
    None,
    Done,
    Name(String),
    Member(Box<Expr>, Name),
    Call(Box<Expr>, Vec<Arg>),
    Index(Box<Expr>, Box<Expr>),
    /// `RECORD with (field: value)`.
    Changed(Box<Expr>, Vec<Arg>),
    List(Vec<Expr>),
    Paren(Box<Expr>),
    Unary(Spanned<Unary>, Box<Expr>),
    Binary(Spanned<Binary>, Box<Expr>, Box<Expr>),
    HasHeldFor(Box<Expr>, Box<Expr>),
    If {
        condition: Box<Condition>,
        then: Block,
        otherwise: Option<Block>,
    },
    Match {
        on: Box<Expr>,
        arms: Vec<MatchArm>,
    },
}

/// `a, b { … }` of a `match`; no names means `else`.
#[derive(Clone, Debug, PartialEq)]
pub struct MatchArm {
    /// The variants.
    pub names: Vec<Name>,
    /// What is done.
    pub block: Block,
    /// All of it.
    pub span: Span,
}

/// A piece of a text.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "each variant is what it says")]
pub enum TextPart {
    Literal(String),
    Hole(Expr),
}
