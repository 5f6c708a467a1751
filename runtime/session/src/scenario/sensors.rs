//! What a scenario says of the sensors.

use super::clause::Clause;
use albacore_navigation::FlowGates;
use albacore_sim::{
    Adcp, Battery, Compass, Ctd, Dvl, Fluorometer, Gps, Lbl, Looks, Navigation, Pressure, Scenario, Sounder,
};

/// `navigation(…)`: how the vehicle knows its position.
pub fn navigation(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    let mut navigation = Navigation { walk: 0.0, lbl: None };
    if let Some(reckoning) = c.clause("dead_reckoning") {
        navigation.walk = reckoning.number("walk")?;
    }
    if let Some(lbl) = c.clause("fixes") {
        navigation.lbl = Some(Lbl {
            every: lbl.number("every")?,
            sigma: lbl.number("sigma")?,
            gate: lbl.number("gate")?,
            outliers: lbl.number("outliers")?,
            outlier: lbl.number("outlier")?,
            drift: lbl.vector("drift")?,
            delay: lbl.number("delay")?,
        });
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
        bias: c.number("bias")?,
        delay: c.number("delay")?,
        saturation: c.number("saturation")?,
    };
    Ok(())
}

/// `adcp(…)`: the Doppler profiler.
pub fn adcp(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    let looks = match c.clause("looks").map(|looks| looks.clause.name.as_str()) {
        Some("down") => Looks::Down,
        Some("both") => Looks::Both,
        _ => Looks::Up,
    };
    scenario.adcp = Adcp {
        noise: c.number("noise")?,
        bias: c.number("bias")?,
        blanking: c.number("blanking")?,
        bin: c.number("bin")?,
        count: c.number("count")? as u32,
        looks,
        rate: c.number("rate")?,
        delay: c.number("delay")?,
        gates: FlowGates {
            fastest: c.number("fastest")?,
            over_ground: c.number("over_ground")?,
            depth: c.number("depth")?,
            altitude: c.number("altitude")?,
        },
    };
    Ok(())
}

/// `sounder(…)`: the echo sounder.
pub fn sounder(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    scenario.sounder = Sounder {
        noise: c.number("noise")?,
        bias: c.number("bias")?,
        nearest: c.number("nearest")?,
        farthest: above_nothing(c.number("farthest")?),
        dropouts: c.number("dropouts")?,
        rate: c.number("rate")?,
        delay: c.number("delay")?,
    };
    Ok(())
}

/// `compass(…)`.
pub fn compass(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    scenario.compass = Compass {
        noise: c.number("noise")?,
        bias: c.number("bias")?,
        deviation: c.number("deviation")?,
        greatest_at: c.heading("greatest_at")?,
        rate: c.number("rate")?,
        delay: c.number("delay")?,
    };
    Ok(())
}

/// `pressure(…)`: the pressure gauge.
pub fn pressure(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    scenario.pressure = Pressure {
        noise: c.number("noise")?,
        bias: c.number("bias")?,
        rate: c.number("rate")?,
        delay: c.number("delay")?,
    };
    Ok(())
}

/// `dvl(…)`: the Doppler log.
pub fn dvl(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    scenario.dvl = Dvl {
        noise: c.number("noise")?,
        bias: c.number("bias")?,
        range: above_nothing(c.number("range")?),
        rate: c.number("rate")?,
        delay: c.number("delay")?,
    };
    Ok(())
}

/// `gps(…)`: satellite fixes at the surface.
pub fn gps(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    scenario.gps = Some(Gps {
        every: c.number("every")?,
        sigma: c.number("sigma")?,
        above: c.number("above")?,
        bias: c.vector("bias")?,
        delay: c.number("delay")?,
    });
    Ok(())
}

/// `battery(…)`: the gauge of its charge.
pub fn battery(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    scenario.battery = Battery { rate: c.number("rate")?, noise: c.number("noise")?, bias: c.number("bias")? };
    Ok(())
}

/// `ctd(…)`: temperature and salinity.
pub fn ctd(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    scenario.ctd = Some(Ctd {
        rate: c.number("rate")?,
        temperature_noise: c.number("temperature_noise")?,
        temperature_bias: c.number("temperature_bias")?,
        salinity_noise: c.number("salinity_noise")?,
        salinity_bias: c.number("salinity_bias")?,
        above: c.number("above")?,
        delay: c.number("delay")?,
    });
    Ok(())
}

/// Of a limit that may be left out nothing stands for none.
fn above_nothing(limit: f64) -> Option<f64> {
    (limit > 0.0).then_some(limit)
}
