//! The lines of a lawn-mower across an area.

use crate::area::Edge;
use crate::plane::{Line, Point, Vector};

/// An area is mown in at most this many rows. Where `step` asks for more they lie farther apart.
pub const ROWS_MAX: u32 = 1000;

/// An edge is longer than another by more than this, in metres: of a square's four the first is the longest.
pub(crate) const LONGER_M: f64 = 1e-3;

/// An end of a row is nearer than another by more than this, in metres: from an area's middle all four are equally far.
const NEARER_M: f64 = 1e-3;

/// A width that is a hair more than a whole number of steps is rounding, and no reason for one more row.
const ROUNDING: f64 = 1e-9;

/// The rows across a convex area that is given by its edges, clockwise: what of them does not change from one to the next.
///
/// Rows lie along the area's longest edge, of several the first, at most `step` metres apart and the outermost half as far
/// from the area's sides. They begin at the end of an outermost row that is nearest to `near`, of several the first of these:
/// start and end of the row beside that edge, driven as the edge goes, clockwise round the area; start and end of the row
/// opposite, driven the same way. Each next one is driven the other way. So the rows are a function of area, step and `near`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rows {
    /// The start of the longest edge.
    pub start: Point,
    /// Outward over that edge, of length 1.
    pub outward: Vector,
    /// Along that edge, of length 1.
    pub ray: Vector,
    /// Metres from one row to the next.
    pub apart: f64,
    /// How many there are.
    pub count: u32,
    /// Whether the first is the one opposite the longest edge.
    pub is_opposite: bool,
    /// Whether the first is driven against the longest edge.
    pub is_backward: bool,
}

impl Rows {
    /// None across an area without edges.
    pub fn across(edges: impl Iterator<Item = Edge> + Clone, step: f64, near: Point) -> Option<Self> {
        let mut edges_left = edges.clone();
        let mut longest = edges_left.next()?;
        for edge in edges_left {
            if edge.line.length() > longest.line.length() + LONGER_M {
                longest = edge;
            }
        }
        let width = edges.clone().map(|edge| longest.gap(edge.line.start)).fold(0.0, f64::max);
        // Written so that a step that is no number, or not above 0, gives as many as may be.
        let wanted = (width / step - ROUNDING).ceil();
        let most = f64::from(ROWS_MAX);
        let count = if step > 0.0 && wanted <= most { wanted.max(1.0) } else { most };
        let (start, outward, ray) = (longest.line.start, longest.normal, longest.line.heading().unit());
        let (apart, count) = (width / count, count as u32);
        let rows = Rows { start, outward, ray, apart, count, is_opposite: false, is_backward: false };
        Some(rows.beginning_nearest(edges, near))
    }

    /// The row of an index, across the same edges; none beyond the last.
    pub fn nth(&self, edges: impl Iterator<Item = Edge>, index: u32) -> Option<Line> {
        let beside = if self.is_opposite { self.count.checked_sub(index.checked_add(1)?)? } else { index };
        let line = self.along(edges, beside)?;
        let turns = self.is_backward == index.is_multiple_of(2);
        Some(if turns { Line { start: line.end, end: line.start } } else { line })
    }

    /// The row of an index counted from the longest edge, driven as that goes.
    fn along(&self, edges: impl Iterator<Item = Edge>, index: u32) -> Option<Line> {
        if index >= self.count {
            return None;
        }
        let inward = (f64::from(index) + 0.5) * self.apart;
        chord(edges, self.ray, self.start - inward * self.outward)
    }

    fn beginning_nearest(self, edges: impl Iterator<Item = Edge> + Clone, near: Point) -> Self {
        let mut first = self;
        let mut nearest = f64::INFINITY;
        for is_opposite in [false, true] {
            let Some(line) = self.along(edges.clone(), if is_opposite { self.count - 1 } else { 0 }) else { continue };
            for (is_backward, end) in [(false, line.start), (true, line.end)] {
                let away = near.distance(end);
                if away < nearest - NEARER_M {
                    (nearest, first) = (away, Rows { is_opposite, is_backward, ..self });
                }
            }
        }
        first
    }
}

/// What of the line through a point, along a ray, lies inside.
fn chord(edges: impl Iterator<Item = Edge>, ray: Vector, through: Point) -> Option<Line> {
    let (mut back, mut ahead) = (f64::NEG_INFINITY, f64::INFINITY);
    for edge in edges {
        let (gap, outward) = (edge.gap(through), ray.dot(edge.normal));
        if outward > 0.0 {
            ahead = ahead.min(gap / outward);
        } else if outward < 0.0 {
            back = back.max(gap / outward);
        }
    }
    (back.is_finite() && back < ahead).then(|| Line { start: through + back * ray, end: through + ahead * ray })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Area, Heading};

    fn rows_near(area: &Area, step: f64, near: Point) -> Vec<Line> {
        let rows = Rows::across(area.edges(), step, near).unwrap();
        (0..).map_while(|i| rows.nth(area.edges(), i)).collect()
    }

    fn rows(area: &Area, step: f64) -> Vec<Line> {
        rows_near(area, step, area.center())
    }

    /// Whether they lead over these places north and east, one after the other.
    fn lead(rows: &[Line], places: &[(f64, f64)]) -> bool {
        let ends: Vec<Point> = rows.iter().flat_map(|row| [row.start, row.end]).collect();
        let is_at = |(end, place): (&Point, &(f64, f64))| end.distance(Point::new(place.0, place.1)) < 1e-3;
        ends.len() == places.len() && ends.iter().zip(places).all(is_at)
    }

    #[test]
    fn rows_lie_along_the_long_side_and_alternate() {
        let area = Area::rectangle(Point::ORIGIN, Heading::NORTH, 200.0, 100.0);
        // Three rows 33.3 m apart. The first long edge, clockwise from the north-west corner, is the eastern one.
        let (n, e) = (100.0, 33.333);
        assert!(lead(&rows(&area, 40.0), &[(n, e), (-n, e), (-n, 0.0), (n, 0.0), (n, -e), (-n, -e)]));
    }

    #[test]
    fn rows_begin_at_the_nearest_of_four_ends() {
        let area = Area::rectangle(Point::ORIGIN, Heading::NORTH, 200.0, 100.0);
        // Of an odd number the last ends across the area from where the first begins, of an even number beside it.
        for (north, east) in [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)] {
            for (far_north, far_east) in [(300.0, 200.0), (100.0, 33.0), (5.0, 2.0)] {
                let near = Point::new(north * far_north, east * far_east);
                let (n, e) = (north * 100.0, east * 33.333);
                let three = [(n, e), (-n, e), (-n, 0.0), (n, 0.0), (n, -e), (-n, -e)];
                assert!(lead(&rows_near(&area, 40.0, near), &three), "{near:?}");
                let two = [(n, east * 25.0), (-n, east * 25.0), (-n, east * -25.0), (n, east * -25.0)];
                assert!(lead(&rows_near(&area, 50.0, near), &two), "{near:?}");
                let one = [(n, 0.0), (-n, 0.0)];
                assert!(lead(&rows_near(&area, 100.0, near), &one), "{near:?}");
            }
        }
    }

    #[test]
    fn of_ends_equally_near_the_first_is_taken() {
        let area = Area::rectangle(Point::ORIGIN, Heading::NORTH, 200.0, 100.0);
        let first = |north: f64, east: f64| rows_near(&area, 50.0, Point::new(north, east))[0].start;
        // Clockwise along the eastern edge: its row's start is in the north.
        for (near, expected) in [
            ((0.0, 0.0), (100.0, 25.0)),
            ((0.0, 40.0), (100.0, 25.0)),
            ((50.0, 0.0), (100.0, 25.0)),
            ((-50.0, 0.0), (-100.0, 25.0)),
            ((0.0, -40.0), (100.0, -25.0)),
            ((0.0004, -0.0004), (100.0, 25.0)),
            ((f64::NAN, 0.0), (100.0, 25.0)),
        ] {
            let start = first(near.0, near.1);
            assert!(start.distance(Point::new(expected.0, expected.1)) < 1e-3, "{near:?}: {start:?}");
        }
    }

    #[test]
    fn no_place_is_farther_than_half_a_step_from_a_row_of_any_convex_area() {
        let p = Point::new;
        let corners = [p(0.0, 0.0), p(90.0, -30.0), p(150.0, 60.0), p(80.0, 130.0), p(-20.0, 70.0)];
        let area = Area::polygon(&corners).unwrap();
        let rows = rows(&area, 25.0);
        let grid = (-40..160).flat_map(|n| (-40..140).map(move |e| p(f64::from(n), f64::from(e))));
        for place in grid.filter(|place| area.gap(*place) >= 0.0) {
            let off = |row: &Line| (place - row.start).right_of(row.heading()).abs();
            let nearest = rows.iter().map(off).fold(f64::INFINITY, f64::min);
            assert!(nearest <= 12.5 + 1e-6, "{place:?} is {nearest} m from the nearest row");
        }
        for row in &rows {
            assert!(area.gap(row.start).abs() < 1e-9 && area.gap(row.end).abs() < 1e-9);
        }
    }

    #[test]
    fn too_many_rows_lie_farther_apart_and_nonsense_is_bounded() {
        let area = Area::rectangle(Point::ORIGIN, Heading::NORTH, 2000.0, 1500.0);
        for step in [1.0, 0.0, -3.0, f64::NAN] {
            assert_eq!(rows(&area, step).len(), ROWS_MAX as usize, "step {step}");
        }
        let rounded = Area::rectangle(Point::ORIGIN, Heading::from_degrees(17.0), 300.0, 200.0);
        assert_eq!(rows(&rounded, 40.0).len(), 5);
        assert_eq!(rows(&area, f64::INFINITY).len(), 1);
        assert_eq!(Rows::across(std::iter::empty(), 10.0, Point::ORIGIN), None);
    }
}
