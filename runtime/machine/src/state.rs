//! The state of a run: one plain value.

use crate::aground::Aground;
use crate::allowance::Allowance;
use crate::bottom::{Bottom, Chart};
use crate::bound::Bound;
use crate::lift::Lift;
use crate::payload::{Question, Request};
use crate::rest::Rest;
use crate::sinking::Sinking;
use crate::tried::Tried;
use crate::trig::Trig;
use crate::{Event, Outcome};
use albacore_geometry::Heading;
use albacore_guidance::parameters::TURN_RATE_MAX;
use albacore_program::{Axis, Channel, LATENCY_MAX_S, LATENCY_PATIENCE_S, Slot, setpoints};
use albacore_vehicle::{Command, Control, Lag, TICK_S, Vertical};
use serde::{Deserialize, Serialize};

/// Everything that a run remembers from one tick to the next.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Inputs first, then the mission's frame with all that is inside it.
    pub words: Vec<f64>,
    /// The tick that comes next.
    pub tick: u64,
    /// What the mission is about.
    pub phase: Phase,
    /// What was asked last, before amendments and limits.
    pub(crate) asked: Asked,
    /// What we want of the vehicle.
    pub(crate) wish: ControlRequest,
    /// What was commanded last.
    pub command: Option<Command>,
    /// The course behind the command filter.
    pub(crate) filtered: Heading,
    /// Who drove last.
    pub(crate) control: Control,
    /// The mission's limits, once it runs.
    pub(crate) limits: Limits,
    /// What is known of the water below.
    pub(crate) bottom: Bottom,
    /// The vehicle deeper than it may be.
    pub(crate) lift: Lift,
    /// The tick in which that was looked at last.
    pub(crate) lift_tick: u64,
    /// How fast the vehicle has sunk lately.
    pub(crate) sinking: Sinking,
    /// The vehicle on the bottom.
    pub(crate) aground: Aground,
    /// Whether the heading and the depth of the very start have been taken.
    pub(crate) stands: bool,
    /// The depth that was sampled last while the mission waited, and in which tick; and whether it can have followed the one before.
    pub(crate) depth_before: Option<(f64, f64)>,
    pub(crate) depth_agrees: bool,
    /// For each channel whether a limit holds it back.
    pub(crate) limited: [bool; Channel::ALL.len()],
    /// For each requirement the ticks of its freshness and of its patience, and whether it is stale.
    pub(crate) requires: Vec<Requirement>,
    /// For so many ticks an echo tells where the bottom is: as long as the mission takes an altitude for fresh, or as the limits do.
    pub(crate) echo_fresh: f64,
    /// The same of the vehicle's link: the longest round trip for freshness.
    pub(crate) link: Requirement,
    /// For how long it has taken longer, half ticks: a tick within it makes up for half a tick beyond.
    pub(crate) lagged: u64,
    /// How far behind the vehicle this tick is.
    pub(crate) lag: Lag,
    /// What the mission's own declarations have put in force: that stays for the recovery.
    pub(crate) declared: Declared,
    /// The time limit in ticks of the mission, and later of its recovery, and the tick from which it counts: the first on
    /// which we drive.
    pub(crate) within: Option<f64>,
    pub(crate) began: u64,
    /// The first tick on which we drive.
    pub(crate) drives_since: Option<u64>,
    /// The same by the host's clock, where it counts.
    pub(crate) host_began: u64,
    /// Channels that overlays set in this tick.
    pub(crate) overridden: Overridden,
    /// The way back to a place that is kept, of this tick: a course and a speed over ground.
    pub(crate) way_back: Option<(Heading, f64)>,
    /// What may still be written by `log` and `report`.
    pub(crate) allowance: Allowance,
    /// How often rules have fired of late.
    pub(crate) rest: Rest,
    /// What payloads have been asked, and who asked has not taken the answer yet.
    pub(crate) questions: Vec<Question>,
}

/// Where a mission is in its life.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Phase {
    /// Before control is ours.
    Waiting,
    /// We drive, and required inputs have not come yet.
    Awaiting,
    /// Under way.
    Running,
    /// A required input is stale: the vehicle stays, since this many ticks.
    Holding(u64),
    /// After a time-out or an abort, which will be the outcome, since this tick.
    Recovering(Outcome, u64),
    /// Ended.
    Over(Outcome),
}

/// What a mission wants of its vehicle. All but guests drive from their start (rule 18).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum ControlRequest {
    /// That it runs its own plan: nothing is sent.
    Listen,
    /// To drive: an override waits for the answer.
    Ask,
    /// To go on driving.
    Drive,
}

/// What a statement asks for.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Asked {
    pub course: Heading,
    /// Over ground; otherwise through the water.
    pub over_ground: bool,
    pub speed: f64,
    pub vertical: Vertical,
}

impl Asked {
    /// To lie still at a depth.
    pub fn still(course: Heading, depth: f64) -> Self {
        Asked { course, over_ground: false, speed: 0.0, vertical: Vertical::Depth(depth) }
    }

    pub fn set(&mut self, channel: Channel, value: f64) {
        match channel {
            Channel::Depth => self.vertical = Vertical::Depth(value),
            Channel::Altitude => self.vertical = Vertical::Altitude(value),
            Channel::Speed => self.speed = value,
        }
    }
}

/// Limits as numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Limits {
    pub altitude: (f64, f64),
    pub depth: (f64, f64),
    pub speed: (f64, f64),
    /// Of the course that is commanded, rad/s at most.
    pub turn_rate: f64,
}

impl Limits {
    pub const NONE: Limits =
        Limits { altitude: (0.0, f64::MAX), depth: (0.0, f64::MAX), speed: (0.0, f64::MAX), turn_rate: TURN_RATE_MAX };

    /// The least and the greatest value of a setpoint.
    pub fn within(&self, channel: Channel) -> (f64, f64) {
        match channel {
            Channel::Depth => self.depth,
            Channel::Altitude => self.altitude,
            Channel::Speed => self.speed,
        }
    }

    /// The same, to be set.
    pub fn of(&mut self, channel: Channel) -> &mut (f64, f64) {
        match channel {
            Channel::Depth => &mut self.depth,
            Channel::Altitude => &mut self.altitude,
            Channel::Speed => &mut self.speed,
        }
    }
}

/// A required input as numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Requirement {
    pub fresh: f64,
    pub patience: Option<f64>,
    pub stale: bool,
    /// The tick on which it was found stale.
    pub since: u64,
}

impl Requirement {
    /// What a link must be like of which a mission says nothing.
    pub const LINK: Requirement = Requirement {
        fresh: LATENCY_MAX_S / TICK_S,
        patience: Some(LATENCY_PATIENCE_S / TICK_S),
        stale: false,
        since: 0,
    };
}

/// What the declarations of a mission put in force.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Declared {
    pub setpoints: [f64; setpoints::WORDS as usize],
    /// How many of the mission's overlays they are; the last ones in its list.
    pub overlays: usize,
}

/// Channels that overlays set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Overridden {
    pub vertical: Option<Vertical>,
    pub speed: Option<f64>,
}

impl Overridden {
    pub fn set(&mut self, channel: Channel, value: f64) {
        match channel {
            Channel::Depth => self.vertical = Some(Vertical::Depth(value)),
            Channel::Altitude => self.vertical = Some(Vertical::Altitude(value)),
            Channel::Speed => self.speed = Some(value),
        }
    }

    pub fn clear(&mut self, axis: Axis) {
        match axis {
            Axis::Vertical => self.vertical = None,
            Axis::Speed => self.speed = None,
        }
    }

    /// What is asked for, with what is set here in place of it.
    pub fn over(&self, asked: &mut Asked) {
        asked.vertical = self.vertical.unwrap_or(asked.vertical);
        asked.speed = self.speed.unwrap_or(asked.speed);
    }
}

/// A run in the middle of a tick: its state, and what has happened so far.
#[derive(Clone)]
pub(crate) struct Run {
    pub state: State,
    pub events: Vec<Event>,
    /// The peak of some input may be another than its latest value: several samples came in a tick, or the words were put in place.
    pub peaks_differ: bool,
    /// An overlay is being stepped: what it keeps is an override.
    pub in_overlay: bool,
    /// In this tick a law went by a position that has not come for a while.
    pub is_lost: bool,
    /// Why the mission is aborted, when it is.
    pub abort: Option<String>,
    /// The outcome of that, where it is another than that the script aborted it.
    pub deserted: Option<Outcome>,
    /// In this tick an override asks for control.
    pub asks: bool,
    /// What payloads are asked in this tick.
    pub requests: Vec<Request>,
    /// The conditions that were tried in this tick, while somebody asks for them.
    pub tried: Option<Vec<Tried>>,
    /// The overlays that amend the course, in their order, with the bases of their wearers' frames; and whether they are known: what is
    /// entered or left makes an event.
    pub amenders: Vec<(u32, Slot)>,
    pub amenders_known: bool,
    pub senses: Senses,
    /// What is known of the water's depth beforehand.
    pub chart: Option<Chart>,
    pub trig: Trig,
    pub bound: Bound,
}

/// Where the inputs are that guidance itself reads; absolute slots of their blocks.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Senses {
    pub position: Option<Slot>,
    pub course: Option<Slot>,
    pub heading: Option<Slot>,
    pub flow: Option<Slot>,
    pub depth: Option<Slot>,
    pub altitude: Option<Slot>,
    pub control: Option<Slot>,
    pub elapsed: Option<Slot>,
}

impl Run {
    pub fn get(&self, slot: Slot) -> f64 {
        self.state.words[slot as usize]
    }

    pub fn set(&mut self, slot: Slot, value: f64) {
        self.state.words[slot as usize] = value;
    }

    pub fn slice(&self, slot: Slot, words: u32) -> &[f64] {
        &self.state.words[slot as usize..(slot + words) as usize]
    }

    pub fn copy(&mut self, to: Slot, from: Slot, words: u32) {
        // Most are points and vectors: two words are copied sooner than a copy of any length is called.
        if words == 2 {
            let (a, b) = (self.get(from), self.get(from + 1));
            self.set(to, a);
            self.set(to + 1, b);
        } else {
            self.state.words.copy_within(from as usize..(from + words) as usize, to as usize);
        }
    }
}
