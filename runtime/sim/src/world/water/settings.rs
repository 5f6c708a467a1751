//! The water's motion: what a scenario says of it, and what of that cannot be.

use crate::scenario::{FLOW_MAX, Scenario, ScenarioIssues, number, rounded_down};
use crate::world::water::{FlowFrame, mesh_fault};
use albacore_geometry::math::{PI, TAU, sin};
use albacore_geometry::{Heading, Vector};
use serde::Deserialize;
use std::ops::RangeInclusive;

/// The water's motion.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Flow {
    /// The mean flow, m/s toward. Default none.
    pub mean: Vector,
    /// Its wandering; none: uniform and steady.
    pub meander: Option<Meander>,
    /// Rate at which the mean turns, clockwise, rad/s; at tick 0 it is `mean`. Default 0.
    pub turning: f64,
    /// Tides, which add up. Default none.
    pub tides: Vec<Tide>,
    /// Surface waves. Default none.
    pub waves: Option<Waves>,
    /// Another current above this one, as in the 2003 trial; none: the same at every height.
    pub upper: Option<UpperFlow>,
}

impl Flow {
    /// The greatest speed of what the whole water does alike, m/s.
    pub fn speed(&self) -> f64 {
        self.tides.iter().fold(self.mean.length(), |speed, tide| speed + tide.amplitude.length())
    }
}

/// The water's mean motion, and how it wanders.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeanFlow {
    mean: Vector,
    meander: f64,
    period: f64,
    damping: f64,
    viscosity: f64,
    margin: f64,
    cell: Option<f64>,
}

impl From<MeanFlow> for (Vector, Option<Meander>) {
    fn from(flow: MeanFlow) -> Self {
        let MeanFlow { mean, meander, period, damping, viscosity, margin, cell } = flow;
        let wanders = Meander { direction_sd: meander, period, damping, viscosity, cell, margin };
        (mean, (meander > 0.0).then_some(wanders))
    }
}

/// How the mean flow turns.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Turning {
    /// Clockwise, rad/s.
    pub rate: f64,
}

/// A tide that runs to and fro on a line: one constituent.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tide {
    /// What it is called.
    pub name: String,
    /// Its velocity where it runs strongest, m/s toward. Default none.
    #[serde(rename = "flood")]
    pub amplitude: Vector,
    /// Its period, s. Default 12.42 h: the principal lunar one, M2.
    pub period: f64,
    /// When it runs strongest that way, s after tick 0. Default 0.
    pub high: f64,
}

impl Default for Tide {
    fn default() -> Self {
        Tide { name: String::from("tide"), amplitude: Vector::ZERO, period: 12.42 * 3600.0, high: 0.0 }
    }
}

/// Surface waves that run one way: a sea of Bretschneider's spectrum.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Waves {
    /// Significant height, m. Default 0.5.
    pub height: f64,
    /// Period of the peak of the spectrum, s. Default 8.
    pub period: f64,
    /// Where they run to. Default north.
    pub toward: Heading,
}

impl Default for Waves {
    fn default() -> Self {
        Waves { height: 0.5, period: 8.0, toward: Heading::NORTH }
    }
}

/// A uniform current that lies over the flow that carries the plume.
///
/// The 2005 paper's own main source of wrong flow (Sec. IV): the upward profiler measures above the vehicle, and where the
/// boundary is low it measures this instead.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct UpperFlow {
    /// Its velocity, m/s toward. Default 0.225 m/s northward.
    #[serde(rename = "flow")]
    pub mean: Vector,
    /// Height above the bottom where it begins, m, on average. Default 3.5.
    pub above: f64,
    /// Its lower boundary moves up and down by this, m. Default 0.
    pub moves: f64,
    /// In this time, s. Default 20 min.
    pub period: f64,
}

impl UpperFlow {
    /// Height above the bottom where it begins at a time (s), m.
    pub fn begins(&self, time: f64) -> f64 {
        if self.moves > 0.0 { self.above + self.moves * sin(TAU * time / self.period) } else { self.above }
    }
}

impl Default for UpperFlow {
    fn default() -> Self {
        UpperFlow { mean: Vector::new(0.225, 0.0), above: 3.5, moves: 0.0, period: 1200.0 }
    }
}

/// A flow field that wanders: the advection field of Farrell et al. 2002 on a grid along the mean flow.
///
/// Each velocity component at the four corners is the mean plus coloured noise of standard deviation
/// `direction_sd` times the greatest speed of mean and tides; inside, du/dt = -(u . grad) u + `viscosity`/2 lap u.
#[derive(Clone, Debug, PartialEq)]
pub struct Meander {
    /// Standard deviation of the flow's direction at a corner, rad. The field damps it on its way in. Default 8 degrees.
    pub direction_sd: f64,
    /// Period of the noise, s: its bandwidth is 2 pi over it. Default 2732 s (0.0023 rad/s).
    pub period: f64,
    /// Damping ratio of the noise, between 0 and 1. Default 0.1.
    pub damping: f64,
    /// Twice the eddy viscosity of the field, m2/s: Farrell's k_x = k_y. Default 27.
    pub viscosity: f64,
    /// Side of a grid cell, about, m. Default none: as large as the viscosity allows in this flow, from 20 m to 40 m.
    pub cell: Option<f64>,
    /// How far the grid reaches beyond the region on every side, m. Default 60.
    pub margin: f64,
}

impl Meander {
    /// Time step of the field, s: a hundredth of the period, from 5 s to 20 s.
    pub fn step(&self) -> f64 {
        (0.01 * self.period).clamp(5.0, 20.0)
    }
}

/// Cells are so large where nothing is said of them, m.
const CELLS: RangeInclusive<f64> = 20.0..=40.0;
/// Corner speeds beyond the mean that a field is ready for, in standard deviations.
const DEVIATIONS: f64 = 4.0;

impl Meander {
    /// The speed to be ready for where the mean flow and the tides have this one at most, m/s.
    pub fn fastest(&self, speed: f64) -> f64 {
        speed * (1.0 + DEVIATIONS * self.direction_sd)
    }

    /// The side of a cell in a flow whose mean and tides have this speed at most, about, m. Centred differences oscillate when a cell's
    /// Peclet number u dx / (k/2) exceeds 2.
    pub fn side(&self, speed: f64) -> f64 {
        let allowed = self.viscosity / self.fastest(speed);
        self.cell.unwrap_or(allowed.max(*CELLS.start()).min(*CELLS.end()))
    }
}

impl Default for Meander {
    fn default() -> Self {
        Meander {
            direction_sd: 8.0 * PI / 180.0,
            period: 2732.0,
            damping: 0.1,
            viscosity: 27.0,
            cell: None,
            margin: 60.0,
        }
    }
}

/// The height of a wave over the depth of the water: higher ones break (McCowan 1894).
const BREAKING: f64 = 0.78;

/// The mean and the upper flow.
pub(crate) fn check(scenario: &Scenario, objections: &mut ScenarioIssues) {
    objections.of("flow").flow("mean", scenario.environment.flow.mean);
    check_current(&scenario.environment.flow, objections);
    if let Some(waves) = &scenario.environment.flow.waves {
        let start = scenario.environment.bottom.depth_at(scenario.vehicle.start);
        let highest = BREAKING * start;
        objections.of("waves").unless(
            Some("height"),
            waves.height <= highest || start <= 0.0 || !start.is_finite(),
            format!(
                "waves {} m high break where the vehicle starts, in {} m of water",
                number(waves.height),
                rounded_down(start)
            ),
            format!("make them {} m high at most, or start in deeper water", rounded_down(highest)),
        );
    }
    let (speed, tides) = (scenario.environment.flow.speed(), !scenario.environment.flow.tides.is_empty());
    let message = format!("with its tides the water runs as fast as {} m/s: no sea does", number(speed));
    let mend = format!("make flow and tides less: {FLOW_MAX} m/s at most, all together");
    objections.of("flow").unless(Some("mean"), !tides || speed <= FLOW_MAX, message, mend);
    if let Some(upper) = &scenario.environment.flow.upper {
        let mut layer = objections.of("upper_layer");
        layer.flow("flow", upper.mean);
        let deepest = scenario.environment.bottom.deepest_possible();
        layer.unless(
            Some("above"),
            upper.above <= deepest || !deepest.is_finite(),
            format!(
                "{} m above the bottom is out of the water, which is {} m deep at most",
                number(upper.above),
                number(deepest)
            ),
            "let the upper layer begin in the water",
        );
        layer.unless(
            Some("moves"),
            upper.moves <= upper.above,
            format!(
                "the boundary moves by {} m, and is {} m above the bottom",
                number(upper.moves),
                number(upper.above)
            ),
            "let it move less: it stays above the bottom",
        );
    }
}

/// What the whole water does alike.
fn check_current(flow: &Flow, objections: &mut ScenarioIssues) {
    for (i, tide) in flow.tides.iter().enumerate() {
        let mut of = objections.nth("tide", i);
        of.name(&tide.name, &flow.tides[..i].iter().map(|t| t.name.as_str()).collect::<Vec<_>>());
        of.flow("flood", tide.amplitude);
    }
    let Some(waves) = &flow.waves else { return };
    let mut of = objections.of("waves");
    // Steeper waves than one in ten break; their length is at most that in deep water.
    let steepest = 0.1 * 9.81 * waves.period * waves.period / TAU;
    of.unless(
        Some("height"),
        waves.height <= steepest,
        format!("waves {} m high break when their period is {} s", number(waves.height), number(waves.period)),
        format!("make them {} m high at most, or their `period` longer", rounded_down(steepest)),
    );
}

/// The meander, once region and mean flow are sound.
pub(crate) fn check_meander(scenario: &Scenario, objections: &mut ScenarioIssues) {
    let Some(meander) = &scenario.environment.flow.meander else { return };
    let before = objections.0.len();
    let mut of = objections.of("flow");
    of.unless(
        Some("meander"),
        scenario.environment.region.is_some(),
        "a `flow` with a `meander` needs a `region`: it wanders on a grid over it",
        "add `region(…)` to the scenario, or leave `meander` out",
    );
    of.unless(
        Some("mean"),
        scenario.environment.flow.mean.length() > 0.0,
        "a flow of 0 m/s cannot meander",
        "give it a speed, or leave `meander` out",
    );
    of.unless(
        Some("damping"),
        meander.damping > 0.0 && meander.damping < 1.0,
        format!("`damping` of `flow` is {}", number(meander.damping)),
        "it must be between 0 and 1",
    );
    if objections.0.len() == before {
        let frame = FlowFrame::new(&scenario.environment.flow, scenario.environment.region.as_ref());
        if let Some(fault) = mesh_fault(meander, &frame, scenario.environment.flow.speed()) {
            objections.of("flow").unless(Some(fault.param), false, fault.message, fault.mend);
        }
    }
}
