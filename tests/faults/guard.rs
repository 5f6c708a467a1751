//! A vehicle that minds what it is told: the fake vehicle's own word on every command, not the interpreter's.

use albacore_session::Plan;
use albacore_sim::Simulator;
use albacore_vehicle::{Command, Measurement, Snapshot, Vehicle, VehicleError, Vertical};
use std::sync::{Arc, Mutex};

/// The limits that `survey.alb` gives itself: m/s, m, m.
const SPEED_MAX: f64 = 2.5;
const DEPTH_MAX: f64 = 15.0;
const ALTITUDE_MIN: f64 = 2.0;
/// Rounding.
const LITTLE: f64 = 1e-9;

/// What was wrong with commands, told once each.
#[derive(Clone, Default)]
pub struct Problems(Arc<Mutex<Vec<String>>>);

impl Problems {
    fn add(&self, problem: String) {
        let mut all = self.0.lock().unwrap();
        if all.len() < 3 {
            all.push(problem);
        }
    }

    /// All of them.
    pub fn take(&self) -> Vec<String> {
        std::mem::take(&mut self.0.lock().unwrap())
    }
}

/// A simulated vehicle, and a look at each command.
pub struct Guard {
    vehicle: Simulator,
    problems: Problems,
    released: bool,
}

impl Guard {
    /// In the world of a plan.
    pub fn new(plan: &Plan, seed: u64, problems: &Problems) -> Self {
        let vehicle = Simulator::new(&plan.scenario, seed).unwrap();
        Guard { vehicle, problems: problems.clone(), released: false }
    }

    fn mind(&self, command: &Command) {
        let heading = command.heading.radians();
        let vertical = match command.vertical {
            Vertical::Depth(depth) => (-LITTLE..=DEPTH_MAX + LITTLE).contains(&depth),
            Vertical::Altitude(altitude) => altitude >= ALTITUDE_MIN - LITTLE && altitude.is_finite(),
        };
        if !(heading.is_finite() && (-LITTLE..=SPEED_MAX + LITTLE).contains(&command.speed) && vertical) {
            self.problems.add(format!("after {} s: {command:?}", self.vehicle.time_s()));
        }
        if self.released {
            self.problems.add(format!("after its release: {command:?}"));
        }
    }
}

impl Vehicle for Guard {
    fn measurements(&self) -> &[Measurement] {
        self.vehicle.measurements()
    }

    fn sense(&mut self, snapshot: &mut Snapshot) -> Result<(), VehicleError> {
        self.vehicle.sense(snapshot)
    }

    fn take_over(&mut self) -> Result<(), VehicleError> {
        self.vehicle.take_over()
    }

    fn command(&mut self, command: &Command) -> Result<(), VehicleError> {
        self.mind(command);
        self.vehicle.command(command)
    }

    fn give_back(&mut self) -> Result<(), VehicleError> {
        self.vehicle.give_back()
    }

    fn release(&mut self) -> Result<(), VehicleError> {
        self.released = true;
        self.vehicle.release()
    }

    fn notices(&mut self) -> Vec<String> {
        self.vehicle.notices()
    }
}
