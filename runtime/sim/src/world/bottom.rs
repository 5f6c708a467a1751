//! How deep the water is: a plane that slopes or a survey's grid, with pits in it.

mod grid;
mod settings;

pub(crate) use settings::DEEPEST_M;
pub(crate) use settings::check;
pub use settings::{Bottom, Grid, Ground, NoGo, Pit, Plane};

use albacore_geometry::math::exp;
use albacore_geometry::{Point, Vector};

impl Bottom {
    /// A level bottom.
    pub fn flat(depth: f64) -> Self {
        Bottom::plane(Plane { from: depth, to: depth, ..Plane::default() })
    }

    /// A plane without pits.
    pub fn plane(plane: Plane) -> Self {
        Bottom { ground: Ground::Plane(plane), pits: Vec::new() }
    }

    /// Whether the water is equally deep everywhere.
    pub fn is_level(&self) -> bool {
        matches!(&self.ground, Ground::Plane(plane) if plane.from == plane.to) && self.pits.is_empty()
    }

    /// Whether its deepest point is worth a search: a plane has it in a corner.
    pub fn has_hollows(&self) -> bool {
        matches!(self.ground, Ground::Grid(_)) || !self.pits.is_empty()
    }

    /// Metres of water at a point: those over the ground, and those of the pits, which land has not.
    pub fn depth_at(&self, p: Point) -> f64 {
        self.depth(p, self.downhill())
    }

    fn depth(&self, p: Point, downhill: Vector) -> f64 {
        let ground = match &self.ground {
            Ground::Plane(plane) => plane.depth((p - Point::ORIGIN).dot(downhill)),
            Ground::Grid(grid) => grid.depth_at(p),
        };
        if ground <= 0.0 {
            return ground;
        }
        self.pits.iter().fold(ground, |depth, pit| depth + pit.depth_at(p))
    }

    /// The direction in which a plane slopes.
    fn downhill(&self) -> Vector {
        match &self.ground {
            Ground::Plane(plane) => plane.toward.unit(),
            Ground::Grid(_) => Vector::ZERO,
        }
    }

    /// The water is nowhere deeper than this, m: it is as deep where all pits lie at the deepest place.
    pub fn deepest_possible(&self) -> f64 {
        let ground = match &self.ground {
            Ground::Plane(plane) => plane.from.max(plane.to),
            Ground::Grid(grid) => grid.depths.iter().copied().fold(0.0, f64::max),
        };
        self.pits.iter().fold(ground, |depth, pit| depth + pit.depth)
    }

    /// The water within a distance of a point, m, is nowhere shallower than this.
    pub fn shallowest_within(&self, distance: f64, of: Point) -> f64 {
        // A pit only deepens.
        match &self.ground {
            Ground::Plane(plane) => plane.from.min(plane.to),
            Ground::Grid(grid) => grid.shallowest_within(distance, of),
        }
    }
}

/// A bottom that is asked again and again how deep the water is: the direction of its slope is found once.
#[derive(Clone, Debug)]
pub struct Seabed {
    bottom: Bottom,
    downhill: Vector,
}

impl Seabed {
    /// That of a bottom.
    pub fn new(bottom: Bottom) -> Self {
        Seabed { downhill: bottom.downhill(), bottom }
    }

    /// Metres of water at a point.
    pub fn depth_at(&self, p: Point) -> f64 {
        self.bottom.depth(p, self.downhill)
    }
}

impl Plane {
    /// Linear from `from` to `to` over the slope, level beyond either end of it; so far along it from the frame's origin, m.
    fn depth(&self, along: f64) -> f64 {
        let share = (along / self.across + 0.5).clamp(0.0, 1.0);
        self.from + (self.to - self.from) * share
    }
}

impl Pit {
    /// How much deeper than the ground it makes the water at a point, m.
    fn depth_at(&self, p: Point) -> f64 {
        let out = p.distance(self.at) / self.radius;
        self.depth * exp(-0.5 * out * out)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use albacore_geometry::Heading;

    fn slope() -> Plane {
        Plane { from: 4.0, to: 8.0, toward: Heading::from_degrees(90.0), across: 400.0 }
    }

    #[test]
    fn a_slope_falls_toward_its_heading_and_ends() {
        for (east, depth) in [(-500.0, 4.0), (-200.0, 4.0), (0.0, 6.0), (100.0, 7.0), (900.0, 8.0)] {
            assert!((Bottom::plane(slope()).depth_at(Point::new(77.0, east)) - depth).abs() < 1e-12);
        }
    }

    #[test]
    fn a_pit_adds_its_depth_and_is_gone_some_radii_away() {
        let at = Point::new(30.0, 100.0);
        let pit = Pit { at, depth: 2.0, radius: 25.0, ..Pit::default() };
        let bottom = Bottom { pits: vec![pit.clone(), pit], ..Bottom::plane(slope()) };
        assert!((bottom.depth_at(at) - 11.0).abs() < 1e-12, "two pits add up");
        assert!((bottom.depth_at(Point::new(55.0, 100.0)) - (7.0 + 4.0 * 0.60653)).abs() < 1e-4);
        assert!((bottom.depth_at(Point::new(180.0, 100.0)) - 7.0).abs() < 1e-6);
        assert!(!bottom.is_level() && Bottom::flat(4.0).is_level() && !Bottom::plane(slope()).is_level());
    }

    #[test]
    fn land_has_no_pits() {
        let (south_west, north_east) = (Point::new(0.0, 0.0), Point::new(100.0, 100.0));
        let grid = Grid { south_west, north_east, rows: 2, columns: 2, depths: vec![-2.0, 8.0, -2.0, 8.0] };
        let pit = Pit { at: Point::new(50.0, 60.0), depth: 5.0, radius: 50.0, ..Pit::default() };
        let bottom = Bottom { ground: Ground::Grid(grid.into()), pits: vec![pit] };
        assert!(bottom.depth_at(Point::new(50.0, 5.0)) <= 0.0);
        assert!(bottom.depth_at(Point::new(50.0, 60.0)) > 8.0);
    }
}
