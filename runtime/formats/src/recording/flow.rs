//! The flow of a record: velocities on a coarse grid, frame after frame.

use super::header::Grid;
use albacore_geometry::{Point, Vector};

/// Velocities on a grid, in time.
#[derive(Debug)]
pub(super) struct FlowRecord {
    /// North of each row, falling, and east of each column, rising, m.
    north: Vec<f64>,
    east: Vec<f64>,
    /// North and east, m/s toward: frame after frame, row after row.
    velocities: Vec<[f32; 2]>,
}

impl FlowRecord {
    /// The flow on a grid whose axes fall and rise; two numbers a node, as many as frames ask for.
    pub fn new(grid: &Grid, numbers: Vec<f32>) -> Self {
        let velocities = numbers.as_chunks::<2>().0.to_vec();
        FlowRecord { north: grid.north_m.clone(), east: grid.east_m.clone(), velocities }
    }

    /// The velocity at a point and a time in frames, m/s toward: linear in time, bilinear in space, held at every edge.
    pub fn at(&self, p: Point, frames: f64) -> Vector {
        let nodes = self.north.len() * self.east.len();
        let last = self.velocities.len() / nodes - 1;
        let frames = frames.clamp(0.0, last as f64);
        let early = (frames as usize).min(last - 1);
        let share = frames - early as f64;
        let falling: (usize, f64) = bracket(self.north.len(), p.north, |i| -self.north[i], -1.0);
        let (row, south) = falling;
        let (column, east) = bracket(self.east.len(), p.east, |i| self.east[i], 1.0);
        let node = early * nodes + row * self.east.len() + column;
        let blend = |at: usize| {
            let (a, b) = (vector(self.velocities[at]), vector(self.velocities[at + nodes]));
            a + share * (b - a)
        };
        let along = |at: usize| {
            let (a, b) = (blend(at), blend(at + 1));
            a + east * (b - a)
        };
        let (near, far) = (along(node), along(node + self.east.len()));
        near + south * (far - near)
    }

    /// The mean over all nodes and frames, m/s toward.
    pub fn mean(&self) -> Vector {
        let sum = self.velocities.iter().fold(Vector::ZERO, |sum, v| sum + vector(*v));
        (1.0 / self.velocities.len() as f64) * sum
    }
}

/// The cell of an axis that holds a coordinate, and the share of the way through it, 0 to 1: the nearest cell's edge beyond
/// the axis. `rising` is the axis taken with the sign that makes it rise.
fn bracket(nodes: usize, coordinate: f64, rising: impl Fn(usize) -> f64, sign: f64) -> (usize, f64) {
    let x = (sign * coordinate).clamp(rising(0), rising(nodes - 1));
    let cell = (1..nodes - 1).take_while(|&i| rising(i) <= x).count();
    (cell, (x - rising(cell)) / (rising(cell + 1) - rising(cell)))
}

fn vector([north, east]: [f32; 2]) -> Vector {
    Vector::new(f64::from(north), f64::from(east))
}
