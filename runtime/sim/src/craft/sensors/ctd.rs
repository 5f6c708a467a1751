//! The CTD: the temperature of the water about the vehicle, and its salinity.

use super::delay::Delay;
use super::{AtRest, Instrument, Surroundings};
use crate::noise::{Noise, Stream};
use crate::scenario::number;
use albacore_vehicle::measurements::{SALINITY, TEMPERATURE};
use albacore_vehicle::rate::is_due;
use albacore_vehicle::{Snapshot, TICK_S};
use serde::Deserialize;

/// The CTD: conductivity and temperature, and the practical salinity that is derived from them and the pressure.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ctd {
    /// Samples a second. Default 1.
    pub rate: f64,
    /// Standard deviation of a temperature, degrees Celsius. Default 0.
    pub temperature_noise: f64,
    /// Its constant error, degrees Celsius: too warm. Default 0.
    pub temperature_bias: f64,
    /// Standard deviation of a salinity. Default 0.
    pub salinity_noise: f64,
    /// Its constant error: too salty. Default 0.
    pub salinity_bias: f64,
    /// Above this depth its cell runs dry, and it tells nothing, m. Default 0.2.
    pub above: f64,
    /// Between a sample and its being told, s. Default 0.
    pub delay: f64,
}

impl Default for Ctd {
    fn default() -> Self {
        Ctd {
            rate: 1.0,
            temperature_noise: 0.0,
            temperature_bias: 0.0,
            salinity_noise: 0.0,
            salinity_bias: 0.0,
            above: 0.2,
            delay: 0.0,
        }
    }
}

impl Ctd {
    /// Why a vehicle at rest has no sample of it.
    pub(super) fn silence(&self, lies: &AtRest) -> Option<String> {
        (lies.depth < self.above).then(|| format!("its CTD is dry above {} m, where it starts", number(self.above)))
    }
}

/// A CTD.
#[derive(Clone, Debug)]
pub struct CtdProbe {
    settings: Ctd,
    temperature: Noise,
    salinity: Noise,
    delay: Delay<(f64, f64)>,
}

impl CtdProbe {
    /// That of a run.
    pub fn new(settings: &Ctd, seed: u64) -> Self {
        let (temperature, salinity) = (Noise::new(seed, Stream::CtdTemperature), Noise::new(seed, Stream::CtdSalinity));
        CtdProbe { settings: settings.clone(), temperature, salinity, delay: Delay::new(settings.delay) }
    }

    /// What it tells at a tick and a depth (m): temperature (degrees Celsius) and practical salinity.
    fn sample(&mut self, tick: u64, depth: f64, water: impl FnOnce(f64) -> (f64, f64)) -> Option<(f64, f64)> {
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

impl Instrument for CtdProbe {
    fn measure(&mut self, around: &mut Surroundings, snapshot: &mut Snapshot) {
        let time = around.tick as f64 * TICK_S;
        let water = |depth| around.world.stratification().at(around.truth.position, depth, time);
        if let Some((temperature, salinity)) = self.sample(around.tick, around.truth.depth, water) {
            snapshot.push(TEMPERATURE, &[temperature]);
            snapshot.push(SALINITY, &[salinity]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WATER: (f64, f64) = (12.0, 34.0);

    #[test]
    fn noise_and_bias_are_as_told_at_the_rate_that_is_told() {
        let settings = Ctd {
            rate: 5.0,
            temperature_noise: 0.02,
            temperature_bias: 0.5,
            salinity_noise: 0.1,
            salinity_bias: -1.0,
            ..Ctd::default()
        };
        let ctd = CtdProbe::new(&settings, 1);
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
        let ctd = CtdProbe::new(&Ctd::default(), 1);
        let water = |depth: f64| (20.0 - depth, 30.0 + depth);
        assert_eq!(ctd.reading(10, 3.0, water), Some((17.0, 33.0)));
        assert_eq!((ctd.reading(10, 0.1, water), ctd.reading(11, 3.0, water)), (None, None));
    }
}
