//! Areas in words: a count of corners, then for each its point and the outward normal of the edge that begins there.

use crate::execute::truth;
use crate::state::Run;
use albacore_arithmetic::bounded;
use albacore_geometry::{
    Area, Edge, Heading, Line, Place, Point, Rows, Vector, farthest_corner, gap, is_convex, nearest_edge, run,
    scattered,
};
use albacore_program::{AREA_CORNER_WORDS, ROWS_WORDS, Slot, area_words};

impl Run {
    pub fn point(&self, at: Slot) -> Point {
        Point::new(self.get(at), self.get(at + 1))
    }

    pub fn set_point(&mut self, at: Slot, p: Point) {
        self.set(at, bounded(p.north));
        self.set(at + 1, bounded(p.east));
    }

    pub fn vector(&self, at: Slot) -> Vector {
        Vector::new(self.get(at), self.get(at + 1))
    }

    pub fn set_vector(&mut self, at: Slot, v: Vector) {
        self.set(at, bounded(v.north));
        self.set(at + 1, bounded(v.east));
    }

    pub fn line(&self, at: Slot) -> Line {
        Line { start: self.point(at), end: self.point(at + 2) }
    }

    pub fn set_line(&mut self, at: Slot, line: Line) {
        self.set_point(at, line.start);
        self.set_point(at + 2, line.end);
    }

    /// Leaves the words empty where there is no area.
    pub fn set_area(&mut self, to: Slot, room: u32, area: Option<&Area>) {
        self.state.words[to as usize..(to + area_words(room)) as usize].fill(0.0);
        let Some(area) = area else { return };
        self.set(to, area.corners().len() as f64);
        for (i, edge) in area.edges().enumerate() {
            let at = to + 1 + AREA_CORNER_WORDS * i as u32;
            self.set_point(at, edge.line.start);
            self.set_vector(at + 2, edge.normal);
        }
    }

    fn corners(&self, area: Slot) -> u32 {
        self.get(area) as u32
    }

    fn corner_point(&self, area: Slot, i: u32) -> Point {
        // The corner after the last is the first.
        let i = if i < self.corners(area) { i } else { 0 };
        self.point(area + 1 + AREA_CORNER_WORDS * i)
    }

    pub fn edge_of(&self, area: Slot, i: u32) -> Edge {
        let line = Line { start: self.corner_point(area, i), end: self.corner_point(area, i + 1) };
        Edge { line, normal: self.vector(area + 1 + AREA_CORNER_WORDS * i + 2) }
    }

    /// The edges in their order. The words of all corners are found once, not anew for each of them.
    pub fn edges_of(&self, area: Slot) -> impl Iterator<Item = Edge> + Clone + '_ {
        let (corners, _) = self.slice(area + 1, AREA_CORNER_WORDS * self.corners(area)).as_chunks();
        (0..corners.len()).map(move |i| {
            let [north, east, normal_north, normal_east] = corners[i];
            let [end_north, end_east, ..] = corners[if i + 1 < corners.len() { i + 1 } else { 0 }];
            let line = Line { start: Point::new(north, east), end: Point::new(end_north, end_east) };
            Edge { line, normal: Vector::new(normal_north, normal_east) }
        })
    }

    pub fn rows_across(&self, area: Slot, step: f64, along: Option<Heading>, near: Point) -> Option<Rows> {
        Rows::across(self.edges_of(area), step, along, near)
    }

    pub fn set_rows(&mut self, at: Slot, rows: Option<Rows>) {
        self.state.words[at as usize..(at + ROWS_WORDS) as usize].fill(0.0);
        let Some(Rows { start, outward, ray, apart, count, lines, is_opposite, is_backward }) = rows else { return };
        self.set(at, f64::from(count));
        self.set(at + 1, bounded(apart));
        self.set(at + 2, truth(is_opposite));
        self.set(at + 3, truth(is_backward));
        self.set_point(at + 4, start);
        self.set_vector(at + 6, outward);
        self.set_vector(at + 8, ray);
        self.set(at + 10, f64::from(lines));
    }

    fn rows(&self, at: Slot) -> Rows {
        Rows {
            count: self.get(at) as u32,
            apart: self.get(at + 1),
            is_opposite: self.get(at + 2) != 0.0,
            is_backward: self.get(at + 3) != 0.0,
            start: self.point(at + 4),
            outward: self.vector(at + 6),
            ray: self.vector(at + 8),
            lines: self.get(at + 10) as u32,
        }
    }

    /// The row at a place, which becomes that of the next.
    pub fn take_row(&mut self, to: Slot, place: Slot, rows: Slot, area: Slot) {
        let here = Place { line: self.get(place + 1) as u32, piece: self.get(place + 2) as u32 };
        let found = self.rows(rows).row_at(self.edges_of(area), here);
        self.set(place, truth(found.is_some()));
        let Some((row, next)) = found else { return };
        self.set_line(to, row);
        self.set(place + 1, f64::from(next.line));
        self.set(place + 2, f64::from(next.piece));
    }

    pub fn edge(&self, at: Slot) -> Edge {
        Edge { line: self.line(at), normal: self.vector(at + 4) }
    }

    pub fn set_edge(&mut self, at: Slot, edge: Edge) {
        self.set_line(at, edge.line);
        self.set_vector(at + 4, edge.normal);
    }

    /// How far a point is from the nearest place of an edge.
    pub fn distance_of_edge(&self, edge: Slot, p: Point) -> f64 {
        bounded(self.edge(edge).distance(p))
    }

    pub fn center(&self, area: Slot) -> Point {
        let n = self.corners(area);
        let sum = (0..n).fold(Vector::ZERO, |sum, i| sum + (self.corner_point(area, i) - Point::ORIGIN));
        Point::ORIGIN + (1.0 / f64::from(n.max(1))) * sum
    }

    pub fn gap(&self, area: Slot, p: Point) -> f64 {
        bounded(gap(self.edges_of(area), p))
    }

    pub fn nearest_edge(&self, area: Slot, p: Point) -> Edge {
        nearest_edge(self.edges_of(area), p).unwrap_or_else(|| self.edge_of(area, 0))
    }

    /// The corner that lies farthest along a heading; of those equally far the one nearest to a point.
    pub fn farthest_corner(&self, area: Slot, heading: Heading, near: Point) -> Point {
        farthest_corner(&self.corner_points(area), heading, near)
    }

    fn corner_points(&self, area: Slot) -> Vec<Point> {
        (0..self.corners(area)).map(|i| self.corner_point(area, i)).collect()
    }

    /// The hull of an area, in other words.
    pub fn set_hull(&mut self, to: Slot, room: u32, area: Slot) {
        if is_convex(self.edges_of(area)) {
            let area = area as usize;
            self.state.words.copy_within(area..area + area_words(room) as usize, to as usize);
        } else {
            let hull = Area::around(&self.corner_points(area));
            self.set_area(to, room, Some(&hull));
        }
    }

    /// The place of an index among those that are scattered over an area.
    pub fn scattered(&self, area: Slot, index: f64, seed: f64) -> Point {
        scattered(self.edges_of(area), index, seed)
    }

    /// Where a ray from a point leaves the area; the point itself when it is outside.
    pub fn exit(&self, area: Slot, from: Point, heading: Heading) -> Point {
        from + run(self.edges_of(area), from, heading.unit()) * heading.unit()
    }
}
