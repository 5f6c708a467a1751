//! Edges belong to an area: on random rectangles and polygons, of every size and far from the origin too.

use albacore_geometry::math::{TAU, cos, exp, ln, sin};
use albacore_geometry::{
    AREA_REACH_MAX_M, Area, Heading, Line, PLACE_MAX_M, Point, Rows, Vector, is_convex, nearest_edge, run, wrap_angle,
};

const AREAS: u32 = 20_000;

/// A polygon has so many corners at most: more of them make no other cases.
const CORNERS: f64 = 24.0;

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

    /// Corners on an ellipse or, as often, nearer to its middle, and at times one in the middle of a side.
    fn polygon(&mut self) -> Option<Area> {
        let (center, tilt) = (self.place(), self.heading());
        let (length, width) = (self.size(2.0, AREA_REACH_MAX_M / 2.0), self.size(2.0, AREA_REACH_MAX_M / 2.0));
        let n = 3 + (self.share() * (CORNERS - 3.0)) as usize;
        let mut angles: Vec<f64> = (0..n).map(|_| TAU * self.share()).collect();
        angles.sort_by(f64::total_cmp);
        let least = if self.share() < 0.5 { 1.0 } else { self.share() };
        let corner = |angle: &f64| {
            let out = least + (1.0 - least) * self.share();
            center + out * length * cos(*angle) * tilt.unit() + out * width * sin(*angle) * (tilt + TAU / 4.0).unit()
        };
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
            let run = run(area.edges(), from, ray);
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

/// How often an area's corners go round a point, seen from there.
fn turns(area: &Area, from: Point) -> f64 {
    let seen = |line: Line| wrap_angle((line.end - from).toward().radians() - (line.start - from).toward().radians());
    (area.edges().map(|edge| seen(edge.line)).sum::<f64>() / TAU).round()
}

/// Whether nothing of a line lies outside, or further than its end anything else than outside: looked at by small steps.
fn leaves_at_its_end(area: &Area, line: Line) -> bool {
    (0..=50).all(|i| area.gap(on(line, f64::from(i) / 50.0)) > -1e-3)
}

#[test]
fn a_ray_leaves_an_area_where_its_outline_is_first_crossed() {
    let mut random = Random { state: 5, far: 1e4 };
    for _ in 0..AREAS / 10 {
        let area = random.area();
        let from = area.center() + random.size(0.1, 0.5 * area.reach().max(1.0)) * random.heading().unit();
        let ray = random.heading().unit();
        let out = from + run(area.edges(), from, ray) * ray;
        if area.gap(from) < 0.0 {
            assert_eq!(out, from);
        } else {
            assert!(area.gap(out).abs() < 1e-3, "{from:?} to {out:?} of {area:?}");
            assert!(leaves_at_its_end(&area, Line { start: from, end: out }), "{from:?} to {out:?} of {area:?}");
        }
    }
}

#[test]
fn the_hull_has_no_dents_and_holds_its_area() {
    let mut random = Random { state: 6, far: 1e4 };
    let mut dents = 0;
    for _ in 0..AREAS / 10 {
        let area = random.area();
        let hull = area.hull();
        assert!(is_convex(hull.edges()) && area.corners().iter().all(|c| hull.gap(*c) >= 0.0), "{hull:?} of {area:?}");
        assert!((hull.width() - area.width()).abs() < 1e-6);
        dents += u32::from(!is_convex(area.edges()));
        assert!(is_convex(area.edges()) != (hull != area), "{hull:?} of {area:?}");
    }
    assert!(dents > AREAS / 50, "{dents}");
}

#[test]
fn rows_lie_inside_and_no_place_is_farther_from_their_lines_than_half_a_step() {
    let mut random = Random { state: 7, far: 1e4 };
    for _ in 0..AREAS / 20 {
        let area = random.area();
        let step = random.size(0.02, 1.0) * area.width();
        let rows = Rows::across(area.edges(), step, None, random.place()).unwrap();
        let lines: Vec<Line> = rows.rows(area.edges()).collect();
        assert_eq!(lines.len(), rows.count as usize);
        for line in &lines {
            assert!(line.length() > 0.0 && leaves_at_its_end(&area, *line), "{line:?} of {area:?}");
            assert!(area.gap(line.start).abs() < 1e-3 && area.gap(line.end).abs() < 1e-3, "{line:?} of {area:?}");
        }
        // Where the line nearest to a place inside crosses it, there is a row.
        for _ in 0..20 {
            let place = area.center() + random.size(0.1, area.reach()) * random.heading().unit();
            let inward = (rows.start - place).dot(rows.outward);
            let line = ((inward / rows.apart - 0.5).round()).clamp(0.0, f64::from(rows.lines) - 1.0);
            let off = inward - (line + 0.5) * rows.apart;
            let beside: Point = place + off * rows.outward;
            if area.gap(beside) > 1e-3 && area.gap(place) >= 0.0 {
                let on_row = |row: &Line| nearest_place(*row, beside) < 1e-3;
                assert!(off.abs() <= 0.5 * rows.apart + 1e-6 && rows.apart <= step.max(area.reach() / 400.0));
                assert!(lines.iter().any(on_row), "{beside:?} of {area:?}");
            }
        }
    }
}

#[test]
fn areas_overlap_where_a_point_lies_inside_both() {
    let mut random = Random { state: 8, far: 100.0 };
    let mut apart = 0;
    for _ in 0..AREAS / 20 {
        let (mut here, mut there) = (random.area(), random.area());
        while here.reach() > 100.0 {
            here = random.area()
        }
        while there.reach() > 100.0 {
            there = random.area()
        }
        let near = |area: &Area| area.center() + 0.05 * area.reach() * Vector::new(1.0, 0.0);
        let both = (0..2000).any(|i| {
            let share = Vector::new(f64::from(i / 40) / 25.0 - 1.0, f64::from(i % 40) / 20.0 - 1.0);
            let place = near(&here) + here.reach() * share;
            here.gap(place) > 0.0 && there.gap(place) > 0.0
        });
        assert!(!both || here.overlaps(&there), "{here:?} {there:?}");
        assert_eq!(here.overlaps(&there), there.overlaps(&here));
        assert_eq!(here.overlaps(&there), here.distance(&there) == 0.0);
        apart += u32::from(!here.overlaps(&there));
    }
    assert!(apart > 20, "{apart}");
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
            if gap.abs() > 1e-3 {
                assert_eq!(gap > 0.0, turns(&area, point) == 1.0, "{gap}, {point:?} of {area:?}");
            }
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
