//! The navigator of a vehicle that tells where it is.

use crate::navigator::{Estimate, Fix, Navigator, Sensed};
use albacore_geometry::Point;

/// Takes every position as it is told; the filter is aboard the vehicle.
#[derive(Clone, Debug)]
pub struct Reported(Estimate);

impl Default for Reported {
    fn default() -> Self {
        Reported(Estimate { position: Point::ORIGIN, sigma: 0.0 })
    }
}

impl Navigator for Reported {
    fn predict(&mut self, _: &Sensed, _: f64) {}

    fn update(&mut self, fix: &Fix) -> bool {
        self.0 = Estimate { position: fix.position, sigma: fix.sigma };
        true
    }

    fn estimate(&self) -> Estimate {
        self.0
    }

    fn boxed(&self) -> Box<dyn Navigator> {
        Box::new(self.clone())
    }
}
