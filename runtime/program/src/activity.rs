//! What can be active: missions, strategies, behaviors, overlays, and the table that switches between them.

use crate::{Addr, Axis, Code, Shape, Slot};
use serde::{Deserialize, Serialize};

/// Index into [`crate::Program::activities`].
pub type ActivityId = u32;

/// The words that every activity keeps for the machine, at its `header`.
pub mod header {
    /// Where its body goes on: an address, or [`ENDED`].
    pub const PC: u32 = 0;
    /// Ticks lived: 0 on the tick of entry. Stands still while suspended, and with it every timer.
    pub const AGE: u32 = 1;
    /// [`IDLE`], [`ACTIVE`] or [`SUSPENDED`].
    pub const STATE: u32 = 2;
    /// One more than the index of the call that is active in its body, or of its active behavior; 0 for none.
    pub const CHILD: u32 = 3;
    /// In a behavior entered `then back`: one more than the index of the behavior that waits.
    pub const BACK_TO: u32 = 4;
    /// The setpoints in force in it: see [`crate::setpoints`].
    pub const SETPOINTS: u32 = 5;
    /// In an overlay: 1 while the trace has been told that it changes the course.
    pub const AMENDING: u32 = SETPOINTS + crate::setpoints::WORDS;
    /// How many words that is.
    pub const WORDS: u32 = AMENDING + 1;

    /// Not entered, or left.
    pub const IDLE: f64 = 0.0;
    /// Entered and not left.
    pub const ACTIVE: f64 = 1.0;
    /// Waiting for another behavior to be done.
    pub const SUSPENDED: f64 = 2.0;
    /// The address of a body that came to its end.
    pub const ENDED: f64 = -1.0;
}

/// What kind of activity, where the machine treats them differently.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum ActivityKind {
    /// A sequence of statements.
    Behavior,
    /// Behaviors and a switching table.
    Strategy,
    /// Amends the course of whatever is active beneath it.
    AmendsCourse,
    /// Commands nothing.
    Beside,
    /// Owns an axis of the command.
    Sets(Axis),
    /// The top.
    Mission,
    /// The mission's recovery.
    Recovery,
    /// A block in which a guest drives its vehicle.
    Override,
}

/// Something that can be active.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Activity {
    /// Its name as traces print it.
    pub name: String,
    /// Where it is declared, `file:line`.
    pub place: String,
    /// What kind.
    pub kind: ActivityKind,
    /// Where its header is, from the base of its frame.
    pub header: Slot,
    /// Its declarations, in textual order, run at entry.
    pub entry: Addr,
    /// Its signals and timers, run at the beginning of each step.
    pub refresh: Addr,
    /// Conditions that abort the mission, in textual order.
    pub aborts: Vec<Abort>,
    /// Its reactions, run at each step after its rules.
    pub reactions: Addr,
    /// What it does.
    pub body: Body,
    /// Its overlays, innermost first: indices into [`crate::Program::overlays`].
    pub overlays: Vec<u32>,
    /// The words it finishes with, and where they are.
    pub result: Option<Valued>,
}

/// What an activity does.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Body {
    /// Statements, one after the other.
    Sequence(Addr),
    /// Behaviors, one at a time.
    Table(Table),
    /// `amend`: code that finds the asked course in `asked` and leaves the new one in `value`.
    Amend {
        /// Where the asked course is put, in radians.
        asked: Slot,
        /// The code, and where the new course is.
        amended: Code,
    },
}

/// Behaviors, one active at a time, and the rules that switch.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Table {
    /// Which is entered first.
    pub start: u32,
    /// The behaviors.
    pub behaviors: Vec<Entry>,
}

/// A behavior in a table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Entry {
    /// Which activity. It shares the frame of its strategy.
    pub activity: ActivityId,
    /// Sets back the timers of its rules; run when it is entered.
    pub arm: Addr,
    /// Updates the timers of its rules; run on every tick before they are tried.
    pub watch: Addr,
    /// The rules that may leave it, in textual order.
    pub exits: Vec<Exit>,
}

/// A rule as it applies to one behavior.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Exit {
    /// Index into [`crate::Program::rules`].
    pub rule: u32,
    /// The guard when the body has not come to its end in this tick.
    pub guard: Code,
    /// The guard when it has; none for a rule that does not mention `done`.
    pub guard_done: Option<Code>,
    /// What the trace prints of the guard.
    pub watched: Vec<WatchedCode>,
    /// What the guard is made of.
    pub terms: Option<Terms>,
    /// The same when the body has come to its end.
    pub terms_done: Option<Terms>,
}

/// What a condition of several terms is made of, for whoever asks why it held or did not: a run does not execute it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Terms {
    /// The condition once more. It leaves a word for each term: 1 if that held, 0 if not, -1 if those before it had decided.
    pub code: Code,
    /// Each term as it is written, and how deep it is in terms before it: `a` is in `a for 3 s`, and what a signal is made of in the
    /// signal.
    pub texts: Vec<(String, u32)>,
}

/// A switching rule.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rule {
    /// As it is written, from the arrow to the guard.
    pub text: String,
    /// `file:line`.
    pub place: String,
    /// Where it leads.
    pub target: Target,
    /// `then back`.
    pub back: bool,
    /// `do { }`.
    pub effect: Option<Addr>,
}

/// Where a rule leads.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Target {
    /// Another behavior of the table.
    Behavior(u32),
    /// The end of the strategy, its result computed by this code.
    Finish(Option<Addr>),
    /// The end of the mission: index into [`crate::Program::texts`].
    Abort(u32),
}

/// `abort "why" on X`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Abort {
    /// The condition as it is written.
    pub text: String,
    /// `file:line`.
    pub place: String,
    /// The condition.
    pub condition: Code,
    /// The names in it and their values.
    pub watched: Vec<WatchedCode>,
    /// What it is made of.
    pub terms: Option<Terms>,
    /// Index into [`crate::Program::texts`].
    pub why: u32,
}

/// A place where a body calls a behavior or a strategy. Its arguments are computed straight into the callee's frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CallSite {
    /// What is called.
    pub activity: ActivityId,
    /// The header of the caller, in its frame.
    pub caller: Slot,
    /// The base of the callee's frame, from the base of the caller's.
    pub base: Slot,
    /// The setpoints it inherits, in the caller's frame.
    pub setpoints: Slot,
}

/// A place where an overlay is put on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OverlaySite {
    /// Which overlay.
    pub activity: ActivityId,
    /// The base of its frame, from the base of the wearer's.
    pub base: Slot,
}

/// A place that reports.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReportSite {
    /// What is reported.
    pub name: String,
    /// Its value and its further fields, with their labels; the first label is empty.
    pub fields: Vec<(String, Valued)>,
}

/// Literal parts and holes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Text {
    /// The parts in order.
    pub parts: Vec<TextPart>,
}

impl Text {
    /// The text as it is told, if it has no holes and is the same whenever it is told.
    pub fn plain(&self) -> Option<String> {
        let literal = |part: &TextPart| match part {
            TextPart::Literal(literal) => Some(literal.clone()),
            TextPart::Hole(_) => None,
        };
        self.parts.iter().map(literal).collect()
    }
}

/// A part of a text.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum TextPart {
    /// As written.
    Literal(String),
    /// A value, found in a slot when the text is used.
    Hole(Valued),
}

/// Words in a slot, and how to read them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Valued {
    /// Where.
    pub slot: Slot,
    /// What they mean.
    pub shape: Shape,
}

/// A named value that the trace follows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Watched {
    /// Its name.
    pub name: String,
    /// Where it is and what it means.
    pub value: Valued,
}

/// A named value that is computed for the trace.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WatchedCode {
    /// Its name.
    pub name: String,
    /// How to compute it.
    pub code: Code,
    /// What it means.
    pub shape: Shape,
}
