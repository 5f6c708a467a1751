//! The vehicle, its own mission and its computer: what a scenario says of them, and what of that cannot be.

use crate::craft::hull::{self, ActuatorLimits, Controller, Crossflow, Fossen, Prestero};
use crate::scenario::{OfClause, Scenario, ScenarioIssues, number, rounded_down};
use albacore_geometry::math::PI;
use albacore_geometry::{Heading, Point};
use albacore_guidance::{Route, Rows, Waypoints};
use albacore_vehicle::{TICK_S, Vertical};
use serde::Deserialize;
use std::ops::RangeInclusive;

/// The vehicle, and where it is when the run begins.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(try_from = "VehicleClause")]
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

/// The same as a script says it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct VehicleClause {
    model: Option<Model>,
    start: Point,
    heading: Heading,
    depth: f64,
    spread: f64,
}

/// A hull as a script says it, with its battery.
#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
enum Model {
    Kinematic(KinematicClause),
    Fossen(FossenClause),
    Prestero(PresteroClause),
}

#[derive(Deserialize)]
struct KinematicClause {
    #[serde(flatten)]
    hull: KinematicHull,
    endurance: f64,
}

#[derive(Deserialize)]
struct FossenClause {
    #[serde(flatten)]
    hull: SubmersibleHull,
    control: Controller,
    endurance: f64,
}

#[derive(Deserialize)]
struct PresteroClause {
    #[serde(flatten)]
    hull: SubmersibleHull,
    as_printed: bool,
    control: Controller,
    endurance: f64,
}

impl TryFrom<VehicleClause> for VehicleSetup {
    type Error = &'static str;

    fn try_from(clause: VehicleClause) -> Result<Self, Self::Error> {
        let VehicleClause { model, start, heading, depth, spread: start_spread } = clause;
        let model = model
            .ok_or("this does not say how the vehicle moves\nwrite `vehicle(kinematic, start: …)`, for example")?;
        let (hull, endurance) = match model {
            Model::Kinematic(KinematicClause { hull, endurance }) => (HullSetup::Kinematic(hull), endurance),
            Model::Fossen(FossenClause { hull, control: controller, endurance }) => {
                (HullSetup::Fossen(SubmersibleHull { controller, ..hull }), endurance)
            }
            Model::Prestero(PresteroClause { hull, as_printed, control: controller, endurance }) => {
                let crossflow = if as_printed { Crossflow::AsPrinted } else { Crossflow::Corrected };
                (HullSetup::Prestero(SubmersibleHull { controller, ..hull }, crossflow), endurance)
            }
        };
        Ok(VehicleSetup { hull, start, start_spread, heading, depth, endurance })
    }
}

/// How a vehicle moves.
#[derive(Clone, Debug, PartialEq)]
pub enum HullSetup {
    /// It follows its commands at once but for limits on its rates.
    Kinematic(KinematicHull),
    /// The REMUS 100 in six degrees of freedom, after Fossen ([`crate::craft::hull::Fossen`]).
    Fossen(SubmersibleHull),
    /// The REMUS 100 in six degrees of freedom, after Prestero ([`crate::craft::hull::Prestero`]).
    Prestero(SubmersibleHull, Crossflow),
}

impl Default for HullSetup {
    fn default() -> Self {
        HullSetup::Kinematic(KinematicHull::default())
    }
}

impl HullSetup {
    /// Its clause in a script.
    fn clause(&self) -> &'static str {
        match self {
            HullSetup::Kinematic(_) => "kinematic",
            HullSetup::Fossen(_) => "fossen",
            HullSetup::Prestero(..) => "prestero",
        }
    }

    /// In so many steps it moves in a tick.
    pub(crate) fn steps(&self) -> u32 {
        match self {
            HullSetup::Kinematic(_) => hull::LEVEL_STEPS,
            HullSetup::Fossen(hull) | HullSetup::Prestero(hull, _) => hull.steps(),
        }
    }

    /// Its greatest speed through the water, m/s.
    pub fn speed_max(&self) -> f64 {
        match self {
            HullSetup::Kinematic(hull) => hull.speed_max,
            HullSetup::Fossen(hull) | HullSetup::Prestero(hull, _) => hull.speed_max,
        }
    }
}

/// A vehicle that follows its commands at once but for limits on its rates: no forces.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct KinematicHull {
    /// Its greatest speed through the water, m/s. Default 2.6 (REMUS 100).
    pub speed_max: f64,
    /// Its greatest rate of turn, rad/s. Default 10 degrees a second.
    pub turn_rate: f64,
    /// Its greatest change of speed, m/s2. Default 0.25.
    pub acceleration: f64,
    /// Its greatest rate of climb and dive, m/s. Default 0.5.
    pub depth_rate: f64,
    /// Standard deviation of its wobble about a commanded altitude, m. Default 0: none.
    #[serde(rename = "wobble")]
    pub altitude_jitter: f64,
    /// The wobble never exceeds this, m. Default 0.7 (the 2005 paper's, Sec. IV).
    #[serde(rename = "wobble_max")]
    pub altitude_jitter_max: f64,
    /// Correlation time of the wobble, s. Default 10.
    #[serde(rename = "wobble_time")]
    pub altitude_jitter_time: f64,
}

impl KinematicHull {
    /// Time constant with which the heading closes a small error, s: the command filter's is before it.
    pub const HEADING_TIME_S: f64 = 0.2;
}

impl Default for KinematicHull {
    fn default() -> Self {
        KinematicHull {
            speed_max: 2.6,
            turn_rate: 10.0 * PI / 180.0,
            acceleration: 0.25,
            depth_rate: 0.5,
            altitude_jitter: 0.0,
            altitude_jitter_max: 0.7,
            altitude_jitter_time: 10.0,
        }
    }
}

/// What can be set of a hull that forces move.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct SubmersibleHull {
    /// Its autopilot asks for no more speed through the water than this, m/s.
    pub speed_max: f64,
    /// The greatest angle of its fins to either side, rad.
    pub fin_max: f64,
    /// The greatest turns of its propeller, 1/s.
    pub turns_max: f64,
    /// Time step of the integration, s: a tick is a whole number of steps.
    pub step: f64,
    /// What moves its fins.
    #[serde(skip)]
    pub controller: Controller,
}

impl SubmersibleHull {
    /// What its propeller may turn at most, 1/s. Lift and drag are those of slow water: beyond twice what the published hulls do
    /// nothing is known of them.
    pub const TURNS_MAX: RangeInclusive<f64> = 1.0..=60.0;
    /// What it may go at most, m/s: no more than so many turns give.
    pub const SPEED_MAX: RangeInclusive<f64> = 0.1..=6.0;

    /// The published limits of the plant after Fossen: 1525 turns a minute.
    pub fn fossen() -> Self {
        SubmersibleHull {
            speed_max: 2.5,
            fin_max: 15.0 * PI / 180.0,
            turns_max: 25.42,
            step: 0.01,
            controller: Controller::Cascade,
        }
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
    fn check(&self, possible: f64, of: &mut OfClause) {
        of.unless(
            Some("speed_max"),
            self.speed_max <= possible,
            format!(
                "`{}` cannot swim {} m/s: its `turns_max` of {} Hz gives {possible:.2} m/s at most",
                of.clause(),
                number(self.speed_max),
                number(self.turns_max)
            ),
            "make `speed_max` smaller, or `turns_max` greater",
        );
        let steps = TICK_S / self.step;
        of.unless(
            Some("step"),
            STEPS.contains(&steps.round()) && (steps - steps.round()).abs() < 1e-9,
            format!("`step` of `{}` is {} ms", of.clause(), number(self.step * 1000.0)),
            format!("a tick of 100 ms must be a whole number of steps, {} to {}", STEPS.start(), STEPS.end()),
        );
    }
}

/// A vehicle's own mission.
#[derive(Clone, Debug, PartialEq)]
pub struct OwnMission {
    /// Where it goes, from where it starts: of rows the first runs along its heading there.
    pub route: Route,
    /// What it holds on the way.
    pub vertical: Vertical,
}

/// Rows as a script says them.
#[derive(Clone, Debug, Deserialize)]
pub struct OwnRows {
    #[serde(flatten)]
    rows: Rows,
    #[serde(flatten)]
    held: Held,
}

/// Waypoints as a script says them.
#[derive(Clone, Debug, Deserialize)]
pub struct OwnWaypoints {
    #[serde(flatten)]
    waypoints: Waypoints,
    #[serde(flatten)]
    held: Held,
}

/// What is held on a route: the depth, else the altitude, m.
#[derive(Clone, Debug, Deserialize)]
struct Held {
    depth: Option<f64>,
    altitude: f64,
}

impl From<Held> for Vertical {
    fn from(held: Held) -> Self {
        held.depth.map_or(Vertical::Altitude(held.altitude), Vertical::Depth)
    }
}

impl From<OwnRows> for OwnMission {
    fn from(own: OwnRows) -> Self {
        OwnMission { route: Route::Rows(own.rows), vertical: own.held.into() }
    }
}

impl From<OwnWaypoints> for OwnMission {
    fn from(own: OwnWaypoints) -> Self {
        OwnMission { route: Route::Waypoints(own.waypoints), vertical: own.held.into() }
    }
}

/// What of the vehicle cannot be.
pub(crate) fn check(scenario: &Scenario, objections: &mut ScenarioIssues) {
    let v = &scenario.vehicle;
    // Where the start is scattered it may be anywhere: as shallow as the ground is there.
    let water = if v.start_spread > 0.0 {
        scenario.environment.bottom.shallowest_within(v.start_spread, v.start)
    } else {
        scenario.environment.bottom.depth_at(v.start)
    };
    // Of a grid without water it has been told.
    let has_water = objections.0.iter().all(|objection| objection.clause != "bottom_grid");
    check_start(v, if has_water { water } else { f64::NAN }, &mut objections.of("vehicle"));
    if let Some(limits) = &scenario.limits {
        let mut of = objections.of("limits");
        of.unless(
            Some("altitude"),
            !(limits.altitude > water && water > 0.0),
            format!(
                "the vehicle keeps {} m from the bottom, and starts where the water is {} m deep",
                number(limits.altitude),
                rounded_down(water)
            ),
            format!("make `altitude` {} m at most, or start in deeper water", rounded_down(water)),
        );
    }
    if let Some(handover) = &scenario.handover {
        objections.of("handover").unless(
            Some(if handover.lasting.is_some() { "lasting" } else { "suspends" }),
            handover.suspends.is_some() == handover.lasting.is_some(),
            "the vehicle would suspend nobody: that takes a time and a while",
            "say both `suspends` and `lasting`, or neither",
        );
    }
    if let Some(own) = &scenario.own_mission {
        check_own_mission(scenario, own, objections);
    }
    let mut of = objections.of(v.hull.clause());
    match &v.hull {
        HullSetup::Kinematic(_) => {}
        HullSetup::Fossen(hull) => hull.check(hull::speed_possible(&Fossen::new(), hull.rpm_max()), &mut of),
        HullSetup::Prestero(hull, crossflow) => {
            hull.check(hull::speed_possible(&Prestero::new(*crossflow), hull.rpm_max()), &mut of);
        }
    }
}

/// Whether it can swim its own mission.
fn check_own_mission(scenario: &Scenario, own: &OwnMission, objections: &mut ScenarioIssues) {
    let v = &scenario.vehicle;
    let legs = own.route.legs(v.start, v.heading);
    let mut of = match &own.route {
        Route::Rows(_) => objections.of("rows"),
        Route::Waypoints(waypoints) => {
            let mut of = objections.of("waypoints");
            check_waypoints(waypoints, v, &mut of);
            of
        }
    };
    let Vertical::Depth(depth) = own.vertical else { return };
    let depths =
        legs.iter().flat_map(|leg| [leg.start, leg.end]).map(|point| scenario.environment.bottom.depth_at(point));
    let shallowest = depths.fold(f64::INFINITY, f64::min);
    of.unless(
        Some("depth"),
        depth <= shallowest || !shallowest.is_finite(),
        format!(
            "where it is to swim the water is {} m deep: it cannot swim there at {} m",
            rounded_down(shallowest),
            number(depth)
        ),
        "make `depth` less, or leave it out for an `altitude`",
    );
}

/// Whether there are any, and none is too far.
fn check_waypoints(waypoints: &Waypoints, v: &VehicleSetup, of: &mut OfClause) {
    let (message, mend) = ("there is nowhere to swim to", "give a point at least");
    of.unless(Some("points"), !waypoints.points.is_empty(), message, mend);
    let ways = std::iter::once(&v.start).chain(&waypoints.points).zip(&waypoints.points);
    let length: f64 = ways.map(|(from, to)| from.distance(*to)).sum();
    let most = waypoints.speed * v.endurance;
    of.unless(
        Some("points"),
        length <= most,
        format!("this way is {:.0} km long, and the battery is empty after {:.0} km", length / 1000.0, most / 1000.0),
        "move the points nearer, or let the vehicle have more `endurance`",
    );
}

/// Whether it can start there; `water` is the depth of the water (m), the least that it may be.
fn check_start(v: &VehicleSetup, water: f64, of: &mut OfClause) {
    let (may, most) = (if v.start_spread > 0.0 { "may start" } else { "starts" }, rounded_down(water));
    let mend = match v.start_spread > 0.0 {
        true => "make `spread` less, or move `start` farther into the water",
        false => "move `start` into the water",
    };
    of.unless(Some("start"), water != 0.0, format!("the vehicle {may} on land"), mend);
    of.unless(
        Some("depth"),
        v.depth <= water || water == 0.0 || !water.is_finite(),
        format!("the vehicle {may} below the bottom: {} m deep in {most} m of water", number(v.depth)),
        format!("make `depth` {most} m at most, or start in deeper water"),
    );
}

/// So many steps of integration in a tick: with fewer the roll of a hull is not followed, with more nothing is gained.
const STEPS: RangeInclusive<f64> = 2.0..=100.0;
