//! What a scenario says of what goes wrong.

use super::Wrong;
use super::clause::Clause;
use albacore_sim::{Disorder, Fault, Scenario, Sensor, Trouble};

/// `fault(…)`: something that goes wrong for a while.
pub fn fault(scenario: &mut Scenario, c: &Clause) -> Result<(), Wrong> {
    let (from, to) = (c.number("from")?, c.number("to")?);
    scenario.faults.push(Fault { trouble: trouble(c)?, from, to: (to > 0.0).then_some(to) });
    Ok(())
}

fn trouble(c: &Clause) -> Result<Trouble, Wrong> {
    let t = c.clause("trouble");
    let t = t.ok_or_else(|| {
        Wrong::with("this does not say what is wrong", "write `fault(position, off)` or `fault(leak)`, for example")
    })?;
    let name = t.clause.name.as_str();
    let own = match name {
        "ignored_commands" => Some(Trouble::IgnoredCommands),
        "leak" => Some(Trouble::Leak),
        "flooding" => Some(Trouble::Flooding { water: t.number("water")?, within: t.number("within")? }),
        "stuck_rudder" => Some(Trouble::StuckRudder(t.number("at")?)),
        "strong_current" => Some(Trouble::StrongCurrent(t.vector("current")?)),
        _ => None,
    };
    match (own, c.clause("sensor")) {
        (Some(trouble), None) => Ok(trouble),
        (Some(_), Some(sensor)) => {
            let sensor = &sensor.clause.name;
            let message = format!("`{name}` is a trouble of the vehicle, not of `{sensor}`");
            Err(Wrong::with(message, format!("leave `{sensor}` out")))
        }
        (None, Some(sensor)) => Ok(Trouble::Sensor(self::sensor(&sensor)?, disorder(&t)?)),
        (None, None) => {
            let message = format!("`{name}` is a trouble of a sensor");
            Err(Wrong::with(message, format!("say of which: `fault(position, {name})`, for example")))
        }
    }
}

fn sensor(c: &Clause) -> Result<Sensor, String> {
    let name = c.clause.name.as_str();
    let found = Sensor::ALL.into_iter().find(|sensor| sensor.name() == name);
    found.ok_or_else(|| format!("the simulator knows no sensor `{name}`"))
}

fn disorder(t: &Clause) -> Result<Disorder, String> {
    Ok(match t.clause.name.as_str() {
        "off" => Disorder::Off,
        "stuck" => Disorder::Stuck,
        "garbage" => Disorder::Garbage,
        "wrong" => Disorder::Wrong(t.number("size")?),
        "slow" => Disorder::Slow(t.number("every")?),
        "delayed" => Disorder::Delayed(t.number("by")?),
        "intermittent" => Disorder::Intermittent { on: t.number("heard")?, off: t.number("silent")? },
        "not_a_number" => Disorder::NotANumber,
        "jump" => Disorder::Jump(t.number("by")? * t.heading("toward")?.unit()),
        "saturated" => Disorder::Saturated(t.number("rate")?),
        other => return Err(format!("the simulator knows no trouble `{other}`")),
    })
}
