//! The vehicle of a prompt: a simulated one, or what a run's vehicle sensed, which follows nobody any more.

use albacore_sim::Simulator;
use albacore_trace::TickRecord;
use albacore_vehicle::{Command, Measurement, Snapshot, Truth, Vehicle, VehicleError};
use std::sync::Arc;

/// A vehicle whose time goes back as well as on.
#[derive(Clone)]
pub(super) enum PromptVehicle {
    Simulated(Box<Simulator>),
    Past(PastVehicle),
}

/// What a run's vehicle sensed.
#[derive(Clone)]
pub(super) struct PastVehicle {
    measurements: Arc<[Measurement]>,
    /// The ticks of its journal.
    ticks: Arc<[TickRecord]>,
    /// How many of them have been sensed.
    sensed: usize,
}

impl PastVehicle {
    pub fn new(measurements: Arc<[Measurement]>, ticks: Arc<[TickRecord]>) -> Self {
        PastVehicle { measurements, ticks, sensed: 0 }
    }

    fn now(&self) -> Option<&TickRecord> {
        self.ticks.get(self.sensed.checked_sub(1)?)
    }
}

impl PromptVehicle {
    /// Whether it is what a run's vehicle sensed.
    pub fn is_past(&self) -> bool {
        matches!(self, PromptVehicle::Past(_))
    }

    /// Whether no tick is left.
    pub fn is_at_end(&self) -> bool {
        matches!(self, PromptVehicle::Past(past) if past.sensed >= past.ticks.len())
    }

    pub fn measurements(&self) -> &[Measurement] {
        match self {
            PromptVehicle::Simulated(vehicle) => vehicle.measurements(),
            PromptVehicle::Past(past) => &past.measurements,
        }
    }

    pub fn sense(&mut self, snapshot: &mut Snapshot) -> Result<(), VehicleError> {
        match self {
            PromptVehicle::Simulated(vehicle) => vehicle.sense(snapshot),
            PromptVehicle::Past(past) => {
                let tick = past.ticks.get(past.sensed);
                let tick = tick.ok_or_else(|| VehicleError("the journal ends here".to_string()))?;
                snapshot.clone_from(&tick.snapshot);
                past.sensed += 1;
                Ok(())
            }
        }
    }

    pub fn take_over(&mut self) -> Result<(), VehicleError> {
        match self {
            PromptVehicle::Simulated(vehicle) => vehicle.take_over(),
            PromptVehicle::Past(_) => Ok(()),
        }
    }

    pub fn command(&mut self, command: &Command) -> Result<(), VehicleError> {
        match self {
            PromptVehicle::Simulated(vehicle) => vehicle.command(command),
            PromptVehicle::Past(_) => Ok(()),
        }
    }

    pub fn ask(&mut self, id: u64, action: &str) -> Result<(), VehicleError> {
        match self {
            PromptVehicle::Simulated(vehicle) => vehicle.ask(id, action),
            PromptVehicle::Past(_) => Ok(()),
        }
    }

    pub fn notices(&mut self) -> Vec<String> {
        match self {
            PromptVehicle::Simulated(vehicle) => vehicle.notices(),
            PromptVehicle::Past(past) => past.now().map_or_else(Vec::new, |tick| tick.notices.clone()),
        }
    }

    /// What is so, where that is known.
    pub fn truth(&self) -> Option<Truth> {
        match self {
            PromptVehicle::Simulated(vehicle) => Some(vehicle.truth()),
            PromptVehicle::Past(past) => past.now().and_then(|tick| tick.truth),
        }
    }
}
