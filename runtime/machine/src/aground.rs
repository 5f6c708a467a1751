//! A vehicle on the bottom: when that ends a mission, and as what.

use crate::bottom::UNDONE_M;
use crate::state::{ControlRequest, Phase, Run};
use crate::{Event, Outcome};
use albacore_vehicle::TICK_S;
use serde::{Deserialize, Serialize};

/// A mission whose vehicle has lain on the bottom for so long, s, at once or again and again while it drove, is aborted: its recovery leads up.
const AGROUND_MAX_S: f64 = 30.0;
/// One that has lain there for so long in all, s, is no vehicle that was only launched from there.
const LAUNCHED_MAX_S: f64 = 10.0;

/// What is known of the vehicle on the bottom.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Aground {
    /// Since which tick it has lain there, and since which with the mission driving.
    since: Option<u64>,
    driven_since: Option<u64>,
    /// For how many ticks it has lain there while the mission drove: what it does by a plan of its own is no mission's fault.
    driven: u64,
    /// The mission drove it in the last tick, and it swam.
    swam: bool,
    /// The mission drove it down on the bottom.
    struck: bool,
    /// The least depth at which it has lain, m.
    depth: Option<f64>,
}

impl Run {
    /// Takes in whether the vehicle lies on the bottom.
    pub fn feel_bottom(&mut self, aground: bool) {
        let tick = self.state.tick;
        let drives = self.drives();
        let driven = aground && drives;
        let since = |of: Option<u64>, lies: bool| lies.then(|| of.unwrap_or(tick));
        let before = self.state.aground;
        self.state.aground = Aground {
            since: since(before.since, aground),
            driven_since: since(before.driven_since, driven),
            driven: before.driven + u64::from(driven),
            swam: drives && !aground,
            struck: before.struck || driven && before.swam,
            depth: match aground {
                true => Some(before.depth.map_or(self.depth(), |least| least.min(self.depth()))),
                false => before.depth,
            },
        };
    }

    /// How deep a recovery may go whose vehicle has lain on the bottom, m: clear of where that was, whatever is asked.
    pub fn above_bottom(&self) -> f64 {
        let lain = self.state.aground.depth.filter(|_| matches!(self.state.phase, Phase::Recovering(..)));
        lain.map_or(f64::MAX, |depth| (depth - UNDONE_M).max(0.0))
    }

    fn lain_s(&self) -> f64 {
        self.state.aground.driven_since.map_or(0.0, |since| self.state.tick.saturating_sub(since) as f64 * TICK_S)
    }

    /// Whether the vehicle that we drive has lain on the bottom for too long: what the mission asks for does not free it.
    pub fn is_stranded(&self) -> bool {
        let in_all = self.state.aground.driven.saturating_sub(1) as f64 * TICK_S;
        self.state.wish == ControlRequest::Drive && self.lain_s().max(in_all) >= AGROUND_MAX_S
    }

    pub fn tell_stranded(&mut self) {
        self.events.push(Event::Aborted(format!("aground for {AGROUND_MAX_S} s")));
    }

    /// What a mission counts as that ends so. One that leaves its vehicle on the bottom, or has driven it there, has not come to its own
    /// end, whatever it says: an event tells why.
    pub fn counts_as(&mut self, outcome: Outcome) -> Outcome {
        let Some(why) = self.why_aground(outcome) else { return outcome };
        if outcome == Outcome::Completed {
            self.events.push(Event::Aborted(why.to_string()));
        }
        Outcome::Aground
    }

    fn why_aground(&self, outcome: Outcome) -> Option<&'static str> {
        let Aground { since, driven, struck, .. } = self.state.aground;
        match outcome {
            Outcome::Completed | Outcome::TimedOut | Outcome::Aborted if since.is_some() => {
                Some("the vehicle lies on the bottom")
            }
            Outcome::Completed if struck => Some("the vehicle struck the bottom"),
            Outcome::Completed if driven as f64 * TICK_S >= LAUNCHED_MAX_S => {
                Some("the vehicle has lain on the bottom")
            }
            _ => None,
        }
    }
}
