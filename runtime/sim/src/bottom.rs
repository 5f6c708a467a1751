//! How deep the water is: a plane that slopes, with pits in it.

use crate::scenario::{Bottom, Pit};
use albacore_geometry::Point;
use albacore_geometry::math::exp;

impl Bottom {
    /// A level bottom.
    pub fn flat(depth: f64) -> Self {
        Bottom { from: depth, to: depth, ..Bottom::default() }
    }

    /// Whether the water is equally deep everywhere.
    pub fn is_level(&self) -> bool {
        self.from == self.to && self.pits.is_empty()
    }

    /// Metres of water at a point: linear from `from` to `to` over the slope, level beyond either end of it, and the pits.
    pub fn depth_at(&self, p: Point) -> f64 {
        let share = (p.along(self.toward) / self.across + 0.5).clamp(0.0, 1.0);
        let plane = self.from + (self.to - self.from) * share;
        self.pits.iter().fold(plane, |depth, pit| depth + pit.depth_at(p))
    }
}

impl Pit {
    /// How much deeper than the plane it makes the water at a point, m.
    fn depth_at(&self, p: Point) -> f64 {
        let out = p.distance(self.at) / self.radius;
        self.depth * exp(-0.5 * out * out)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use albacore_geometry::Heading;

    fn slope() -> Bottom {
        Bottom { from: 4.0, to: 8.0, toward: Heading::from_degrees(90.0), across: 400.0, ..Bottom::default() }
    }

    #[test]
    fn a_slope_falls_toward_its_heading_and_ends() {
        for (east, depth) in [(-500.0, 4.0), (-200.0, 4.0), (0.0, 6.0), (100.0, 7.0), (900.0, 8.0)] {
            assert!((slope().depth_at(Point::new(77.0, east)) - depth).abs() < 1e-12);
        }
    }

    #[test]
    fn a_pit_adds_its_depth_and_is_gone_some_radii_away() {
        let at = Point::new(30.0, 100.0);
        let pit = Pit { at, depth: 2.0, radius: 25.0, ..Pit::default() };
        let bottom = Bottom { pits: vec![pit.clone(), pit], ..slope() };
        assert!((bottom.depth_at(at) - 11.0).abs() < 1e-12, "two pits add up");
        assert!((bottom.depth_at(Point::new(55.0, 100.0)) - (7.0 + 4.0 * 0.60653)).abs() < 1e-4);
        assert!((bottom.depth_at(Point::new(180.0, 100.0)) - 7.0).abs() < 1e-6);
        assert!(!bottom.is_level() && Bottom::flat(4.0).is_level() && !slope().is_level());
    }
}
