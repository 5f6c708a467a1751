//! What the filter of 15 states is told of the vehicle and of its instruments.

use super::super::component::Component;
use super::super::spread::Spread;

/// Instruments, where they are aboard, and how well they measure. Lengths are m, in the body's frame; sigmas are standard deviations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ins15Setup {
    /// How sigma points are drawn.
    pub spread: Spread,
    /// Whether yaw stays within half a turn, or is counted on.
    pub yaw: Component,
    /// Of a sample of the gyroscopes, rad/s.
    pub gyro_sigma: f64,
    /// Of a sample of the accelerometers, m/s2.
    pub accelerometer_sigma: f64,
    /// Of rates of turn that were not measured, as white noise of each step, rad/s: of roll, pitch and yaw. A turn of 0.1 rad/s for 2 s
    /// has the power of 2 rad/s at 100 Hz; roll and pitch come and go faster, and are smaller.
    pub unmeasured_turn: [f64; 3],
    /// Of an acceleration that was not measured, likewise, m/s2: 0.2 m/s2 for some 5 s.
    pub unmeasured_acceleration: f64,
    /// Of the velocity with which a step goes on, m/s: the paper's `sigma_u` of Eq. (16), of which it has no number.
    pub velocity_sigma: f64,
    /// Of roll, pitch and yaw as they are measured, rad.
    pub attitude_sigma: [f64; 3],
    /// Of the pressure, Pa.
    pub pressure_sigma: f64,
    /// Of a time of arrival, s, with what its counting adds: the root of `sigma_toa^2 + 1 / (12 f^2)`. Ranges to a millimetre are no
    /// straight function of a state that is known to 100 m, after a silence: believed as they are they make the filter too sure of
    /// yaw and place (5 % of errors beyond three deviations, 0.5 % with eleven times the deviation; `tests/ukf/long_run.rs`).
    pub arrival_sigma: f64,
    /// Whether the noise of a step has what Eq. (16) leaves out: what the gyroscopes' does to the velocity, and what errors of attitude
    /// and velocity make of each other in the position. Both matter where the velocity is lost.
    pub complete_noise: bool,
    /// Whether a place that is hardly known is found anew by times of arrival, instead of corrected by them.
    pub finds: bool,
    /// Of the water, kg/m3.
    pub density: f64,
    /// m/s2.
    pub gravity: f64,
    /// In the water, m/s.
    pub sound_speed: f64,
    /// Where the pressure sensor is aboard.
    pub pressure_sensor: [f64; 3],
    /// Where the receivers are aboard.
    pub receivers: [[f64; 3]; 5],
    /// Where the transponder is: north, east and down, m.
    pub transponder: [f64; 3],
    /// What is believed of what is measured.
    pub gates: Ins15Gates,
}

/// The bound of each measurement's normalised innovation squared; none believes all.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ins15Gates {
    /// With 3 degrees of freedom.
    pub attitude: Option<f64>,
    /// With 1.
    pub pressure: Option<f64>,
    /// With 3.
    pub velocity: Option<f64>,
    /// With 5.
    pub arrival: Option<f64>,
}

impl Default for Ins15Setup {
    /// The instruments of the paper's Table 1. What it does not say: where receivers, pressure sensor and transponder are, the
    /// water's density, `sigma_u` and the spread.
    fn default() -> Self {
        Ins15Setup {
            // Points as far away as the state is uncertain; with an alpha of 0.1 the filter is too sure more often (11 to 14 % of
            // errors in yaw and place, instead of 5 %, after silences).
            spread: Spread { alpha: 1.0, ..Spread::default() },
            yaw: Component::Circle,
            gyro_sigma: 0.005,
            accelerometer_sigma: 0.1,
            unmeasured_turn: [0.3, 0.3, 2.0],
            unmeasured_acceleration: 6.0,
            velocity_sigma: 0.05,
            attitude_sigma: [0.05, 0.05, 0.2],
            pressure_sigma: 200.0,
            // 1 / sqrt(3) us, and a clock of 500 kHz.
            arrival_sigma: 0.816e-6,
            finds: false,
            complete_noise: false,
            density: 1025.0,
            gravity: 9.81,
            sound_speed: 1500.0,
            pressure_sensor: [0.5, 0.0, 0.0],
            receivers: [
                [0.75, 0.0, 0.0],
                [-0.55, 0.0, 0.0],
                [0.1, 0.095, 0.0],
                [0.1, -0.0475, 0.0823],
                [-0.2, -0.0475, -0.0823],
            ],
            transponder: [0.0, 0.0, 2.0],
            gates: Ins15Gates::default(),
        }
    }
}
