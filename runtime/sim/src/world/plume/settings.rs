//! The plume: what a scenario says of it, and what of that cannot be.

use crate::scenario::{Scenario, ScenarioIssues, number};
use crate::world::plume::LONGEST_STEP_S;
use albacore_vehicle::TICK_S;
use serde::Deserialize;

/// How the chemical spreads: filaments that drift, diffuse and grow (Farrell et al. 2002).
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plume {
    /// Growth of a filament's squared radius, m2/s: r2 = `initial_radius`^2 + `growth` age. Default 1e-4.
    pub growth: f64,
    /// Radius of a filament at release, m: the standard deviation of its Gaussian. Default 0.2.
    pub initial_radius: f64,
    /// Horizontal diffusivity of filaments about the centre-line, m2/s. Default 0.027.
    pub diffusivity: f64,
    /// Vertical diffusivity of filaments, m2/s. Default 0: each stays at its source's height.
    pub vertical: f64,
    /// Height above the bottom of the layer that holds the plume, m. Default none: a flat plume, the same at any height.
    pub layer: Option<f64>,
    /// Time step, s: a whole number of ticks, 5 s at most. Default 1. Statistics do not depend on it.
    pub step: f64,
    /// Whether filaments go in strides of many steps, in which their ways are found where somebody looks. Default true. Nor does
    /// anything depend on this.
    pub graded: bool,
}

impl Default for Plume {
    fn default() -> Self {
        Plume {
            growth: 1e-4,
            initial_radius: 0.2,
            diffusivity: 0.027,
            vertical: 0.0,
            layer: None,
            step: 1.0,
            graded: true,
        }
    }
}

/// What of the plume cannot be, once region and flow are sound.
pub(crate) fn check(scenario: &Scenario, objections: &mut ScenarioIssues) {
    let Some(plume) = &scenario.environment.plume else { return };
    let mut of = objections.of("plume");
    let has_region = scenario.environment.region.is_some();
    of.unless(
        None,
        has_region,
        "`plume` needs a `region`: its filaments live there",
        "add `region(…)` to the scenario",
    );
    of.unless(
        None,
        scenario.environment.flow.speed() > 0.0,
        "`plume` needs a `flow` that carries it",
        "give the scenario one: `flow(12 cm/s toward 140 deg)`, for example",
    );
    of.unless(
        Some("vertical"),
        plume.layer.is_some() || plume.vertical <= 0.0,
        "`vertical` of `plume` needs a `layer`: the height that holds the plume",
        "add one, such as `layer: 3.5 m`, or leave `vertical` out",
    );
    let ticks = plume.step / TICK_S;
    of.unless(
        Some("step"),
        plume.step >= TICK_S && plume.step <= LONGEST_STEP_S && (ticks - ticks.round()).abs() < 1e-9,
        format!("`step` of `plume` is {} s", number(plume.step)),
        format!("it must be a whole number of ticks of {TICK_S} s, and {LONGEST_STEP_S} s at most"),
    );
}
