//! The command filter: commanded courses reach the vehicle smoothed and no faster than it can turn.

use crate::parameters::FILTER_BANDWIDTH;
use albacore_geometry::Heading;
use albacore_geometry::math::exp;

/// A first-order filter on the wrapped course error, psi' = clamp(5 e, +-rate), between the behaviors and the vehicle (2005
/// paper, Sec. V: 5 rad/s and a rate of 10 degrees per second, [`crate::parameters::TURN_RATE_MAX`]; the paper does not give
/// its order).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CommandFilter {
    /// The course that comes out.
    pub course: Heading,
}

impl CommandFilter {
    /// How many words the state takes.
    pub const WORDS: usize = 1;

    /// A filter at rest at a course.
    pub fn new(course: Heading) -> Self {
        CommandFilter { course }
    }

    /// The filtered course `dt` seconds on, the short way round, turned no faster than `rate` rad/s.
    ///
    /// Solved exactly for a constant command (a ramp while the error is large, then an exponential): it cannot
    /// overshoot, and two short steps give what one long step gives.
    pub fn step(&mut self, commanded: Heading, rate: f64, dt: f64) -> Heading {
        // The error below which the bandwidth, not the rate limit, rules.
        let knee = rate / FILTER_BANDWIDTH;
        let error = commanded - self.course;
        let dt = dt.max(0.0);
        let ramp_time = ((error.abs() - knee) / rate).clamp(0.0, dt);
        let after_ramp = error.abs() - rate * ramp_time;
        let left_over = after_ramp * exp(-FILTER_BANDWIDTH * (dt - ramp_time));
        self.course = self.course + (error.abs() - left_over) * if error < 0.0 { -1.0 } else { 1.0 };
        self.course
    }

    /// The state as plain numbers.
    pub fn to_words(self) -> [f64; Self::WORDS] {
        [self.course.radians()]
    }

    /// The state back from its numbers.
    pub fn from_words(words: &[f64; Self::WORDS]) -> Self {
        CommandFilter { course: Heading::from_radians(words[0]) }
    }
}
