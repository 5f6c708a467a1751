//! What a scenario says of the vehicle, its own mission and its computer.

use super::clause::Clause;
use albacore_guidance::Rows;
use albacore_sim::{Handover, KinematicVehicle, OwnMission, Scenario};
use albacore_vehicle::Vertical;

/// `vehicle(…)`: how it moves and where it starts.
pub fn vehicle(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    let model = c.clause("model").ok_or("a vehicle needs a model: write `vehicle(kinematic, start: …)`")?;
    scenario.vehicle = KinematicVehicle {
        start: c.point("start")?,
        start_spread: c.number("spread")?,
        heading: c.heading("heading")?,
        depth: c.number("depth")?,
        speed_max: model.number("speed_max")?,
        turn_rate: model.number("turn_rate")?,
        acceleration: model.number("acceleration")?,
        depth_rate: model.number("depth_rate")?,
        altitude_jitter: model.number("wobble")?,
        altitude_jitter_max: model.number("wobble_max")?,
        altitude_jitter_time: model.number("wobble_time")?,
        endurance: model.number("endurance")?,
        ..KinematicVehicle::default()
    };
    Ok(())
}

/// `rows(…)`: its own mission.
pub fn rows(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    let depth = c.number("depth")?;
    let vertical = if depth > 0.0 { Vertical::Depth(depth) } else { Vertical::Altitude(c.number("altitude")?) };
    let rows = Rows {
        length: c.number("length")?,
        spacing: c.number("spacing")?,
        count: c.number("count")? as u32,
        speed: c.number("speed")?,
    };
    scenario.own_mission = Some(OwnMission { rows, vertical });
    Ok(())
}

/// `handover(…)`: how its computer answers.
pub fn handover(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    scenario.handover = Some(Handover {
        after: c.number("after")?,
        refuses: c.number("refuses")? != 0.0,
        silent: c.number("silent")? != 0.0,
        suspends: c.number("suspends")?,
        lasting: c.number("lasting")?,
        takes_back: c.number("takes_back")?,
        offers: c.number("offers")?,
    });
    Ok(())
}
