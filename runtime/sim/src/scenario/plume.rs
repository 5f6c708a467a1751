//! The plume and its sources: what a scenario says of them, and what of that cannot be.

use crate::plume::{LONGEST_STEP_S, spin_up_begin, stays_in_layer};
use crate::scenario::{Objections, Scenario};
use albacore_geometry::Point;
use albacore_vehicle::TICK_S;
use serde::{Deserialize, Serialize};

/// How the chemical spreads: filaments that drift, diffuse and grow (Farrell et al. 2002).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
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
}

impl Default for Plume {
    fn default() -> Self {
        Plume { growth: 1e-4, initial_radius: 0.2, diffusivity: 0.027, vertical: 0.0, layer: None, step: 1.0 }
    }
}

/// What releases chemical.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Source {
    /// What it is called.
    pub name: String,
    /// Where it stands. Default the frame's origin.
    pub at: Point,
    /// Metres above the bottom. Default 0.2.
    pub height: f64,
    /// Filaments released a second, on average; the moments are a Poisson process. Default 1.
    pub rate: f64,
    /// What the sensor reads in the middle of one single filament of age `reference_age`, as a ratio of full scale.
    /// Default 0.08: twice a 4 % threshold.
    pub peak: f64,
    /// The age that `peak` is for, s. Default 8752: 1094 m at 12.5 cm/s.
    pub reference_age: f64,
}

impl Default for Source {
    fn default() -> Self {
        Source {
            name: String::from("source"),
            at: Point::ORIGIN,
            height: 0.2,
            rate: 1.0,
            peak: 0.08,
            reference_age: 8752.0,
        }
    }
}

/// What of the plume cannot be, once region and flow are sound.
pub(crate) fn check(scenario: &Scenario, objections: &mut Objections) {
    let Some(plume) = &scenario.plume else { return };
    objections.unless(scenario.region.is_some(), "`plume` needs a `region`: its filaments live there");
    objections.unless(scenario.flow.mean.length() > 0.0, "`plume` needs a flow to carry it: `flow.mean` is 0");
    objections.not_negative("plume.growth", plume.growth);
    objections.positive("plume.initial_radius", plume.initial_radius);
    objections.not_negative("plume.diffusivity", plume.diffusivity);
    objections.not_negative("plume.vertical", plume.vertical);
    match plume.layer {
        Some(layer) => {
            objections.positive("plume.layer", layer);
            objections.unless(
                stays_in_layer(plume, LONGEST_STEP_S) || layer <= 0.0,
                format!("`plume.vertical` mixes a `plume.layer` of {layer} m within seconds: leave both out for a flat plume"),
            );
        }
        None => objections
            .unless(plume.vertical <= 0.0, "`plume.vertical` needs a `plume.layer`: the height that holds the plume"),
    }
    let ticks = plume.step / TICK_S;
    objections.unless(
        plume.step >= TICK_S && plume.step <= LONGEST_STEP_S && (ticks - ticks.round()).abs() < 1e-9,
        format!(
            "`plume.step` is {} s: it must be a whole number of ticks of {TICK_S} s, {LONGEST_STEP_S} s at most",
            plume.step
        ),
    );
}

/// What of the sources cannot be, once region and flow are sound.
pub(crate) fn check_sources(scenario: &Scenario, objections: &mut Objections) {
    objections.unless(
        scenario.sources.is_empty() || scenario.has_plume(),
        "`sources` need a `plume`: without one nothing spreads",
    );
    let before = objections.0.len();
    for source in &scenario.sources {
        let name = &source.name;
        objections.finite(&format!("source {name}: at"), [source.at.north, source.at.east]);
        objections.not_negative(&format!("source {name}: height"), source.height);
        objections.positive(&format!("source {name}: rate"), source.rate);
        objections.positive(&format!("source {name}: peak"), source.peak);
        objections.not_negative(&format!("source {name}: reference_age"), source.reference_age);
        if let Some(region) = &scenario.region {
            let gap = region.gap(source.at);
            objections.unless(gap >= 0.0, format!("source `{name}` is {:.1} m outside the `region`", -gap));
        }
        if let Some(layer) = scenario.plume.as_ref().and_then(|plume| plume.layer) {
            objections.unless(
                source.height <= layer,
                format!("source `{name}` is {} m above the bottom, over the `plume.layer` of {layer} m", source.height),
            );
        }
    }
    if objections.0.len() == before && scenario.plume.is_some() && scenario.flow.mean.length() > 0.0 {
        let transit = -spin_up_begin(scenario);
        let filaments = transit * scenario.sources.iter().map(|source| source.rate).sum::<f64>();
        objections.unless(
            transit <= SPIN_UP_MAX_S,
            format!("`flow.mean` is so slow that the plume takes {transit:.0} s to cross the region: at most {SPIN_UP_MAX_S} s are simulated"),
        );
        objections.unless(
            filaments <= FILAMENTS_MAX,
            format!("the sources' `rate` makes about {filaments:.0} filaments at a time: at most {FILAMENTS_MAX} are simulated"),
        );
    }
}

/// The longest spin-up of a plume, s.
const SPIN_UP_MAX_S: f64 = 200_000.0;
/// The most filaments alive, by estimate.
const FILAMENTS_MAX: f64 = 200_000.0;
