//! Flow compensation: what to do through the water in order to go where asked over the ground.

use albacore_geometry::math::{PI, asin};
use albacore_geometry::{Heading, Vector};

/// A speed through the water below this many m/s has no direction worth steering for.
const STILL_MPS: f64 = 1e-9;

/// What to ask of the vehicle, relative to the water.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThroughWater {
    /// Where to point the vehicle.
    pub heading: Heading,
    /// Speed through the water in m/s, never above the vehicle's maximum.
    pub speed: f64,
    /// Whether the vehicle will move over the ground along the course asked for, at whatever speed. False only when the
    /// current is too strong for it. True at speed zero, which asks for no course.
    pub holds_course: bool,
}

/// Compensates a course and speed over ground for the flow (m/s, toward): V_f = V_g - F_g, psi = atan2(v_f, u_f),
/// u_c = |V_f| (2005 paper, appendix A).
///
/// The paper leaves open what is to happen when |V_f| is more than the vehicle can do, or nothing. Ours:
/// - above `speed_max` the course is kept by the crab angle and ground speed is given up;
/// - when the flow across the course is itself above `speed_max` no crab angle keeps it, and the vehicle heads straight
///   against that flow, at full speed, so that it leaves the course as slowly as it can (the limit of the case above);
/// - when the flow alone does what was asked, the vehicle points along the course and waits;
/// - at speed zero it points along the course and drifts: to hold a place is another statement's business.
pub fn through_water(course: Heading, speed: f64, flow: Vector, speed_max: f64) -> ThroughWater {
    if speed <= 0.0 {
        return ThroughWater { heading: course, speed: 0.0, holds_course: true };
    }
    let wanted = speed * course.unit() - flow;
    let wanted_speed = wanted.length();
    if wanted_speed <= STILL_MPS {
        return ThroughWater { heading: course, speed: 0.0, holds_course: true };
    }
    if wanted_speed <= speed_max {
        return ThroughWater { heading: wanted.toward(), speed: wanted_speed, holds_course: true };
    }
    let across = flow.right_of(course);
    if across.abs() >= speed_max {
        let crab = if across > 0.0 { -PI / 2.0 } else { PI / 2.0 };
        return ThroughWater { heading: course + crab, speed: speed_max.max(0.0), holds_course: false };
    }
    let made_good = flow.along(course) + (speed_max * speed_max - across * across).sqrt();
    ThroughWater { heading: course + asin(-across / speed_max), speed: speed_max, holds_course: made_good > 0.0 }
}
