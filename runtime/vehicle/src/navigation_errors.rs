//! How far off an inertial navigator is.

use serde::{Deserialize, Serialize};

/// States of an inertial navigator: roll, pitch and yaw (rad), the biases of the gyroscopes (rad/s), north, east and down (m), the velocity
/// over ground in the body's frame (m/s), the biases of the accelerometers (m/s2).
pub const NAVIGATION_STATES: usize = 15;

impl NavigationErrors {
    /// Where roll, pitch and yaw stand among the states; the other groups of three begin at the next ones.
    pub const ATTITUDE: usize = 0;
    /// The biases of the gyroscopes.
    pub const GYRO_BIAS: usize = 3;
    /// North, east and down.
    pub const PLACE: usize = 6;
    /// The velocity.
    pub const VELOCITY: usize = 9;
    /// The biases of the accelerometers.
    pub const ACCELEROMETER_BIAS: usize = 12;

    /// The errors of a group of states.
    pub fn of(&self, group: usize) -> [f64; 3] {
        std::array::from_fn(|i| self.error.get(group + i).copied().unwrap_or_default())
    }

    /// The standard deviations to expect of them.
    pub fn expected(&self, group: usize) -> [f64; 3] {
        std::array::from_fn(|i| self.sigma.get(group + i).copied().unwrap_or_default())
    }

    /// The greatest size of the errors of a group.
    pub fn greatest(&self, group: usize) -> f64 {
        self.of(group).into_iter().fold(0.0, |most, error| error.abs().max(most))
    }
}

/// What an inertial navigator believes less what is so, and what it expects of that: known in simulation only.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct NavigationErrors {
    /// Of each state.
    pub error: [f64; NAVIGATION_STATES],
    /// The standard deviation to expect of each.
    pub sigma: [f64; NAVIGATION_STATES],
    /// The covariance of north and east, m2.
    pub north_east: f64,
    /// The square of the error by its covariance (NEES), of each state: 1 on average where the filter is right.
    pub nees: f64,
    /// The square of each innovation by its covariance (NIS), of each number, of the tick: attitude, pressure, velocity and times of
    /// arrival; none where nothing came.
    pub nis: [Option<f64>; 4],
    /// Whether an instrument disagrees with it now, or tells nothing that it needs.
    pub doubted: bool,
}
