//! The vehicle, its own mission and its computer: what a scenario says of them, and what of that cannot be.

use crate::scenario::{Objections, Scenario};
use albacore_geometry::math::PI;
use albacore_geometry::{Heading, Point};
use albacore_guidance::Rows;
use albacore_vehicle::Vertical;
use serde::{Deserialize, Serialize};

/// A vehicle that follows its commands at once but for limits on its rates: no forces.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct KinematicVehicle {
    /// Where it starts. Default the frame's origin.
    pub start: Point,
    /// Each seed starts somewhere else, evenly in a disc of this radius about `start`, m. Default 0: all there.
    pub start_spread: f64,
    /// Its heading at the start. Default north.
    pub heading: Heading,
    /// Its depth at the start, m. Default 0.
    pub depth: f64,
    /// Its greatest speed through the water, m/s. Default 2.6 (REMUS 100).
    pub speed_max: f64,
    /// Its greatest rate of turn, rad/s. Default 10 degrees a second.
    pub turn_rate: f64,
    /// Time constant with which the heading closes a small error, s. Default 0.2: the command filter's is before it.
    pub heading_time: f64,
    /// Its greatest change of speed, m/s2. Default 0.25.
    pub acceleration: f64,
    /// Its greatest rate of climb and dive, m/s. Default 0.5.
    pub depth_rate: f64,
    /// Standard deviation of its wobble about a commanded altitude, m. Default 0: none.
    pub altitude_jitter: f64,
    /// The wobble never exceeds this, m. Default 0.7 (the 2005 paper's, Sec. IV).
    pub altitude_jitter_max: f64,
    /// Correlation time of the wobble, s. Default 10.
    pub altitude_jitter_time: f64,
    /// How long the battery lasts, s; its charge falls linearly. Default 22 h (REMUS 100).
    pub endurance: f64,
}

impl Default for KinematicVehicle {
    fn default() -> Self {
        KinematicVehicle {
            start: Point::ORIGIN,
            start_spread: 0.0,
            heading: Heading::NORTH,
            depth: 0.0,
            speed_max: 2.6,
            turn_rate: 10.0 * PI / 180.0,
            heading_time: 0.2,
            acceleration: 0.25,
            depth_rate: 0.5,
            altitude_jitter: 0.0,
            altitude_jitter_max: 0.7,
            altitude_jitter_time: 10.0,
            endurance: 22.0 * 3600.0,
        }
    }
}

/// A vehicle's own mission: rows from where it starts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct OwnMission {
    /// The rows: the first begins at the start and runs along the vehicle's heading there.
    pub rows: Rows,
    /// What it holds on them.
    pub vertical: Vertical,
}

/// How a vehicle's own computer answers who asks to drive it. Times are seconds since tick 0; 0 is never.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Handover {
    /// How long it takes to give way, s.
    pub after: f64,
    /// Whether it refuses.
    pub refuses: bool,
    /// Whether it never answers.
    pub silent: bool,
    /// When it stops listening for a while, and for how long.
    pub suspends: f64,
    /// For so long.
    pub lasting: f64,
    /// When it takes control back from who drives by then.
    pub takes_back: f64,
    /// From when on it offers to be driven.
    pub offers: f64,
}

/// What of the vehicle cannot be.
pub(crate) fn check(scenario: &Scenario, objections: &mut Objections) {
    let v = &scenario.vehicle;
    objections.finite("vehicle.start", [v.start.north, v.start.east]);
    objections.finite("vehicle.heading", [v.heading.radians(), 0.0]);
    objections.not_negative("vehicle.start_spread", v.start_spread);
    objections.not_negative("vehicle.depth", v.depth);
    // Where the start is scattered it may be anywhere: as shallow as the plane ever is.
    let water = if v.start_spread > 0.0 {
        scenario.bottom.from.min(scenario.bottom.to)
    } else {
        scenario.bottom.depth_at(v.start)
    };
    objections.unless(
        v.depth <= water || !water.is_finite(),
        format!(
            "`vehicle.depth` is {} m where the water is {water} m deep: the vehicle starts below the bottom",
            v.depth
        ),
    );
    for (name, value) in [
        ("vehicle.speed_max", v.speed_max),
        ("vehicle.turn_rate", v.turn_rate),
        ("vehicle.heading_time", v.heading_time),
        ("vehicle.acceleration", v.acceleration),
        ("vehicle.depth_rate", v.depth_rate),
        ("vehicle.altitude_jitter_time", v.altitude_jitter_time),
        ("vehicle.endurance", v.endurance),
    ] {
        objections.positive(name, value);
    }
    objections.not_negative("vehicle.altitude_jitter", v.altitude_jitter);
    objections.not_negative("vehicle.altitude_jitter_max", v.altitude_jitter_max);
}
