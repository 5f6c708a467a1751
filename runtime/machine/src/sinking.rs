//! How fast a vehicle sinks, and how much deeper it will be until its fins lift it.

use albacore_vehicle::TICK_S;
use serde::{Deserialize, Serialize};

/// How fast it sinks is measured over so long, s, twice: what jumps does not sink.
const MEASURED_S: f64 = 4.0;
/// It sinks by so much at least, m/s, and counts as sinking by so much at most.
const SINKS: f64 = 0.1;
const SINKS_MAX: f64 = 0.6;
/// A hull that sinks goes on for so long, s, until its fins bite: where it will be by then counts as where it is.
const AHEAD_S: f64 = 40.0;

/// How fast a vehicle has sunk lately.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Sinking {
    /// The depth, m, in a tick, from which on it is measured.
    depth: f64,
    since: u64,
    /// What was measured last, and before that, m/s.
    rates: [f64; 2],
}

impl Sinking {
    /// What is known of a vehicle that is so deep, m, in a tick, and of which nothing was known.
    pub fn from(tick: u64, depth: f64) -> Self {
        Sinking { depth, since: tick, rates: [0.0; 2] }
    }

    /// The same a tick later.
    pub fn after(self, tick: u64, depth: f64) -> Self {
        let lasts = tick.saturating_sub(self.since) as f64 * TICK_S;
        match lasts < MEASURED_S {
            true => self,
            false => Sinking { depth, since: tick, rates: [(depth - self.depth) / lasts, self.rates[0]] },
        }
    }

    /// By how much a vehicle will be deeper when its fins bite, m.
    pub fn ahead(self) -> f64 {
        let rate = self.rates[0].min(self.rates[1]);
        if rate < SINKS { 0.0 } else { AHEAD_S * rate.min(SINKS_MAX) }
    }
}
