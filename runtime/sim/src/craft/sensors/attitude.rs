//! The attitude sensor: roll, pitch and yaw, by tilt sensors and a compass.

use super::raw::{RawSample, RawSensor};
use crate::craft::hull::State;
use crate::noise::Noise;
use albacore_geometry::wrap_angle;
use albacore_vehicle::rate::is_due;
use serde::Deserialize;

/// An attitude sensor. The default is that of Table 1 of Jayasiri et al. (2016).
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AttitudeSensor {
    /// Samples a second. Default 10.
    pub rate: f64,
    /// Standard deviation of roll and of pitch, rad. Default 0.05.
    pub tilt_noise: f64,
    /// Standard deviation of yaw, rad. Default 0.2.
    pub yaw_noise: f64,
    /// The constant error of yaw, rad, clockwise. Default 0.
    pub yaw_bias: f64,
}

impl Default for AttitudeSensor {
    fn default() -> Self {
        AttitudeSensor { rate: 10.0, tilt_noise: 0.05, yaw_noise: 0.2, yaw_bias: 0.0 }
    }
}

impl AttitudeSensor {
    /// Standard deviations of roll, pitch and yaw, rad.
    pub fn sigma(&self) -> [f64; 3] {
        [self.tilt_noise, self.tilt_noise, self.yaw_noise]
    }
}

/// A sensor in a run.
#[derive(Clone, Debug)]
pub struct AttitudeGauge {
    settings: AttitudeSensor,
    noise: Noise,
}

impl AttitudeGauge {
    /// That of a run.
    pub fn new(settings: &AttitudeSensor, seed: u64) -> Self {
        AttitudeGauge { settings: settings.clone(), noise: Noise::named(seed, "attitude") }
    }

    /// What it tells at the end of a tick: Eq. (7).
    pub fn measure(&self, tick: u64, state: &State, step: u16, raw: &mut Vec<RawSample>) {
        if !is_due(self.settings.rate, tick) {
            return;
        }
        let sigma = self.settings.sigma();
        let told = |i: usize| state.pose[3 + i] + sigma[i] * self.noise.gaussian(3 * tick + i as u64);
        let [roll, pitch, yaw] = std::array::from_fn(told);
        let yaw = wrap_angle(yaw + self.settings.yaw_bias);
        raw.push(RawSample::new(RawSensor::Attitude, step, [roll, pitch, yaw]));
    }
}
