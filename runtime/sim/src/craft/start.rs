//! Where a run begins: a scenario may scatter its starts over the seeds.

use crate::craft::setup::VehicleSetup;
use crate::noise::{Noise, Stream};
use albacore_geometry::Heading;
use albacore_geometry::math::TAU;

impl VehicleSetup {
    /// The same vehicle where this seed starts it: evenly anywhere in its disc.
    pub fn placed(&self, seed: u64) -> VehicleSetup {
        let mut placed = self.clone();
        if self.start_spread > 0.0 {
            let noise = Noise::new(seed, Stream::Start);
            // The root makes it even over the disc: a ring holds the more area the wider it is.
            let out = self.start_spread * noise.uniform(0).sqrt();
            placed.start += out * Heading::from_radians(TAU * noise.uniform(1)).unit();
        }
        placed
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use albacore_geometry::Point;

    #[test]
    fn starts_fill_their_disc_evenly_and_stay_without_one() {
        let start = Point::new(40.0, -30.0);
        let vehicle = VehicleSetup { start, start_spread: 60.0, ..VehicleSetup::default() };
        let ranges: Vec<f64> = (0..4000).map(|seed| vehicle.placed(seed).start.distance(start)).collect();
        assert!(ranges.iter().all(|range| *range <= 60.0));
        // A quarter of the disc lies within half its radius.
        let near = ranges.iter().filter(|range| **range < 30.0).count();
        assert!((900..1100).contains(&near), "{near}");
        assert_eq!(vehicle.placed(3), vehicle.placed(3));
        let fixed = VehicleSetup { start, ..VehicleSetup::default() };
        assert_eq!(fixed.placed(3), fixed);
    }
}
