//! Which scenarios are impossible, and how that is said.

use albacore_geometry::Vector;
use albacore_vehicle::TICK_S;

/// Why a scenario cannot be simulated: every fault found in it.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", faults.join("; "))]
pub struct ScenarioError {
    /// One sentence each, naming the field at fault.
    pub faults: Vec<String>,
}

/// Collects what cannot be in a scenario, one sentence each.
#[derive(Default)]
pub(crate) struct Objections(pub Vec<String>);

impl Objections {
    pub fn unless(&mut self, holds: bool, fault: impl Into<String>) {
        if !holds {
            self.0.push(fault.into());
        }
    }

    pub fn positive(&mut self, name: &str, value: f64) {
        self.unless(value > 0.0 && value.is_finite(), format!("`{name}` is {value}: it must be above 0"));
    }

    pub fn not_negative(&mut self, name: &str, value: f64) {
        self.unless(value >= 0.0 && value.is_finite(), format!("`{name}` is {value}: it must be 0 or more"));
    }

    /// Samples a second of what is read at ticks.
    pub fn rate(&mut self, name: &str, rate: f64) {
        let most = 1.0 / TICK_S;
        self.unless(
            rate > 0.0 && rate <= most,
            format!("`{name}` is {rate} Hz: it must be above 0 and {most} at most, a sample a tick"),
        );
    }

    /// The way from a sensor to who reads it.
    pub fn delay(&mut self, name: &str, value: f64) {
        self.unless(
            (0.0..=DELAY_MAX_S).contains(&value),
            format!("`{name}` is {value} s: it must be 0 to {DELAY_MAX_S}"),
        );
    }

    /// A share of a whole.
    pub fn share(&mut self, name: &str, value: f64) {
        self.unless((0.0..=1.0).contains(&value), format!("`{name}` is {value}: it must be 0 to 1"));
    }

    pub fn finite(&mut self, name: &str, values: [f64; 2]) {
        self.unless(values.iter().all(|v| v.is_finite()), format!("`{name}` is not a finite number"));
    }

    pub fn flow(&mut self, name: &str, flow: Vector) {
        let speed = flow.length();
        self.unless(speed <= FLOW_MAX, format!("`{name}` is {speed} m/s: it must be {FLOW_MAX} m/s at most"));
    }
}

/// The longest delay of a sensor, s.
const DELAY_MAX_S: f64 = 600.0;
/// The fastest flow, m/s: tidal races reach 8.
const FLOW_MAX: f64 = 10.0;
