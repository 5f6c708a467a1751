//! The compass: what it makes of the true heading.

use super::delay::Delay;
use super::rate::is_due;
use crate::noise::{Noise, Stream};
use crate::scenario;
use albacore_geometry::Heading;
use albacore_geometry::math::cos;

/// A compass, read at every tick and told at its rate.
#[derive(Clone, Debug)]
pub struct Compass {
    settings: scenario::Compass,
    noise: Noise,
    delay: Delay<Heading>,
}

impl Compass {
    /// The compass of a run.
    pub fn new(settings: &scenario::Compass, seed: u64) -> Self {
        Compass {
            settings: settings.clone(),
            noise: Noise::new(seed, Stream::Compass),
            delay: Delay::new(settings.delay),
        }
    }

    /// What it tells at a tick, when it reads `heading`.
    pub fn sample(&mut self, tick: u64, heading: Heading) -> Option<Heading> {
        self.delay.pass(tick, is_due(self.settings.rate, tick).then_some(heading))
    }

    /// How far it is off at a tick on a heading, rad clockwise; none for a perfect one.
    pub fn error(&self, tick: u64, heading: Heading) -> Option<f64> {
        let s = &self.settings;
        if s.noise == 0.0 && s.bias == 0.0 && s.deviation == 0.0 {
            return None;
        }
        let noise = if s.noise > 0.0 { s.noise * self.noise.gaussian(tick) } else { 0.0 };
        Some(s.bias + s.deviation * cos(heading - s.greatest_at) + noise)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_deviation_is_greatest_at_its_heading_and_opposite_at_the_other() {
        let settings = scenario::Compass {
            bias: 0.1,
            deviation: 0.05,
            greatest_at: Heading::from_degrees(40.0),
            ..Default::default()
        };
        let compass = Compass::new(&settings, 1);
        for (degrees, error) in [(40.0, 0.15), (130.0, 0.1), (220.0, 0.05), (310.0, 0.1)] {
            assert!((compass.error(7, Heading::from_degrees(degrees)).unwrap() - error).abs() < 1e-12);
        }
        assert_eq!(Compass::new(&scenario::Compass::default(), 1).error(7, Heading::NORTH), None);
    }

    #[test]
    fn noise_is_as_told() {
        let compass = Compass::new(&scenario::Compass { noise: 0.02, ..Default::default() }, 1);
        let errors: Vec<f64> = (0..10_000).map(|tick| compass.error(tick, Heading::NORTH).unwrap()).collect();
        let mean = errors.iter().sum::<f64>() / 1e4;
        let deviation = (errors.iter().map(|e| e * e).sum::<f64>() / 1e4).sqrt();
        assert!(mean.abs() < 0.001 && (deviation - 0.02).abs() < 0.001, "{mean} {deviation}");
    }
}
