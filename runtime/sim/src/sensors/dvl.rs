//! The Doppler log: the velocity over ground, while it sees the bottom.

use super::rate::is_due;
use crate::noise::{Noise, Stream};
use crate::scenario;
use albacore_geometry::Vector;

/// A Doppler log.
#[derive(Clone, Debug)]
pub struct Dvl {
    settings: scenario::Dvl,
    noise: Noise,
}

impl Dvl {
    /// The log of a run.
    pub fn new(settings: &scenario::Dvl, seed: u64) -> Self {
        Dvl { settings: settings.clone(), noise: Noise::new(seed, Stream::Dvl) }
    }

    /// Whether it sees the bottom from an altitude, m.
    pub fn has_lock(&self, altitude: f64) -> bool {
        self.settings.range.is_none_or(|range| altitude <= range)
    }

    /// Whether it tells a velocity at a tick and an altitude, m.
    pub fn tells(&self, tick: u64, altitude: f64) -> bool {
        self.has_lock(altitude) && is_due(self.settings.rate, tick)
    }

    /// What it makes of a true velocity at a tick, m/s; none for a perfect one.
    pub fn noisy(&self, tick: u64, velocity: Vector) -> Option<Vector> {
        let noise = |component: u64| self.settings.noise * self.noise.gaussian(2 * tick + component);
        (self.settings.noise > 0.0).then(|| velocity + Vector::new(noise(0), noise(1)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lock_is_lost_above_its_range() {
        let dvl = Dvl::new(&scenario::Dvl { range: Some(30.0), rate: 2.0, ..Default::default() }, 1);
        assert!(dvl.tells(5, 30.0) && !dvl.tells(5, 30.1) && !dvl.tells(6, 30.0));
        let dvl = Dvl::new(&scenario::Dvl { noise: 0.02, ..Default::default() }, 1);
        let truth = Vector::new(1.0, 1.0);
        let square = |tick| {
            let error = dvl.noisy(tick, truth).unwrap() - truth;
            error.dot(error)
        };
        let variance = (0..10_000).map(square).sum::<f64>() / 2e4;
        assert!((variance.sqrt() - 0.02).abs() < 0.001 && dvl.tells(3, 1e4));
        assert_eq!(Dvl::new(&scenario::Dvl::default(), 1).noisy(3, truth), None);
    }
}
