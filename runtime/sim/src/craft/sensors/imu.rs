//! The inertial measurement unit: three gyroscopes and three accelerometers along the axes of the body.

use super::raw::{RawSample, RawSensor};
use crate::craft::hull::{GRAVITY, State, Track, attitude_of};
use crate::noise::Noise;
use albacore_vehicle::TICK_S;
use nalgebra::Vector3;
use serde::Deserialize;

/// An inertial unit. The default is that of Table 1 of Jayasiri et al. (2016), with the biases of its Eq. (4) and (6).
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Imu {
    /// Samples a second, a whole number of them in a tick. Default 100.
    pub rate: f64,
    /// Standard deviation of a rate of turn, rad/s. Default 0.005.
    pub gyro_noise: f64,
    /// The constant error of each gyroscope, rad/s. Default 0.01.
    pub gyro_bias: f64,
    /// Standard deviation of a specific force, m/s2. Default 0.1.
    pub accelerometer_noise: f64,
    /// The constant error of each accelerometer, m/s2. Default 0.05.
    pub accelerometer_bias: f64,
}

impl Default for Imu {
    fn default() -> Self {
        Imu { rate: 100.0, gyro_noise: 0.005, gyro_bias: 0.01, accelerometer_noise: 0.1, accelerometer_bias: 0.05 }
    }
}

impl Imu {
    /// Samples in a tick.
    pub fn samples(&self) -> usize {
        (self.rate * TICK_S).round().max(1.0) as usize
    }
}

/// A unit in a run.
#[derive(Clone, Debug)]
pub struct InertialUnit {
    settings: Imu,
    gyro: Noise,
    accelerometer: Noise,
}

impl InertialUnit {
    /// That of a run.
    pub fn new(settings: &Imu, seed: u64) -> Self {
        let (gyro, accelerometer) = (Noise::named(seed, "gyroscope"), Noise::named(seed, "accelerometer"));
        InertialUnit { settings: settings.clone(), gyro, accelerometer }
    }

    /// Samples in a tick, and the seconds of each.
    pub fn samples(&self) -> (usize, f64) {
        let samples = self.settings.samples();
        (samples, TICK_S / samples as f64)
    }

    /// The constant errors of a gyroscope (rad/s) and of an accelerometer (m/s2).
    pub fn biases(&self) -> (f64, f64) {
        (self.settings.gyro_bias, self.settings.accelerometer_bias)
    }

    /// What it tells in a tick in which the hull moved so: Eq. (4) and (6), each sample the mean over its time.
    pub fn measure(&self, tick: u64, track: &Track, raw: &mut Vec<RawSample>) {
        let s = &self.settings;
        let (samples, time) = self.samples();
        let steps = track.steps() / samples;
        for sample in 0..samples {
            let (Some(before), Some(after)) =
                (track.states.get(sample * steps), track.states.get((sample + 1) * steps))
            else {
                return;
            };
            let (turn, force) = felt(before, after, time);
            let index = 3 * (tick * samples as u64 + sample as u64);
            let noisy = |true_value: Vector3<f64>, bias: f64, deviation: f64, noise: Noise| {
                std::array::from_fn::<f64, 3, _>(|i| {
                    true_value[i] + bias + deviation * noise.gaussian(index + i as u64)
                })
            };
            let step = sample as u16;
            let turn = noisy(turn, s.gyro_bias, s.gyro_noise, self.gyro);
            raw.push(RawSample::new(RawSensor::Gyroscope, step, turn));
            let force = noisy(force, s.accelerometer_bias, s.accelerometer_noise, self.accelerometer);
            raw.push(RawSample::new(RawSensor::Accelerometer, step, force));
        }
    }
}

/// The mean rates of turn (rad/s) and the mean specific force (m/s2) between two states, in the body's frame: what accelerates the body
/// but its weight. Of the middle between both, so that it is right to the second order.
fn felt(before: &State, after: &State, time: f64) -> (Vector3<f64>, Vector3<f64>) {
    let linear = |state: &State| Vector3::from(state.velocity.fixed_rows::<3>(0));
    let angular = |state: &State| Vector3::from(state.velocity.fixed_rows::<3>(3));
    let turn = 0.5 * (angular(before) + angular(after));
    let velocity = 0.5 * (linear(before) + linear(after));
    let mut middle = 0.5 * (before.pose + after.pose);
    // Yaw goes round; a step turns by little.
    middle[5] = before.pose[5];
    let weight = Vector3::from(attitude_of(&middle).to_body([0.0, 0.0, -GRAVITY]));
    (turn, (linear(after) - linear(before)) / time + turn.cross(&velocity) + weight)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::craft::hull::Controls;
    use nalgebra::Vector6;

    #[test]
    fn at_rest_it_feels_its_weight_and_in_a_turn_its_centre() {
        let still = State::default();
        let (turn, force) = felt(&still, &still, 0.01);
        assert_eq!((turn, force), (Vector3::zeros(), Vector3::new(0.0, 0.0, -GRAVITY)));
        let circling = State { velocity: Vector6::new(1.5, 0.0, 0.0, 0.0, 0.0, 0.1), ..still };
        let (turn, force) = felt(&circling, &circling, 0.01);
        assert!((turn.z - 0.1).abs() < 1e-15 && (force.y - 0.15).abs() < 1e-12, "{turn} {force}");
    }

    #[test]
    fn noise_and_biases_are_as_told() {
        let unit = InertialUnit::new(&Imu::default(), 1);
        let track = Track { states: vec![State::default(); 11], controls: vec![Controls::default(); 10] };
        let mut raw = Vec::new();
        (0..2000).for_each(|tick| unit.measure(tick, &track, &mut raw));
        let moments = |sensor, axis: usize| {
            let told: Vec<f64> = raw.iter().filter(|s| s.sensor == sensor).map(|s| s.array::<3>()[axis]).collect();
            let mean = told.iter().sum::<f64>() / told.len() as f64;
            (mean, (told.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / told.len() as f64).sqrt())
        };
        for axis in 0..3 {
            let (mean, deviation) = moments(RawSensor::Gyroscope, axis);
            assert!((mean - 0.01).abs() < 2e-4 && (deviation - 0.005).abs() < 2e-4, "{mean} {deviation}");
            let (mean, deviation) = moments(RawSensor::Accelerometer, axis);
            let weight = if axis == 2 { -GRAVITY } else { 0.0 };
            assert!((mean - weight - 0.05).abs() < 3e-3 && (deviation - 0.1).abs() < 2e-3, "{mean} {deviation}");
        }
    }
}
