//! Trials of hulls in tests.

use crate::craft::hull::{Hull, Motion};
use crate::craft::setup::{HullSetup, VehicleSetup};
use albacore_geometry::{Heading, Point, Vector};
use albacore_vehicle::{Command, TICK_S, Vertical};

/// A hull under way, and what is asked of it.
pub struct Trial {
    /// The hull.
    pub hull: Hull,
    /// How the water moves, m/s toward.
    pub flow: Vector,
    /// How deep it is, m.
    pub bottom: fn(Point) -> f64,
}

impl Trial {
    /// At rest, 5 m deep in water of 50 m.
    pub fn new(hull: HullSetup) -> Self {
        Trial::at(hull, 5.0)
    }

    /// At rest, so deep, m.
    pub fn at(hull: HullSetup, depth: f64) -> Self {
        let setup = VehicleSetup { hull, depth, ..VehicleSetup::default() };
        Trial { hull: Hull::new(&setup, Vector::ZERO, 1), flow: Vector::ZERO, bottom: |_| 50.0 }
    }

    /// What it does on a command that stays.
    pub fn obey(&mut self, command: Option<Command>, seconds: f64) -> Vec<Motion> {
        (0..(seconds / TICK_S).round() as u64)
            .map(|tick| {
                self.hull.step(tick, command.as_ref(), self.flow, self.bottom, None).unwrap();
                *self.hull.motion()
            })
            .collect()
    }

    /// The same on a heading, at a speed.
    pub fn go(&mut self, heading_deg: f64, speed: f64, vertical: Vertical, seconds: f64) -> Vec<Motion> {
        self.obey(Some(Command::new(Heading::from_degrees(heading_deg), speed, vertical)), seconds)
    }

    /// Running north at 2 m/s and 5 m depth.
    pub fn cruising(hull: HullSetup) -> Self {
        let mut trial = Trial::new(hull);
        trial.go(0.0, 2.0, Vertical::Depth(5.0), 90.0);
        trial
    }
}

/// When the last of the values was further than `band` from the goal, s; and how far beyond it any of them went.
pub fn response(values: impl Iterator<Item = f64> + Clone, goal: f64, band: f64) -> (f64, f64) {
    let outside = values.clone().enumerate().filter(|(_, value)| (value - goal).abs() > band).last();
    let settled = outside.map_or(0.0, |(tick, _)| (tick + 1) as f64 * TICK_S);
    (settled, values.map(|value| value - goal).fold(0.0, f64::max))
}
