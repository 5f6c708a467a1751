//! The echo sounder: how far the bottom is, with noise.

use crate::noise::{Noise, Stream};
use crate::scenario::Sounder;

/// An echo at every tick.
#[derive(Clone, Debug)]
pub struct EchoSounder {
    /// Standard deviation of one echo, m.
    deviation: f64,
    noise: Noise,
}

impl EchoSounder {
    /// The sounder of a run.
    pub fn new(settings: &Sounder, seed: u64) -> Self {
        EchoSounder { deviation: settings.noise, noise: Noise::new(seed, Stream::Sounder) }
    }

    /// What it makes of a true altitude, m: never less than nothing.
    pub fn reading(&self, tick: u64, altitude: f64) -> f64 {
        if self.deviation > 0.0 { (altitude + self.deviation * self.noise.gaussian(tick)).max(0.0) } else { altitude }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn echoes_scatter_about_the_truth_and_a_perfect_one_is_the_truth() {
        let sounder = EchoSounder::new(&Sounder { noise: 0.05 }, 1);
        let errors: Vec<f64> = (0..10_000).map(|tick| sounder.reading(tick, 3.0) - 3.0).collect();
        let mean = errors.iter().sum::<f64>() / 10_000.0;
        let deviation = (errors.iter().map(|e| e * e).sum::<f64>() / 10_000.0).sqrt();
        assert!(mean.abs() < 0.002 && (deviation - 0.05).abs() < 0.002, "{mean} {deviation}");
        assert!((0..1000).all(|tick| sounder.reading(tick, 0.01) >= 0.0));
        assert_eq!(EchoSounder::new(&Sounder::default(), 1).reading(7, 3.3), 3.3);
    }
}
