//! The lowered form of a checked mission: what the compiler gives and the machine executes. Plain data.
//!
//! Types and units are gone: every value is a run of 64-bit floating-point *words*, every name a *slot*, an offset from the
//! base of the frame of the declaration that owns it. There is no recursion in the language, so the frame of everything that
//! can ever be called has its place before launch, and the whole state of a run is one array of words.

mod activity;
pub mod calendar;
mod cause;
mod guide;
pub mod number;
mod op;
pub mod seen;
pub mod senses;
mod setpoint;
mod shape;
mod slot;
mod statement;
mod verify;

pub use activity::{
    Abort, Activity, ActivityId, ActivityKind, Body, CallSite, Entry, Exit, OverlaySite, ReportSite, Rule, Table,
    Target, Terms, Text, TextPart, Valued, Watched, WatchedCode, header,
};
pub use cause::{ANSWER_WORDS, Cause, OverrideEnd};
pub use guide::{Ends, GUIDANCE_WORDS, GuidanceLaw, Guide, Omitted, Param, ParamKind, Steering};
pub use op::{AreaOp, Compute, ListOp, MapOp, Op, When};
pub use setpoint::{Axis, Channel, Mark, Setpoint, SetpointKind, setpoints};
pub use shape::{AREA_CORNER_WORDS, Display, GRID_WORDS, ROW_PLACE_WORDS, ROWS_WORDS, Shape, area_words};
pub use slot::{ABSOLUTE, Addr, Slot};
pub use statement::{Loop, ROUND_WORDS, Rounds, Statement, StatementPart};
pub use verify::{Claim, Claims, Unit, Unsound};

pub(crate) use shape::EDGE_WORDS;

use albacore_arithmetic::Interval;
use albacore_geometry::Geodetic;
use serde::{Deserialize, Serialize};

/// The version of this form. A journal of another version is not resumed.
pub const PROGRAM_VERSION: u32 = 17;

/// A whole mission, ready to run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Program {
    /// All code.
    pub ops: Vec<Op>,
    /// Everything that can be active.
    pub activities: Vec<Activity>,
    /// Places where a body calls a behavior or a strategy.
    pub calls: Vec<CallSite>,
    /// Places where an overlay is put on.
    pub overlays: Vec<OverlaySite>,
    /// Switching rules, in textual order.
    pub rules: Vec<Rule>,
    /// What is recorded.
    pub recordings: Vec<Recording>,
    /// What it asks of payloads, such as `camera.start`.
    pub asks: Vec<String>,
    /// Places that report.
    pub reports: Vec<ReportSite>,
    /// Statements that tell when they begin.
    pub statements: Vec<Statement>,
    /// Texts with their holes: of `log` and `abort`.
    pub texts: Vec<Text>,
    /// Memories that rules change, for the trace.
    pub memories: Vec<Watched>,
    /// The inputs it reads.
    pub inputs: Vec<Input>,
    /// Numbers that code reads: they lie behind the inputs in a run's words.
    pub constants: Vec<f64>,
    /// What belongs to the mission alone.
    pub mission: Mission,
    /// How many words a run needs in all: inputs first, then constants, then the mission's frame.
    pub words: u32,
}

/// An area of a mission.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NamedArea {
    /// Its name.
    pub name: String,
    /// Its slot, in the mission's frame.
    pub at: Slot,
}

/// What belongs to the mission alone.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Mission {
    /// Its name.
    pub name: String,
    /// Its activity.
    pub activity: ActivityId,
    /// The base of its frame.
    pub base: Slot,
    /// Its operating area, and the regions of it that it names.
    pub areas: Vec<NamedArea>,
    /// Gives its parameters their values; run before anything else.
    pub params: Addr,
    /// Its time limit, in ticks.
    pub within: Option<Code>,
    /// Where the local frame touches the globe.
    pub origin: Option<Geodetic>,
    /// What no command may exceed.
    pub limits: Limits,
    /// The inputs it cannot do without.
    pub requires: Vec<Require>,
    /// What runs once after a time-out or an abort.
    pub recovery: Option<Recovery>,
    /// Whether it is a guest of its vehicle, which it drives in its overrides alone; otherwise from its start.
    pub guest: bool,
}

/// A piece of code that leaves a value in a slot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Code {
    /// Where it begins.
    pub entry: Addr,
    /// Where its value is afterwards.
    pub value: Slot,
}

/// The longest round trip over a vehicle's link on which a mission that names none goes on, s. Ours: at 2 m/s the vehicle is
/// then 4 m from where it says, about what dead reckoning between fixes comes to.
pub const LATENCY_MAX_S: f64 = 2.0;
/// For so long a mission holds on a link that lags, before it aborts, s.
pub const LATENCY_PATIENCE_S: f64 = 10.0;
/// The age, in seconds, beyond which what a vertical limit is held by counts for nothing: depth and altitude. A mission that
/// `requires` a younger altitude is held by that; one that lets it be older reads on, and its limits do not: at 2.5 m/s a bottom
/// that rises by 1 m in 10 m comes 1.25 m nearer in this time.
pub const LIMIT_FRESH_S: f64 = 5.0;
/// How long, in seconds, a mission holds for the depth that a vertical limit needs before it aborts, unless its `requires` says
/// otherwise.
pub const LIMIT_PATIENCE_S: f64 = 30.0;
/// The least limit on the rate of turn, rad/s: a tenth of a degree a second. No vehicle that goes anywhere turns more slowly.
pub const TURN_RATE_MIN: f64 = 0.1 * (std::f64::consts::PI / 180.0);

/// The most rows of what is recorded in a second: one a tick, Hz.
pub const RECORD_RATE_MAX: f64 = 1.0 / albacore_vehicle::TICK_S;

/// What no command may exceed: each is code, run at the mission's start.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Limits {
    /// Of the setpoints, each at the place of its channel.
    pub setpoints: [Bounds; Channel::ALL.len()],
    /// Radians per second of the course that is commanded, at most; else what the command filter has.
    pub turn_rate_max: Option<Code>,
    /// Ticks that the round trip over the vehicle's link may take; else [`LATENCY_MAX_S`].
    pub latency_max: Option<Code>,
}

/// The bounds of a setpoint.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Bounds {
    /// Its least value.
    pub least: Option<Code>,
    /// Its greatest value.
    pub greatest: Option<Code>,
}

/// An input that the mission cannot do without.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Require {
    /// Index into [`Program::inputs`].
    pub input: u32,
    /// The age in ticks beyond which it is stale.
    pub fresh: Code,
    /// What holds before the first sample.
    pub at_first: Option<Code>,
    /// How many ticks the mission holds before it aborts; none: it aborts at once.
    pub hold_for: Option<Code>,
}

/// What runs once after a time-out or an abort.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Recovery {
    /// The activity of its block, which shares the mission's frame.
    pub activity: ActivityId,
    /// Its time limit, in ticks.
    pub within: Option<Code>,
}

/// Inputs that are recorded while an activity is active; what a mission records, to the end of its run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Recording {
    /// Of which activity.
    pub activity: ActivityId,
    /// Indices into [`Program::inputs`], each with the labels of its further fields.
    pub inputs: Vec<(u32, Vec<String>)>,
    /// How often, Hz.
    pub rate: f64,
}

/// An input of a program.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Input {
    /// Its name, which is also the name of the vehicle's channel.
    pub name: String,
    /// Where its block of words begins. Absolute, as inputs belong to no frame.
    pub at: Slot,
    /// The words of its latest sample, fields included.
    pub width: u32,
    /// How many of its last samples are kept for `hits`.
    pub kept: u32,
    /// Its shape, for the trace.
    pub shape: Shape,
    /// The shapes of its further fields, which follow it in a sample.
    pub fields: Vec<Shape>,
}

/// The layout of an input's block of words, from its start.
impl Input {
    /// The tick of the latest sample; negative before the first.
    pub const STAMP: u32 = 0;
    /// The largest first number since the last tick, or the latest value when no sample came.
    pub const PEAK: u32 = 1;
    /// How many samples have come in all.
    pub const COUNT: u32 = 2;
    /// The latest sample.
    pub const VALUE: u32 = 3;

    /// Whether a sample can be a value of this input, with its further fields as far as it has them.
    pub fn admits(&self, sample: &[f64]) -> bool {
        let mut rest = sample;
        Self::is_bounded(sample)
            && self.shapes().all(|shape| {
                let Some((value, after)) = rest.split_at_checked(shape.words() as usize) else { return true };
                rest = after;
                shape.admits(value)
            })
    }

    /// Whether no number of a sample is larger than is kept: where nothing is counted that is all that is asked of it.
    #[inline]
    pub fn is_bounded(sample: &[f64]) -> bool {
        sample.iter().all(|x| Interval::ANY.holds(*x))
    }

    /// Whether some of its numbers count something, or say whether.
    pub fn counts(&self) -> bool {
        self.shapes().any(Shape::counts)
    }

    fn shapes(&self) -> impl Iterator<Item = &Shape> {
        std::iter::once(&self.shape).chain(&self.fields)
    }

    /// The words of its block.
    pub fn words(&self) -> u32 {
        Self::VALUE + self.width + self.kept
    }

    /// Where the ring of kept samples begins, from the start of the block.
    pub fn ring(&self) -> u32 {
        Self::VALUE + self.width
    }
}
