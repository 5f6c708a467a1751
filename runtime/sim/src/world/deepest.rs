//! The deepest point of an area: what a search for it is measured against.

use crate::world::bottom::{Bottom, Ground};
use albacore_geometry::{Area, Edge, Point, Vector, gap, nearest_edge};

/// The first look is at so many points a side of the area's bounding box: of a pit a hundredth as wide some are seen.
const GRID: i32 = 100;
/// Each later look is at so many points a side of a box half as wide, about the deepest yet.
const CLOSER: i32 = 8;
/// Until the box is narrower than this, m.
const FINE_M: f64 = 1e-3;

impl Bottom {
    /// The deepest point of an area, to a millimetre where the bottom is curved; of several equally deep the first found.
    pub fn deepest(&self, area: &Area) -> Point {
        let edges: Vec<Edge> = area.edges().collect();
        let (mut low, mut high) = (area.center(), area.center());
        for corner in area.corners() {
            low = Point::new(low.north.min(corner.north), low.east.min(corner.east));
            high = Point::new(high.north.max(corner.north), high.east.max(corner.east));
        }
        let mut half = 0.5 * (high - low);
        let mut deepest = self.deepest_of_grid(&edges, inside(&edges, low + half), half, GRID);
        if let Ground::Grid(grid) = &self.ground {
            // Between its cells a survey is nowhere deeper than at one of them.
            for (cell, _) in grid.cells_between(low, high) {
                if self.depth_at(cell) > self.depth_at(deepest) && gap(edges.iter().copied(), cell) >= 0.0 {
                    deepest = cell;
                }
            }
        }
        while half.length() > FINE_M {
            half = 0.5 * half;
            deepest = self.deepest_of_grid(&edges, deepest, half, CLOSER);
        }
        deepest
    }

    /// The deepest of a point and of a grid about it. What lies outside the area is moved to its edge, which is so searched too.
    fn deepest_of_grid(&self, area: &[Edge], middle: Point, half: Vector, points: i32) -> Point {
        let part = |i: i32| 2.0 * f64::from(i) / f64::from(points) - 1.0;
        let (mut deepest, mut depth) = (middle, self.depth_at(middle));
        for i in 0..=points {
            for j in 0..=points {
                let place = inside(area, middle + Vector::new(part(i) * half.north, part(j) * half.east));
                if self.depth_at(place) > depth {
                    (deepest, depth) = (place, self.depth_at(place));
                }
            }
        }
        deepest
    }
}

/// A point moved into an area, given by its edges: from outside to the nearest place of its outline.
fn inside(area: &[Edge], p: Point) -> Point {
    let edges = || area.iter().copied();
    let outside = gap(edges(), p) < 0.0;
    nearest_edge(edges(), p).filter(|_| outside).map_or(p, |edge| edge.nearest(p))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::bottom::{Grid, Pit, Plane};
    use albacore_geometry::Heading;
    use std::sync::Arc;

    fn pit(north: f64, east: f64, depth: f64, radius: f64) -> Pit {
        Pit { at: Point::new(north, east), depth, radius, ..Pit::default() }
    }

    #[test]
    fn the_deepest_of_several_pits_is_found_to_the_millimetre() {
        let area = Area::rectangle(Point::new(20.0, -10.0), Heading::from_degrees(30.0), 400.0, 240.0);
        let pits = vec![pit(80.0, 20.0, 1.4, 45.0), pit(-60.0, -31.7, 2.0, 12.0), pit(-500.0, 0.0, 9.0, 20.0)];
        let bottom = Bottom { pits, ..Bottom::flat(3.0) };
        let deepest = bottom.deepest(&area);
        // The broad pit's flank pulls it aside by less than a metre; beyond the area a deeper one does not count.
        assert!(deepest.distance(Point::new(-60.0, -31.7)) < 1.0, "{deepest:?}");
        let deeper = |angle: f64| bottom.depth_at(deepest + 0.01 * Heading::from_degrees(angle).unit());
        assert!((0..36).all(|i| deeper(f64::from(10 * i)) < bottom.depth_at(deepest)));
    }

    #[test]
    fn of_a_slope_it_is_the_corner_and_of_a_pit_outside_the_edge() {
        let area = Area::rectangle(Point::ORIGIN, Heading::from_degrees(30.0), 200.0, 100.0);
        let slope = Bottom::plane(Plane { from: 4.0, to: 8.0, toward: Heading::from_degrees(50.0), across: 1000.0 });
        let corner = *area.corners().iter().max_by(|a, b| slope.depth_at(**a).total_cmp(&slope.depth_at(**b))).unwrap();
        assert!(slope.deepest(&area).distance(corner) < 0.01, "{:?}", slope.deepest(&area));

        let outside = Point::ORIGIN + 130.0 * Heading::from_degrees(30.0).unit();
        let bottom = Bottom { pits: vec![pit(outside.north, outside.east, 2.0, 30.0)], ..Bottom::flat(4.0) };
        let middle_of_edge = Point::ORIGIN + 100.0 * Heading::from_degrees(30.0).unit();
        assert!(bottom.deepest(&area).distance(middle_of_edge) < 0.1, "{:?}", bottom.deepest(&area));
    }

    /// Single cells of two equally deep but for a millimetre, among 500 by 500: no look at 100 a side meets either.
    #[test]
    fn of_a_survey_the_deepest_cell_within_the_area_is_found() {
        let mut depths = vec![5.0; 500 * 500];
        let mut deepen = |row: usize, column: usize, depth: f64| depths[row * 500 + column] = depth;
        deepen(123, 77, 9.0);
        deepen(311, 402, 9.001);
        deepen(498, 2, 11.0);
        let corner = Point::new(499.0, 499.0);
        let grid = Grid { south_west: Point::ORIGIN, north_east: corner, rows: 500, columns: 500, depths };
        let bottom = Bottom { ground: Ground::Grid(Arc::new(grid)), pits: Vec::new() };
        let area = Area::rectangle(Point::new(250.0, 250.0), Heading::NORTH, 480.0, 480.0);
        assert!(bottom.deepest(&area).distance(Point::new(311.0, 402.0)) < 1e-3, "{:?}", bottom.deepest(&area));
        assert!(bottom.depth_at(Point::new(498.0, 2.0)) > 10.99, "and a deeper one lies outside");
    }
}
