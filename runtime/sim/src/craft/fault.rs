//! What goes wrong: faults of sensors and of the vehicle, each for a while.
//!
//! A fault of a sensor changes its samples on their way to who drives, and nothing else: the vehicle's own autopilot keeps the
//! sensors that it has. Which measurements a sensor has, and what each disorder makes of them, is said at [`Sensor`] and
//! [`SensorFault`]. The kinds are those of PX4's failure injection.

mod clause;
mod filter;
mod sensor;
mod under_way;

pub use sensor::Sensor;
pub(crate) use under_way::Faults;

use crate::craft::setup::HullSetup;
use crate::scenario::{OfClause, Scenario, ScenarioIssues, number};
use albacore_geometry::Vector;
use albacore_vehicle::TICK_S;
use albacore_vehicle::measurements::{HEADING, POSITION, info};
use serde::Deserialize;
use std::fmt;

/// Something that goes wrong for a while.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(try_from = "clause::FaultClause")]
pub struct Fault {
    /// What.
    pub trouble: FaultKind,
    /// When it begins, s after tick 0.
    pub from: f64,
    /// When it is over, s after tick 0; none: it lasts to the end.
    pub to: Option<f64>,
}

impl Fault {
    /// Whether it begins in a run that lasts so long, s.
    pub fn begins_within(&self, lasting: f64) -> bool {
        to_tick(self.from) < to_tick(lasting)
    }
}

/// The nearest tick to a time, s after tick 0: one such as 0.3 s is no whole number of binary tenths.
fn to_tick(seconds: f64) -> f64 {
    (seconds / TICK_S).round()
}

/// What can go wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FaultKind {
    /// A sensor tells something else than what it measures.
    Sensor(Sensor, SensorFault),
    /// The vehicle does not hear commands: it goes on with the last that it heard.
    IgnoredCommands,
    /// Water gets in: the vehicle takes control back for good, and floats up.
    Leak,
    /// Water gets into the hull, evenly for a while, and makes it heavier; the vehicle does not know.
    Flooding {
        /// So much in all, kg.
        water: f64,
        /// In this time from when the fault begins, s; 0: at once.
        within: f64,
    },
    /// The rudder stands at a share of its greatest deflection, positive to starboard, whatever the heading asked for.
    StuckRudder(f64),
    /// So much current is added to that of the water about the vehicle, m/s toward. The plume is not carried by it.
    StrongCurrent(Vector),
}

/// What a sensor's samples become. Where a disorder needs the last sample before it and there was none, it lets the first pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SensorFault {
    /// No samples come.
    Off,
    /// Samples come as ever; each is the last one from before.
    Stuck,
    /// Random numbers from far below to far above what the sensor can measure, evenly.
    Garbage,
    /// A constant error that could be true, so many times the usual one of [`Sensor`]. It is the same for a whole run.
    Wrong(f64),
    /// Samples come so many seconds apart: those between are lost.
    Slow(f64),
    /// Samples come so many seconds late; at first therefore none.
    Delayed(f64),
    /// Samples come and stay away by turns of random length, exponentially distributed about these means, s. It begins with
    /// none.
    Intermittent {
        /// How long samples come.
        on: f64,
        /// How long they stay away.
        off: f64,
    },
    /// Each number is none, or infinite.
    NotANumber,
    /// Positions are displaced by so much, m: a bad fix.
    Jump(Vector),
    /// The gyroscope turns no faster than this, rad/s: what the vehicle turns faster is missing from heading and course.
    Saturated(f64),
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.trouble.fmt(f)
    }
}

impl fmt::Display for FaultKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FaultKind::Sensor(sensor, disorder) => write!(f, "{} {disorder}", sensor.name()),
            FaultKind::IgnoredCommands => f.write_str("ignored commands"),
            FaultKind::Leak => f.write_str("leak"),
            FaultKind::Flooding { .. } => f.write_str("flooding"),
            FaultKind::StuckRudder(_) => f.write_str("stuck rudder"),
            FaultKind::StrongCurrent(_) => f.write_str("strong current"),
        }
    }
}

impl fmt::Display for SensorFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            SensorFault::Off => "off",
            SensorFault::Stuck => "stuck",
            SensorFault::Garbage => "garbage",
            SensorFault::Wrong(_) => "wrong",
            SensorFault::Slow(_) => "slow",
            SensorFault::Delayed(_) => "delayed",
            SensorFault::Intermittent { .. } => "intermittent",
            SensorFault::NotANumber => "not a number",
            SensorFault::Jump(_) => "jumped",
            SensorFault::Saturated(_) => "saturated",
        })
    }
}

/// What of the faults cannot be.
pub(crate) fn check(scenario: &Scenario, objections: &mut ScenarioIssues) {
    for (i, fault) in scenario.faults.iter().enumerate() {
        let mut of = objections.nth("fault", i);
        if let Some(to) = fault.to {
            of.unless(
                Some("to"),
                to > fault.from,
                format!("this fault is over at {} s, and begins at {} s", number(to), number(fault.from)),
                "make `to` later than `from`, or leave it out for a fault that lasts",
            );
        }
        match fault.trouble {
            FaultKind::Sensor(sensor, disorder) => {
                disorder.check(sensor, &mut of);
                let raw = sensor.raw().filter(|_| sensor.measurement().is_none());
                if let Some((missing, mend)) = raw.and_then(|raw| scenario.instruments.lacks(raw)) {
                    of.unless(
                        Some("sensor"),
                        false,
                        format!("nothing takes what `{}` tells: {missing}", sensor.name()),
                        mend,
                    );
                }
            }
            FaultKind::StrongCurrent(current) => of.flow("current", current),
            FaultKind::Flooding { .. } => of.unless(
                Some("trouble"),
                !matches!(scenario.vehicle.hull, HullSetup::Kinematic(_)),
                "flooding is nothing to a `kinematic` vehicle, which knows no weight",
                "let the vehicle be a `fossen` or a `prestero`",
            ),
            FaultKind::IgnoredCommands | FaultKind::Leak | FaultKind::StuckRudder(_) => {}
        }
    }
}

impl SensorFault {
    fn check(self, sensor: Sensor, of: &mut OfClause) {
        let mut only_of = |only: u16, what: &str| {
            let name = info(only).name;
            of.unless(
                Some("trouble"),
                sensor.measurement() == Some(only),
                format!("`{}` cannot {what}: only `{name}` can", sensor.name()),
                format!("write `{name}`, or choose another trouble"),
            );
        };
        match self {
            SensorFault::Jump(_) => only_of(POSITION, "jump"),
            SensorFault::Saturated(_) => only_of(HEADING, "be saturated"),
            _ => {}
        }
    }
}
