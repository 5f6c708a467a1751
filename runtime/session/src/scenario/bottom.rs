//! What a scenario says of the water's depth.

use super::clause::Clause;
use albacore_sim::{Bottom, Pit, Scenario};

/// `bottom(…)`: a plane.
pub fn bottom(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    scenario.bottom = Bottom {
        from: c.number("from")?,
        to: c.number("to")?,
        toward: c.heading("toward")?,
        across: c.number("across")?,
        pits: std::mem::take(&mut scenario.bottom.pits),
    };
    Ok(())
}

/// `pit(…)`: a hollow in it.
pub fn pit(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    scenario.bottom.pits.push(Pit {
        name: c.text("name")?,
        at: c.point("at")?,
        depth: c.number("depth")?,
        radius: c.number("radius")?,
    });
    Ok(())
}
