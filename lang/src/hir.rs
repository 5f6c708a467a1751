//! The checked program: names resolved, types known, every conversion spelt out. What lowering reads.

use crate::source::Span;
use crate::types::Type;
use albacore_program::{Channel, Guide};

/// Index into [`Scope::vars`] of the declaration that owns it.
pub type VarId = usize;
/// Index of an activity.
pub type ActivityId = usize;
/// Index of a function.
pub type FnId = usize;
/// Index of an input.
pub type InputId = usize;

/// A checked program, before a mission is chosen.
#[derive(Clone, Debug, Default)]
pub struct Hir {
    /// Functions, those of the standard library included.
    pub fns: Vec<Function>,
    /// Activities, nested behaviors included.
    pub activities: Vec<Activity>,
    /// Inputs.
    pub inputs: Vec<Input>,
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
    /// All its variables, parameters first.
    pub vars: Vec<Var>,
    /// How many of them are parameters.
    pub params: usize,
    /// What it gives.
    pub result: Type,
    /// Its body.
    pub body: Block,
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

/// Bounds of a number, ends included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The least value.
    pub low: f64,
    /// The greatest value.
    pub high: f64,
    /// Zero is not among them although it lies between them.
    pub not_zero: bool,
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
}

/// A piece of a text.
#[derive(Clone, Debug)]
#[allow(missing_docs, reason = "each variant is what it says")]
pub enum TextPart {
    Literal(String),
    Hole(Expr),
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
    Pow,
    Neg,
    Abs,
    Min,
    Max,
    Sqrt,
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
    Rectangle,
    Polygon,
    Center,
    Gap,
    /// An area, a heading, a point.
    Corner,
    NearestEdge,
    EdgeGap,
    EdgeTangent,
    Exit,
    /// A list's first so many.
    Top,
    /// A list and an index.
    At,
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
    If(Expr, Block, Block),
    Match(Expr, Vec<(Vec<usize>, Block)>, Option<Block>),
    ForRange { var: VarId, first: Expr, last: Expr, inclusive: bool, body: Block },
    ForList { var: VarId, list: Expr, body: Block },
    ForEdges { var: VarId, area: Expr, body: Block },
    ForRows { var: VarId, area: Expr, step: Expr, body: Block },
    While { condition: Expr, bind: Option<VarId>, body: Block },
    Loop(Block),
    With(Vec<With>, Block),
    Timed(Box<Timed>),
    Finish(Option<Expr>),
    Abort(Vec<TextPart>),
    Report { name: String, fields: Vec<(String, Expr)> },
    Log(Vec<TextPart>),
}

/// What `with` puts in force.
#[derive(Clone, Debug)]
#[allow(missing_docs, reason = "each variant is what it says")]
pub enum With {
    Setpoint(Channel, Expr),
    Overlay(ActivityId, Vec<Expr>),
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
}

/// What kind of activity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "each variant is the kind of its name")]
pub enum Kind {
    Behavior,
    Strategy,
    AmendsCourse,
    Sets(Channel),
    Mission,
}

/// A behavior, strategy, overlay or mission.
#[derive(Clone, Debug)]
pub struct Activity {
    /// Its name as traces print it.
    pub name: String,
    /// The name by which it was declared, with its module.
    pub full_name: String,
    /// Which kind.
    pub kind: Kind,
    /// Where it is declared.
    pub span: Span,
    /// The strategy or mission in which it is nested, whose variables it shares.
    pub owner: Option<ActivityId>,
    /// All variables, parameters first; those of nested behaviors included.
    pub vars: Vec<Var>,
    /// How many of them are parameters.
    pub params: usize,
    /// The parameters' defaults.
    pub defaults: Vec<Option<Expr>>,
    /// What it finishes with.
    pub result: Option<Type>,
    /// Declarations in textual order.
    pub decls: Vec<Decl>,
    /// `abort "…" on X`.
    pub aborts: Vec<(Vec<TextPart>, Expr)>,
    /// `on X { }`.
    pub reactions: Vec<(Expr, Block)>,
    /// What it does.
    pub body: Body,
    /// What belongs to a mission alone.
    pub mission: Option<Mission>,
}

/// A declaration of an activity.
#[derive(Clone, Debug)]
#[allow(missing_docs, reason = "each variant is the declaration of its name")]
pub enum Decl {
    With(Vec<With>),
    Signal(VarId, Expr),
    Memory(VarId, Option<Expr>),
    Area(VarId, Expr),
}

/// What an activity does.
#[derive(Clone, Debug)]
#[allow(missing_docs, reason = "each variant is what it says")]
pub enum Body {
    Sequence(Block),
    Table { start: usize, behaviors: Vec<ActivityId>, rules: Vec<Rule> },
    Amend { asked: VarId, block: Block },
}

/// A switching rule.
#[derive(Clone, Debug)]
pub struct Rule {
    /// Indices into the table's behaviors.
    pub sources: Vec<usize>,
    /// Where it leads.
    pub target: Target,
    /// Its guard.
    pub on: Expr,
    /// `then back`.
    pub back: bool,
    /// `do { }`.
    pub effect: Option<Block>,
    /// Where it stands.
    pub span: Span,
    /// Where its guard stands.
    pub on_span: Span,
}

/// Where a rule leads.
#[derive(Clone, Debug)]
#[allow(missing_docs, reason = "each variant is what it says")]
pub enum Target {
    Behavior(usize),
    Finish(Option<Expr>),
    Abort(Vec<TextPart>),
}

/// What belongs to a mission alone.
#[derive(Clone, Debug, Default)]
pub struct Mission {
    /// The scenario it names.
    pub scenario: Option<String>,
    /// Its time limit.
    pub within: Option<Expr>,
    /// Its operating area.
    pub area: Option<VarId>,
    /// `channel >= value`: channel, whether it is the least value, the value.
    pub limits: Vec<(Channel, bool, Expr)>,
    /// The inputs it cannot do without.
    pub requires: Vec<Require>,
    /// What runs after a time-out or an abort.
    pub recovery: Option<(Option<Expr>, Block)>,
}

/// An input that a mission cannot do without.
#[derive(Clone, Debug)]
pub struct Require {
    /// Which.
    pub input: InputId,
    /// The age beyond which it is stale.
    pub fresh: Expr,
    /// What holds before the first sample.
    pub at_first: Option<Expr>,
    /// How long the mission holds before it aborts.
    pub hold_for: Option<Expr>,
}

/// A scenario: clauses with their arguments.
#[derive(Clone, Debug)]
pub struct Scenario {
    /// Its name.
    pub name: String,
    /// Its parameters.
    pub vars: Vec<Var>,
    /// Their defaults.
    pub defaults: Vec<Option<Expr>>,
    /// What it says, in order.
    pub clauses: Vec<ClauseUse>,
}

/// A clause of a scenario.
#[derive(Clone, Debug)]
pub struct ClauseUse {
    /// Which.
    pub name: String,
    /// Where it stands.
    pub span: Span,
    /// Its arguments by the names of the clause's parameters, defaults included.
    pub args: Vec<(String, ClauseArg)>,
}

/// An argument of a clause.
#[derive(Clone, Debug)]
#[allow(missing_docs, reason = "each variant is what it says")]
pub enum ClauseArg {
    Value(Expr),
    Nested(ClauseUse),
}

/// A test.
#[derive(Clone, Debug)]
pub struct Test {
    /// What it is called.
    pub name: String,
    /// Where its name stands.
    pub span: Span,
    /// The mission that it runs.
    pub mission: ActivityId,
    /// The mission's arguments.
    pub args: Vec<Expr>,
    /// The scenario, by its index.
    pub scenario: usize,
    /// The seeds, both ends included.
    pub seeds: (u64, u64),
    /// What must hold.
    pub expects: Vec<Expect>,
    /// The seeds whose switches are compared with a snapshot.
    pub snapshots: Vec<u64>,
    /// The variables that expectations speak of.
    pub vars: Vec<Var>,
    /// Which of them is what.
    pub known: TestVars,
}

/// What expectations can speak of.
#[derive(Clone, Debug)]
pub struct TestVars {
    /// The vehicle's true position.
    pub position: VarId,
    /// The true source nearest to the latest report, else to the vehicle.
    pub nearest_source: VarId,
    /// Where the vehicle started.
    pub start: VarId,
    /// The deepest point of the mission's area.
    pub deepest: VarId,
    /// The points whose true water depth is asked for, and where the answers go; what one asks with comes before it.
    pub depths: Vec<(Expr, VarId)>,
    /// Since the run began.
    pub time: VarId,
    /// Whether the mission came to its own end.
    pub completed: VarId,
    /// The mission's area.
    pub area: VarId,
    /// The mission.
    pub mission: ActivityId,
    /// By name, where it was first reported.
    pub reported: Vec<(String, VarId)>,
    /// By name, when it was first reported.
    pub reported_at: Vec<(String, VarId)>,
}

/// An expectation.
#[derive(Clone, Debug)]
pub struct Expect {
    /// When it must hold.
    pub when: When,
    /// The condition.
    pub holds: Expr,
    /// Where it stands.
    pub span: Span,
}

/// When an expectation must hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum When {
    /// At the end of this share of the runs.
    AtTheEnd(f64),
    /// At every tick of every run.
    Always,
}

impl Activity {
    /// One of which only the name is known yet.
    pub fn empty(name: &str, span: Span) -> Self {
        Activity {
            name: name.rsplit('.').next().unwrap_or(name).to_string(),
            full_name: name.to_string(),
            kind: Kind::Behavior,
            span,
            owner: None,
            vars: Vec::new(),
            params: 0,
            defaults: Vec::new(),
            result: None,
            decls: Vec::new(),
            aborts: Vec::new(),
            reactions: Vec::new(),
            body: Body::Sequence(Block::default()),
            mission: None,
        }
    }
}

impl Interval {
    /// Any number.
    pub const ANY: Interval = Interval { low: f64::NEG_INFINITY, high: f64::INFINITY, not_zero: false };

    /// One number.
    pub fn exactly(value: f64) -> Self {
        Interval { low: value, high: value, not_zero: value != 0.0 }
    }

    /// From one number to another, ends included.
    pub fn new(low: f64, high: f64) -> Self {
        Interval { low, high, not_zero: low > 0.0 || high < 0.0 }
    }

    /// The number, when it can be only one.
    pub fn constant(self) -> Option<f64> {
        (self.low == self.high).then_some(self.low)
    }

    /// Whether zero is impossible.
    pub fn excludes_zero(self) -> bool {
        self.not_zero || self.low > 0.0 || self.high < 0.0
    }
}
