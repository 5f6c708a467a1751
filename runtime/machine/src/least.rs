//! The least of what came of late, from a beginning on.

use albacore_vehicle::TICK_S;
use serde::{Deserialize, Serialize};

/// What came so long ago, s, counts no more: once to twice this, by turns.
const SPAN_S: f64 = 20.0;

/// The least of the numbers of the last 20 to 40 s, begun anew as long as there is reason to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct LeastOfLate {
    /// The tick in which there was reason last.
    reason: Option<u64>,
    /// The tick in which the present span began, what was least in it, and in the one before.
    span: u64,
    now: Option<f64>,
    before: Option<f64>,
}

impl LeastOfLate {
    /// There is reason to go by the least from here on.
    pub fn begin(&mut self, tick: u64) {
        if !self.holds(tick) {
            *self = LeastOfLate { span: tick, ..LeastOfLate::default() };
        }
        self.reason = Some(tick);
    }

    /// Takes in a number.
    pub fn add(&mut self, tick: u64, number: f64) {
        if !self.holds(tick) {
            return;
        }
        if since(self.span, tick) >= SPAN_S {
            (self.before, self.now, self.span) = (self.now, None, tick);
        }
        self.now = Some(self.now.map_or(number, |least| least.min(number)));
    }

    /// Whether there was reason of late.
    pub fn holds(&self, tick: u64) -> bool {
        self.reason.is_some_and(|reason| since(reason, tick) <= 2.0 * SPAN_S)
    }

    /// The least of late; more than any number where there is no reason to go by it.
    pub fn least(&self, tick: u64) -> f64 {
        let known = [self.now, self.before].into_iter().flatten().filter(|_| self.holds(tick));
        known.fold(f64::MAX, f64::min)
    }
}

fn since(then: u64, tick: u64) -> f64 {
    (tick - then) as f64 * TICK_S
}
