//! Edges belong to an area: on random rectangles and polygons, of every size and far from the origin too.

use albacore_geometry::math::{TAU, cos, exp, ln, sin};
use albacore_geometry::{AREA_CORNERS_MAX, AREA_REACH_MAX_M, Area, Heading, Line, PLACE_MAX_M, Point, nearest_edge};

const AREAS: u32 = 20_000;

/// How far rounding moves a point off the edge that it is computed to lie on, m, at most.
const ROUNDED_M: f64 = 1e-6;

/// Numbers that are random enough, and the same in every run (SplitMix64).
struct Random {
    state: u64,
    /// How far from the origin a place may be, m.
    far: f64,
}

impl Random {
    /// From 0 to 1.
    fn share(&mut self) -> f64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.state;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((x ^ (x >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// As often between 1 and 10 as between 10 and 100.
    fn size(&mut self, least: f64, most: f64) -> f64 {
        least * exp(self.share() * ln(most / least))
    }

    fn heading(&mut self) -> Heading {
        Heading::from_radians(TAU * self.share())
    }

    fn place(&mut self) -> Point {
        Point::ORIGIN + self.size(1.0, self.far) * self.heading().unit()
    }

    fn rectangle(&mut self) -> Area {
        Area::rectangle(self.place(), self.heading(), self.size(1.0, 1e5), self.size(1.0, 1e5))
    }

    /// Corners on an ellipse, and at times one in the middle of a side.
    fn polygon(&mut self) -> Option<Area> {
        let (center, tilt) = (self.place(), self.heading());
        let (length, width) = (self.size(2.0, AREA_REACH_MAX_M / 2.0), self.size(2.0, AREA_REACH_MAX_M / 2.0));
        let n = 3 + (self.share() * (AREA_CORNERS_MAX - 3) as f64) as usize;
        let mut angles: Vec<f64> = (0..n).map(|_| TAU * self.share()).collect();
        angles.sort_by(f64::total_cmp);
        let corner =
            |angle: &f64| center + length * cos(*angle) * tilt.unit() + width * sin(*angle) * (tilt + TAU / 4.0).unit();
        let mut corners: Vec<Point> = angles.iter().map(corner).collect();
        if self.share() < 0.5 {
            let between = on(Line { start: corners[0], end: corners[1] }, self.share());
            corners.insert(1, between);
        }
        if self.share() < 0.5 {
            corners.reverse();
        }
        Area::polygon(&corners).ok()
    }

    fn area(&mut self) -> Area {
        loop {
            let area = if self.share() < 0.3 { Some(self.rectangle()) } else { self.polygon() };
            if let Some(area) = area.filter(|area| area.width() > 1.0) {
                return area;
            }
        }
    }
}

fn on(line: Line, share: f64) -> Point {
    line.start + share * (line.end - line.start)
}

#[test]
fn corners_and_points_of_edges_lie_in_their_area() {
    let mut random = Random { state: 1, far: PLACE_MAX_M };
    for _ in 0..AREAS {
        let area = random.area();
        for edge in area.edges() {
            for share in [0.0, 1.0, 0.5, random.share(), random.share()] {
                let point = on(edge.line, share);
                assert_eq!((area.gap(point), edge.gap(point)), (0.0, 0.0), "{share} of {edge:?} of {area:?}");
            }
        }
    }
}

#[test]
fn what_lies_beside_an_edge_is_within_or_without() {
    let mut random = Random { state: 2, far: PLACE_MAX_M };
    for _ in 0..AREAS {
        let area = random.area();
        for edge in area.edges() {
            let (middle, beside) = (on(edge.line, 0.5), 2.0 * ROUNDED_M * edge.normal);
            assert!(area.gap(middle + beside) < 0.0, "{edge:?} of {area:?}");
            assert!(edge.gap(middle + -beside) > 0.0, "{edge:?} of {area:?}");
        }
    }
}

#[test]
fn a_ray_along_an_edge_leaves_the_area_at_its_end() {
    let mut random = Random { state: 3, far: 1e5 };
    for _ in 0..AREAS {
        let area = random.area();
        for edge in area.edges() {
            let (from, ray) = (edge.line.start, edge.line.heading().unit());
            let run = area.edges().filter_map(|edge| edge.run(from, ray)).fold(f64::INFINITY, f64::min);
            assert!(run > 0.999 * edge.line.length(), "{run} of {edge:?} of {area:?}");
            assert!(area.gap(from + run * ray) >= 0.0, "{run} of {edge:?} of {area:?}");
        }
    }
}

/// By halving: the place on a line that is nearest to a point.
fn nearest_place(line: Line, to: Point) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..200 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if on(line, a).distance(to) < on(line, b).distance(to) { high = b } else { low = a }
    }
    on(line, low).distance(to)
}

#[test]
fn the_gap_is_the_distance_to_the_nearest_place_of_all_edges() {
    let mut random = Random { state: 4, far: 1e4 };
    for _ in 0..AREAS / 10 {
        let area = random.area();
        let corner = area.corners()[0];
        let beside = |random: &mut Random, place: Point| place + random.size(0.1, 1e5) * random.heading().unit();
        for point in [beside(&mut random, corner), beside(&mut random, area.center()), random.place()] {
            let distance = area.edges().map(|edge| nearest_place(edge.line, point)).fold(f64::INFINITY, f64::min);
            let gap = area.gap(point);
            assert!((gap.abs() - distance).abs() < 1e-3, "{gap} is not {distance}, from {point:?} to {area:?}");
            assert_eq!(gap < 0.0, area.edges().any(|edge| edge.gap(point) < 0.0), "{point:?} of {area:?}");
            let nearest = nearest_edge(area.edges(), point).unwrap();
            assert!((nearest.distance(point) - gap.abs()).abs() < 1e-6, "{point:?} of {area:?}");
        }
    }
}

#[test]
fn two_areas_are_as_far_apart_as_their_nearest_places() {
    let square = |north, east| Area::rectangle(Point::new(north, east), Heading::NORTH, 10.0, 10.0);
    for (north, east, apart) in
        [(13.0, 14.0, 5.0), (0.0, 14.0, 4.0), (-13.0, 14.0, 5.0), (10.0, 0.0, 0.0), (3.0, 3.0, 0.0)]
    {
        let (here, there) = (square(0.0, 0.0), square(north, east));
        for found in [here.distance(&there), there.distance(&here)] {
            assert!((found - apart).abs() < 1e-9, "{found} of {north} {east}");
        }
    }
    // Across a corner no line of an edge is as far as the areas are.
    let turned = Area::rectangle(Point::new(30.0, 40.0), Heading::from_degrees(45.0), 10.0, 10.0);
    let corners = Point::new(5.0, 5.0).distance(Point::new(30.0, 40.0 - 5.0 * 2f64.sqrt()));
    assert!((square(0.0, 0.0).distance(&turned) - corners).abs() < 1e-9);
}
