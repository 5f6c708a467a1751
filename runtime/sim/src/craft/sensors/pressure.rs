//! The pressure gauge: how deep the vehicle is, by the weight of the water over it.

use super::delay::Delay;
use super::{EVERY_TICK, Instrument, Surroundings};
use crate::noise::{Noise, Stream};
use albacore_vehicle::measurements::DEPTH;
use albacore_vehicle::rate::is_due;
use albacore_vehicle::{Snapshot, Truth};
use serde::Deserialize;

/// The pressure gauge, which tells the depth.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pressure {
    /// Samples a second. Default 10.
    pub rate: f64,
    /// Standard deviation of its noise, m of water.
    pub noise: f64,
    /// Its constant error, m of water: too deep.
    pub bias: f64,
    /// Between a sample and its being told, s. Default 0.
    pub delay: f64,
}

impl Default for Pressure {
    fn default() -> Self {
        Pressure { rate: EVERY_TICK, noise: 0.0, bias: 0.0, delay: 0.0 }
    }
}

/// A gauge.
#[derive(Clone, Debug)]
pub struct PressureGauge {
    settings: Pressure,
    noise: Noise,
    delay: Delay<f64>,
}

impl PressureGauge {
    /// The gauge of a run.
    pub fn new(settings: &Pressure, seed: u64) -> Self {
        PressureGauge {
            settings: settings.clone(),
            noise: Noise::new(seed, Stream::Pressure),
            delay: Delay::new(settings.delay),
        }
    }

    /// What it tells at a tick when the true depth is `depth`, m.
    fn sample(&mut self, tick: u64, depth: f64) -> Option<f64> {
        self.delay.pass(tick, self.reading(tick, depth))
    }

    /// What it makes of a true depth at a tick, m, when it tells anything: never less than nothing.
    fn reading(&self, tick: u64, depth: f64) -> Option<f64> {
        let s = &self.settings;
        let noise = if s.noise > 0.0 { s.noise * self.noise.gaussian(tick) } else { 0.0 };
        let is_perfect = s.noise == 0.0 && s.bias == 0.0;
        let told = if is_perfect { depth } else { (depth + s.bias + noise).max(0.0) };
        is_due(s.rate, tick).then_some(told)
    }
}

impl Instrument for PressureGauge {
    fn measure(&mut self, around: &mut Surroundings, snapshot: &mut Snapshot) {
        let Truth { position, depth, altitude, .. } = *around.truth;
        let weighed = depth + around.world.wave_head(position, altitude, around.time_s());
        if let Some(depth) = self.sample(around.tick, weighed.max(0.0)) {
            snapshot.push(DEPTH, &[depth]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bias_and_noise_are_as_told_and_a_perfect_gauge_tells_the_truth() {
        let gauge = PressureGauge::new(&Pressure { noise: 0.1, bias: 0.5, rate: 5.0, ..Default::default() }, 1);
        let errors: Vec<f64> = (0..20_000).filter_map(|tick| Some(gauge.reading(tick, 3.0)? - 3.0)).collect();
        assert_eq!(errors.len(), 10_000);
        let mean = errors.iter().sum::<f64>() / 1e4;
        let deviation = (errors.iter().map(|e| (e - mean) * (e - mean)).sum::<f64>() / 1e4).sqrt();
        assert!((mean - 0.5).abs() < 0.005 && (deviation - 0.1).abs() < 0.005, "{mean} {deviation}");
        assert_eq!(PressureGauge::new(&Pressure::default(), 1).reading(7, 3.3), Some(3.3));
    }
}
