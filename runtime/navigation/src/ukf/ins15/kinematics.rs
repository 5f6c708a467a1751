//! How the 15 states change in time, and what is not known of it.

use super::attitude::rates;
use albacore_geometry::Attitude;
use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

/// Where roll, pitch and yaw stand among the states.
pub const ATTITUDE: usize = 0;
const GYRO_BIAS: usize = 3;
/// Where north, east and down stand.
pub const POSITION: usize = 6;
/// Where the velocity in the body's frame stands.
pub const VELOCITY: usize = 9;
const ACCELEROMETER_BIAS: usize = 12;

/// Three of the states.
#[inline]
pub fn part(state: &SVector<f64, 15>, first: usize) -> Vector3<f64> {
    Vector3::new(state[first], state[first + 1], state[first + 2])
}

/// What accelerometers tell at rest and level, m/s2: up, in a frame whose z is down.
pub fn at_rest(gravity: f64) -> Vector3<f64> {
    Vector3::new(0.0, 0.0, -gravity)
}

/// Eq. (14), a second: with the gyroscopes' rates, rad/s, and what the accelerometers tell beyond what they tell at rest, m/s2. Without the
/// first it does not turn, without the second its velocity in the body's frame stays.
#[inline]
pub fn derivative(
    state: &SVector<f64, 15>,
    attitude: Attitude,
    gyro: Option<&Vector3<f64>>,
    force: Option<&Vector3<f64>>,
) -> SVector<f64, 15> {
    let turn = gyro.map_or_else(Vector3::zeros, |gyro| gyro - part(state, GYRO_BIAS));
    let velocity = part(state, VELOCITY);
    let position = attitude.to_ned(velocity.into()).into();
    let acceleration =
        force.map_or_else(Vector3::zeros, |force| force - turn.cross(&velocity) - part(state, ACCELEROMETER_BIAS));
    let still = Vector3::zeros();
    let parts = [rates(attitude) * turn, still, position, acceleration, still];
    SVector::from_fn(|i, _| parts[i / 3][i % 3])
}

/// Standard deviations of what a step goes on with.
#[derive(Clone, Copy, Debug)]
pub struct StepSigmas {
    /// Rates of turn, rad/s, body.
    pub turn: [f64; 3],
    /// Velocity, m/s.
    pub velocity: f64,
    /// Acceleration, m/s2.
    pub acceleration: f64,
}

/// Eq. (16): the covariance of what a step of so many seconds adds. `J1 (sigma_u^2 I) J1'` is `sigma_u^2 I`.
#[inline]
pub fn process_noise(attitude: Attitude, sigmas: &StepSigmas, time: f64) -> SMatrix<f64, 15, 15> {
    let square = |x: f64| x * x;
    let mut noise = SMatrix::<f64, 15, 15>::zeros();
    let rates = rates(attitude) * turned_by(sigmas.turn, time);
    noise.fixed_view_mut::<3, 3>(ATTITUDE, ATTITUDE).copy_from(&(rates * rates.transpose()));
    for axis in 0..3 {
        noise[(POSITION + axis, POSITION + axis)] = square(sigmas.velocity * time);
        noise[(VELOCITY + axis, VELOCITY + axis)] = square(sigmas.acceleration * time);
    }
    noise
}

/// The standard deviations of the angles by which rates with some noise turn in a step, rad.
fn turned_by(turn: [f64; 3], time: f64) -> Matrix3<f64> {
    Matrix3::from_diagonal(&(Vector3::from(turn) * time))
}

/// Adds what (16) leaves out: the noise of the gyroscopes turns the velocity in the body's
/// frame as it turns the body. At 1.5 m/s that is nothing; a velocity that is lost may be believed to be 40 m/s.
#[inline]
pub fn add_turned(
    noise: &mut SMatrix<f64, 15, 15>,
    attitude: Attitude,
    velocity: &Vector3<f64>,
    turn: [f64; 3],
    time: f64,
) {
    let turn = turned_by(turn, time);
    let turned = velocity.cross_matrix() * turn;
    let with_attitude = turned * (rates(attitude) * turn).transpose();
    let mut block = noise.fixed_view_mut::<3, 3>(VELOCITY, VELOCITY);
    block += turned * turned.transpose();
    noise.fixed_view_mut::<3, 3>(VELOCITY, ATTITUDE).copy_from(&with_attitude);
    noise.fixed_view_mut::<3, 3>(ATTITUDE, VELOCITY).copy_from(&with_attitude.transpose());
}
