//! How vehicles move: hulls of several kinds, and what is common to all of them.

mod actuators;
mod autopilot;
mod fossen;
mod kinematics;
mod mass;
mod prestero;
mod six_dof;
mod submersible;
mod surface;

pub use actuators::{ActuatorLimits, Actuators, Stuck};
pub use autopilot::Gains;
pub use fossen::Fossen;
pub use kinematics::Kinematics;
pub use prestero::{Crossflow, Prestero};
pub use six_dof::{Attitude, Controls, Load, Plant, Six, State, Surroundings, runge_kutta};
pub use submersible::{Settings, Submersible};
pub use surface::{Body, Surface};

use albacore_geometry::{Heading, Point, Vector};

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
}
