//! What happened in a tick, for traces and journals.

use albacore_program::{ActivityId, Cause, Channel};
use albacore_vehicle::Control;
use serde::{Deserialize, Serialize};

/// Something that happened. Words are values in the form that the program's shapes describe.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Event {
    /// Who drives has changed.
    Control(Control),
    /// An activity was entered.
    Entered(ActivityId),
    /// An activity was left.
    Left(ActivityId, Cause),
    /// An activity waits for another to be done (`then back`).
    Suspended(ActivityId),
    /// It goes on where it was.
    Resumed(ActivityId),
    /// A rule fired.
    Switched {
        /// Index into the program's rules.
        rule: u32,
        /// The behavior that was active.
        from: ActivityId,
        /// Which of its entry's exits fired.
        exit: u32,
        /// The words of the exit's watched values, one after the other. Of a rule with `done` and `then back` one more: whether the behavior
        /// had come to its end. Otherwise it is left as done, or not.
        values: Vec<f64>,
    },
    /// A rule changed a memory: index into the program's memories, and its words now.
    Remembered(u32, Vec<f64>),
    /// A report: index into the program's report sites, and the words of its fields, one after the other.
    Reported(u32, Vec<f64>),
    /// A line of log, its holes filled.
    Logged(String),
    /// An overlay begins to change the course: asked and given, in radians.
    Amending(ActivityId, f64, f64),
    /// It leaves the course alone again.
    AmendingEnded(ActivityId),
    /// A limit begins to hold a setpoint back: asked and given, in SI units.
    Limited(Channel, f64, f64),
    /// It no longer does.
    LimitedEnded(Channel),
    /// A required input is too old: index into the program's inputs.
    Stale(u32),
    /// It is fresh again.
    Fresh(u32),
    /// The mission is aborted.
    Aborted(String),
    /// The mission's time is up.
    TimedOut,
    /// The mission is over.
    Ended(Outcome),
    /// The mission waits for the first sample of a required input: index into the program's inputs.
    Awaited(u32),
    /// More is logged and reported than is written: from here on nothing is.
    Silenced,
    /// A place is to be kept, and the vehicle is carried off though it goes back: whether that is so from here on.
    Adrift(bool),
    /// So many lines of log and report were not written; from here on they are again.
    Unwritten(u64),
    /// The round trip over the vehicle's link takes longer than it may: s, and at most.
    Lagging(f64, f64),
    /// It no longer does.
    LaggingEnded,
    /// The mission's time is up by the host's clock, and not yet by the vehicle's: the two, s.
    HostTimeUp(f64, f64),
    /// How deep the water is below is not known any more: what a least altitude allows from here on, in metres of depth.
    BottomLost(f64),
    /// It is known again.
    BottomFound,
    /// The vehicle is deeper than its limits allow and does not rise: from here on it makes at least so much way, m/s.
    Lifted(f64),
    /// It is no longer too deep, as far as that is known.
    Risen,
    /// It has not risen, and makes no more way for it.
    LiftedInVain,
    /// Rules fire in more than every fourth tick, for seconds now: index into the program's rules, of the last.
    Restless(u32),
    /// They no longer do.
    Settled,
    /// A payload is asked: index into the program's `asks`.
    Asked(u32),
    /// What became of that.
    Answered(u32, Heard),
    /// A statement begins: index into the program's statements, and [`albacore_program::ROUND_WORDS`] words of each loop around it.
    /// It is told and decides nothing: no digest holds it.
    Began(u32, Vec<f64>),
    /// An activity that has a result has come to its own end, and is left next: the words of the result. No digest holds it either.
    Finished(ActivityId, Vec<f64>),
}

/// What a payload has answered.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Heard {
    /// Its value.
    Value(bool),
    /// That it will not.
    Refused,
    /// Nothing, for as long as it was awaited.
    Nothing,
}

/// How a mission ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Outcome {
    /// It came to its own end.
    Completed,
    /// Its time limit ended it.
    TimedOut,
    /// The script aborted it.
    Aborted,
    /// The person aborted it.
    Interrupted,
    /// The vehicle would not let us drive.
    Refused,
    /// The vehicle took control back.
    ReleasedByVehicle,
    /// The vehicle was heard no more.
    LinkLost,
    /// The vehicle or the machine failed.
    Failed,
    /// The vehicle lay on the bottom at its end, or for too long on the way.
    Aground,
}

impl Outcome {
    /// The outcome's name, as results carry it.
    pub fn name(self) -> &'static str {
        match self {
            Outcome::Completed => "completed",
            Outcome::TimedOut => "timed_out",
            Outcome::Aborted => "aborted",
            Outcome::Interrupted => "interrupted",
            Outcome::Refused => "refused",
            Outcome::ReleasedByVehicle => "released_by_vehicle",
            Outcome::LinkLost => "link_lost",
            Outcome::Failed => "failed",
            Outcome::Aground => "aground",
        }
    }
}
