//! The syntax tree: what was written, every node with its place.

mod expr;
mod operators;

pub use expr::{Expr, ExprKind, MatchArm, TextPart};
pub use operators::{Binary, Unary};

use crate::source::{Span, Spanned};

/// A name and where it stands.
pub type Name = Spanned<String>;

/// A name with the modules before it, `search.find`.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// The names between the dots.
    pub parts: Vec<Name>,
    /// All of it.
    pub span: Span,
}

impl Path {
    /// As it is written.
    pub fn text(&self) -> String {
        self.parts.iter().map(|p| p.node.as_str()).collect::<Vec<_>>().join(".")
    }
}

/// A file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct File {
    /// Its items, in order.
    pub items: Vec<Item>,
}

/// What may stand at the left margin.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "each variant is the item of its name")]
pub enum Item {
    Use(Vec<Path>),
    Const(Const),
    Enum { name: Name, variants: Vec<Name> },
    Record { name: Name, fields: Vec<Field> },
    Unit { name: Name, value: Expr },
    Input { name: Name, ty: Ty, fields: Vec<Field> },
    Clause { name: Name, params: Vec<Param>, result: Option<Ty>, of_vehicle: bool },
    Fn(Function),
    Signal { name: Name, ty: Option<Ty>, value: Expr },
    Activity(Activity),
    Scenario { name: Name, params: Vec<Param>, base: Option<Path>, body: Block },
    Vehicle { name: Name, base: Option<Path>, body: Block },
    Payload { name: Name, actions: Vec<PayloadAction> },
    Test(Test),
}

/// `const name: type = value`.
#[derive(Clone, Debug, PartialEq)]
pub struct Const {
    /// Its name.
    pub name: Name,
    /// Its type, when written.
    pub ty: Option<Ty>,
    /// Its value.
    pub value: Expr,
}

/// `start() -> Bool` of a payload.
#[derive(Clone, Debug, PartialEq)]
pub struct PayloadAction {
    /// Its name.
    pub name: Name,
    /// The type of what it is answered with.
    pub result: Ty,
}

/// `label: type` of a record or an input.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Its label.
    pub name: Name,
    /// Its type.
    pub ty: Ty,
}

/// `fn name(params) -> type { … }`.
#[derive(Clone, Debug, PartialEq)]
pub struct Function {
    /// Its name.
    pub name: Name,
    /// What it takes.
    pub params: Vec<Param>,
    /// What it gives.
    pub result: Ty,
    /// Its body, whose last expression is its value.
    pub body: Block,
}

/// `name: type = default in range`.
#[derive(Clone, Debug, PartialEq)]
pub struct Param {
    /// Its name.
    pub name: Name,
    /// Its type.
    pub ty: Ty,
    /// The value when none is given.
    pub default: Option<Expr>,
    /// The values it may have.
    pub range: Option<Range>,
}

/// `first .. last` or `first ..< end`.
#[derive(Clone, Debug, PartialEq)]
pub struct Range {
    /// The first value.
    pub first: Expr,
    /// The last value, or with `..<` the one after it.
    pub last: Expr,
    /// `..` rather than `..<`.
    pub inclusive: bool,
}

/// A type as it is written.
#[derive(Clone, Debug, PartialEq)]
pub struct Ty {
    /// What it is.
    pub kind: TyKind,
    /// `?`: it may be absent.
    pub optional: bool,
    /// Where it stands.
    pub span: Span,
}

/// What a written type is.
#[derive(Clone, Debug, PartialEq)]
pub enum TyKind {
    /// `Length`, `cpt.Source`, or with factors `Length^2/Duration`.
    Named {
        /// The first name.
        path: Path,
        /// Further names with their powers.
        factors: Vec<(Name, f64)>,
    },
    /// `behavior(Point) -> Bool`, with the types of what it is called with and of the result that is read.
    Behavior(Vec<Ty>, Option<Box<Ty>>),
    /// `Map[Ratio; 900]`.
    Map {
        /// What a cell holds.
        element: Box<Ty>,
        /// How many cells there are at most.
        cells: Box<Expr>,
    },
    /// `[Point; 6] by most KEY`.
    List {
        /// What it holds.
        element: Box<Ty>,
        /// How many at most.
        capacity: Box<Expr>,
        /// Whether the greatest comes first, and by which key.
        order: Option<(bool, Box<Expr>)>,
    },
}

/// What kind of activity.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "each variant is the keyword of its name")]
pub enum ActivityKind {
    Behavior,
    /// What it is derived from.
    Strategy {
        base: Option<Path>,
    },
    /// Its verb and channel, `amends course`; one without runs beside.
    Overlay {
        does: Option<(Name, Name)>,
    },
    Mission {
        scenario: Option<Path>,
        within: Option<Expr>,
    },
}

/// `behavior`, `strategy`, `overlay` or `mission`.
#[derive(Clone, Debug, PartialEq)]
pub struct Activity {
    /// Which of them.
    pub kind: ActivityKind,
    /// Its name.
    pub name: Name,
    /// What it takes.
    pub params: Vec<Param>,
    /// What it finishes with.
    pub result: Option<Ty>,
    /// Its declarations, rules, reactions and statements.
    pub body: Block,
}

/// `{ … }`.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// What stands in it.
    pub clauses: Vec<Clause>,
    /// Braces included.
    pub span: Span,
}

/// One clause of a block.
#[derive(Clone, Debug, PartialEq)]
pub struct Clause {
    /// What it is.
    pub kind: ClauseKind,
    /// All of it.
    pub span: Span,
}

/// What may stand in a block. Which block may hold which is for the checker to say.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "each variant is the clause of its name")]
pub enum ClauseKind {
    Behavior(Activity),
    With(Vec<WithItem>),
    Signal {
        name: Name,
        ty: Option<Ty>,
        value: Expr,
    },
    Memory {
        name: Name,
        ty: Ty,
        init: Option<Expr>,
    },
    Let {
        name: Name,
        ty: Option<Ty>,
        value: Timed,
    },
    Var {
        name: Name,
        ty: Option<Ty>,
        value: Expr,
    },
    /// `name = value`, or one element of a list, `name[index] = value`.
    Assign {
        name: Name,
        index: Option<Expr>,
        value: Expr,
    },
    Reaction {
        on: Expr,
        block: Block,
    },
    Start(Name),
    Rule(SwitchingRule),
    Area {
        name: Name,
        value: Expr,
    },
    Limits(Vec<Expr>),
    Requires(Vec<Require>),
    Recovery {
        within: Option<Expr>,
        block: Block,
    },
    /// `record a, b at 1 Hz`.
    Recording {
        inputs: Vec<Name>,
        rate: Expr,
    },
    Amend(Block),
    Abort {
        why: Expr,
        on: Option<Expr>,
    },
    Finish(Option<Expr>),
    Report {
        name: Expr,
        value: Expr,
        fields: Vec<(Name, Expr)>,
    },
    Log(Expr),
    For {
        name: Name,
        /// Of a map: the name of the place.
        place: Option<Name>,
        over: ForOver,
        block: Block,
    },
    While {
        condition: Condition,
        block: Block,
    },
    Loop(Block),
    Timed(Timed),
}

/// `with safety.cage(op), altitude 2 m`.
#[derive(Clone, Debug, PartialEq)]
pub enum WithItem {
    /// A channel held.
    Setpoint(Setpoint),
    /// An overlay put on.
    Overlay(Expr),
}

/// `depth 3 m`.
#[derive(Clone, Debug, PartialEq)]
pub struct Setpoint {
    /// `depth`, `altitude` or `speed`.
    pub channel: Name,
    /// What it is held at.
    pub value: Expr,
    /// All of it.
    pub span: Span,
}

/// What a `for` walks.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "each variant is what it says")]
pub enum ForOver {
    Range(Range),
    List(Expr),
}

/// The condition of `if` and `while`.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "each variant is what it says")]
pub enum Condition {
    Holds(Expr),
    Let { name: Name, value: Expr },
}

/// `A, B -> C on X then back do { }`.
#[derive(Clone, Debug, PartialEq)]
pub struct SwitchingRule {
    /// The behaviors left; none means `any`.
    pub sources: Vec<Name>,
    /// Where the sources stand.
    pub sources_span: Span,
    /// What is entered or ended.
    pub target: Target,
    /// The guard.
    pub on: Expr,
    /// `then back`.
    pub back: Option<Span>,
    /// `do { }`.
    pub effect: Option<Block>,
}

/// Where a rule leads.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "each variant is what it says")]
pub enum Target {
    Behavior(Name),
    Finish(Option<Expr>, Span),
    Abort(Expr, Span),
}

/// `position, course fresh 5 s, at first X, else abort`.
#[derive(Clone, Debug, PartialEq)]
pub struct Require {
    /// The inputs.
    pub inputs: Vec<Name>,
    /// The age beyond which they are stale.
    pub fresh: Expr,
    /// What holds before the first sample.
    pub at_first: Option<Expr>,
    /// `hold for T then abort`; `abort` at once when `None`.
    pub hold_for: Option<Expr>,
    /// Whether a response is written.
    pub answered: bool,
}

/// A statement with the modifiers that bound it in time.
#[derive(Clone, Debug, PartialEq)]
pub struct Timed {
    /// What is done.
    pub action: Action,
    /// `for T`.
    pub duration: Option<Expr>,
    /// `until X`.
    pub until: Option<Expr>,
    /// `within T`.
    pub within: Option<Expr>,
    /// `at depth 3 m, speed 1 m/s`.
    pub at: Vec<Setpoint>,
    /// A modifier written twice.
    pub repeated: Option<Span>,
    /// All of it.
    pub span: Span,
}

impl Timed {
    /// Whether any modifier is written.
    pub fn is_modified(&self) -> bool {
        self.duration.is_some() || self.until.is_some() || self.within.is_some() || !self.at.is_empty()
    }
}

/// What a statement does.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "each variant is the statement of its name")]
pub enum Action {
    Guide { verb: Name, args: Vec<Arg> },
    Keep(Setpoint),
    Hold,
    Wait,
    Watch,
    Override(Override),
    Ask(Ask),
    Expr(Expr),
}

/// `ask camera.start()`.
#[derive(Clone, Debug, PartialEq)]
pub struct Ask {
    /// The payload.
    pub payload: Path,
    /// What it is asked to do.
    pub action: Name,
}

/// `override when offered within T { … }`.
#[derive(Clone, Debug, PartialEq)]
pub struct Override {
    /// Whether it waits for the vehicle to hand over of its own accord.
    pub offered: bool,
    /// How long it waits for control.
    pub answer: Option<Expr>,
    /// What is done in control.
    pub block: Block,
}

/// `label: value`, or `value`.
#[derive(Clone, Debug, PartialEq)]
pub struct Arg {
    /// The label, when written.
    pub label: Option<Name>,
    /// The value.
    pub value: Expr,
}

/// `test "…" { … }`.
#[derive(Clone, Debug, PartialEq)]
pub struct Test {
    /// What it is called.
    pub name: Expr,
    /// Its clauses.
    pub clauses: Vec<Spanned<TestClause>>,
    /// All of it.
    pub span: Span,
}

/// A clause of a test.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "each variant is the clause of its name")]
pub enum TestClause {
    Run {
        mission: Path,
        args: Vec<Arg>,
        scenario: Path,
        seeds: Range,
    },
    /// A row of the table of the mission's parameters.
    Row {
        args: Vec<Arg>,
    },
    Expect {
        mode: ExpectMode,
        holds: Expr,
    },
    SnapshotSwitches {
        seed: f64,
    },
}

/// In which runs and when an expectation must hold.
#[derive(Clone, Debug, PartialEq)]
pub enum ExpectMode {
    /// At the end of every run.
    EveryRun,
    /// At the end of this share of the runs.
    ShareOfRuns(Expr),
    /// At every tick of every run.
    Always,
    /// At some tick of every run.
    Once,
    /// At every tick in which a behavior is active.
    While(Path),
}
