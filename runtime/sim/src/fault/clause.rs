//! Faults as a script says them: of a sensor its disorder, else what the vehicle suffers from.

use super::{Disorder, Fault, Sensor, Trouble};
use albacore_geometry::{Heading, Vector};
use serde::Deserialize;

/// `fault(…)`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FaultClause {
    sensor: Option<Sensor>,
    trouble: Option<TroubleClause>,
    from: f64,
    to: Option<f64>,
}

/// What is wrong.
#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
enum TroubleClause {
    Off,
    Stuck,
    Garbage,
    Wrong { size: f64 },
    Slow { every: f64 },
    Delayed { by: f64 },
    Intermittent { heard: f64, silent: f64 },
    NotANumber,
    Jump { by: f64, toward: Heading },
    Saturated { rate: f64 },
    IgnoredCommands,
    Leak,
    Flooding { water: f64, within: f64 },
    StuckRudder { at: f64 },
    StrongCurrent { current: Vector },
}

/// What a trouble is one of.
enum Of {
    Sensor(&'static str, Disorder),
    Vehicle(&'static str, Trouble),
}

impl From<TroubleClause> for Of {
    fn from(clause: TroubleClause) -> Self {
        use TroubleClause as T;
        match clause {
            T::Off => Of::Sensor("off", Disorder::Off),
            T::Stuck => Of::Sensor("stuck", Disorder::Stuck),
            T::Garbage => Of::Sensor("garbage", Disorder::Garbage),
            T::Wrong { size } => Of::Sensor("wrong", Disorder::Wrong(size)),
            T::Slow { every } => Of::Sensor("slow", Disorder::Slow(every)),
            T::Delayed { by } => Of::Sensor("delayed", Disorder::Delayed(by)),
            T::Intermittent { heard, silent } => {
                Of::Sensor("intermittent", Disorder::Intermittent { on: heard, off: silent })
            }
            T::NotANumber => Of::Sensor("not_a_number", Disorder::NotANumber),
            T::Jump { by, toward } => Of::Sensor("jump", Disorder::Jump(by * toward.unit())),
            T::Saturated { rate } => Of::Sensor("saturated", Disorder::Saturated(rate)),
            T::IgnoredCommands => Of::Vehicle("ignored_commands", Trouble::IgnoredCommands),
            T::Leak => Of::Vehicle("leak", Trouble::Leak),
            T::Flooding { water, within } => Of::Vehicle("flooding", Trouble::Flooding { water, within }),
            T::StuckRudder { at } => Of::Vehicle("stuck_rudder", Trouble::StuckRudder(at)),
            T::StrongCurrent { current } => Of::Vehicle("strong_current", Trouble::StrongCurrent(current)),
        }
    }
}

impl TryFrom<FaultClause> for Fault {
    type Error = String;

    fn try_from(clause: FaultClause) -> Result<Self, String> {
        let FaultClause { sensor, trouble, from, to } = clause;
        let trouble = trouble
            .ok_or("this does not say what is wrong\nwrite `fault(position, off)` or `fault(leak)`, for example")?;
        let trouble = match (trouble.into(), sensor) {
            (Of::Sensor(_, disorder), Some(sensor)) => Trouble::Sensor(sensor, disorder),
            (Of::Sensor(name, _), None) => {
                return Err(format!(
                    "`{name}` is a trouble of a sensor\nsay of which: `fault(position, {name})`, for example"
                ));
            }
            (Of::Vehicle(_, trouble), None) => trouble,
            (Of::Vehicle(name, _), Some(sensor)) => {
                let sensor = sensor.name();
                return Err(format!("`{name}` is a trouble of the vehicle, not of `{sensor}`\nleave `{sensor}` out"));
            }
        };
        Ok(Fault { trouble, from, to })
    }
}
