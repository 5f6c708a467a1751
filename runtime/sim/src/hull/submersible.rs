//! A hull that forces move: plant, actuators and autopilot.

use super::actuators::{ActuatorLimits, Actuators};
use super::autopilot::{Autopilot, Gains, Sensed};
use super::six_dof::{Attitude, Controls, Plant, State, Surroundings, runge_kutta};
use super::surface::{Body, Surface};
use super::{Berth, Motion};
use albacore_geometry::{Heading, Point, Vector, wrap_angle};
use albacore_vehicle::{Command, TICK_S};

/// What is set for a submersible, whatever its plant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Steps of the integration in a tick.
    pub steps: u32,
    /// The greatest speed through the water that it is to go, m/s.
    pub speed_max: f64,
    /// What its actuators can do.
    pub limits: ActuatorLimits,
    /// The gains of its autopilot.
    pub gains: Gains,
}

/// A submersible under way.
#[derive(Clone, Debug)]
pub struct Submersible<P> {
    plant: P,
    state: State,
    /// Fins and propeller: also what is stuck of them.
    pub actuators: Actuators,
    /// Water that came in: buoyancy lost, N.
    pub buoyancy_loss: f64,
    autopilot: Autopilot,
    surface: Surface,
    steps: u32,
    motion: Motion,
}

impl<P: Plant> Submersible<P> {
    /// At rest in water that moves with `flow`.
    pub fn new(plant: P, body: &Body, settings: &Settings, berth: &Berth) -> Self {
        let Berth { position, heading, depth, flow } = *berth;
        let pose = [position.north, position.east, depth, 0.0, 0.0, wrap_angle(heading.radians())];
        let [u, v, w] = Attitude::of(&pose).to_body([flow.north, flow.east, 0.0]);
        let state = State { pose, velocity: [u, v, w, 0.0, 0.0, 0.0] };
        let motion = berth.motion();
        Submersible {
            actuators: Actuators::new(settings.limits, TICK_S / f64::from(settings.steps)),
            autopilot: Autopilot::new(&plant, settings.gains, &settings.limits, settings.speed_max),
            surface: Surface::new(body),
            plant,
            state,
            buoyancy_loss: 0.0,
            steps: settings.steps,
            motion,
        }
    }

    /// Where it is and how it moves.
    pub fn motion(&self) -> &Motion {
        &self.motion
    }

    /// What its autopilot and its actuators make of a command in the coming tick.
    fn controls(&mut self, command: Option<&Command>, water_depth: f64) -> Controls {
        let [_, _, depth, _, pitch, _] = self.state.pose;
        let [_, _, _, _, pitch_rate, yaw_rate] = self.state.velocity;
        let sensed = Sensed {
            heading: self.motion.heading,
            pitch,
            pitch_rate,
            yaw_rate,
            depth,
            water_depth,
            speed: self.motion.speed,
        };
        let wanted = self.autopilot.steer(&sensed, command);
        self.actuators.within_limits(&wanted)
    }

    /// Lets one tick go by, in water that moves with `flow`. `water_depth` tells the depth of the water at a point.
    pub fn step(&mut self, command: Option<&Command>, flow: Vector, water_depth: impl Fn(Point) -> f64) {
        let before = self.motion.position;
        let goal = self.controls(command, water_depth(before));
        let around = Surroundings { current: flow, buoyancy_loss: self.buoyancy_loss, surface: Some(self.surface) };
        let h = TICK_S / f64::from(self.steps);
        for _ in 0..self.steps {
            let controls = self.actuators.step(&goal);
            self.state = runge_kutta(&self.plant, &self.state, &controls, &around, h);
        }
        self.state.pose[5] = wrap_angle(self.state.pose[5]);
        let aground = self.rest_on(water_depth(Point::new(self.state.pose[0], self.state.pose[1])));
        self.observe(before, flow, aground);
    }

    /// The bottom stops it and holds it: it can only rise from there. Whether it does.
    fn rest_on(&mut self, bottom: f64) -> bool {
        if self.state.pose[2] <= bottom {
            return false;
        }
        self.state.pose[2] = bottom;
        let attitude = Attitude::of(&self.state.pose);
        let [u, v, w, ..] = self.state.velocity;
        let [_, _, down] = attitude.to_ned([u, v, w]);
        let [u, v, w] = attitude.to_body([0.0, 0.0, down.min(0.0)]);
        self.state.velocity[..3].copy_from_slice(&[u, v, w]);
        true
    }

    fn observe(&mut self, before: Point, flow: Vector, aground: bool) {
        let [north, east, depth, roll, pitch, yaw] = self.state.pose;
        let position = Point::new(north, east);
        let [ahead, ..] = Attitude::of(&self.state.pose).to_body([flow.north, flow.east, 0.0]);
        self.motion = Motion {
            position,
            heading: Heading::from_radians(yaw),
            pitch,
            roll,
            // At the surface it may lie a little out of the water.
            depth: depth.max(0.0),
            speed: self.state.velocity[0] - ahead,
            ground_velocity: (1.0 / TICK_S) * (position - before),
            aground,
        };
    }
}

#[cfg(test)]
mod tests;
