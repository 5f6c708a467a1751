//! Faults as a script says them: of a sensor its disorder, else what the vehicle suffers from.

use super::{Fault, FaultKind, Sensor, SensorFault};
use albacore_geometry::{Heading, Vector};
use serde::Deserialize;

/// `fault(…)`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FaultClause {
    sensor: Option<Sensor>,
    trouble: Option<FaultKindClause>,
    from: f64,
    to: Option<f64>,
}

/// What is wrong.
#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
enum FaultKindClause {
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
enum FaultOf {
    Sensor(&'static str, SensorFault),
    Vehicle(&'static str, FaultKind),
}

impl From<FaultKindClause> for FaultOf {
    fn from(clause: FaultKindClause) -> Self {
        use FaultKindClause as T;
        match clause {
            T::Off => FaultOf::Sensor("off", SensorFault::Off),
            T::Stuck => FaultOf::Sensor("stuck", SensorFault::Stuck),
            T::Garbage => FaultOf::Sensor("garbage", SensorFault::Garbage),
            T::Wrong { size } => FaultOf::Sensor("wrong", SensorFault::Wrong(size)),
            T::Slow { every } => FaultOf::Sensor("slow", SensorFault::Slow(every)),
            T::Delayed { by } => FaultOf::Sensor("delayed", SensorFault::Delayed(by)),
            T::Intermittent { heard, silent } => {
                FaultOf::Sensor("intermittent", SensorFault::Intermittent { on: heard, off: silent })
            }
            T::NotANumber => FaultOf::Sensor("not_a_number", SensorFault::NotANumber),
            T::Jump { by, toward } => FaultOf::Sensor("jump", SensorFault::Jump(by * toward.unit())),
            T::Saturated { rate } => FaultOf::Sensor("saturated", SensorFault::Saturated(rate)),
            T::IgnoredCommands => FaultOf::Vehicle("ignored_commands", FaultKind::IgnoredCommands),
            T::Leak => FaultOf::Vehicle("leak", FaultKind::Leak),
            T::Flooding { water, within } => FaultOf::Vehicle("flooding", FaultKind::Flooding { water, within }),
            T::StuckRudder { at } => FaultOf::Vehicle("stuck_rudder", FaultKind::StuckRudder(at)),
            T::StrongCurrent { current } => FaultOf::Vehicle("strong_current", FaultKind::StrongCurrent(current)),
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
            (FaultOf::Sensor(_, disorder), Some(sensor)) => FaultKind::Sensor(sensor, disorder),
            (FaultOf::Sensor(name, _), None) => {
                return Err(format!(
                    "`{name}` is a trouble of a sensor\nsay of which: `fault(position, {name})`, for example"
                ));
            }
            (FaultOf::Vehicle(_, trouble), None) => trouble,
            (FaultOf::Vehicle(name, _), Some(sensor)) => {
                let sensor = sensor.name();
                return Err(format!("`{name}` is a trouble of the vehicle, not of `{sensor}`\nleave `{sensor}` out"));
            }
        };
        Ok(Fault { trouble, from, to })
    }
}
