//! What a scenario says of the plume and its sources.

use super::clause::Clause;
use albacore_geometry::Point;
use albacore_sim::{Patch, Plume, Scenario, Source, Times};

/// `plume(…)`: how chemical spreads.
pub fn plume(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    let layer = c.number("layer")?;
    scenario.plume = Some(Plume {
        growth: c.number("growth")?,
        initial_radius: c.number("initial_radius")?,
        diffusivity: c.number("diffusivity")?,
        vertical: c.number("vertical")?,
        layer: (layer != 0.0).then_some(layer),
        step: c.number("step")?,
        graded: c.number("graded")? != 0.0,
    });
    Ok(())
}

/// `source(…)`: what releases it.
pub fn source(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    let at = c.point("at")?;
    scenario.sources.push(released(c, at, None)?);
    Ok(())
}

/// `leak(…)`: the same along a line.
pub fn leak(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    let (from, to) = (c.point("from")?, c.point("to")?);
    scenario.sources.push(released(c, from, Some(to))?);
    Ok(())
}

/// What a source and a leak have in common.
fn released(c: &Clause, at: Point, to: Option<Point>) -> Result<Source, String> {
    Ok(Source {
        name: c.text("name")?,
        at,
        to,
        height: c.number("height")?,
        rate: c.number("rate")?,
        peak: c.number("peak")?,
        reference_age: c.number("peak_age")?,
        when: Times {
            begins: c.number("begins")?,
            ends: c.number("ends")?,
            on: c.number("on")?,
            off: c.number("off")?,
        },
    })
}

/// `patch(…)`: what was left in the water.
pub fn patch(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    scenario.patches.push(Patch {
        name: c.text("name")?,
        at: c.point("at")?,
        radius: c.number("radius")?,
        height: c.number("height")?,
        filaments: c.number("filaments")? as u32,
        age: c.number("age")?,
        peak: c.number("peak")?,
        reference_age: c.number("peak_age")?,
    });
    Ok(())
}
