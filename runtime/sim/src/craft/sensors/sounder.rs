//! The echo sounder: how far the bottom is, where it hears an echo.

use super::delay::Delay;
use super::{AtRest, EVERY_TICK, Instrument, InstrumentSetup, Surroundings};
use crate::noise::{Noise, Stream};
use crate::scenario::{ScenarioIssues, number};
use albacore_vehicle::measurements::{ALTITUDE, DEPTH, WATER_DEPTH};
use albacore_vehicle::rate::is_due;
use albacore_vehicle::{Sample, Snapshot};
use serde::Deserialize;

/// The echo sounder: the height above the bottom, and with the vehicle's depth that of the water.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sounder {
    /// Echoes a second. Default 10: at every tick.
    pub rate: f64,
    /// Standard deviation of one echo, m. Default 0.
    pub noise: f64,
    /// Its constant error, m: too far. Default 0.
    pub bias: f64,
    /// It hears no echo from nearer than this, m. Default 0.
    pub nearest: f64,
    /// It hears no echo from farther than this, m. Default none: from anywhere.
    pub farthest: Option<f64>,
    /// The share of echoes that are lost. Default 0.
    pub dropouts: f64,
    /// Between an echo and its being told, s. Default 0.
    pub delay: f64,
}

impl Default for Sounder {
    fn default() -> Self {
        Sounder { rate: EVERY_TICK, noise: 0.0, bias: 0.0, nearest: 0.0, farthest: None, dropouts: 0.0, delay: 0.0 }
    }
}

impl Sounder {
    fn hears(&self, altitude: f64) -> bool {
        altitude >= self.nearest && self.farthest.is_none_or(|farthest| altitude <= farthest)
    }

    /// Why a vehicle at rest has no altitude.
    pub(super) fn silence(&self, lies: &AtRest) -> Option<String> {
        let away = number(lies.altitude);
        (!self.hears(lies.altitude)).then(|| match self.farthest.filter(|&farthest| lies.altitude > farthest) {
            Some(farthest) => {
                format!(
                    "the bottom is {away} m away where it starts, and its sounder hears none farther than {} m",
                    number(farthest)
                )
            }
            None => format!(
                "the bottom is {away} m away where it starts, and its sounder hears none nearer than {} m",
                number(self.nearest)
            ),
        })
    }
}

/// A sounder.
#[derive(Clone, Debug)]
pub struct EchoSounder {
    settings: Sounder,
    noise: Noise,
    dropouts: Noise,
    delay: Delay<f64>,
}

impl EchoSounder {
    /// The sounder of a run.
    pub fn new(settings: &Sounder, seed: u64) -> Self {
        let (noise, dropouts) = (Noise::new(seed, Stream::Sounder), Noise::new(seed, Stream::SounderDropout));
        EchoSounder { settings: settings.clone(), noise, dropouts, delay: Delay::new(settings.delay) }
    }

    /// What it tells at a tick when the true altitude is `altitude`, m.
    fn sample(&mut self, tick: u64, altitude: f64) -> Option<f64> {
        self.delay.pass(tick, self.reading(tick, altitude))
    }

    /// What it makes of a true altitude at a tick, m, when it hears an echo: never less than nothing.
    fn reading(&self, tick: u64, altitude: f64) -> Option<f64> {
        let s = &self.settings;
        let is_lost = s.dropouts > 0.0 && self.dropouts.uniform(tick) < s.dropouts;
        if is_lost || !s.hears(altitude) || !is_due(s.rate, tick) {
            return None;
        }
        let noise = if s.noise > 0.0 { s.noise * self.noise.gaussian(tick) } else { 0.0 };
        let is_perfect = s.noise == 0.0 && s.bias == 0.0;
        Some(if is_perfect { altitude } else { (altitude + s.bias + noise).max(0.0) })
    }
}

impl Instrument for EchoSounder {
    fn measure(&mut self, around: &mut Surroundings, snapshot: &mut Snapshot) {
        let Some(echo) = self.sample(around.tick, around.truth.altitude) else { return };
        snapshot.push(ALTITUDE, &[echo]);
        if let Some(depth) = water_depth(&snapshot.samples) {
            snapshot.push(WATER_DEPTH, &[depth]);
        }
    }
}

/// The depth of the water is the sum of what is told of depth and altitude in the same tick, and not told without both.
pub fn water_depth(samples: &[Sample]) -> Option<f64> {
    let latest = |measurement| samples.iter().rev().find(|s| s.measurement == measurement).map(|s| s.reading[0]);
    latest(DEPTH).zip(latest(ALTITUDE)).map(|(depth, altitude)| depth + altitude)
}

/// What of it cannot be.
pub(super) fn check(setup: &InstrumentSetup, issues: &mut ScenarioIssues) {
    let Sounder { nearest, farthest: Some(farthest), .. } = setup.sounder else { return };
    let (farthest_m, nearest_m) = (number(farthest), number(nearest));
    issues.of("sounder").unless(
        Some("farthest"),
        farthest > nearest,
        format!("`sounder` hears from {farthest_m} m at most, and not from nearer than {nearest_m} m"),
        "make `farthest` greater than `nearest`, or it hears nothing",
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn echoes_scatter_about_the_truth_and_a_perfect_one_is_the_truth() {
        let sounder = EchoSounder::new(&Sounder { noise: 0.05, ..Sounder::default() }, 1);
        let errors: Vec<f64> = (0..10_000).map(|tick| sounder.reading(tick, 3.0).unwrap() - 3.0).collect();
        let mean = errors.iter().sum::<f64>() / 10_000.0;
        let deviation = (errors.iter().map(|e| e * e).sum::<f64>() / 10_000.0).sqrt();
        assert!(mean.abs() < 0.002 && (deviation - 0.05).abs() < 0.002, "{mean} {deviation}");
        assert!((0..1000).all(|tick| sounder.reading(tick, 0.01).unwrap() >= 0.0));
        assert_eq!(EchoSounder::new(&Sounder::default(), 1).reading(7, 3.3), Some(3.3));
    }

    #[test]
    fn echoes_are_lost_out_of_range_and_at_random() {
        let settings = Sounder { nearest: 0.5, farthest: Some(30.0), bias: -0.2, ..Sounder::default() };
        let sounder = EchoSounder::new(&settings, 1);
        assert_eq!((sounder.reading(1, 0.4), sounder.reading(1, 31.0)), (None, None));
        assert_eq!(sounder.reading(1, 3.0), Some(2.8));
        let sounder = EchoSounder::new(&Sounder { dropouts: 0.3, ..settings }, 1);
        let lost = (0..10_000).filter(|&tick| sounder.reading(tick, 3.0).is_none()).count();
        assert!((2_800..3_200).contains(&lost), "{lost}");
    }
}
