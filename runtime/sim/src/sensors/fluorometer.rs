//! The chemical sensor: noise, saturation and false alarms, at its own rate.

use super::delay::Delay;
use crate::noise::{Noise, Stream};
use crate::scenario;
use albacore_vehicle::TICK_S;

/// What a false alarm reads at least, ratio of full scale.
const FALSE_ALARM: f64 = 0.10;
/// A sample that falls on a tick belongs to it, whatever the rounding of its time.
const TICK_TOLERANCE: f64 = 1e-9;

/// A fluorometer. Sample k is taken at k / rate seconds.
#[derive(Clone, Debug)]
pub struct Fluorometer {
    settings: scenario::Fluorometer,
    noise: Noise,
    alarms: Noise,
    next: u64,
    tube: Delay<f64>,
}

impl Fluorometer {
    /// Before its first sample.
    pub fn new(settings: &scenario::Fluorometer, seed: u64) -> Self {
        Fluorometer {
            settings: settings.clone(),
            noise: Noise::new(seed, Stream::Fluorometer),
            alarms: Noise::new(seed, Stream::FalseAlarm),
            next: 0,
            tube: Delay::new(settings.delay),
        }
    }

    /// The number and time (s) of the next sample, if it is due by a tick.
    pub fn due(&mut self, tick: u64) -> Option<(u64, f64)> {
        let last = (tick as f64 * (self.settings.rate * TICK_S) + TICK_TOLERANCE).floor();
        if self.next as f64 > last {
            return None;
        }
        let sample = self.next;
        self.next += 1;
        Some((sample, sample as f64 / self.settings.rate))
    }

    /// Sends a reading on its way.
    pub fn send(&mut self, tick: u64, reading: f64) {
        self.tube.send(tick, reading);
    }

    /// The next reading that has come by a tick.
    pub fn sample(&mut self, tick: u64) -> Option<f64> {
        self.tube.sample(tick)
    }

    /// The reading of a sample where the truth is `concentration`; both are ratios of full scale.
    pub fn reading(&self, sample: u64, concentration: f64) -> f64 {
        let noisy = concentration + self.settings.noise * self.noise.gaussian(sample) + self.settings.bias;
        let alarm = self.alarms.uniform(sample) < self.settings.false_alarms / self.settings.rate;
        let read = if alarm { noisy.max(FALSE_ALARM) } else { noisy };
        read.clamp(0.0, self.settings.saturation)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_come_at_their_rate() {
        for (rate, expected) in [(10.0, 101), (25.0, 251), (2.0, 21), (3.0, 31)] {
            let settings = scenario::Fluorometer { rate, ..Default::default() };
            let mut sensor = Fluorometer::new(&settings, 1);
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
        let settings = scenario::Fluorometer { noise: 0.003, false_alarms: 0.01, ..Default::default() };
        let sensor = Fluorometer::new(&settings, 1);
        let n = 1_000_000;
        let above = (0..n).filter(|&k| sensor.reading(k, 0.0) > 0.04).count();
        assert!((800..1200).contains(&above), "one alarm in a thousand samples: {above} of {n}");
        assert!((0..1000).all(|k| sensor.reading(k, 1.8) == 1.0 && sensor.reading(k, 0.0) >= 0.0));
        let dull = Fluorometer::new(&scenario::Fluorometer { saturation: 0.4, bias: 0.1, noise: 0.0, ..settings }, 1);
        assert!(dull.reading(1, 0.35) == 0.4 && (dull.reading(1, 0.2) - 0.3).abs() < 1e-12);
        let mean = (0..n).map(|k| sensor.reading(k, 0.5)).sum::<f64>() / n as f64;
        assert!((mean - 0.5).abs() < 1e-4);
    }
}
