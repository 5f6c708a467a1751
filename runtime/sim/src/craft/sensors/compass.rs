//! The compass: what it makes of the true heading.

use super::EVERY_TICK;
use super::delay::Delay;
use crate::noise::{Noise, Stream};
use albacore_geometry::Heading;
use albacore_geometry::math::cos;
use albacore_vehicle::rate::is_due;
use serde::Deserialize;

/// The compass: its error turns heading, course, dead reckoning and the flow estimate alike.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Compass {
    /// Samples of the heading a second. Default 10.
    pub rate: f64,
    /// Standard deviation of its noise, rad.
    pub noise: f64,
    /// Its constant error, rad, clockwise.
    pub bias: f64,
    /// The greatest deviation that the vehicle's own iron causes, rad: semicircular, as the cosine of the heading from where it is
    /// greatest (coefficients B and C of compass adjusters).
    pub deviation: f64,
    /// The heading of the greatest deviation, clockwise.
    pub greatest_at: Heading,
    /// Between a sample and its being told, s. Default 0.
    pub delay: f64,
}

impl Default for Compass {
    fn default() -> Self {
        Compass { rate: EVERY_TICK, noise: 0.0, bias: 0.0, deviation: 0.0, greatest_at: Heading::NORTH, delay: 0.0 }
    }
}

/// A compass, read at every tick and told at its rate.
#[derive(Clone, Debug)]
pub struct MagneticCompass {
    settings: Compass,
    noise: Noise,
    delay: Delay<Heading>,
}

impl MagneticCompass {
    /// The compass of a run.
    pub fn new(settings: &Compass, seed: u64) -> Self {
        MagneticCompass {
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
        let settings =
            Compass { bias: 0.1, deviation: 0.05, greatest_at: Heading::from_degrees(40.0), ..Default::default() };
        let compass = MagneticCompass::new(&settings, 1);
        for (degrees, error) in [(40.0, 0.15), (130.0, 0.1), (220.0, 0.05), (310.0, 0.1)] {
            assert!((compass.error(7, Heading::from_degrees(degrees)).unwrap() - error).abs() < 1e-12);
        }
        assert_eq!(MagneticCompass::new(&Compass::default(), 1).error(7, Heading::NORTH), None);
    }

    #[test]
    fn noise_is_as_told() {
        let compass = MagneticCompass::new(&Compass { noise: 0.02, ..Default::default() }, 1);
        let errors: Vec<f64> = (0..10_000).map(|tick| compass.error(tick, Heading::NORTH).unwrap()).collect();
        let mean = errors.iter().sum::<f64>() / 1e4;
        let deviation = (errors.iter().map(|e| e * e).sum::<f64>() / 1e4).sqrt();
        assert!(mean.abs() < 0.001 && (deviation - 0.02).abs() < 0.001, "{mean} {deviation}");
    }
}
