//! `search.find`: across the flow from edge to edge.

use albacore_geometry::math::radians;
use albacore_geometry::{Area, Edge, Heading, Point, nearest_edge};

const TURN: f64 = 6.0;

#[derive(Clone)]
pub struct Find {
    edges: Vec<Edge>,
    center: Point,
    lean: f64,
    leg: Heading,
    /// The leg on which an edge was met.
    met: Heading,
    /// No candidate fitted: along the edge until one does.
    along_edge: bool,
}

impl Find {
    pub fn enter(area: &Area, position: Point, down: Heading) -> Self {
        let edges: Vec<Edge> = area.edges().collect();
        let lean = radians(20.0);
        let (left, right) = (down - radians(90.0) - lean, down + radians(90.0) + lean);
        let leg = if run(&edges, position, left) > run(&edges, position, right) { left } else { right };
        Find { edges, center: area.center(), lean, leg, met: leg, along_edge: false }
    }

    pub fn course(&self) -> Heading {
        self.leg
    }

    pub fn step(&mut self, position: Point, down: Heading) -> Heading {
        if self.along_edge {
            let next = self.reflected(position, down);
            if next.is_some() || self.meets(position) {
                self.leg = next.unwrap_or_else(|| (self.center - position).toward());
                self.along_edge = false;
            }
        } else if self.meets(position) {
            self.met = self.leg;
            match self.reflected(position, down) {
                Some(next) => self.leg = next,
                None => {
                    self.leg = nearest_edge(self.edges.iter().copied(), position)
                        .map_or(self.leg, |edge| edge.tangent(self.met));
                    self.along_edge = true;
                }
            }
        }
        self.leg
    }

    fn meets(&self, position: Point) -> bool {
        let ahead = self.leg.unit();
        self.edges.iter().any(|edge| edge.gap(position) < TURN && ahead.dot(edge.normal) > 0.0)
    }

    fn reflected(&self, position: Point, down: Heading) -> Option<Heading> {
        let old = self.met.unit();
        let near = |edge: &&Edge| edge.gap(position) < TURN;
        let edges_met = self.edges.iter().filter(near).filter(|edge| old.dot(edge.normal) > 0.0).count();
        for side in [-radians(90.0), radians(90.0)] {
            for tilt in [self.lean, -self.lean] {
                let candidate = down + side + tilt;
                let new = candidate.unit();
                let fits = self.edges.iter().filter(near).all(|edge| {
                    let along = edge.line.heading().unit();
                    let back = old.dot(along) * new.dot(along) < 0.0;
                    new.dot(edge.normal) < 0.0 && !(edges_met == 1 && old.dot(edge.normal) > 0.0 && back)
                });
                if fits {
                    return Some(candidate);
                }
            }
        }
        None
    }
}

/// How far a ray runs before it leaves.
fn run(edges: &[Edge], from: Point, toward: Heading) -> f64 {
    let ray = toward.unit();
    let mut run = f64::INFINITY;
    for edge in edges {
        let (gap, outward) = (edge.gap(from), ray.dot(edge.normal));
        if gap < 0.0 {
            return 0.0;
        }
        if outward > 0.0 {
            run = run.min(gap / outward);
        }
    }
    ((from + run * ray) - from).length()
}
