//! The vehicle of a prompt: a simulated one, what a run's vehicle sensed, which follows nobody any more, or one at the end of a link.

use albacore_sim::Simulator;
use albacore_trace::TickRecord;
use albacore_vehicle::{Command, Measurement, Snapshot, Truth, Vehicle, VehicleError};
use std::collections::VecDeque;
use std::sync::{Arc, PoisonError, RwLock};

/// What a vehicle at the end of a link has told in so many ticks is kept: ten hours.
const TOLD_MAX: usize = 360_000;

/// A vehicle of which a copy stays where it was: its time can be gone through again.
#[derive(Clone)]
pub(super) enum PromptVehicle {
    Simulated(Box<Simulator>),
    Past(PastVehicle),
    Linked(LinkedVehicle),
}

/// A vehicle at the end of a link, and what it has sensed. A copy senses the same again, and reaches nobody.
pub(super) struct LinkedVehicle {
    live: Option<Box<dyn Vehicle + Send>>,
    measurements: Arc<[Measurement]>,
    told: Arc<RwLock<Told>>,
    /// How many ticks have been sensed.
    sensed: u64,
}

/// What a vehicle at the end of a link has told.
#[derive(Default)]
struct Told {
    /// The tick of the first that is kept.
    first: u64,
    ticks: VecDeque<Snapshot>,
}

impl LinkedVehicle {
    pub fn new(vehicle: Box<dyn Vehicle + Send>) -> Self {
        let measurements = vehicle.measurements().into();
        LinkedVehicle { live: Some(vehicle), measurements, told: Arc::default(), sensed: 0 }
    }

    /// The earliest tick that can be sensed again.
    pub fn first(&self) -> u64 {
        self.told.read().unwrap_or_else(PoisonError::into_inner).first
    }

    fn sense(&mut self, snapshot: &mut Snapshot) -> Result<(), VehicleError> {
        match &mut self.live {
            Some(vehicle) => {
                vehicle.sense(snapshot)?;
                let mut told = self.told.write().unwrap_or_else(PoisonError::into_inner);
                told.ticks.push_back(snapshot.clone());
                if told.ticks.len() > TOLD_MAX {
                    told.ticks.pop_front();
                    told.first += 1;
                }
            }
            None => {
                let told = self.told.read().unwrap_or_else(PoisonError::into_inner);
                let tick = self.sensed.checked_sub(told.first).and_then(|at| told.ticks.get(at as usize));
                snapshot.clone_from(tick.ok_or_else(|| VehicleError("that is not remembered".to_string()))?);
            }
        }
        self.sensed += 1;
        Ok(())
    }
}

impl Clone for LinkedVehicle {
    fn clone(&self) -> Self {
        let (measurements, told) = (Arc::clone(&self.measurements), Arc::clone(&self.told));
        LinkedVehicle { live: None, measurements, told, sensed: self.sensed }
    }
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

    /// Whether it is one at the end of a link, or what such a one sensed.
    pub fn is_linked(&self) -> bool {
        matches!(self, PromptVehicle::Linked(_))
    }

    /// Who hears what is said to it: nobody of what was sensed by others.
    pub fn port(&mut self) -> Option<&mut dyn Vehicle> {
        match self {
            PromptVehicle::Simulated(vehicle) => Some(vehicle.as_mut()),
            PromptVehicle::Past(_) => None,
            PromptVehicle::Linked(vehicle) => match &mut vehicle.live {
                Some(live) => Some(live.as_mut()),
                None => None,
            },
        }
    }

    /// Whether no tick is left.
    pub fn is_at_end(&self) -> bool {
        matches!(self, PromptVehicle::Past(past) if past.sensed >= past.ticks.len())
    }

    pub fn measurements(&self) -> &[Measurement] {
        match self {
            PromptVehicle::Simulated(vehicle) => vehicle.measurements(),
            PromptVehicle::Past(past) => &past.measurements,
            PromptVehicle::Linked(vehicle) => &vehicle.measurements,
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
            PromptVehicle::Linked(vehicle) => vehicle.sense(snapshot),
        }
    }

    pub fn take_over(&mut self) -> Result<(), VehicleError> {
        self.port().map_or(Ok(()), |vehicle| vehicle.take_over())
    }

    pub fn command(&mut self, command: &Command) -> Result<(), VehicleError> {
        self.port().map_or(Ok(()), |vehicle| vehicle.command(command))
    }

    pub fn ask(&mut self, id: u64, action: &str) -> Result<(), VehicleError> {
        self.port().map_or(Ok(()), |vehicle| vehicle.ask(id, action))
    }

    pub fn notices(&mut self) -> Vec<String> {
        match self {
            PromptVehicle::Past(past) => past.now().map_or_else(Vec::new, |tick| tick.notices.clone()),
            PromptVehicle::Simulated(_) | PromptVehicle::Linked(_) => {
                self.port().map_or_else(Vec::new, |vehicle| vehicle.notices())
            }
        }
    }

    /// What is so, where that is known.
    pub fn truth(&self) -> Option<Truth> {
        match self {
            PromptVehicle::Simulated(vehicle) => Some(vehicle.truth()),
            PromptVehicle::Past(past) => past.now().and_then(|tick| tick.truth),
            PromptVehicle::Linked(_) => None,
        }
    }
}
