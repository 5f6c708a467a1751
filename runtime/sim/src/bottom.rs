//! How deep the water is.

use crate::scenario::Bottom;
use albacore_geometry::Point;

impl Bottom {
    /// A level bottom.
    pub fn flat(depth: f64) -> Self {
        Bottom { from: depth, to: depth, ..Bottom::default() }
    }

    /// Metres of water at a point: linear from `from` to `to` over the slope, level beyond either end of it.
    pub fn depth_at(&self, p: Point) -> f64 {
        let share = (p.along(self.toward) / self.across + 0.5).clamp(0.0, 1.0);
        self.from + (self.to - self.from) * share
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use albacore_geometry::Heading;

    #[test]
    fn a_slope_falls_toward_its_heading_and_ends() {
        let bottom = Bottom { from: 4.0, to: 8.0, toward: Heading::from_degrees(90.0), across: 400.0 };
        for (east, depth) in [(-500.0, 4.0), (-200.0, 4.0), (0.0, 6.0), (100.0, 7.0), (900.0, 8.0)] {
            assert!((bottom.depth_at(Point::new(77.0, east)) - depth).abs() < 1e-12);
        }
    }
}
