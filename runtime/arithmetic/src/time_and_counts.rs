//! Time and counts.

use crate::{Interval, Operation, bounded};
use albacore_vehicle::TICK_S;

/// The seconds that an input is old before it has had any sample.
pub const NEVER_S: f64 = 1e9;

/// A hair above a whole number of ticks is rounding, not a longer time.
const HAIR: f64 = 1e-6;

/// The seconds that a sample is old which came so many ticks ago; one that never came is of a negative number of ticks.
pub struct Age;

impl Operation<1> for Age {
    #[inline]
    fn execute([ticks]: [f64; 1]) -> f64 {
        if ticks < 0.0 { NEVER_S } else { bounded(ticks * TICK_S) }
    }

    fn rule([ticks]: [Interval; 1]) -> Interval {
        let since = Interval::new(Self::execute([ticks.low.max(0.0)]), Self::execute([ticks.high.max(0.0)]));
        match (ticks.low < 0.0, ticks.high < 0.0) {
            (_, true) => Interval::exactly(NEVER_S),
            (true, false) => since.or(Interval::exactly(NEVER_S)),
            (false, false) => since,
        }
    }
}

/// Rule 1: seconds as whole ticks, rounded up, at least one. A negative time is nobody's wish: one tick stands for it.
pub struct Ticks;

impl Operation<1> for Ticks {
    #[inline]
    fn execute([seconds]: [f64; 1]) -> f64 {
        bounded((seconds / TICK_S - HAIR).ceil().max(1.0))
    }

    fn rule([seconds]: [Interval; 1]) -> Interval {
        Interval::new(Self::execute([seconds.low]), Self::execute([seconds.high]))
    }

    fn is_defined([seconds]: [Interval; 1]) -> bool {
        seconds.low >= 0.0
    }
}

/// What counting gives: of the elements of a list, of the samples that are kept.
pub fn counted(most: u32) -> Interval {
    Interval::new(0.0, f64::from(most))
}
