//! The Doppler log: the velocity over ground, while it sees the bottom.

use super::delay::Delay;
use super::rate::is_due;
use crate::noise::{Noise, Stream};
use crate::scenario;
use albacore_geometry::{Heading, Vector};

/// A Doppler log.
#[derive(Clone, Debug)]
pub struct Dvl {
    settings: scenario::Dvl,
    noise: Noise,
    delay: Delay<Vector>,
}

impl Dvl {
    /// The log of a run.
    pub fn new(settings: &scenario::Dvl, seed: u64) -> Self {
        Dvl { settings: settings.clone(), noise: Noise::new(seed, Stream::Dvl), delay: Delay::new(settings.delay) }
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
        let mut dvl = Dvl::new(&scenario::Dvl { range: Some(30.0), rate: 2.0, ..Default::default() }, 1);
        let mut sample = |tick, altitude| dvl.sample(tick, altitude, truth);
        assert_eq!((sample(5, 30.0), sample(5, 30.1), sample(6, 30.0)), (Some(truth), None, None));
    }

    #[test]
    fn noise_and_bias_are_as_told_and_a_perfect_log_has_none() {
        let dvl = Dvl::new(&scenario::Dvl { noise: 0.02, bias: 0.1, ..Default::default() }, 1);
        let truth = Vector::new(1.0, 1.0);
        let square = |tick| {
            let error = dvl.imperfect(tick, truth, Heading::NORTH).unwrap() - truth - Vector::new(0.1, 0.0);
            error.dot(error)
        };
        let variance = (0..10_000).map(square).sum::<f64>() / 2e4;
        assert!((variance.sqrt() - 0.02).abs() < 0.001);
        assert_eq!(Dvl::new(&scenario::Dvl::default(), 1).imperfect(3, truth, Heading::NORTH), None);
    }
}
