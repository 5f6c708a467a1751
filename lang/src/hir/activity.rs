//! Behaviors, strategies, overlays and missions.

use super::{ActivityId, Block, Expr, InputId, TextPart, Var, VarId, With};
use crate::source::Span;
use crate::types::Type;
use albacore_program::{Axis, Channel};

/// What kind of activity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[allow(missing_docs, reason = "each variant is the kind of its name")]
pub enum Kind {
    Behavior,
    Strategy,
    AmendsCourse,
    /// An overlay that commands nothing.
    Beside,
    Sets(Axis),
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
    /// `record a, b at 1 Hz`.
    pub recordings: Vec<Recording>,
    /// What it does.
    pub body: Body,
    /// What belongs to a mission alone.
    pub mission: Option<Mission>,
}

/// What is recorded while an activity is active.
#[derive(Clone, Debug)]
pub struct Recording {
    /// The inputs, each with where it is named.
    pub inputs: Vec<(InputId, Span)>,
    /// How often, Hz.
    pub rate: f64,
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

/// For each behavior of a table the rules that leave it, in their order.
pub fn leaving(rules: &[Rule], behaviors: usize) -> Vec<Vec<usize>> {
    let mut leaving = vec![Vec::new(); behaviors];
    for (i, rule) in rules.iter().enumerate() {
        for &source in &rule.sources {
            if leaving[source].last() != Some(&i) {
                leaving[source].push(i);
            }
        }
    }
    leaving
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
    /// Its operating area, and the regions of it that it names.
    pub areas: Vec<VarId>,
    /// `channel >= value`: channel, whether it is the least value, the value.
    pub limits: Vec<(Channel, bool, Expr)>,
    /// The fastest turn that is commanded.
    pub turn_rate: Option<Expr>,
    /// The longest round trip over the vehicle's link.
    pub latency: Option<Expr>,
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
    /// Where it is named.
    pub span: Span,
    /// The age beyond which it is stale.
    pub fresh: Expr,
    /// What holds before the first sample.
    pub at_first: Option<Expr>,
    /// How long the mission holds before it aborts.
    pub hold_for: Option<Expr>,
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
            recordings: Vec::new(),
            body: Body::Sequence(Block::default()),
            mission: None,
        }
    }
}
