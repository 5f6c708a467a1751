//! The lines of a lawn-mower across an area.

use crate::area::Edge;
use crate::plane::{Line, Point};

/// An area is mown in at most this many rows. Where `step` asks for more they lie farther apart.
pub const ROWS_MAX: u32 = 1000;

/// An edge is longer than another by more than this, in metres: of a square's four the first is the longest.
const LONGER_M: f64 = 1e-3;

/// A width that is a hair more than a whole number of steps is rounding, and no reason for one more row.
const ROUNDING: f64 = 1e-9;

/// The row of an index across a convex area that is given by its edges, clockwise; none beyond the last.
///
/// Rows lie along the area's longest edge, of several the first, at most `step` metres apart and the outermost half as far
/// from the area's sides. The first is beside that edge and driven as it goes, clockwise round the area; each next one the
/// other way. So the rows are a function of the area alone.
pub fn row(edges: impl Iterator<Item = Edge> + Clone, step: f64, index: u32) -> Option<Line> {
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
    let count = if step > 0.0 && wanted <= f64::from(ROWS_MAX) { wanted.max(1.0) } else { f64::from(ROWS_MAX) };
    if f64::from(index) >= count {
        return None;
    }
    let inward = (f64::from(index) + 0.5) * (width / count);
    let through = longest.line.start - inward * longest.normal;
    let row = chord(edges, longest, through)?;
    Some(if index.is_multiple_of(2) { row } else { Line { start: row.end, end: row.start } })
}

/// What of the line through a point, along an edge, lies inside.
fn chord(edges: impl Iterator<Item = Edge>, along: Edge, through: Point) -> Option<Line> {
    let ray = along.line.heading().unit();
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

    fn rows(area: &Area, step: f64) -> Vec<Line> {
        let edges: Vec<Edge> = area.edges().collect();
        (0..).map_while(|i| row(edges.iter().copied(), step, i)).collect()
    }

    #[test]
    fn rows_lie_along_the_long_side_and_alternate() {
        let area = Area::rectangle(Point::ORIGIN, Heading::NORTH, 200.0, 100.0).unwrap();
        let rows = rows(&area, 40.0);
        // Three rows 33.3 m apart. The first long edge, clockwise from the north-west corner, is the eastern one.
        assert_eq!(rows.len(), 3);
        for (row, (from, to, east)) in
            rows.iter().zip([(100.0, -100.0, 33.333), (-100.0, 100.0, 0.0), (100.0, -100.0, -33.333)])
        {
            assert!(row.start.distance(Point::new(from, east)) < 1e-3, "{row:?}");
            assert!(row.end.distance(Point::new(to, east)) < 1e-3, "{row:?}");
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
        let area = Area::rectangle(Point::ORIGIN, Heading::NORTH, 2000.0, 1500.0).unwrap();
        for step in [1.0, 0.0, -3.0, f64::NAN] {
            assert_eq!(rows(&area, step).len(), ROWS_MAX as usize, "step {step}");
        }
        let rounded = Area::rectangle(Point::ORIGIN, Heading::from_degrees(17.0), 300.0, 200.0).unwrap();
        assert_eq!(rows(&rounded, 40.0).len(), 5);
        assert_eq!(rows(&area, f64::INFINITY).len(), 1);
        assert_eq!(row(std::iter::empty(), 10.0, 0), None);
    }
}
