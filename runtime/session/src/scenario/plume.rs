//! What a scenario says of the plume and its sources.

use super::clause::Clause;
use albacore_sim::{Plume, Scenario, Source};

/// `plume(…)`: how chemical spreads.
pub fn plume(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    let layer = c.number("layer")?;
    scenario.plume = Some(Plume {
        growth: c.number("growth")?,
        initial_radius: c.number("initial_radius")?,
        diffusivity: c.number("diffusivity")?,
        vertical: c.number("vertical")?,
        layer: (layer > 0.0).then_some(layer),
        step: c.number("step")?,
    });
    Ok(())
}

/// `source(…)`: what releases it.
pub fn source(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    scenario.sources.push(Source {
        name: c.text("name")?,
        at: c.point("at")?,
        height: c.number("height")?,
        rate: c.number("rate")?,
        peak: c.number("peak")?,
        reference_age: c.number("peak_age")?,
    });
    Ok(())
}
