//! What a scenario says of the sensors.

use super::clause::Clause;
use albacore_sim::{Adcp, Fluorometer, Lbl, Navigation, Scenario, Sounder};

/// `navigation(…)`: how the vehicle knows its position.
pub fn navigation(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    let mut navigation = Navigation { walk: 0.0, lbl: None };
    if let Some(reckoning) = c.clause("dead_reckoning") {
        navigation.walk = reckoning.number("walk")?;
    }
    if let Some(lbl) = c.clause("fixes") {
        navigation.lbl =
            Some(Lbl { every: lbl.number("every")?, sigma: lbl.number("sigma")?, gate: lbl.number("gate")? });
    }
    scenario.navigation = Some(navigation);
    Ok(())
}

/// `fluorometer(…)`: the chemical sensor.
pub fn fluorometer(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    scenario.fluorometer = Fluorometer {
        rate: c.number("rate")?,
        noise: c.number("noise")?,
        false_alarms: c.number("false_alarms")?,
        ahead: c.number("ahead")?,
    };
    Ok(())
}

/// `adcp(…)`: the Doppler profiler.
pub fn adcp(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    scenario.adcp = Adcp { noise: c.number("noise")? };
    Ok(())
}

/// `sounder(…)`: the echo sounder.
pub fn sounder(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    scenario.sounder = Sounder { noise: c.number("noise")? };
    Ok(())
}
