//! The chemical sensor: noise, saturation and false alarms, at its own rate.

use super::delay::Delay;
use super::{Instrument, InstrumentSetup, Surroundings};
use crate::noise::{Noise, Stream};
use crate::scenario::{ScenarioIssues, number};
use crate::world::World;
use albacore_geometry::{Heading, Point};
use albacore_vehicle::Snapshot;
use albacore_vehicle::TICK_S;
use albacore_vehicle::measurements::CHEMICAL;
use serde::Deserialize;

/// The chemical sensor.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fluorometer {
    /// Samples a second; more than one may come in a tick. Default 10.
    pub rate: f64,
    /// Standard deviation of its noise, ratio of full scale. Default 0.003.
    pub noise: f64,
    /// False alarms a second, on average: samples that read at least 10 %. Default 0.
    pub false_alarms: f64,
    /// How far its intake is ahead of the vehicle's reference point, m. Default 0.8: the nose of a 1.6 m REMUS 100.
    pub ahead: f64,
    /// Its constant error, ratio of full scale. Default 0.
    pub bias: f64,
    /// Between sample and reading, s: pump and tube. Default 0.
    pub delay: f64,
    /// It reads no more than this, ratio of full scale. Default 1.
    pub saturation: f64,
}

impl Default for Fluorometer {
    fn default() -> Self {
        Fluorometer { rate: 10.0, noise: 0.003, false_alarms: 0.0, ahead: 0.8, bias: 0.0, delay: 0.0, saturation: 1.0 }
    }
}

/// What a false alarm reads at least, ratio of full scale.
const FALSE_ALARM: f64 = 0.10;
/// A sample that falls on a tick belongs to it, whatever the rounding of its time.
const TICK_TOLERANCE: f64 = 1e-9;
/// A sample this near a tick, in ticks, is taken on it.
const ON_THE_TICK: f64 = 1e-6;

/// A fluorometer. Sample k is taken at k / rate seconds.
#[derive(Clone, Debug)]
pub struct ChemicalSensor {
    settings: Fluorometer,
    noise: Noise,
    alarms: Noise,
    next: u64,
    tube: Delay<f64>,
    /// Where its intake was a tick ago, and its height above the bottom (m).
    before: Option<(Point, f64)>,
}

impl ChemicalSensor {
    /// Before its first sample.
    pub fn new(settings: &Fluorometer, seed: u64) -> Self {
        ChemicalSensor {
            settings: settings.clone(),
            noise: Noise::new(seed, Stream::Fluorometer),
            alarms: Noise::new(seed, Stream::FalseAlarm),
            next: 0,
            tube: Delay::new(settings.delay),
            before: None,
        }
    }

    /// Where its intake is on a vehicle at a depth (m), and its height above the bottom (m).
    pub fn intake(&self, position: Point, heading: Heading, depth: f64, world: &World) -> (Point, f64) {
        let intake = position + self.settings.ahead * heading.unit();
        (intake, (world.water_depth(intake) - depth).max(0.0))
    }

    /// The number and time (s) of the next sample, if it is due by a tick.
    fn due(&mut self, tick: u64) -> Option<(u64, f64)> {
        let last = (tick as f64 * (self.settings.rate * TICK_S) + TICK_TOLERANCE).floor();
        if self.next as f64 > last {
            return None;
        }
        let sample = self.next;
        self.next += 1;
        Some((sample, sample as f64 / self.settings.rate))
    }

    /// The reading of a sample where the truth is `concentration`; both are ratios of full scale.
    fn reading(&self, sample: u64, concentration: f64) -> f64 {
        let noisy = concentration + self.settings.noise * self.noise.gaussian(sample) + self.settings.bias;
        let alarm = self.alarms.uniform(sample) < self.settings.false_alarms / self.settings.rate;
        let read = if alarm { noisy.max(FALSE_ALARM) } else { noisy };
        read.clamp(0.0, self.settings.saturation)
    }
}

impl Instrument for ChemicalSensor {
    fn measure(&mut self, around: &mut Surroundings, snapshot: &mut Snapshot) {
        let tick = around.tick;
        let now = around.intake;
        let before = self.before.replace(now).unwrap_or(now);
        while let Some((sample, time)) = self.due(tick) {
            // How long before this tick the sample was taken, in ticks.
            let back = (tick as f64 - time / TICK_S).clamp(0.0, 1.0);
            let concentration = if back <= ON_THE_TICK {
                around.truth.concentration
            } else {
                let place = now.0 + back * (before.0 - now.0);
                around.world.concentration(place, now.1 + back * (before.1 - now.1), time)
            };
            self.tube.send(tick, self.reading(sample, concentration));
        }
        while let Some(reading) = self.tube.sample(tick) {
            snapshot.push(CHEMICAL, &[reading]);
        }
    }
}

/// What of it cannot be.
pub(super) fn check(setup: &InstrumentSetup, issues: &mut ScenarioIssues) {
    let Fluorometer { false_alarms, rate, .. } = setup.fluorometer;
    issues.of("fluorometer").unless(
        Some("false_alarms"),
        false_alarms <= rate,
        format!("`fluorometer` has more `false_alarms` than samples: its `rate` is {} Hz", number(rate)),
        "make them fewer: a sample gives one alarm at most",
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_come_at_their_rate() {
        for (rate, expected) in [(10.0, 101), (25.0, 251), (2.0, 21), (3.0, 31)] {
            let settings = Fluorometer { rate, ..Default::default() };
            let mut sensor = ChemicalSensor::new(&settings, 1);
            let mut samples = 0;
            for tick in 0..=100 {
                while let Some((_, time)) = sensor.due(tick) {
                    assert!(time <= tick as f64 * TICK_S + 1e-9 && time > (tick as f64 - 1.0) * TICK_S - 1e-9);
                    samples += 1;
                }
            }
            assert_eq!(samples, expected, "{rate} Hz");
        }
    }

    #[test]
    fn noise_saturation_and_false_alarms() {
        let settings = Fluorometer { noise: 0.003, false_alarms: 0.01, ..Default::default() };
        let sensor = ChemicalSensor::new(&settings, 1);
        let n = 1_000_000;
        let above = (0..n).filter(|&k| sensor.reading(k, 0.0) > 0.04).count();
        assert!((800..1200).contains(&above), "one alarm in a thousand samples: {above} of {n}");
        assert!((0..1000).all(|k| sensor.reading(k, 1.8) == 1.0 && sensor.reading(k, 0.0) >= 0.0));
        let dull = ChemicalSensor::new(&Fluorometer { saturation: 0.4, bias: 0.1, noise: 0.0, ..settings }, 1);
        assert!(dull.reading(1, 0.35) == 0.4 && (dull.reading(1, 0.2) - 0.3).abs() < 1e-12);
        let mean = (0..n).map(|k| sensor.reading(k, 0.5)).sum::<f64>() / n as f64;
        assert!((mean - 0.5).abs() < 1e-4);
    }
}
