//! The numbers the guidance laws are published with, and the ones we had to choose, each with its source.

use albacore_geometry::math::PI;

/// One degree in radians.
const DEGREE: f64 = PI / 180.0;

/// Course correction for each metre off the line, in radians per metre: K = 5 degrees per metre (2005 paper, Table IV).
pub const CROSS_TRACK_GAIN: f64 = 5.0 * DEGREE;

/// The largest course correction, in radians: 45 degrees (2005 paper, appendix A.2).
pub const CROSS_TRACK_MAX: f64 = 45.0 * DEGREE;

/// A point is reached within this many metres: R = 10 m (2005 paper, Table IV).
pub const ARRIVAL_RADIUS: f64 = 10.0;

/// A new approach to what was only circled begins this many turning radii away: far enough outside both turning circles to
/// straighten out. Ours.
pub const STAND_OFF: f64 = 3.0;

/// A vehicle that keeps its place lies still within this many metres of it, and goes back from there. Ours: as near as a
/// point is reached.
pub const STATION_OUTER_RADIUS: f64 = ARRIVAL_RADIUS;

/// It lies still again within this many metres. Ours.
pub const STATION_INNER_RADIUS: f64 = 3.0;

/// It goes back so fast that it would be there in this many seconds. Ours: at 1 m/s from the outer radius.
pub const STATION_RETURN_TIME: f64 = 10.0;

/// It goes back no slower than this many m/s over ground, if it may: below, rudders have little to act on. Ours.
pub const STATION_SPEED_MIN: f64 = 0.5;

/// Nor faster than this many m/s over ground, whatever else allows: nobody is in a hurry. Ours.
pub const STATION_SPEED_MAX: f64 = 1.5;

/// It is adrift when it has been carried so many metres farther off on its way back. Ours.
pub const STATION_ADRIFT: f64 = 2.0 * STATION_OUTER_RADIUS;

/// A position older than this many seconds says nothing of where a vehicle drifts. Ours.
pub const STATION_POSITION_AGE_MAX: f64 = 5.0;

/// A line is followed once the course is within this angle of it, in radians: theta of appendix A.2, which the paper
/// leaves open. Ours: 30 degrees.
pub const LINE_CAPTURE_ANGLE: f64 = 30.0 * DEGREE;

/// Bandwidth of the command filter, in radians per second (2005 paper, Sec. V).
pub const FILTER_BANDWIDTH: f64 = 5.0;

/// The fastest turn a command asks for, in radians per second: 10 degrees per second (2005 paper, Sec. V).
pub const TURN_RATE_MAX: f64 = 10.0 * DEGREE;

/// Paths are planned with a turning circle this much wider than the vehicle's tightest, so that feedback has
/// something left to correct with. Ours: the paper's 10 m cannot be flown at its own 2 m/s and 10 degrees per second
/// (11.5 m).
pub const TURNING_RADIUS_MARGIN: f64 = 1.1;

/// How long before it is due a turn is commanded, in seconds: the lag of the command filter, 1 /
/// [`FILTER_BANDWIDTH`], and half a control period of 100 ms.
pub const TURN_LEAD_TIME: f64 = 1.0 / FILTER_BANDWIDTH + 0.05;

/// A vehicle does not move this many metres between two ticks: more is a correction of its navigation, and says
/// nothing of the ground in between. Ours: five times what 2 m/s covers in a control period of 100 ms.
pub const NAVIGATION_JUMP: f64 = 1.0;

/// The radius in metres to plan turns with, at a speed in m/s and a turn rate in rad/s: R_m = 1.1 v / rate.
///
/// For the 2005 paper's vehicle (2 m/s, 10 degrees per second) 12.6 m.
pub fn turning_radius(speed: f64, rate_limit: f64) -> f64 {
    TURNING_RADIUS_MARGIN * speed / rate_limit
}

/// The radius in metres to plan turns over ground with, in a compensated current of `flow` m/s: [`turning_radius`]
/// times v / (v - flow). Still-water radius when the flow is as fast as the vehicle: no radius helps then.
///
/// Turning with the current behind it, the vehicle has only v - flow of its own to turn, and must turn it the faster
/// for its course over ground to turn at the same rate: in 0.5 m/s at 2 m/s by a third.
pub fn turning_radius_in_flow(speed: f64, flow: f64, rate_limit: f64) -> f64 {
    let still = turning_radius(speed, rate_limit);
    if flow < speed { still * speed / (speed - flow.max(0.0)) } else { still }
}
