//! `safety.cage`: what keeps the vehicle inside.

use albacore_geometry::{Area, Edge, Heading, Point, Vector, gap, nearest_edge};

const BAND: f64 = 5.0;
const BEYOND: f64 = 30.0;
const EQUALLY_FAR: f64 = 1.0;

#[derive(Clone)]
pub struct Cage {
    edges: Vec<Edge>,
}

impl Cage {
    pub fn new(area: &Area) -> Self {
        Cage { edges: area.edges().collect() }
    }

    /// Far outside.
    pub fn is_left(inside: f64) -> bool {
        inside < -BEYOND
    }

    /// To the nearest edge, m; negative outside.
    pub fn inside(&self, position: Point) -> f64 {
        gap(self.edges.iter().copied(), position)
    }

    /// The course that does not lead out.
    pub fn amend(&self, asked: Heading, inside: f64, position: Point, heading: Heading) -> Heading {
        if inside >= BAND {
            return asked;
        }
        let mut go = asked.unit();
        let mut home = Vector::ZERO;
        for edge in &self.edges {
            let gap = edge.gap(position);
            let out = go.dot(edge.normal);
            if gap < 0.0 {
                home = home - edge.normal;
            } else if gap < BAND && out > 0.0 {
                go = go - ((1.0 - gap / BAND) * out) * edge.normal;
            }
        }
        if home.length() > 0.0 {
            home.toward()
        } else if go.length() > 0.01 {
            go.toward()
        } else {
            nearest_edge(self.edges.iter().copied(), position).map_or(asked, |edge| edge.tangent(heading))
        }
    }
}

/// The corner that lies farthest along a heading; of those equally far the nearest.
pub fn corner(area: &Area, toward: Heading, near: Point) -> Point {
    let far = area.corners().iter().map(|c| c.along(toward)).fold(f64::NEG_INFINITY, f64::max);
    let candidates = area.corners().iter().copied().filter(|c| c.along(toward) > far - EQUALLY_FAR);
    candidates.reduce(|best, c| if c.distance(near) < best.distance(near) { c } else { best }).unwrap_or(near)
}
