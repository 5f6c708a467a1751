//! The Doppler log: the velocity over ground, while it sees the bottom.

use super::EVERY_TICK;
use super::delay::Delay;
use crate::noise::{Noise, Stream};
use albacore_geometry::{Heading, Vector};
use albacore_vehicle::rate::is_due;
use serde::Deserialize;

/// The Doppler log, which tells speed and course over ground.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Dvl {
    /// Samples a second. Default 10.
    pub rate: f64,
    /// Standard deviation of each component of a sample, m/s.
    pub noise: f64,
    /// Its constant error, m/s: so much too fast ahead. Default 0.
    pub bias: f64,
    /// It sees the bottom from so high at most, m. Beyond it tells nothing, and dead reckoning goes on with the velocity that it
    /// told last. Default none: from any height.
    pub range: Option<f64>,
    /// Between a sample and its being told, s; dead reckoning has it at once. Default 0.
    pub delay: f64,
}

impl Default for Dvl {
    fn default() -> Self {
        Dvl { rate: EVERY_TICK, noise: 0.0, bias: 0.0, range: None, delay: 0.0 }
    }
}

/// A Doppler log.
#[derive(Clone, Debug)]
pub struct DopplerLog {
    settings: Dvl,
    noise: Noise,
    delay: Delay<Vector>,
}

impl DopplerLog {
    /// The log of a run.
    pub fn new(settings: &Dvl, seed: u64) -> Self {
        DopplerLog {
            settings: settings.clone(),
            noise: Noise::new(seed, Stream::Dvl),
            delay: Delay::new(settings.delay),
        }
    }

    /// Whether it sees the bottom from an altitude, m.
    pub fn has_lock(&self, altitude: f64) -> bool {
        self.settings.range.is_none_or(|range| altitude <= range)
    }

    /// What it tells at a tick and an altitude (m), when it reads `velocity`, m/s.
    pub fn sample(&mut self, tick: u64, altitude: f64, velocity: Vector) -> Option<Vector> {
        let tells = self.has_lock(altitude) && is_due(self.settings.rate, tick);
        self.delay.pass(tick, tells.then_some(velocity))
    }

    /// What it makes of a true velocity at a tick, m/s, of a vehicle that points somewhere; none for a perfect one.
    pub fn imperfect(&self, tick: u64, velocity: Vector, heading: Heading) -> Option<Vector> {
        let s = &self.settings;
        if s.noise == 0.0 && s.bias == 0.0 {
            return None;
        }
        let noise =
            |component: u64| if s.noise > 0.0 { s.noise * self.noise.gaussian(2 * tick + component) } else { 0.0 };
        Some(velocity + s.bias * heading.unit() + Vector::new(noise(0), noise(1)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lock_is_lost_above_its_range() {
        let truth = Vector::new(1.0, 1.0);
        let mut dvl = DopplerLog::new(&Dvl { range: Some(30.0), rate: 2.0, ..Default::default() }, 1);
        let mut sample = |tick, altitude| dvl.sample(tick, altitude, truth);
        assert_eq!((sample(5, 30.0), sample(5, 30.1), sample(6, 30.0)), (Some(truth), None, None));
    }

    #[test]
    fn noise_and_bias_are_as_told_and_a_perfect_log_has_none() {
        let dvl = DopplerLog::new(&Dvl { noise: 0.02, bias: 0.1, ..Default::default() }, 1);
        let truth = Vector::new(1.0, 1.0);
        let square = |tick| {
            let error = dvl.imperfect(tick, truth, Heading::NORTH).unwrap() - truth - Vector::new(0.1, 0.0);
            error.dot(error)
        };
        let variance = (0..10_000).map(square).sum::<f64>() / 2e4;
        assert!((variance.sqrt() - 0.02).abs() < 0.001);
        assert_eq!(DopplerLog::new(&Dvl::default(), 1).imperfect(3, truth, Heading::NORTH), None);
    }
}
