//! How far off an inertial navigator is.

use serde::{Deserialize, Serialize};

/// States of an inertial navigator: roll, pitch and yaw (rad), the biases of the gyroscopes (rad/s), north, east and down (m), the velocity
/// over ground in the body's frame (m/s), the biases of the accelerometers (m/s2).
pub const NAVIGATION_STATES: usize = 15;

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
