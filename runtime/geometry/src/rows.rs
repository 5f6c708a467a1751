//! The lines of a lawn-mower across an area.

use crate::area::Edge;
use crate::heading::Heading;
use crate::outline::chords;
use crate::plane::{Line, Point, Vector};

/// An area is mown in at most this many rows. Where `step` asks for more they lie farther apart.
pub const ROWS_MAX: u32 = 1000;

/// An edge is longer than another by more than this, in metres: of a square's four the first is the longest.
pub(crate) const LONGER_M: f64 = 1e-3;

/// An end of a row is nearer than another by more than this, in metres: from an area's middle all four are equally far.
const NEARER_M: f64 = 1e-3;

/// A width that is a hair more than a whole number of steps is rounding, and no reason for one more row.
const ROUNDING: f64 = 1e-9;

/// The rows across an area that is given by its edges, clockwise: what of them does not change from one to the next.
///
/// Rows lie on lines along a heading, at most `step` metres apart and the outermost half as far from the area's sides. Where no
/// heading is given it is that of the longest edge, of several the first, clockwise round the area. A line that leaves the area and
/// comes back has a row for each piece that lies inside, driven one after the other. Rows begin at the end of an outermost row that
/// is nearest to `near`, of several the first of these: start and end of the row farthest to the left of the heading, driven along
/// it; start and end of the row opposite, driven the same way. Each next one is driven the other way. So the rows are a function of
/// area, step, heading and `near`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rows {
    /// A point on the line along the rows to the left of which nothing of the area lies.
    pub start: Point,
    /// To the left of the rows' heading, of length 1: outward over the longest edge.
    pub outward: Vector,
    /// The rows' heading, of length 1.
    pub ray: Vector,
    /// Metres from one line to the next.
    pub apart: f64,
    /// How many rows there are.
    pub count: u32,
    /// And on how many lines.
    pub lines: u32,
    /// Whether the first line is the one farthest to the right.
    pub is_opposite: bool,
    /// Whether the first is driven against the heading.
    pub is_backward: bool,
}

/// Where a row is: on which line from the first on, and as which of that line's pieces, in the order in which they are driven.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// The line.
    pub line: u32,
    /// The piece.
    pub piece: u32,
}

impl Rows {
    /// None across an area without edges.
    pub fn across(
        edges: impl Iterator<Item = Edge> + Clone,
        step: f64,
        along: Option<Heading>,
        near: Point,
    ) -> Option<Self> {
        let longest = longest(edges.clone())?;
        let (outward, ray) = match along.map(Heading::unit) {
            Some(ray) => (Vector::new(ray.east, -ray.north), ray),
            None => (longest.normal, longest.line.heading().unit()),
        };
        let inward = edges.clone().map(|edge| (longest.line.start - edge.line.start).dot(outward));
        let (least, most) = inward.fold((0.0, 0.0), |(least, most): (f64, f64), off| (least.min(off), most.max(off)));
        let (start, width) = (longest.line.start - least * outward, most - least);
        let mut rows = Rows {
            start,
            outward,
            ray,
            apart: width,
            count: 1,
            lines: lines_of(width, step),
            is_opposite: false,
            is_backward: false,
        };
        // With half the lines an area has fewer rows, and on a single line fewer than it has edges.
        loop {
            rows.apart = width / f64::from(rows.lines);
            rows.count = rows.pieces(edges.clone()).iter().sum();
            if rows.count <= ROWS_MAX || rows.lines == 1 {
                return Some(rows.beginning_nearest(edges, near));
            }
            rows.lines = rows.lines.div_ceil(2);
        }
    }

    /// The row at a place, across the same edges, and the place of the next; none beyond the last.
    pub fn row_at(&self, edges: impl Iterator<Item = Edge>, place: Place) -> Option<(Line, Place)> {
        if place.line >= self.lines {
            return None;
        }
        let line = if self.is_opposite { self.lines - 1 - place.line } else { place.line };
        let mut pieces = self.along(edges, line);
        if self.is_backward == place.line.is_multiple_of(2) {
            pieces.reverse();
            pieces.iter_mut().for_each(|piece| *piece = Line { start: piece.end, end: piece.start });
        }
        let next = if (place.piece as usize) + 1 < pieces.len() {
            Place { piece: place.piece + 1, ..place }
        } else {
            Place { line: place.line + 1, piece: 0 }
        };
        pieces.get(place.piece as usize).map(|row| (*row, next))
    }

    /// All rows across the same edges, from the first on.
    pub fn rows(self, edges: impl Iterator<Item = Edge> + Clone) -> impl Iterator<Item = Line> {
        let mut place = Place::default();
        std::iter::from_fn(move || {
            let (row, next) = self.row_at(edges.clone(), place)?;
            place = next;
            Some(row)
        })
    }

    /// Metres from the line at the start to the line of an index.
    fn inward(&self, line: u32) -> f64 {
        (f64::from(line) + 0.5) * self.apart
    }

    fn is_beyond(&self, p: Point, inward: f64) -> bool {
        (self.start - p).dot(self.outward) > inward
    }

    /// How many pieces of each line lie inside, counted from the left: half as often as it is crossed.
    fn pieces(&self, edges: impl Iterator<Item = Edge>) -> Vec<u32> {
        let inward: Vec<f64> = (0..self.lines).map(|line| self.inward(line)).collect();
        // At each line: how many more edges cross it than the one before.
        let mut more = vec![0i32; inward.len() + 1];
        for Edge { line, .. } in edges {
            let before = |p: Point| inward.partition_point(|inward| self.is_beyond(p, *inward));
            let (a, b) = (before(line.start), before(line.end));
            more[a.min(b)] += 1;
            more[a.max(b)] -= 1;
        }
        let mut crossed = 0;
        let pieces = more.iter().take(inward.len()).map(|more| {
            crossed += more;
            crossed.unsigned_abs() / 2
        });
        pieces.collect()
    }

    /// The pieces of the line of an index counted from the left, driven along the heading.
    fn along(&self, edges: impl Iterator<Item = Edge>, line: u32) -> Vec<Line> {
        let inward = self.inward(line);
        chords(edges, self.ray, self.start - inward * self.outward, |p| self.is_beyond(p, inward))
    }

    fn beginning_nearest(self, edges: impl Iterator<Item = Edge> + Clone, near: Point) -> Self {
        let mut first = self;
        let mut nearest = f64::INFINITY;
        for is_opposite in [false, true] {
            let pieces = self.along(edges.clone(), if is_opposite { self.lines - 1 } else { 0 });
            let (Some(front), Some(back)) = (pieces.first(), pieces.last()) else { continue };
            for (is_backward, end) in [(false, front.start), (true, back.end)] {
                let away = near.distance(end);
                if away < nearest - NEARER_M {
                    (nearest, first) = (away, Rows { is_opposite, is_backward, ..self });
                }
            }
        }
        first
    }
}

/// Of an area's edges the longest, of several the first.
fn longest(mut edges: impl Iterator<Item = Edge>) -> Option<Edge> {
    let first = edges.next()?;
    Some(edges.fold(
        first,
        |longest, edge| {
            if edge.line.length() > longest.line.length() + LONGER_M { edge } else { longest }
        },
    ))
}

/// On how many lines rows lie that are at most so far apart.
fn lines_of(width: f64, step: f64) -> u32 {
    // Written so that a step that is no number, or not above 0, gives as many as may be.
    let wanted = (width / step - ROUNDING).ceil();
    let most = f64::from(ROWS_MAX);
    let lines = if step > 0.0 && wanted <= most { wanted.max(1.0) } else { most };
    lines as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Area, Heading};

    fn rows_near(area: &Area, step: f64, near: Point) -> Vec<Line> {
        Rows::across(area.edges(), step, None, near).unwrap().rows(area.edges()).collect()
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
    fn a_line_that_leaves_the_area_has_a_row_for_each_piece() {
        let p = Point::new;
        // A U, open to the north, 100 m deep: its longest edge is the southern one.
        let corners = [
            (0.0, 0.0),
            (120.0, 0.0),
            (120.0, 40.0),
            (40.0, 40.0),
            (40.0, 100.0),
            (120.0, 100.0),
            (120.0, 140.0),
            (0.0, 140.0),
        ];
        let area = Area::polygon(&corners.map(|(north, east)| p(north, east))).unwrap();
        let rows = rows_near(&area, 40.0, p(0.0, 0.0));
        let places = [(20.0, 0.0), (20.0, 140.0), (60.0, 140.0), (60.0, 100.0), (60.0, 40.0), (60.0, 0.0)];
        let last = [(100.0, 0.0), (100.0, 40.0), (100.0, 100.0), (100.0, 140.0)];
        assert!(lead(&rows, &[&places[..], &last[..]].concat()), "{rows:?}");
    }

    #[test]
    fn rows_along_a_heading_cover_the_area_from_inside() {
        let p = Point::new;
        // An L that is turned: an inner edge lies on a line of the rows along its sides.
        let l = [(0.0, 0.0), (100.0, 0.0), (100.0, 50.0), (50.0, 50.0), (50.0, 100.0), (0.0, 100.0)];
        for turn in (0..360).step_by(7).map(f64::from) {
            let ahead = Heading::from_degrees(turn).unit();
            let turned = l.map(|(n, e)| p(3.0, -8.0) + n * ahead + e * Vector::new(-ahead.east, ahead.north));
            let area = Area::polygon(&turned).unwrap();
            for along in (0..360).step_by(15).map(|off| Heading::from_degrees(turn + f64::from(off))) {
                for step in [12.5, 40.0, 100.0] {
                    let rows: Vec<Line> =
                        Rows::across(area.edges(), step, Some(along), turned[0]).unwrap().rows(area.edges()).collect();
                    for row in &rows {
                        let ends = [row.start, row.end].map(|end| area.gap(end).abs());
                        assert!(ends[0] < 1e-6 && ends[1] < 1e-6, "{turn:?} {along:?} {step}: {row:?} {ends:?}");
                        assert!((row.end - row.start).right_of(along).abs() < 1e-6);
                    }
                    for place in area
                        .edges()
                        .flat_map(|edge| [edge.line.start, edge.line.start + 0.5 * (edge.line.end - edge.line.start)])
                    {
                        let off = |row: &Line| (place - row.start).right_of(along).abs();
                        let nearest = rows.iter().map(off).fold(f64::INFINITY, f64::min);
                        assert!(
                            nearest <= step / 2.0 + 1e-6,
                            "{turn:?} {along:?} {step}: {place:?} is {nearest} m off"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn rows_along_a_heading_begin_nearest_and_take_turns() {
        let area = Area::rectangle(Point::ORIGIN, Heading::NORTH, 200.0, 100.0);
        let across = |near| {
            let rows = Rows::across(area.edges(), 100.0, Some(Heading::from_degrees(90.0)), near).unwrap();
            rows.rows(area.edges()).collect::<Vec<_>>()
        };
        let p = Point::new;
        assert!(lead(&across(Point::ORIGIN), &[(50.0, -50.0), (50.0, 50.0), (-50.0, 50.0), (-50.0, -50.0)]));
        assert!(lead(&across(p(-90.0, 40.0)), &[(-50.0, 50.0), (-50.0, -50.0), (50.0, -50.0), (50.0, 50.0)]));
    }

    #[test]
    fn a_comb_has_no_more_rows_than_any_area() {
        let tooth =
            |i: u32| [(0.0, 0.0), (900.0, 0.5), (900.0, 1.5), (0.0, 2.0)].map(|(n, e)| (n, e + 4.0 * f64::from(i)));
        let mut corners: Vec<Point> = (0..200).flat_map(tooth).map(|(n, e)| Point::new(n, e)).collect();
        corners.extend([Point::new(-1.0, 800.0), Point::new(-1.0, -1000.0)]);
        let area = Area::polygon(&corners).unwrap();
        let rows = rows(&area, 1.0);
        assert!(rows.len() > ROWS_MAX as usize / 4 && rows.len() <= ROWS_MAX as usize, "{}", rows.len());
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
        assert_eq!(Rows::across(std::iter::empty(), 10.0, None, Point::ORIGIN), None);
    }
}
