//! The USBL receiver: an ultra-short baseline of hydrophones, which measures range and bearing of a beacon. With what the vehicle believes
//! of its own position that is a place.

use super::delay::Delay;
use super::{Instrument, Surroundings};
use crate::noise::Noise;
use albacore_geometry::{Point, Vector};
use albacore_navigation::Estimate;
use albacore_vehicle::Snapshot;
use albacore_vehicle::measurements::BEACON;
use albacore_vehicle::rate::is_due;
use serde::Deserialize;

/// The receiver.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Usbl {
    /// Samples a second. Default 1.
    pub rate: f64,
    /// Standard deviation of the way to the beacon, m an axis. Default 0.
    pub noise: f64,
    /// It hears none from farther, m. Default none: from anywhere.
    pub range: Option<f64>,
    /// The share of samples that are lost. Default 0.
    pub dropouts: f64,
    /// Between a sample and its being told, s. Default 0.
    pub delay: f64,
}

impl Default for Usbl {
    fn default() -> Self {
        Usbl { rate: 1.0, noise: 0.0, range: None, dropouts: 0.0, delay: 0.0 }
    }
}

/// A receiver.
#[derive(Clone, Debug)]
pub struct UsblReceiver {
    settings: Usbl,
    noise: Noise,
    dropouts: Noise,
    delay: Delay<(Point, f64)>,
}

impl UsblReceiver {
    /// That of a run.
    pub fn new(settings: &Usbl, seed: u64) -> Self {
        let (noise, dropouts) = (Noise::named(seed, "usbl noise"), Noise::named(seed, "usbl dropouts"));
        UsblReceiver { settings: settings.clone(), noise, dropouts, delay: Delay::new(settings.delay) }
    }

    /// Where the beacon seems to be that is truly so far away, to a vehicle that believes to be at a place and whose compass is off by an
    /// angle (rad, clockwise); with the standard deviation of that, m an axis.
    fn reading(&self, tick: u64, way: Vector, believed: Estimate, off: f64) -> Option<(Point, f64)> {
        let s = &self.settings;
        let is_lost = s.dropouts > 0.0 && self.dropouts.uniform(tick) < s.dropouts;
        let is_heard = s.range.is_none_or(|range| way.length() <= range);
        if is_lost || !is_heard || !is_due(s.rate, tick) {
            return None;
        }
        // A perfect one adds no rounding of its own.
        let turned = if off == 0.0 { way } else { way.length() * (way.toward() + off).unit() };
        let noise = match s.noise > 0.0 {
            true => s.noise * Vector::new(self.noise.gaussian(2 * tick), self.noise.gaussian(2 * tick + 1)),
            false => Vector::ZERO,
        };
        let sigma = (s.noise * s.noise + believed.sigma * believed.sigma).sqrt();
        Some((believed.position + turned + noise, sigma))
    }
}

impl Instrument for UsblReceiver {
    fn measure(&mut self, around: &mut Surroundings, snapshot: &mut Snapshot) {
        let beacon = around.world.beacon(around.time_s());
        let off = around.compass - around.truth.heading;
        let reading =
            beacon.and_then(|beacon| self.reading(around.tick, beacon - around.truth.position, around.believed, off));
        if let Some((place, sigma)) = self.delay.pass(around.tick, reading) {
            snapshot.push(BEACON, &[place.north, place.east, sigma]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WAY: Vector = Vector { north: 30.0, east: 40.0 };

    fn at(north: f64, east: f64, sigma: f64) -> Estimate {
        Estimate { position: Point::new(north, east), sigma }
    }

    #[test]
    fn a_perfect_one_adds_the_way_to_what_is_believed() {
        let usbl = UsblReceiver::new(&Usbl::default(), 1);
        assert_eq!(usbl.reading(10, WAY, at(1.0, 2.0, 3.0), 0.0), Some((Point::new(31.0, 42.0), 3.0)));
        assert_eq!(usbl.reading(11, WAY, at(1.0, 2.0, 3.0), 0.0), None);
        let (place, _) = usbl.reading(10, WAY, at(0.0, 0.0, 0.0), std::f64::consts::FRAC_PI_2).unwrap();
        assert!(place.distance(Point::new(-40.0, 30.0)) < 1e-9, "{place:?}");
    }

    #[test]
    fn noise_range_and_dropouts_are_as_told() {
        let settings = Usbl { rate: 10.0, noise: 2.0, range: Some(50.0), dropouts: 0.3, delay: 0.0 };
        let usbl = UsblReceiver::new(&settings, 1);
        let told: Vec<(Point, f64)> =
            (0..20_000).filter_map(|tick| usbl.reading(tick, WAY, at(0.0, 0.0, 1.0), 0.0)).collect();
        assert!((13_700..14_300).contains(&told.len()), "{}", told.len());
        let count = told.len() as f64;
        let mean = told.iter().map(|(place, _)| place.north - 30.0).sum::<f64>() / count;
        let variance = told.iter().map(|(place, _)| (place.east - 40.0) * (place.east - 40.0)).sum::<f64>() / count;
        assert!(mean.abs() < 0.06 && (variance.sqrt() - 2.0).abs() < 0.05, "{mean} {variance}");
        assert!(told.iter().all(|(_, sigma)| *sigma == 5.0_f64.sqrt()));
        assert_eq!(usbl.reading(10, 1.01 * WAY, at(0.0, 0.0, 1.0), 0.0), None);
    }
}
