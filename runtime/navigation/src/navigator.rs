//! What makes a position of what was sensed.

use crate::navigators::Inertial;
use crate::ukf::Aiding;
use albacore_geometry::{Heading, Point, Vector};
use std::fmt::Debug;

/// Estimates where the vehicle is: in simulation from what the instruments measure, on a link from what the vehicle tells.
pub trait Navigator: Debug + Send + Sync {
    /// Some seconds go by, in which this was sensed.
    fn predict(&mut self, sensed: &Sensed, time: f64);

    /// A fix has come. Whether it changed the estimate.
    fn update(&mut self, fix: &Fix) -> bool;

    /// Takes what an instrument told as it measured it. Those that reckon from speed and compass have no use for it.
    fn sense(&mut self, _: &Raw<'_>) {}

    /// Where the vehicle is, as far as is known.
    fn estimate(&self) -> Estimate;

    /// All that it knows, where it is an inertial one.
    fn inertial(&self) -> Option<&Inertial> {
        None
    }

    /// The same, to be told more.
    fn inertial_mut(&mut self) -> Option<&mut Inertial> {
        None
    }

    /// What it has noticed of its instruments since this was last asked.
    fn take_notices(&mut self) -> Vec<String> {
        Vec::new()
    }

    /// A copy, with all that it knows.
    fn boxed(&self) -> Box<dyn Navigator>;
}

impl Clone for Box<dyn Navigator> {
    fn clone(&self) -> Self {
        self.boxed()
    }
}

/// What is sensed of a vehicle's own motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sensed {
    /// Its velocity over ground, m/s; the last one where there is no new one.
    pub ground_velocity: Vector,
    /// Where the compass says that its nose points.
    pub heading: Heading,
}

/// What instruments told as they measured it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Raw<'a> {
    /// The inertial unit, of some seconds up to now.
    Inertial {
        /// Rates of turn, rad/s, body; none: nothing came.
        gyro: Option<[f64; 3]>,
        /// Specific force, m/s2, body; none: nothing came.
        accelerometer: Option<[f64; 3]>,
        /// s.
        time: f64,
    },
    /// What aids it, of now.
    Aiding(&'a Aiding),
}

/// A position that was measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fix {
    /// Where the vehicle is by it.
    pub position: Point,
    /// Standard deviation of its error, m an axis.
    pub sigma: f64,
    /// It is taken only if it differs from the estimate by more than this, m; 0 takes every one.
    pub gate: f64,
}

/// A position, and how well it is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Where the vehicle is.
    pub position: Point,
    /// Standard deviation of the error to expect, m an axis.
    pub sigma: f64,
}
