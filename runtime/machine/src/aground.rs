//! A vehicle on the bottom: when that ends a mission, and as what.

use crate::bottom::UNDONE_M;
use crate::state::{ControlRequest, Phase, Run};
use crate::{Event, Outcome};
use albacore_vehicle::TICK_S;
use serde::{Deserialize, Serialize};

/// A mission whose vehicle has lain on the bottom for so long, s, at once or again and again while it drove, is aborted: its recovery leads up.
const AGROUND_MAX_S: f64 = 30.0;

/// What is known of the vehicle on the bottom.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Aground {
    /// Since which tick it has lain there, and since which with the mission driving.
    since: Option<u64>,
    driven_since: Option<u64>,
    /// For how many ticks it has lain there while the mission drove: what it does by a plan of its own is no mission's fault.
    driven: u64,
    /// It has swum while the mission drove: one that is launched from the bottom has not run aground there.
    swam: bool,
    /// It has come down on the bottom while the mission drove.
    struck: bool,
    /// The least depth at which it has lain, m.
    depth: Option<f64>,
}

impl Run {
    /// Takes in whether the vehicle lies on the bottom.
    pub fn feel_bottom(&mut self, aground: bool) {
        let tick = self.state.tick;
        let since = |of: Option<u64>, lies: bool| lies.then(|| of.unwrap_or(tick));
        let Aground { since: lain, driven_since, .. } = self.state.aground;
        self.state.aground.since = since(lain, aground);
        self.state.aground.driven_since = since(driven_since, aground && self.drives());
        let drives = self.drives();
        self.state.aground.swam |= drives && !aground;
        self.state.aground.driven += u64::from(aground && drives);
        self.state.aground.struck |= drives && aground && self.state.aground.swam;
        if aground {
            let depth = self.depth();
            self.state.aground.depth = Some(self.state.aground.depth.map_or(depth, |least| least.min(depth)));
        }
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
        let Aground { since, struck, .. } = self.state.aground;
        match outcome {
            Outcome::Completed | Outcome::TimedOut | Outcome::Aborted if since.is_some() => {
                Some("the vehicle lies on the bottom")
            }
            Outcome::Completed if struck => Some("the vehicle struck the bottom"),
            _ => None,
        }
    }
}
