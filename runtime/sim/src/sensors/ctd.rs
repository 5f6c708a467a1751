//! The CTD: the temperature of the water about the vehicle, and its salinity.

use super::delay::Delay;
use super::rate::is_due;
use crate::noise::{Noise, Stream};
use crate::scenario;

/// A CTD.
#[derive(Clone, Debug)]
pub struct Ctd {
    settings: scenario::Ctd,
    temperature: Noise,
    salinity: Noise,
    delay: Delay<(f64, f64)>,
}

impl Ctd {
    /// That of a run.
    pub fn new(settings: &scenario::Ctd, seed: u64) -> Self {
        let (temperature, salinity) = (Noise::new(seed, Stream::CtdTemperature), Noise::new(seed, Stream::CtdSalinity));
        Ctd { settings: settings.clone(), temperature, salinity, delay: Delay::new(settings.delay) }
    }

    /// What it tells at a tick and a depth (m): temperature (degrees Celsius) and practical salinity.
    pub fn sample(&mut self, tick: u64, depth: f64, water: impl FnOnce(f64) -> (f64, f64)) -> Option<(f64, f64)> {
        self.delay.pass(tick, self.reading(tick, depth, water))
    }

    /// Temperature (degrees Celsius) and practical salinity at a tick and a depth (m), when it tells anything, of water that
    /// has those that `water` gives for a depth. Salinity is never less than nothing.
    fn reading(&self, tick: u64, depth: f64, water: impl FnOnce(f64) -> (f64, f64)) -> Option<(f64, f64)> {
        let s = &self.settings;
        if depth < s.above || !is_due(s.rate, tick) {
            return None;
        }
        let noise = |deviation: f64, of: Noise| if deviation > 0.0 { deviation * of.gaussian(tick) } else { 0.0 };
        let (temperature, salinity) = water(depth);
        let temperature = temperature + s.temperature_bias + noise(s.temperature_noise, self.temperature);
        let salinity = salinity + s.salinity_bias + noise(s.salinity_noise, self.salinity);
        Some((temperature, salinity.max(0.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WATER: (f64, f64) = (12.0, 34.0);

    #[test]
    fn noise_and_bias_are_as_told_at_the_rate_that_is_told() {
        let settings = scenario::Ctd {
            rate: 5.0,
            temperature_noise: 0.02,
            temperature_bias: 0.5,
            salinity_noise: 0.1,
            salinity_bias: -1.0,
            ..scenario::Ctd::default()
        };
        let ctd = Ctd::new(&settings, 1);
        let told: Vec<(f64, f64)> = (0..20_000).filter_map(|tick| ctd.reading(tick, 3.0, |_| WATER)).collect();
        assert_eq!(told.len(), 10_000);
        let moments = |of: fn(&(f64, f64)) -> f64| {
            let mean = told.iter().map(of).sum::<f64>() / 1e4;
            (mean, (told.iter().map(|x| (of(x) - mean) * (of(x) - mean)).sum::<f64>() / 1e4).sqrt())
        };
        let ((mean, deviation), (mean_s, deviation_s)) = (moments(|x| x.0), moments(|x| x.1));
        assert!((mean - 12.5).abs() < 0.001 && (deviation - 0.02).abs() < 0.001, "{mean} {deviation}");
        assert!((mean_s - 33.0).abs() < 0.005 && (deviation_s - 0.1).abs() < 0.005, "{mean_s} {deviation_s}");
    }

    #[test]
    fn a_perfect_one_tells_the_truth_and_a_dry_one_nothing() {
        let ctd = Ctd::new(&scenario::Ctd::default(), 1);
        let water = |depth: f64| (20.0 - depth, 30.0 + depth);
        assert_eq!(ctd.reading(10, 3.0, water), Some((17.0, 33.0)));
        assert_eq!((ctd.reading(10, 0.1, water), ctd.reading(11, 3.0, water)), (None, None));
    }
}
