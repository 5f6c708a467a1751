//! What a scenario says of the water's motion and of where it is computed.

use super::clause::Clause;
use albacore_sim::{Meander, Scenario};

/// `flow(…)`: where the water goes, and how that wanders.
pub fn flow(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    scenario.flow.mean = c.vector("mean")?;
    let direction_sd = c.number("meander")?;
    scenario.flow.meander = if direction_sd > 0.0 {
        Some(Meander {
            direction_sd,
            period: c.number("period")?,
            damping: c.number("damping")?,
            viscosity: c.number("viscosity")?,
            margin: c.number("margin")?,
            cell: c.number("cell")?,
            ..Meander::default()
        })
    } else {
        None
    };
    Ok(())
}

/// `region(…)`: where flow and plume are computed.
pub fn region(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    scenario.region = Some(c.area("area")?);
    Ok(())
}
