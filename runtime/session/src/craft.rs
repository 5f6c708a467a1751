//! What a run drives: a simulated vehicle, of which the truth is known, or one behind a link, of which it is not.

use albacore_geometry::Point;
use albacore_sim::{Simulator, Truth};
use albacore_vehicle::{Channel, Vehicle};

/// A vehicle and what is known of it besides.
pub(crate) enum Craft {
    /// In a simulated world.
    Simulated(Box<Simulator>),
    /// At the end of a link.
    Linked(Box<dyn Vehicle + Send>),
}

impl Craft {
    /// The vehicle as a mission sees it.
    pub fn port(&mut self) -> &mut dyn Vehicle {
        match self {
            Craft::Simulated(simulator) => simulator.as_mut(),
            Craft::Linked(vehicle) => vehicle.as_mut(),
        }
    }

    /// What it measures.
    pub fn channels(&self) -> &[Channel] {
        match self {
            Craft::Simulated(simulator) => simulator.channels(),
            Craft::Linked(vehicle) => vehicle.channels(),
        }
    }

    /// What is so, whatever the sensors say: known in simulation only.
    pub fn truth(&self) -> Option<Truth> {
        match self {
            Craft::Simulated(simulator) => Some(simulator.truth()),
            Craft::Linked(_) => None,
        }
    }

    /// How deep the water is at a point, m: known in simulation only.
    pub fn water_depth(&self, at: Point) -> Option<f64> {
        match self {
            Craft::Simulated(simulator) => Some(simulator.water_depth(at)),
            Craft::Linked(_) => None,
        }
    }

    /// The plume's filaments, for the picture.
    pub fn filaments(&self) -> Vec<(Point, f64)> {
        match self {
            Craft::Simulated(simulator) => simulator.filaments().collect(),
            Craft::Linked(_) => Vec::new(),
        }
    }
}

/// Metres driven, from position to position.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Odometer {
    last: Option<Point>,
    /// Steps shorter than this are not counted until they add up to it, m.
    grain: f64,
    length: f64,
}

/// A link's positions are 0.2 m fine: shorter steps than this would count its rounding as a way.
const LINK_GRAIN: f64 = 2.0;

impl Odometer {
    /// Of a vehicle before its first tick.
    pub fn new(craft: &Craft) -> Self {
        let last = craft.truth().map(|truth| truth.position);
        Odometer { last, grain: if last.is_some() { 0.0 } else { LINK_GRAIN }, length: 0.0 }
    }

    /// The vehicle is here now.
    pub fn reach(&mut self, here: Point) {
        let step = here.distance(self.last.unwrap_or(here));
        if step >= self.grain {
            self.length += step;
        }
        if step >= self.grain || self.last.is_none() {
            self.last = Some(here);
        }
    }

    /// The way so far, m.
    pub fn length(&self) -> f64 {
        self.length
    }
}
