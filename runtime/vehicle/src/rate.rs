//! When something is done that is done so many times a second: an instrument's samples, the rows of what is recorded.

use crate::TICK_S;

/// A sample that falls on a tick belongs to it, whatever the rounding of its time.
const TOLERANCE: f64 = 1e-9;

/// How manieth sample it is that falls on a tick or between it and the one before.
pub fn sample(rate: f64, tick: u64) -> u64 {
    // The cast rounds down.
    (tick as f64 * (rate * TICK_S) + TOLERANCE) as u64
}

/// Whether a sample of an instrument with so many a second, ten at most, falls on a tick or between it and the one before.
pub fn is_due(rate: f64, tick: u64) -> bool {
    tick == 0 || sample(rate, tick) > sample(rate, tick - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_come_at_their_rate() {
        for (rate, expected) in [(10.0, 601), (5.0, 301), (3.0, 181), (0.1, 7)] {
            assert_eq!((0..=600).filter(|&tick| is_due(rate, tick)).count(), expected, "{rate} Hz");
        }
    }
}
