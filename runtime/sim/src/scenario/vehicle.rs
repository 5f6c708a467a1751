//! The vehicle, its own mission and its computer: what a scenario says of them, and what of that cannot be.

use crate::hull::{self, ActuatorLimits, Crossflow, Fossen, Prestero};
use crate::scenario::{Objections, Scenario};
use albacore_geometry::math::PI;
use albacore_geometry::{Heading, Point};
use albacore_guidance::Route;
use albacore_vehicle::{TICK_S, Vertical};
use serde::{Deserialize, Serialize};

/// The vehicle, and where it is when the run begins.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct VehicleSetup {
    /// How it moves. Default [`KinematicHull`].
    pub hull: HullSetup,
    /// Where it starts. Default the frame's origin.
    pub start: Point,
    /// Each seed starts somewhere else, evenly in a disc of this radius about `start`, m. Default 0: all there.
    pub start_spread: f64,
    /// Its heading at the start. Default north.
    pub heading: Heading,
    /// Its depth at the start, m. Default 0.
    pub depth: f64,
    /// How long the battery lasts, s; its charge falls linearly. Default 22 h (REMUS 100).
    pub endurance: f64,
}

impl Default for VehicleSetup {
    fn default() -> Self {
        VehicleSetup {
            hull: HullSetup::default(),
            start: Point::ORIGIN,
            start_spread: 0.0,
            heading: Heading::NORTH,
            depth: 0.0,
            endurance: 22.0 * 3600.0,
        }
    }
}

/// How a vehicle moves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum HullSetup {
    /// It follows its commands at once but for limits on its rates.
    Kinematic(KinematicHull),
    /// The REMUS 100 in six degrees of freedom, after Fossen ([`crate::hull::Fossen`]).
    Fossen(SubmersibleHull),
    /// The REMUS 100 in six degrees of freedom, after Prestero ([`crate::hull::Prestero`]).
    Prestero(SubmersibleHull, Crossflow),
}

impl Default for HullSetup {
    fn default() -> Self {
        HullSetup::Kinematic(KinematicHull::default())
    }
}

impl HullSetup {
    /// Its greatest speed through the water, m/s.
    pub fn speed_max(&self) -> f64 {
        match self {
            HullSetup::Kinematic(hull) => hull.speed_max,
            HullSetup::Fossen(hull) | HullSetup::Prestero(hull, _) => hull.speed_max,
        }
    }
}

/// A vehicle that follows its commands at once but for limits on its rates: no forces.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct KinematicHull {
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
}

impl Default for KinematicHull {
    fn default() -> Self {
        KinematicHull {
            speed_max: 2.6,
            turn_rate: 10.0 * PI / 180.0,
            heading_time: 0.2,
            acceleration: 0.25,
            depth_rate: 0.5,
            altitude_jitter: 0.0,
            altitude_jitter_max: 0.7,
            altitude_jitter_time: 10.0,
        }
    }
}

/// What can be set of a hull that forces move.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SubmersibleHull {
    /// Its autopilot asks for no more speed through the water than this, m/s.
    pub speed_max: f64,
    /// The greatest angle of its fins to either side, rad.
    pub fin_max: f64,
    /// The greatest turns of its propeller, 1/s.
    pub turns_max: f64,
    /// Time step of the integration, s: a tick is a whole number of steps.
    pub step: f64,
}

impl SubmersibleHull {
    /// The published limits of the plant after Fossen: 1525 turns a minute.
    pub fn fossen() -> Self {
        SubmersibleHull { speed_max: 2.5, fin_max: 15.0 * PI / 180.0, turns_max: 25.42, step: 0.01 }
    }

    /// Those of the plant after Prestero. Its propeller is published at 1500 turns a minute and 1.54 m/s; that it can do 2500 is
    /// drawn out from there.
    pub fn prestero() -> Self {
        SubmersibleHull { turns_max: 41.67, ..SubmersibleHull::fossen() }
    }

    /// Steps in a tick.
    pub fn steps(&self) -> u32 {
        (TICK_S / self.step).round().max(1.0) as u32
    }

    /// The greatest turns of its propeller, 1/min.
    fn rpm_max(&self) -> f64 {
        60.0 * self.turns_max
    }

    /// What its fins and its propeller can do.
    pub fn limits(&self) -> ActuatorLimits {
        ActuatorLimits { fin: self.fin_max, rpm: self.rpm_max(), ..ActuatorLimits::default() }
    }

    /// What of it cannot be; `possible` is the speed that its greatest turns give, m/s.
    fn check(&self, possible: f64, objections: &mut Objections) {
        objections.positive("vehicle.hull.speed_max", self.speed_max);
        objections.unless(
            self.fin_max > 0.0 && self.fin_max <= FIN_MAX,
            format!("`vehicle.hull.fin_max` is {} rad: it must be above 0 and at most {FIN_MAX}", self.fin_max),
        );
        objections.positive("vehicle.hull.turns_max", self.turns_max);
        objections.unless(
            self.speed_max <= possible || !possible.is_finite(),
            format!(
                "`vehicle.hull.speed_max` is {} m/s: its `turns_max` of {} Hz gives {possible:.2} m/s at most",
                self.speed_max, self.turns_max
            ),
        );
        let steps = TICK_S / self.step;
        objections.unless(
            STEPS.contains(&steps.round()) && (steps - steps.round()).abs() < 1e-9,
            format!(
                "`vehicle.hull.step` is {} s: a tick of {TICK_S} s must be a whole number of steps, {} to {}",
                self.step,
                STEPS.start(),
                STEPS.end()
            ),
        );
    }
}

/// A vehicle's own mission.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OwnMission {
    /// Where it goes, from where it starts: of rows the first runs along its heading there.
    pub route: Route,
    /// What it holds on the way.
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

/// The vehicle's own limits, whoever commands it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Limits {
    /// It goes no deeper than this, m. Default none.
    pub depth: Option<f64>,
    /// It comes no nearer to the bottom than this, m. Default 0: it may.
    pub altitude: f64,
    /// It goes no faster through the water than this, m/s. Default none: as fast as its hull can.
    pub speed: Option<f64>,
}

/// What of the vehicle cannot be.
pub(crate) fn check(scenario: &Scenario, objections: &mut Objections) {
    let v = &scenario.vehicle;
    objections.finite("vehicle.start", [v.start.north, v.start.east]);
    objections.finite("vehicle.heading", [v.heading.radians(), 0.0]);
    objections.not_negative("vehicle.start_spread", v.start_spread);
    objections.not_negative("vehicle.depth", v.depth);
    // Where the start is scattered it may be anywhere: as shallow as the ground is there.
    let water = if v.start_spread > 0.0 {
        scenario.bottom.shallowest_within(v.start_spread, v.start)
    } else {
        scenario.bottom.depth_at(v.start)
    };
    objections.unless(water != 0.0, "`vehicle.start` is, or may be, on land: the vehicle starts aground");
    objections.unless(
        v.depth <= water || !water.is_finite(),
        format!(
            "`vehicle.depth` is {} m where the water is {water} m deep: the vehicle starts below the bottom",
            v.depth
        ),
    );
    objections.positive("vehicle.endurance", v.endurance);
    if let Some(limits) = &scenario.limits {
        objections.positive("limits.depth", limits.depth.unwrap_or(1.0));
        objections.not_negative("limits.altitude", limits.altitude);
        objections.positive("limits.speed", limits.speed.unwrap_or(1.0));
    }
    if let Some(Route::Waypoints(waypoints)) = scenario.own_mission.as_ref().map(|own| &own.route) {
        objections.unless(!waypoints.points.is_empty(), "`waypoints.points` is empty: there is nowhere to swim to");
        for point in &waypoints.points {
            objections.finite("waypoints.points", [point.north, point.east]);
        }
        objections.positive("waypoints.speed", waypoints.speed);
    }
    match &v.hull {
        HullSetup::Kinematic(hull) => check_kinematic(hull, objections),
        HullSetup::Fossen(hull) => hull.check(hull::speed_possible(&Fossen::new(), hull.rpm_max()), objections),
        HullSetup::Prestero(hull, crossflow) => {
            hull.check(hull::speed_possible(&Prestero::new(*crossflow), hull.rpm_max()), objections);
        }
    }
}

fn check_kinematic(hull: &KinematicHull, objections: &mut Objections) {
    for (name, value) in [
        ("vehicle.speed_max", hull.speed_max),
        ("vehicle.turn_rate", hull.turn_rate),
        ("vehicle.heading_time", hull.heading_time),
        ("vehicle.acceleration", hull.acceleration),
        ("vehicle.depth_rate", hull.depth_rate),
        ("vehicle.altitude_jitter_time", hull.altitude_jitter_time),
    ] {
        objections.positive(name, value);
    }
    objections.not_negative("vehicle.altitude_jitter", hull.altitude_jitter);
    objections.not_negative("vehicle.altitude_jitter_max", hull.altitude_jitter_max);
}

/// The greatest angle of a fin, rad: beyond it no fin lifts.
const FIN_MAX: f64 = 1.0;
/// So many steps of integration in a tick: with fewer the roll of a hull is not followed, with more nothing is gained.
const STEPS: std::ops::RangeInclusive<f64> = 2.0..=100.0;
