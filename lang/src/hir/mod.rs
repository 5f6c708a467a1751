//! The checked program: names resolved, types known, every conversion spelt out. What lowering reads.

mod activity;
mod first;
mod operator;
mod position;
mod same;
mod simulated;
mod text;
mod walk;

pub use activity::{Activity, Body, Decl, Kind, Mission, Recording, Require, Rule, Target, leaving};
pub use albacore_arithmetic::Interval;
pub use first::{First, is_control};
pub use position::middle;
pub use same::{mentions_done, same_condition, same_value};
pub use simulated::{
    ClauseArg, ClauseUse, Counted, Expect, OUTCOMES, ReportPart, Row, Scenario, Test, TestNames, TrueInput, When,
    Which, test_file_name,
};
pub use text::TextPart;
pub(crate) use text::without_holes;
pub use walk::{activity_children, block_children, calls_in, children};

use crate::source::Span;
use crate::types::Type;
use albacore_program::{Channel, Guide};

/// Index into the variables of the declaration that owns it.
pub type VarId = usize;
/// Index of an activity.
pub type ActivityId = usize;
/// Index of a function.
pub type FnId = usize;
/// Index of an input.
pub type InputId = usize;

/// The values of the input `elapsed`, which the machine counts.
pub const ELAPSED: Interval = Interval { low: 0.0, ..Interval::ANY };

/// A checked program, before a mission is chosen.
#[derive(Clone, Debug, Default)]
pub struct Hir {
    /// Functions, those of the standard library included.
    pub fns: Vec<Function>,
    /// Activities, nested behaviors included.
    pub activities: Vec<Activity>,
    /// Inputs.
    pub inputs: Vec<Input>,
    /// Payloads.
    pub payloads: Vec<Payload>,
    /// Scenarios.
    pub scenarios: Vec<Scenario>,
    /// Tests.
    pub tests: Vec<Test>,
}

/// What a variable is, which tells who may change it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "each variant is the declaration of its name")]
pub enum VarKind {
    Param,
    Let,
    Var,
    Memory,
    Signal,
    Loop,
    Area,
}

impl VarKind {
    /// Whether it stays as it is from where it stands to the end of its block.
    pub fn is_fixed(self) -> bool {
        matches!(self, VarKind::Param | VarKind::Let | VarKind::Loop | VarKind::Area)
    }
}

/// A variable of a function or an activity. A nested behavior's variables belong to its strategy.
#[derive(Clone, Debug)]
pub struct Var {
    /// Its name.
    pub name: String,
    /// What it is.
    pub kind: VarKind,
    /// Its type.
    pub ty: Type,
    /// Where it is declared.
    pub span: Span,
    /// The values a number can have.
    pub range: Interval,
    /// A signal that holds for one tick at a time.
    pub is_momentary: bool,
    /// It walks a list of constants: an angle among them may stand for a heading, as each constant may.
    pub walks_constants: bool,
    /// In a list kept in order: which end comes first, and the key, a function of `it`.
    pub order: Option<Order>,
}

/// `by most KEY`.
#[derive(Clone, Debug)]
pub struct Order {
    /// The greatest comes first.
    pub most: bool,
    /// The variable `it`.
    pub it: VarId,
    /// The key.
    pub key: Box<Expr>,
}

/// A pure function.
#[derive(Clone, Debug)]
pub struct Function {
    /// Its name.
    pub name: String,
    /// Where it is declared.
    pub span: Span,
    /// All its variables, parameters first.
    pub vars: Vec<Var>,
    /// How many of them are parameters.
    pub params: usize,
    /// What it gives.
    pub result: Type,
    /// Its body.
    pub body: Block,
}

impl Function {
    /// One that is declared, and not checked yet.
    pub fn empty(name: &str, span: Span) -> Self {
        Function {
            name: name.to_string(),
            span,
            vars: Vec::new(),
            params: 0,
            result: Type::Unknown,
            body: Block::default(),
        }
    }
}

/// Statements, and the value of the last when it is one.
#[derive(Clone, Debug, Default)]
pub struct Block {
    /// The statements.
    pub stmts: Vec<Stmt>,
    /// The value.
    pub value: Option<Box<Expr>>,
}

/// An expression.
#[derive(Clone, Debug)]
pub struct Expr {
    /// What it is.
    pub kind: ExprKind,
    /// Its type.
    pub ty: Type,
    /// Where it stands.
    pub span: Span,
    /// The values a number can have, as far as is known.
    pub range: Interval,
}

impl Expr {
    /// The value of an optional that is known to be present; what is never absent is its own value. This is the only place
    /// that makes an [`ExprKind::Unwrap`], so that none stands over a value without a presence.
    pub fn unwrapped(self) -> Expr {
        match &self.ty {
            Type::Optional(inner) => {
                let (ty, span, range) = ((**inner).clone(), self.span, self.range);
                Expr { kind: ExprKind::Unwrap(Box::new(self)), ty, span, range }
            }
            _ => self,
        }
    }
}

/// What an expression is.
#[derive(Clone, Debug)]
#[allow(missing_docs, reason = "each variant is what it says")]
pub enum ExprKind {
    Number(f64),
    Geodetic {
        latitude_deg: f64,
        longitude_deg: f64,
    },
    Text(Vec<TextPart>),
    None,
    /// The body of the source behavior has come to its end.
    Done,
    Var(VarId),
    Input(InputId, InputPart),
    /// An optional made of a value.
    Present(Box<Expr>),
    /// The value of an optional that is known to be present.
    Unwrap(Box<Expr>),
    IsPresent(Box<Expr>),
    /// `x else y`.
    Else(Box<Expr>, Box<Expr>),
    /// A built-in operation on the values of its operands.
    Do(Builtin, Vec<Expr>),
    Call(FnId, Vec<Expr>),
    /// A record's fields in order.
    Record(Vec<Expr>),
    /// A record with other values in some parts, each so many words from its start.
    Changed(Box<Expr>, Vec<(u32, Expr)>),
    /// A list's elements in order.
    List(Vec<Expr>),
    /// A part of a value: so many words from its start.
    Part(Box<Expr>, u32),
    If(Box<Expr>, Block, Block),
    /// A value computed before and named, for `if let` and `while let`.
    Match(Box<Expr>, Vec<(Vec<usize>, Block)>, Option<Block>),
    /// `X for T`.
    HeldFor(Box<Expr>, Box<Expr>),
    /// `becomes X`.
    Becomes(Box<Expr>),
    /// `after T`.
    After(Box<Expr>),
    /// `every T`, in the condition of a rule or a reaction.
    Every(Box<Expr>),
}

/// What is read of an input.
#[derive(Clone, Debug)]
pub enum InputPart {
    /// Its latest sample.
    Value,
    /// A field, so many words from the sample's start.
    Field(u32),
    /// Seconds since the latest sample.
    Age,
    /// Whether a sample has come in this tick.
    IsNew,
    /// The largest sample since the last tick.
    Peak,
    /// How many of the last samples reached a limit.
    Hits(Box<Expr>, u32),
}

/// Operations that the machine knows. Operands are in the order of the names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "each variant is the operation of its name")]
pub enum Builtin {
    Add,
    Sub,
    Mul,
    Div,
    /// A number over another, absent where that is zero.
    Quotient,
    /// A vector over a number, absent where that is zero.
    VectorQuotient,
    AddInt,
    SubInt,
    MulInt,
    Pow,
    Neg,
    Abs,
    Min,
    Max,
    Sqrt,
    Exp,
    Ln,
    Atan2,
    Floor,
    Ceil,
    Round,
    Sin,
    Cos,
    /// Into [0, 2 pi).
    Heading,
    /// Into (-pi, pi].
    Angle,
    Lt,
    Le,
    Eq,
    Not,
    And,
    Or,
    AddVector,
    SubVector,
    /// A vector and a number.
    Scale,
    /// A length and a heading.
    Toward,
    Direction,
    Length,
    Dot,
    /// A vector or point, and a heading.
    Along,
    /// Two numbers side by side.
    Pair,
    Line,
    /// From the start of a line to its end.
    LineVector,
    Rectangle,
    Polygon,
    Hull,
    Center,
    Gap,
    /// An area, a heading, a point: its centre when none is given.
    Corner,
    /// An area, an index, a seed: 0 when none is given.
    Scattered,
    NearestEdge,
    EdgeGap,
    EdgeDistance,
    EdgeTangent,
    Exit,
    /// From a point to where a ray from it leaves the area.
    Run,
    /// A list's first so many.
    Top,
    /// A list and an index.
    At,
    /// An area and what each cell of a map over it holds.
    Map,
    /// A map and a point.
    Cell,
    Spread,
}

/// A statement.
#[derive(Clone, Debug)]
pub struct Stmt {
    /// What it does.
    pub kind: StmtKind,
    /// Where it stands.
    pub span: Span,
}

/// What a statement does.
#[derive(Clone, Debug)]
#[allow(missing_docs, reason = "each variant is the statement of its name")]
pub enum StmtKind {
    Set(VarId, Expr),
    Insert(VarId, Expr),
    Remove(VarId, Expr),
    Clear(VarId),
    /// An element of a list by its index, or of a map by its place, if there is one.
    Replace(VarId, Expr, Expr),
    If(Expr, Block, Block),
    Match(Expr, Vec<(Vec<usize>, Block)>, Option<Block>),
    ForRange {
        var: VarId,
        first: Expr,
        last: Expr,
        inclusive: bool,
        body: Block,
    },
    ForList {
        var: VarId,
        /// Of a map: what names the place.
        place: Option<VarId>,
        list: Expr,
        body: Block,
    },
    ForEdges {
        var: VarId,
        area: Expr,
        body: Block,
    },
    ForRows {
        var: VarId,
        rows: Box<RowPlan>,
        body: Block,
    },
    While {
        condition: Expr,
        bind: Option<VarId>,
        body: Block,
    },
    Loop(Block),
    With(Vec<With>, Block),
    Timed(Box<Timed>),
    Finish(Option<Expr>),
    Abort(Vec<TextPart>),
    Report {
        name: String,
        fields: Vec<(String, Expr)>,
    },
    Log(Vec<TextPart>),
}

/// The rows of an area.
#[derive(Clone, Debug)]
pub struct RowPlan {
    /// The area.
    pub area: Expr,
    /// How far they lie apart at most.
    pub step: Expr,
    /// Their heading: that of the longest edge, where none is given.
    pub along: Option<Expr>,
    /// They begin at the end that is nearest to it.
    pub near: Expr,
}

/// What `with` puts in force.
#[derive(Clone, Debug)]
#[allow(missing_docs, reason = "each variant is what it says")]
pub enum With {
    Setpoint(Channel, Expr),
    /// An overlay with its arguments, and where it is put on.
    Overlay(ActivityId, Vec<Expr>, Span),
}

/// A statement that takes time.
#[derive(Clone, Debug)]
pub struct Timed {
    /// What it does.
    pub action: Action,
    /// `for T`.
    pub duration: Option<Expr>,
    /// `until X`.
    pub until: Option<Expr>,
    /// `within T`.
    pub within: Option<Expr>,
    /// `at depth 3 m`.
    pub at: Vec<(Channel, Expr)>,
    /// The type of a call's result, where that is its outcome: of a behavior that is given as one without a result it is not.
    pub value: Option<Type>,
    /// Where its outcome goes: whether it ended by itself, or a call's result.
    pub result: Option<VarId>,
}

/// What a statement that takes time does.
#[derive(Clone, Debug)]
pub enum Action {
    /// Guidance with its arguments.
    Guide(Guide, Vec<Expr>),
    /// A setpoint read anew at every tick.
    Keep(Channel, Expr),
    /// A call with its arguments.
    Call(ActivityId, Vec<Expr>),
    /// The vehicle runs its own plan, and nothing is sent.
    Watch,
    /// Takes control, does what its block says, and gives control back however that ends.
    Override(Override),
    /// Asks a payload for one of its actions, by their places, and waits for the answer.
    Ask(usize, usize),
}

/// Something aboard that a mission asks to do things.
#[derive(Clone, Debug)]
pub struct Payload {
    /// Its name.
    pub name: String,
    /// What it does, by name, and where that is declared.
    pub actions: Vec<(String, Span)>,
}

impl Payload {
    /// One of its actions as vehicles know it: `camera.start`.
    pub fn action(&self, action: usize) -> String {
        self.actions.get(action).map_or_else(String::new, |(name, _)| format!("{}.{name}", self.name))
    }
}

/// `override when offered within T { … }` (rule 18).
#[derive(Clone, Debug)]
pub struct Override {
    /// Whether it waits for the vehicle to hand over of its own accord.
    pub offered: bool,
    /// How long it waits for control.
    pub answer: Option<Expr>,
    /// What is done in control.
    pub block: Block,
}

/// An input.
#[derive(Clone, Debug)]
pub struct Input {
    /// Its name.
    pub name: String,
    /// The type of its value.
    pub ty: Type,
    /// Its further fields.
    pub fields: Vec<(String, Type)>,
    /// Where those are declared.
    pub places: Vec<Span>,
}
