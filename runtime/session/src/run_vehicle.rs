//! What a run drives: a simulated vehicle, of which the truth is known, or one behind a link, of which it is not.

use albacore_geometry::Point;
use albacore_sim::Simulator;
use albacore_vehicle::{Measurement, NavigationErrors, Truth, Vehicle};

/// A vehicle and what is known of it besides.
pub(crate) enum RunVehicle {
    /// In a simulated world.
    Simulated(Box<Simulator>),
    /// At the end of a link.
    Linked(Box<dyn Vehicle + Send>),
}

impl RunVehicle {
    /// The vehicle as a mission sees it.
    pub fn port(&mut self) -> &mut dyn Vehicle {
        match self {
            RunVehicle::Simulated(simulator) => simulator.as_mut(),
            RunVehicle::Linked(vehicle) => vehicle.as_mut(),
        }
    }

    /// What it measures.
    pub fn measurements(&self) -> &[Measurement] {
        match self {
            RunVehicle::Simulated(simulator) => simulator.measurements(),
            RunVehicle::Linked(vehicle) => vehicle.measurements(),
        }
    }

    /// What is so, whatever the sensors say: known in simulation only.
    pub fn truth(&self) -> Option<Truth> {
        match self {
            RunVehicle::Simulated(simulator) => Some(simulator.truth()),
            RunVehicle::Linked(_) => None,
        }
    }

    /// How far off its inertial navigator is, where it has one: known in simulation only.
    pub fn navigation(&self) -> Option<NavigationErrors> {
        match self {
            RunVehicle::Simulated(simulator) => simulator.navigation(),
            RunVehicle::Linked(_) => None,
        }
    }

    /// How deep the water is at a point, m: known in simulation only.
    pub fn water_depth(&self, at: Point) -> Option<f64> {
        match self {
            RunVehicle::Simulated(simulator) => Some(simulator.water_depth(at)),
            RunVehicle::Linked(_) => None,
        }
    }

    /// The plume's filaments, for the picture.
    pub fn filaments(&self) -> Vec<(Point, f64)> {
        match self {
            RunVehicle::Simulated(simulator) => simulator.filaments().collect(),
            RunVehicle::Linked(_) => Vec::new(),
        }
    }
}
