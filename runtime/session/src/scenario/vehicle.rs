//! What a scenario says of the vehicle, its own mission and its computer.

use super::Wrong;
use super::clause::Clause;
use albacore_guidance::{Route, Rows, Waypoints};
use albacore_link::Dialect;
use albacore_sim::hull::Crossflow;
use albacore_sim::{HullSetup, KinematicHull, OwnMission, Scenario, SubmersibleHull, VehicleSetup};
use albacore_vehicle::{Handover, Limits, Vertical};

/// `vehicle(…)`: how it moves and where it starts.
pub fn vehicle(scenario: &mut Scenario, c: &Clause) -> Result<(), Wrong> {
    let model = c.clause("model");
    let model = model.ok_or_else(|| {
        Wrong::with("this does not say how the vehicle moves", "write `vehicle(kinematic, start: …)`, for example")
    })?;
    scenario.vehicle = VehicleSetup {
        hull: hull(&model)?,
        start: c.point("start")?,
        start_spread: c.number("spread")?,
        heading: c.heading("heading")?,
        depth: c.number("depth")?,
        endurance: model.number("endurance")?,
    };
    Ok(())
}

/// `kinematic(…)`, `fossen(…)` or `prestero(…)`: how it moves.
fn hull(c: &Clause) -> Result<HullSetup, String> {
    Ok(match c.clause.name.as_str() {
        "fossen" => HullSetup::Fossen(submersible(c)?),
        "prestero" => {
            let crossflow = if c.number("as_printed")? != 0.0 { Crossflow::AsPrinted } else { Crossflow::Corrected };
            HullSetup::Prestero(submersible(c)?, crossflow)
        }
        "kinematic" => HullSetup::Kinematic(KinematicHull {
            speed_max: c.number("speed_max")?,
            turn_rate: c.number("turn_rate")?,
            acceleration: c.number("acceleration")?,
            depth_rate: c.number("depth_rate")?,
            altitude_jitter: c.number("wobble")?,
            altitude_jitter_max: c.number("wobble_max")?,
            altitude_jitter_time: c.number("wobble_time")?,
            ..KinematicHull::default()
        }),
        other => return Err(format!("the simulator knows no hull `{other}`")),
    })
}

fn submersible(c: &Clause) -> Result<SubmersibleHull, String> {
    Ok(SubmersibleHull {
        speed_max: c.number("speed_max")?,
        fin_max: c.number("fin_max")?,
        turns_max: c.number("turns_max")?,
        step: c.number("step")?,
    })
}

/// `limits(…)`: the vehicle's own, apart from the mission's.
pub fn limits(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    // 0 is no limit.
    let limit = |name: &str| Ok::<_, String>(Some(c.number(name)?).filter(|limit| *limit != 0.0));
    scenario.limits = Some(Limits { depth: limit("depth")?, altitude: c.number("altitude")?, speed: limit("speed")? });
    Ok(())
}

/// `rows(…)`: its own mission.
pub fn rows(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    let rows = Rows {
        length: c.number("length")?,
        spacing: c.number("spacing")?,
        count: c.number("count")? as u32,
        speed: c.number("speed")?,
    };
    own_mission(scenario, c, Route::Rows(rows))
}

/// `waypoints(…)`: its own mission.
pub fn waypoints(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    let waypoints = Waypoints { points: c.points("points")?, speed: c.number("speed")? };
    own_mission(scenario, c, Route::Waypoints(waypoints))
}

/// A route, and what is held on it.
fn own_mission(scenario: &mut Scenario, c: &Clause, route: Route) -> Result<(), String> {
    let depth = c.number("depth")?;
    let vertical = if depth > 0.0 { Vertical::Depth(depth) } else { Vertical::Altitude(c.number("altitude")?) };
    scenario.own_mission = Some(OwnMission { route, vertical });
    Ok(())
}

/// `dialect(…)`: what it speaks at the end of a link.
pub fn dialect(c: &Clause) -> Result<Dialect, Wrong> {
    let speaks =
        c.clause("speaks").ok_or_else(|| Wrong::with("`dialect` needs a protocol", "write `dialect(recon)`"))?;
    Ok(Dialect::named(&speaks.clause.name).map_err(|error| error.message)?)
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
