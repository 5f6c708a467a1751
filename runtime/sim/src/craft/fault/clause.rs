//! Faults as a script says them: of a sensor its disorder, else what the vehicle suffers from.

use super::{Fault, FaultKind, Sensor, SensorFault};
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
    Sensor(&'static str, SensorFault),
    Vehicle(&'static str, FaultKind),
}

impl From<TroubleClause> for Of {
    fn from(clause: TroubleClause) -> Self {
        use TroubleClause as T;
        match clause {
            T::Off => Of::Sensor("off", SensorFault::Off),
            T::Stuck => Of::Sensor("stuck", SensorFault::Stuck),
            T::Garbage => Of::Sensor("garbage", SensorFault::Garbage),
            T::Wrong { size } => Of::Sensor("wrong", SensorFault::Wrong(size)),
            T::Slow { every } => Of::Sensor("slow", SensorFault::Slow(every)),
            T::Delayed { by } => Of::Sensor("delayed", SensorFault::Delayed(by)),
            T::Intermittent { heard, silent } => {
                Of::Sensor("intermittent", SensorFault::Intermittent { on: heard, off: silent })
            }
            T::NotANumber => Of::Sensor("not_a_number", SensorFault::NotANumber),
            T::Jump { by, toward } => Of::Sensor("jump", SensorFault::Jump(by * toward.unit())),
            T::Saturated { rate } => Of::Sensor("saturated", SensorFault::Saturated(rate)),
            T::IgnoredCommands => Of::Vehicle("ignored_commands", FaultKind::IgnoredCommands),
            T::Leak => Of::Vehicle("leak", FaultKind::Leak),
            T::Flooding { water, within } => Of::Vehicle("flooding", FaultKind::Flooding { water, within }),
            T::StuckRudder { at } => Of::Vehicle("stuck_rudder", FaultKind::StuckRudder(at)),
            T::StrongCurrent { current } => Of::Vehicle("strong_current", FaultKind::StrongCurrent(current)),
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
            (Of::Sensor(_, disorder), Some(sensor)) => FaultKind::Sensor(sensor, disorder),
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
