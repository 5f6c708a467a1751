//! What every guidance function answers, and the one law that brings a vehicle back onto its track.

use crate::parameters::{CROSS_TRACK_GAIN, CROSS_TRACK_MAX};
use albacore_geometry::Heading;

/// The answer of a guidance function for one tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guidance {
    /// The course over ground to command.
    pub course: Heading,
    /// Whether the statement has done what it was asked. The course is then still a sensible one to go on with.
    pub arrived: bool,
}

/// The angle in radians to turn clockwise of the track's own direction when `left` metres to the left of it (negative
/// to the right): K d, at most 45 degrees either way (2005 paper, appendix A.2).
///
/// Printed, the saturated branch is chosen by d >= d_1 without the absolute value, so that 20 m to the right would
/// command 100 degrees to the left; the distance is meant, and taken, without its sign.
pub fn cross_track(left: f64) -> f64 {
    (CROSS_TRACK_GAIN * left).clamp(-CROSS_TRACK_MAX, CROSS_TRACK_MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use albacore_geometry::math::radians;

    #[test]
    fn five_degrees_a_metre_up_to_forty_five() {
        let check = |left: f64, degrees: f64| assert!((cross_track(left) - radians(degrees)).abs() < 1e-12, "{left} m");
        check(0.0, 0.0);
        check(1.0, 5.0);
        check(-8.9, -44.5);
        check(9.0, 45.0);
        check(20.0, 45.0);
        check(-20.0, -45.0);
    }
}
