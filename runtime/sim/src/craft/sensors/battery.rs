//! The battery: what it says is left in it.

use super::{Instrument, Surroundings};
use crate::noise::{Noise, Stream};
use albacore_vehicle::Snapshot;
use albacore_vehicle::measurements::BATTERY;
use albacore_vehicle::rate::is_due;
use serde::Deserialize;

/// The gauge of the battery's charge.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Battery {
    /// Samples a second. Default 0.1.
    pub rate: f64,
    /// Standard deviation of its noise, share of a full charge. Default 0.
    pub noise: f64,
    /// Its constant error, share of a full charge: too full. Default 0.
    pub bias: f64,
}

impl Default for Battery {
    fn default() -> Self {
        Battery { rate: 0.1, noise: 0.0, bias: 0.0 }
    }
}

/// A gauge of the charge.
#[derive(Clone, Debug)]
pub struct BatteryGauge {
    settings: Battery,
    noise: Noise,
}

impl BatteryGauge {
    /// The gauge of a run.
    pub fn new(settings: &Battery, seed: u64) -> Self {
        BatteryGauge { settings: settings.clone(), noise: Noise::new(seed, Stream::Battery) }
    }

    /// What it makes of a true charge at a tick, when it tells anything: shares of a full one.
    fn reading(&self, tick: u64, charge: f64) -> Option<f64> {
        let s = &self.settings;
        let noise = if s.noise > 0.0 { s.noise * self.noise.gaussian(tick) } else { 0.0 };
        is_due(s.rate, tick).then_some((charge + s.bias + noise).clamp(0.0, 1.0))
    }
}

impl Instrument for BatteryGauge {
    fn measure(&mut self, around: &mut Surroundings, snapshot: &mut Snapshot) {
        if let Some(charge) = self.reading(around.tick, around.charge) {
            snapshot.push(BATTERY, &[charge]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bias_and_noise_are_as_told_and_it_is_never_less_than_empty() {
        let battery = BatteryGauge::new(&Battery { rate: 10.0, noise: 0.02, bias: 0.1 }, 1);
        let errors: Vec<f64> = (0..10_000).map(|tick| battery.reading(tick, 0.5).unwrap() - 0.5).collect();
        let mean = errors.iter().sum::<f64>() / 1e4;
        let deviation = (errors.iter().map(|e| (e - mean) * (e - mean)).sum::<f64>() / 1e4).sqrt();
        assert!((mean - 0.1).abs() < 0.001 && (deviation - 0.02).abs() < 0.001, "{mean} {deviation}");
        assert!((0..1000).all(|tick| battery.reading(tick, 1.0).unwrap() <= 1.0));
        let perfect = BatteryGauge::new(&Battery::default(), 1);
        assert_eq!((perfect.reading(100, 0.3), perfect.reading(101, 0.3)), (Some(0.3), None), "every 10 s");
    }
}
