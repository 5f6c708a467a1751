//! An operating area: a polygon whose outline does not meet itself, its edges, and how far a point is from leaving it.

use crate::heading::Heading;
use crate::math::PI;
use crate::outline;
use crate::plane::{Line, Point, Vector};
use serde::{Deserialize, Serialize};

/// Corners of an outline that is known in every direction from its centre: one a degree.
pub const OUTLINE_CORNERS: u32 = 360;
/// An area has at most this many corners.
pub const AREA_CORNERS_MAX: usize = 1024;

/// No corner of an operating area is farther from its middle than this, m. A flat plane cannot do better: at this distance the scale
/// of the local frame is wrong by 123 mm in a kilometre.
pub const AREA_REACH_MAX_M: f64 = 100_000.0;

/// What is thinner than this, m, is no area to work in, but a point or a line: positions are known no better.
pub const AREA_WIDTH_MIN_M: f64 = 1.0;

/// No place lies farther from the origin of its frame, north or east, than this, m: more than twice round the Earth.
pub const PLACE_MAX_M: f64 = 1e8;

/// What is no farther from an edge than this, m, lies on it. It is more than rounding moves a computed point, even [`PLACE_MAX_M`] out,
/// and less than anyone knows a place to.
pub(crate) const ON_EDGE_M: f64 = 1e-6;

/// A ray that goes out by no more than this, m, on the length of an edge goes along it.
const ALONG_EDGE_M: f64 = 1e-7;

/// Corners closer together than this, in metres, are one corner, and edges that come so near to one another meet.
pub(crate) const SEPARATION_M: f64 = 1e-3;

/// Corners whose coordinates along a direction differ by less than this, in metres, are equally far.
const EQUALLY_FAR_M: f64 = 1.0;

/// A polygon in the tangent plane, its corners clockwise seen from above. It may have dents, and its outline does not meet itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Corners")]
pub struct Area {
    corners: Vec<Point>,
}

/// An area as it is read.
#[derive(Deserialize)]
struct Corners {
    corners: Vec<Point>,
}

impl TryFrom<Corners> for Area {
    type Error = AreaError;

    fn try_from(read: Corners) -> Result<Self, Self::Error> {
        Area::polygon(&read.corners)
    }
}

/// One side of an area.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Edge {
    /// The side itself, clockwise round the area.
    pub line: Line,
    /// The outward unit normal.
    pub normal: Vector,
}

/// Why a polygon is not an area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AreaError {
    /// Fewer than three distinct corners.
    TooFewCorners,
    /// More than [`AREA_CORNERS_MAX`] corners.
    TooManyCorners,
    /// The edges from these two corners on, counted from 0 as they were given, meet.
    Crossed(usize, usize),
    /// It is so wide where it is thinnest, m: less than [`AREA_WIDTH_MIN_M`].
    TooThin(f64),
    /// A coordinate is not a number, or more than twice [`PLACE_MAX_M`].
    TooFar,
}

impl std::fmt::Display for AreaError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            AreaError::TooFewCorners => write!(f, "an area needs at least three distinct corners"),
            AreaError::TooManyCorners => write!(f, "an area has at most {AREA_CORNERS_MAX} corners"),
            AreaError::Crossed(a, b) => {
                write!(f, "its outline crosses itself, after corners {} and {}", a + 1, b + 1)
            }
            AreaError::TooThin(width) => {
                write!(
                    f,
                    "it is {width:.2} m wide where it is thinnest, and no area is thinner than {AREA_WIDTH_MIN_M} m"
                )
            }
            AreaError::TooFar => write!(f, "a corner lies nowhere on Earth"),
        }
    }
}

impl std::error::Error for AreaError {}

/// Of corners the one that lies farthest along a heading; of those equally far the one nearest to a point.
pub fn farthest_corner(corners: &[Point], heading: Heading, near: Point) -> Point {
    let far = corners.iter().map(|c| c.along(heading)).fold(f64::NEG_INFINITY, f64::max);
    let mut best: Option<Point> = None;
    for &c in corners.iter().filter(|c| c.along(heading) > far - EQUALLY_FAR_M) {
        if best.is_none_or(|b| c.distance(near) < b.distance(near)) {
            best = Some(c);
        }
    }
    best.unwrap_or(near)
}

/// Metres from a point to the nearest edge of an area, positive inside and negative outside.
pub fn gap(edges: impl Iterator<Item = Edge>, p: Point) -> f64 {
    let nothing = (f64::INFINITY, false);
    let (away, is_inside) = edges.fold(nothing, |(away, is_inside), edge| {
        (away.min(edge.distance(p)), is_inside != outline::passes_east_of(edge, p))
    });
    match away {
        _ if away < ON_EDGE_M => 0.0,
        _ if is_inside => away,
        _ => -away,
    }
}

/// The edge of an area that is nearest to a point; beyond a corner, of its two the one whose line is farther off. Of equals the first.
pub fn nearest_edge(edges: impl Iterator<Item = Edge>, p: Point) -> Option<Edge> {
    let away = |edge: &Edge| (edge.distance(p), -edge.gap(p).abs());
    edges
        .map(|edge| (away(&edge), edge))
        .reduce(|best, next| if next.0 < best.0 { next } else { best })
        .map(|(_, edge)| edge)
}

/// How far a ray goes from a point inside an area, m, until it leaves; 0 from outside, and where nothing tells.
pub fn run(edges: impl Iterator<Item = Edge> + Clone, from: Point, ray: Vector) -> f64 {
    if gap(edges.clone(), from) < 0.0 {
        return 0.0;
    }
    let next = edges.clone().skip(1).chain(edges.clone().take(1));
    let runs =
        edges.zip(next).filter_map(|(edge, next)| match (edge.run(from, ray), edge.run_to_corner(next, from, ray)) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        });
    let run = runs.fold(f64::INFINITY, f64::min);
    if run.is_finite() { run } else { 0.0 }
}

/// Whether an area has no dents: no edge leads out over the line of the one before.
pub fn is_convex(edges: impl Iterator<Item = Edge> + Clone) -> bool {
    let next = edges.clone().skip(1).chain(edges.clone().take(1));
    edges.zip(next).all(|(edge, next)| edge.gap(next.line.end) >= 0.0)
}

impl Edge {
    /// Metres from the edge's line, positive inside the area and negative outside; 0 on it, whatever rounding makes of a point there.
    pub fn gap(self, p: Point) -> f64 {
        let gap = self.exact_gap(p);
        if gap.abs() < ON_EDGE_M { 0.0 } else { gap }
    }

    /// Metres to the edge itself: beside it to its line, past an end to that corner.
    pub fn distance(self, p: Point) -> f64 {
        let (side, there) = (self.line.end - self.line.start, p - self.line.start);
        let along = there.dot(side);
        if along < 0.0 {
            there.length()
        } else if along > side.dot(side) {
            p.distance(self.line.end)
        } else {
            self.gap(p).abs()
        }
    }

    /// The place of the edge that is nearest to a point.
    pub fn nearest(self, p: Point) -> Point {
        let (side, there) = (self.line.end - self.line.start, p - self.line.start);
        let along = there.dot(side);
        if along < 0.0 {
            self.line.start
        } else if along > side.dot(side) {
            self.line.end
        } else {
            p + self.gap(p) * self.normal
        }
    }

    /// How far a ray goes from a point inside the area, m, until it leaves over this edge, between its corners.
    fn run(self, from: Point, ray: Vector) -> Option<f64> {
        if !self.is_left_by(ray) || self.gap(from) < 0.0 {
            return None;
        }
        let run = self.exact_gap(from).max(0.0) / ray.dot(self.normal);
        let along = (from + run * ray - self.line.start).dot(self.line.heading().unit());
        (along > ON_EDGE_M && along < self.line.length() - ON_EDGE_M).then_some(run)
    }

    /// How far a ray goes until it leaves at the corner between this edge and the next; past a dent it goes on inside.
    fn run_to_corner(self, next: Edge, from: Point, ray: Vector) -> Option<f64> {
        let there = self.line.end - from;
        let (run, beside) = (there.dot(ray), there.dot(Vector::new(-ray.east, ray.north)));
        if run < -ON_EDGE_M || beside.abs() > ON_EDGE_M {
            return None;
        }
        let (this, next_too) = (self.is_left_by(ray), next.is_left_by(ray));
        let is_dent = self.gap(next.line.end) < 0.0;
        let leaves = if is_dent { this && next_too } else { this || next_too };
        leaves.then_some(run.max(0.0))
    }

    /// Whether a ray goes outward over its line, and not along it.
    fn is_left_by(self, ray: Vector) -> bool {
        ray.dot(self.normal) * self.line.length() > ALONG_EDGE_M
    }

    fn exact_gap(self, p: Point) -> f64 {
        (self.line.start - p).dot(self.normal)
    }

    /// The direction along the edge, either way, that is nearest to a heading; clockwise round the area on a tie.
    pub fn tangent(self, nearest: Heading) -> Heading {
        let forward = self.line.heading();
        if (forward - nearest).abs() <= PI / 2.0 { forward } else { forward.reverse() }
    }
}

impl Area {
    /// The polygon with these corners, given either way round.
    pub fn polygon(corners: &[Point]) -> Result<Self, AreaError> {
        let is_near = |x: f64| x.abs() <= 2.0 * PLACE_MAX_M;
        if !corners.iter().all(|c| is_near(c.north) && is_near(c.east)) {
            return Err(AreaError::TooFar);
        }
        if corners.len() < 3 {
            return Err(AreaError::TooFewCorners);
        }
        if corners.len() > AREA_CORNERS_MAX {
            return Err(AreaError::TooManyCorners);
        }
        let n = corners.len();
        if (0..n).any(|i| corners[i].distance(corners[(i + 1) % n]) < SEPARATION_M) {
            return Err(AreaError::TooFewCorners);
        }
        // A rectangle of that width is none the less an area for being turned.
        let width = outline::width(corners);
        if width < AREA_WIDTH_MIN_M - ON_EDGE_M {
            return Err(AreaError::TooThin(width));
        }
        if let Some((a, b)) = outline::meeting(corners) {
            return Err(AreaError::Crossed(a, b));
        }
        let mut area = Area { corners: corners.to_vec() };
        if outline::surface(corners) < 0.0 {
            area.corners.reverse();
        }
        Ok(area)
    }

    /// The rectangle of a given length along a direction and width across it, in metres. There is always one: a side shorter than
    /// [`AREA_WIDTH_MIN_M`] is as long as that, and a centre farther out than [`PLACE_MAX_M`] lies there, so that no corner falls
    /// on another by rounding.
    pub fn rectangle(center: Point, along: Heading, length: f64, width: f64) -> Self {
        let near = |x: f64| x.clamp(-PLACE_MAX_M, PLACE_MAX_M);
        let center = Point::new(near(center.north), near(center.east));
        let half = |side: f64| 0.5 * side.max(AREA_WIDTH_MIN_M);
        let (u, v) = (half(length) * along.unit(), half(width) * (along + PI / 2.0).unit());
        Area { corners: vec![center + u - v, center + u + v, center - u + v, center - u - v] }
    }

    /// The corners, clockwise seen from above.
    pub fn corners(&self) -> &[Point] {
        &self.corners
    }

    /// The sides, clockwise, beginning at the first corner.
    pub fn edges(&self) -> impl Iterator<Item = Edge> + Clone + '_ {
        let n = self.corners.len();
        (0..n).map(move |i| {
            let line = Line { start: self.corners[i], end: self.corners[(i + 1) % n] };
            // Clockwise round the area, outside is on the left.
            Edge { line, normal: (line.heading() - PI / 2.0).unit() }
        })
    }

    /// The mean of the corners: the middle of a rectangle.
    pub fn center(&self) -> Point {
        let n = self.corners.len() as f64;
        let sum = self.corners.iter().fold(Vector::ZERO, |sum, &c| sum + (c - Point::ORIGIN));
        Point::ORIGIN + (1.0 / n) * sum
    }

    /// Metres to the nearest edge, positive inside and negative outside.
    pub fn gap(&self, p: Point) -> f64 {
        gap(self.edges(), p)
    }

    /// The distance from the middle to the farthest corner, m.
    pub fn reach(&self) -> f64 {
        let center = self.center();
        self.corners.iter().map(|corner| corner.distance(center)).fold(0.0, f64::max)
    }

    /// Whether a point lies inside or on an edge.
    pub fn contains(&self, p: Point) -> bool {
        self.gap(p) >= 0.0
    }

    /// How large it is, m2.
    pub fn surface(&self) -> f64 {
        0.5 * outline::surface(&self.corners).abs()
    }

    /// How thin it is where it is thinnest, m: the least distance of two parallels between which it lies.
    pub fn width(&self) -> f64 {
        outline::width(&self.corners)
    }

    /// The least area without dents that holds it: itself, if it has none.
    pub fn hull(&self) -> Area {
        if is_convex(self.edges()) { self.clone() } else { Area::around(&self.corners) }
    }

    /// The least area without dents that holds the corners of one that has some.
    pub fn around(corners: &[Point]) -> Area {
        Area { corners: outline::hull(corners) }
    }

    /// How far another area is from this one, m; 0 where they meet.
    pub fn distance(&self, other: &Area) -> f64 {
        if self.overlaps(other) {
            return 0.0;
        }
        // Of two polygons that do not overlap the nearest places are a corner of one and a place on the other's edges.
        let from_corners = |of: &Area, to: &Area| of.corners.iter().map(|&c| -to.gap(c)).fold(f64::INFINITY, f64::min);
        from_corners(self, other).min(from_corners(other, self)).max(0.0)
    }

    /// Whether two areas have more than edges in common: then an edge of one passes through the inside of the other, or one holds
    /// a point that lies inside the other.
    pub fn overlaps(&self, other: &Area) -> bool {
        let passes = |of: &Area, area: &Area| {
            of.edges().any(|edge| outline::stretches(edge.line, area.edges()).any(|middle| area.gap(middle) > 0.0))
        };
        let holds = |of: &Area, area: &Area| of.gap(area.inner_point()) > 0.0;
        passes(self, other) || passes(other, self) || holds(self, other) || holds(other, self)
    }

    /// A point inside: the middle of the longest stretch of the line through it that is half way between the two southernmost
    /// corners that are not equally far south.
    fn inner_point(&self) -> Point {
        let south = self.corners.iter().map(|c| c.north).fold(f64::INFINITY, f64::min);
        let others = self.corners.iter().map(|c| c.north).filter(|north| *north > south + ON_EDGE_M);
        let middle = 0.5 * (south + others.fold(f64::INFINITY, f64::min));
        let through = Point::new(middle, self.corners[0].east);
        let chords = outline::chords(self.edges(), Vector::new(0.0, 1.0), through, |p| p.north > middle);
        let longest = chords.into_iter().max_by(|a, b| a.length().total_cmp(&b.length()));
        longest.map_or(self.corners[0], |line| line.start + 0.5 * (line.end - line.start))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_width_is_the_least_there_is() {
        let of = |length, width| Area::rectangle(Point::ORIGIN, Heading::from_degrees(30.0), length, width);
        assert!((of(200.0, 40.0).width() - 40.0).abs() < 1e-9 && (of(3.0, 40.0).width() - 3.0).abs() < 1e-9);
        let corner = |north, east| Point::new(north, east);
        let wedge = Area::polygon(&[corner(0.0, 0.0), corner(0.0, 100.0), corner(1.5, 50.0)]).unwrap();
        assert!((wedge.width() - 1.5).abs() < 1e-4);
    }

    #[test]
    fn a_rectangle_lies_along_its_heading() {
        let area = Area::rectangle(Point::new(10.0, 20.0), Heading::from_degrees(90.0), 200.0, 40.0);
        assert!(area.center().distance(Point::new(10.0, 20.0)) < 1e-9);
        assert!((area.gap(Point::new(10.0, 20.0)) - 20.0).abs() < 1e-9);
        assert!((area.gap(Point::new(10.0, 119.0)) - 1.0).abs() < 1e-9);
        assert!((area.gap(Point::new(10.0, 125.0)) + 5.0).abs() < 1e-9);
    }

    #[test]
    fn there_is_a_rectangle_for_all_numbers() {
        for (far, length, width) in [(0.0, 4e-4, 400.0), (1e150, 100.0, 1000.0), (1e12, 1.0, 1e5), (-1e9, 0.0, -3.0)] {
            let center = Point::new(far, -far);
            let area = Area::rectangle(center, Heading::from_degrees(33.0), length, width);
            assert_eq!(area.edges().count(), 4);
            let middle = area.center();
            assert!(area.gap(middle) > 0.49 && area.gap(middle + Vector::new(0.0, 1e5)) < 0.0, "{area:?}");
        }
    }

    #[test]
    fn either_way_round_gives_the_same_area() {
        let corners = [Point::new(0.0, 0.0), Point::new(10.0, 0.0), Point::new(10.0, 10.0), Point::new(0.0, 10.0)];
        let mut reversed = corners;
        reversed.reverse();
        let gap = |c: &[Point]| Area::polygon(c).unwrap().gap(Point::new(4.0, 5.0));
        assert_eq!(gap(&corners), gap(&reversed));
        assert!(gap(&corners) > 0.0);
    }

    #[test]
    fn stars_and_slivers_are_refused_and_dents_are_not() {
        let p = Point::new;
        let dent = [p(0.0, 0.0), p(10.0, 0.0), p(3.0, 3.0), p(0.0, 10.0)];
        assert!(!is_convex(Area::polygon(&dent).unwrap().edges()));
        let star = [p(10.0, 0.0), p(-8.0, 6.0), p(3.0, -9.5), p(3.0, 9.5), p(-8.0, -6.0)];
        assert_eq!(Area::polygon(&star), Err(AreaError::Crossed(0, 2)));
        assert_eq!(Area::polygon(&[p(0.0, 0.0), p(1.0, 0.0)]), Err(AreaError::TooFewCorners));
        assert_eq!(Area::polygon(&[p(0.0, 0.0), p(0.0, 0.0), p(1.0, 0.0)]), Err(AreaError::TooFewCorners));
        assert_eq!(Area::polygon(&[p(0.0, f64::NAN), p(0.0, 0.0), p(1.0, 0.0)]), Err(AreaError::TooFar));
        assert_eq!(Area::polygon(&[p(0.0, 0.0), p(0.0, 9.0), p(0.0, 18.0)]), Err(AreaError::TooThin(0.0)));
        let bent = Area::polygon(&[p(0.0, 0.0), p(1e-9, 9.0), p(0.0, 18.0)]);
        assert!(matches!(bent, Err(AreaError::TooThin(width)) if width < 1e-8), "{bent:?}");
        let spike = [p(0.0, 0.0), p(0.0, 9.0), p(9.0, 9.0), p(20.0, 9.0), p(9.0, 9.0005), p(9.0, 0.0)];
        assert_eq!(Area::polygon(&spike), Err(AreaError::TooFewCorners).or(Err(AreaError::Crossed(1, 3))));
        let pinched = [p(0.0, 0.0), p(9.0, 9.0), p(9.0, 0.0), p(0.0, 9.0), p(-9.0, 9.0), p(-9.0, 0.0)];
        assert_eq!(Area::polygon(&pinched), Err(AreaError::Crossed(0, 2)));
        let sliver = Area::polygon(&[p(0.0, 0.0), p(0.0, 100.0), p(0.5, 50.0)]);
        assert!(matches!(sliver, Err(AreaError::TooThin(width)) if (width - 0.5).abs() < 1e-4), "{sliver:?}");
        let thinnest = Area::rectangle(p(1e6, -1e6), Heading::from_degrees(33.0), AREA_WIDTH_MIN_M, 1e5);
        assert!(Area::polygon(thinnest.corners()).is_ok());
        assert_eq!(Area::polygon(&[p(0.0, 1e9), p(0.0, 0.0), p(1.0, 0.0)]), Err(AreaError::TooFar));
    }

    #[test]
    fn areas_overlap_whose_insides_meet() {
        let square = |north, east, turned: f64| {
            Area::rectangle(Point::new(north, east), Heading::from_degrees(turned), 10.0, 10.0)
        };
        let area = square(0.0, 0.0, 0.0);
        for (north, east, turned, meet) in [
            (3.0, 3.0, 0.0, true),
            (0.0, 0.0, 45.0, true),
            (0.0, 10.1, 0.0, false),
            (10.0, 0.0, 0.0, false),
            // A corner of the turned one reaches 7.07 m.
            (0.0, 12.0, 45.0, true),
            (0.0, 12.1, 45.0, false),
            // Corner to corner: only the edges of the turned one lie between.
            (9.0, 9.0, 45.0, false),
            (8.0, 8.0, 45.0, true),
        ] {
            let other = square(north, east, turned);
            assert_eq!((area.overlaps(&other), other.overlaps(&area)), (meet, meet), "{north} {east} {turned}");
        }
        let whole = Area::rectangle(Point::ORIGIN, Heading::NORTH, 1000.0, 1000.0);
        assert!(whole.overlaps(&area) && area.overlaps(&whole));
    }

    #[test]
    fn an_edge_knows_both_its_directions() {
        let area = Area::rectangle(Point::ORIGIN, Heading::NORTH, 100.0, 50.0);
        let north_edge = area.edges().max_by(|a, b| a.normal.north.total_cmp(&b.normal.north)).unwrap();
        assert_eq!(north_edge.tangent(Heading::from_degrees(80.0)).degrees().round(), 90.0);
        assert_eq!(north_edge.tangent(Heading::from_degrees(300.0)).degrees().round(), 270.0);
    }
}
