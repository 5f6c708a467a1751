//! Which scenarios are impossible, and how that is said.

use albacore_geometry::Vector;

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

    pub fn finite(&mut self, name: &str, values: [f64; 2]) {
        self.unless(values.iter().all(|v| v.is_finite()), format!("`{name}` is not a finite number"));
    }

    pub fn flow(&mut self, name: &str, flow: Vector) {
        let speed = flow.length();
        self.unless(speed <= FLOW_MAX, format!("`{name}` is {speed} m/s: it must be {FLOW_MAX} m/s at most"));
    }
}

/// The fastest flow, m/s: tidal races reach 8.
const FLOW_MAX: f64 = 10.0;
