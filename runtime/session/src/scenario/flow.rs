//! What a scenario says of the water: its motion, where that is computed, its layers.

use super::clause::Clause;
use albacore_sim::{Meander, Scenario, Stratification, Tide, UpperFlow, Waves};

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

/// `turning(…)`: the mean flow turns.
pub fn turning(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    scenario.flow.turning = c.number("rate")?;
    Ok(())
}

/// `tide(…)`: a flow to and fro.
pub fn tide(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    scenario.flow.tides.push(Tide {
        name: c.text("name")?,
        amplitude: c.vector("flood")?,
        period: c.number("period")?,
        high: c.number("high")?,
    });
    Ok(())
}

/// `waves(…)`: a sea.
pub fn waves(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    scenario.flow.waves =
        Some(Waves { height: c.number("height")?, period: c.number("period")?, toward: c.heading("toward")? });
    Ok(())
}

/// `upper_layer(…)`: another current above.
pub fn upper_layer(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    scenario.flow.upper = Some(UpperFlow {
        mean: c.vector("flow")?,
        above: c.number("above")?,
        moves: c.number("moves")?,
        period: c.number("period")?,
    });
    Ok(())
}

/// `stratification(…)`: its temperature and salinity.
pub fn stratification(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    scenario.stratification = Stratification {
        surface: c.number("surface")?,
        bottom: c.number("bottom")?,
        surface_salinity: c.number("surface_salinity")?,
        bottom_salinity: c.number("bottom_salinity")?,
        thermocline: c.number("thermocline")?,
        thickness: c.number("thickness")?,
    };
    Ok(())
}
