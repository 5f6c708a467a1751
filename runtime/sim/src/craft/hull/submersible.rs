//! A hull that forces move: plant, actuators and autopilot.

use super::actuators::{ActuatorLimits, Actuators};
use super::autopilot::{Autopilot, Gains, Misjudged, Sensed};
use super::grounding::{Grounding, Intent, pivot};
use super::lqr::Controller;
use super::six_dof::{Plant, State, Surroundings, attitude_of, runge_kutta};
use super::surface::{Body, Surface};
use super::{Diverged, Motion, StartPose, Track};
use albacore_geometry::{Heading, Point, Vector, wrap_angle};
use albacore_vehicle::{Command, TICK_S};
use nalgebra::Vector6;

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
    /// What moves its fins.
    pub controller: Controller,
}

impl Settings {
    /// Time step of the integration, s.
    pub fn step(&self) -> f64 {
        TICK_S / f64::from(self.steps)
    }
}

/// A submersible under way.
#[derive(Clone, Debug)]
pub struct Submersible<P> {
    plant: P,
    state: State,
    /// Fins and propeller: also what is stuck of them.
    pub actuators: Actuators,
    /// What its autopilot is told with errors.
    pub misjudged: Misjudged,
    /// Water that came in: buoyancy lost, N.
    pub buoyancy_loss: f64,
    autopilot: Autopilot,
    surface: Surface,
    /// Its length, m.
    length: f64,
    grounding: Option<Grounding>,
    steps: u32,
    motion: Motion,
    /// How the water about it moved in the last tick.
    flow: Vector,
}

impl<P: Plant> Submersible<P> {
    /// At rest in water that moves with `flow`.
    pub fn new(plant: P, body: &Body, settings: &Settings, berth: &StartPose) -> Self {
        let StartPose { position, heading, depth, flow } = *berth;
        let pose = Vector6::new(position.north, position.east, depth, 0.0, 0.0, wrap_angle(heading.radians()));
        let [u, v, w] = attitude_of(&pose).to_body([flow.north, flow.east, 0.0]);
        let state = State { pose, velocity: Vector6::new(u, v, w, 0.0, 0.0, 0.0) };
        let motion = berth.motion();
        Submersible {
            actuators: Actuators::new(settings.limits, settings.step()),
            autopilot: Autopilot::new(&plant, settings),
            surface: Surface::new(body),
            length: body.length,
            grounding: None,
            plant,
            state,
            misjudged: Misjudged::default(),
            buoyancy_loss: 0.0,
            steps: settings.steps,
            motion,
            flow,
        }
    }

    /// Where it is and how it moves.
    pub fn motion(&self) -> &Motion {
        &self.motion
    }

    /// Lets one tick go by, in water that moves with `flow`. `water_depth` tells the depth of the water at a point. If the
    /// equations run away, it stays where it was.
    ///
    /// Where the bottom stops it, it is aground: it stays where it was, at rest, until what is commanded leads up or away.
    pub fn step(
        &mut self,
        command: Option<&Command>,
        flow: Vector,
        water_depth: impl Fn(Point) -> f64,
        mut track: Option<&mut Track>,
    ) -> Result<(), Diverged> {
        let misjudged = self.misjudged;
        // Asked whenever the fins are moved: once a tick by the cascade, at every step of the integration by the regulator of the 2016
        // paper.
        let told =
            |state: &State, flow: Vector, water_depth: f64| Sensed::of(state, flow, water_depth).off_by(&misjudged);
        let before = self.motion.position;
        let here = water_depth(before);
        let wanted = self.autopilot.steer(&told(&self.state, self.flow, here), command);
        let mut goal = self.actuators.within_limits(&wanted);
        let around = Surroundings { current: flow, buoyancy_loss: self.buoyancy_loss, surface: Some(self.surface) };
        let h = TICK_S / f64::from(self.steps);
        let mut state = self.state;
        if let Some(track) = &mut track {
            track.begin(&state);
        }
        for step in 0..self.steps {
            if step > 0 && self.autopilot.steers_within_a_tick() {
                let wanted = self.autopilot.steer_on(&told(&state, flow, here), &wanted);
                goal = self.actuators.within_limits(&wanted);
            }
            let controls = self.actuators.step(&goal);
            state = runge_kutta(&self.plant, &state, &controls, &around, h);
            if let Some(track) = &mut track {
                track.push(&controls[1], &state);
            }
        }
        if !state.velocity.iter().all(|rate| rate.abs() <= RATE_MAX) {
            return Err(Diverged);
        }
        state.pose[5] = wrap_angle(state.pose[5]);
        self.meet_bottom(state, command, water_depth);
        if let Some(track) = &mut track {
            track.end_in(&self.state);
        }
        self.observe(before, flow);
        Ok(())
    }

    /// Takes the state that a tick would lead to, as far as the bottom lets it.
    fn meet_bottom(&mut self, mut state: State, command: Option<&Command>, water_depth: impl Fn(Point) -> f64) {
        let before = self.state.pose;
        let told = match (&self.grounding, command) {
            (Some(grounding), Some(command)) => Some(grounding.intent(&before, command, self.length, &water_depth)),
            _ => None,
        };
        if told == Some(Intent::Stay) {
            state = State { pose: before, ..State::default() };
        } else {
            self.grounding = Grounding::after(self.grounding, &before, &mut state, water_depth);
        }
        if self.grounding.is_some() {
            self.autopilot.start_afresh();
            pivot(&mut state, &before, command.map(|command| command.heading), told == Some(Intent::Up));
        }
        self.state = state;
    }

    fn observe(&mut self, before: Point, flow: Vector) {
        let [north, east, depth, roll, pitch, yaw] = self.state.pose.into();
        let position = Point::new(north, east);
        self.flow = flow;
        self.motion = Motion {
            position,
            heading: Heading::from_radians(yaw),
            pitch,
            roll,
            // At the surface it may lie a little out of the water.
            depth: depth.max(0.0),
            speed: Sensed::of(&self.state, flow, 0.0).speed,
            ground_velocity: (1.0 / TICK_S) * (position - before),
            aground: self.grounding.is_some(),
        };
    }
}

/// No hull moves so fast or turns so fast, m/s and rad/s: the equations have run away.
const RATE_MAX: f64 = 100.0;

#[cfg(test)]
mod tests;
