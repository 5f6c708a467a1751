//! How vehicles move: hulls of several kinds, and what is common to all of them.

mod actuators;
mod autopilot;
mod fossen;
mod grounding;
mod kinematics;
mod lqr;
mod mass;
mod prestero;
mod six_dof;
mod submersible;
mod surface;
mod track;
#[cfg(test)]
mod trial;

pub(crate) use autopilot::{Misjudged, speed_possible};

pub use actuators::{ActuatorLimits, Actuators, Stuck};
pub use autopilot::{Gains, Sensed};
pub use fossen::Fossen;
pub use kinematics::Kinematics;
pub use lqr::{Controller, LqrGains};
pub use prestero::{Crossflow, Prestero};
pub use six_dof::{Controls, Load, Plant, Six, State, Surroundings, attitude_of, runge_kutta};
pub use submersible::{Settings, Submersible};
pub use surface::{Body, Surface};
pub(crate) use track::LEVEL_STEPS;
pub use track::Track;

use crate::craft::setup::{HullSetup, SubmersibleHull, VehicleSetup};
use albacore_geometry::{Heading, Point, Vector};
use albacore_vehicle::Command;

/// Acceleration of gravity, m/s2.
pub(crate) const GRAVITY: f64 = 9.81;

/// Where a hull is and how it moves, at a tick.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion {
    /// Where it is.
    pub position: Point,
    /// Where its nose points.
    pub heading: Heading,
    /// Nose up, rad.
    pub pitch: f64,
    /// Starboard side down, rad.
    pub roll: f64,
    /// Depth, m.
    pub depth: f64,
    /// Speed ahead through the water, m/s.
    pub speed: f64,
    /// Velocity over ground in the last tick, m/s.
    pub ground_velocity: Vector,
    /// Whether the bottom held it in the last tick.
    pub aground: bool,
}

/// Why a hull can't go on: its equations ran away, for the steps of their integration are too long for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the motion of the hull cannot be computed: take a shorter `step`, or less of `turns_max`, `fin_max` and `speed_max`"
)]
pub struct Diverged;

/// Where a hull is before its first tick, at rest in the water.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StartPose {
    /// Where.
    pub position: Point,
    /// Where its nose points.
    pub heading: Heading,
    /// How deep, m.
    pub depth: f64,
    /// The water's velocity there, m/s toward.
    pub flow: Vector,
}

impl StartPose {
    /// That of a vehicle as a scenario has it, in water that moves with `flow`.
    pub fn of(vehicle: &VehicleSetup, flow: Vector) -> Self {
        StartPose { position: vehicle.start, heading: vehicle.heading, depth: vehicle.depth, flow }
    }

    fn motion(&self) -> Motion {
        let StartPose { position, heading, depth, flow } = *self;
        Motion { position, heading, depth, ground_velocity: flow, ..Motion::default() }
    }
}

/// The hull of a vehicle.
#[derive(Clone, Debug)]
pub enum Hull {
    /// Without forces.
    Kinematic(Kinematics),
    /// The REMUS 100 after Fossen.
    Fossen(Box<Submersible<Fossen>>),
    /// The REMUS 100 after Prestero.
    Prestero(Box<Submersible<Prestero>>),
}

impl Hull {
    /// At rest at its start, in water that moves with `flow`.
    pub fn new(setup: &VehicleSetup, flow: Vector, seed: u64) -> Self {
        let berth = StartPose::of(setup, flow);
        let settings = |hull: &SubmersibleHull, gains: Gains| Settings {
            steps: hull.steps(),
            speed_max: hull.speed_max,
            limits: hull.limits(),
            gains,
            controller: hull.controller,
        };
        match &setup.hull {
            HullSetup::Kinematic(hull) => Hull::Kinematic(Kinematics::new(hull, &berth, seed)),
            HullSetup::Fossen(hull) => {
                let plant = Fossen::new();
                let body = plant.body();
                Hull::Fossen(Box::new(Submersible::new(plant, &body, &settings(hull, Gains::FOSSEN), &berth)))
            }
            HullSetup::Prestero(hull, crossflow) => {
                let plant = Prestero::new(*crossflow);
                let body = plant.body();
                Hull::Prestero(Box::new(Submersible::new(plant, &body, &settings(hull, Gains::PRESTERO), &berth)))
            }
        }
    }

    /// Where it is and how it moves.
    pub fn motion(&self) -> &Motion {
        match self {
            Hull::Kinematic(hull) => hull.motion(),
            Hull::Fossen(hull) => hull.motion(),
            Hull::Prestero(hull) => hull.motion(),
        }
    }

    /// Lets one tick go by, in water that moves with `flow`. Without a command the propeller stops and the fins are neutral.
    /// `water_depth` tells the depth of the water at a point, and `track` becomes what the tick was, step by step.
    pub fn step(
        &mut self,
        tick: u64,
        command: Option<&Command>,
        flow: Vector,
        water_depth: impl Fn(Point) -> f64,
        track: Option<&mut Track>,
    ) -> Result<(), Diverged> {
        match self {
            Hull::Kinematic(hull) => {
                hull.step(tick, command, flow, water_depth, track);
                Ok(())
            }
            Hull::Fossen(hull) => hull.step(command, flow, water_depth, track),
            Hull::Prestero(hull) => hull.step(command, flow, water_depth, track),
        }
    }

    /// Has its rudder stuck at a share of its greatest deflection, positive to starboard; none: it is free.
    pub fn stick_rudder(&mut self, share: Option<f64>) {
        if let Hull::Kinematic(hull) = self {
            hull.stuck_rudder = share;
        }
        if let Some(actuators) = self.actuators_mut() {
            actuators.stuck.rudder = share.map(|share| share * actuators.limits().fin);
        }
    }

    /// Its fins and its propeller, also to have them stuck; a kinematic hull has none.
    pub fn actuators_mut(&mut self) -> Option<&mut Actuators> {
        match self {
            Hull::Kinematic(_) => None,
            Hull::Fossen(hull) => Some(&mut hull.actuators),
            Hull::Prestero(hull) => Some(&mut hull.actuators),
        }
    }

    /// Has its autopilot go by what it is told with these errors, until it is told otherwise; a kinematic hull has none.
    pub(crate) fn misjudge(&mut self, errors: &Misjudged) {
        match self {
            Hull::Kinematic(_) => {}
            Hull::Fossen(hull) => hull.misjudged = *errors,
            Hull::Prestero(hull) => hull.misjudged = *errors,
        }
    }

    /// Has so much water in it, kg, of which it becomes heavier, or lighter where that is below 0. Its inertia stays as it was, for
    /// what floods a hull in time is little beside its mass. A kinematic hull does not know weight.
    pub fn flood(&mut self, water: f64) {
        match self {
            Hull::Kinematic(_) => {}
            Hull::Fossen(hull) => hull.buoyancy_loss = GRAVITY * water,
            Hull::Prestero(hull) => hull.buoyancy_loss = GRAVITY * water,
        }
    }
}
