//! A vehicle by its lines: what it says of itself, in modes that no front seat of ours sends.

use albacore_geometry::math::degrees;
use albacore_geometry::{Geodetic, Heading, TangentFrame};
use albacore_link::Controller;
use albacore_link::recon::{self, Adcp, FromVehicle, Mode, State, seal};
use albacore_vehicle::measurements::COURSE;
use albacore_vehicle::{Control, Snapshot};

pub struct Vehicle {
    pub controller: Controller,
    pub snapshot: Snapshot,
    pub time_ms: u32,
    /// What it says that it holds.
    pub heading_goal: Heading,
    pub depth_goal: f64,
    pub speed: f64,
}

impl Vehicle {
    pub fn new() -> Self {
        let frame = TangentFrame { origin: Geodetic::from_degrees(36.18, -75.74) };
        Vehicle {
            controller: Controller::new(recon::controller(), frame),
            snapshot: Snapshot::default(),
            time_ms: 0,
            heading_goal: Heading::NORTH,
            depth_goal: 3.0,
            speed: 0.0,
        }
    }

    /// One state with this mode; who drives then, and what was sent.
    pub fn says(&mut self, mode: u8) -> (Control, String) {
        assert!(self.hear(mode));
        self.controller.sense(&mut self.snapshot);
        (self.snapshot.control, String::from_utf8(self.controller.take_output()).unwrap())
    }

    /// One state with this mode, a tick later; whether it makes a tick.
    pub fn hear(&mut self, mode: u8) -> bool {
        self.time_ms += 100;
        let state = State {
            time_ms: self.time_ms,
            position: Geodetic::from_degrees(36.18, -75.74),
            depth: 3.0,
            depth_goal: self.depth_goal,
            altitude: None,
            pitch: 0.0,
            roll: 0.0,
            rpm: 0.0,
            rpm_goal: 0.0,
            speed: self.speed,
            heading: Heading::NORTH,
            heading_rate: 0.0,
            heading_goal: self.heading_goal,
            mode: Mode(mode),
            leg: None,
        };
        self.controller.hear(seal(&state.to_string()).as_bytes());
        self.controller.is_due()
    }

    /// A message of the profiler, which belongs to the next state.
    pub fn profiles(&mut self, ahead: f64, starboard: f64) {
        let heading = Heading::NORTH;
        let adcp = Adcp { ahead, starboard, vertical: 0.0, altitude: None, heading, current: None, look: 'U' };
        self.controller.hear(seal(&FromVehicle::Adcp(adcp).to_string()).as_bytes());
    }

    /// The course of the last tick, in degrees.
    pub fn course(&self) -> Option<f64> {
        let sample = self.snapshot.samples.iter().find(|sample| sample.measurement == COURSE)?;
        Some((degrees(sample.reading[0]) * 10.0).round() / 10.0)
    }

    pub fn driven() -> Self {
        let mut vehicle = Vehicle::new();
        vehicle.says(0x01);
        vehicle.controller.take_over();
        (0..3).for_each(|_| assert_eq!(vehicle.says(0x0D).0, Control::InControl));
        vehicle
    }
}
