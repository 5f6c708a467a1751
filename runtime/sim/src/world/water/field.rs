//! The advection field of Farrell et al. 2002: velocities on a grid, driven by coloured noise at its four corners.

use crate::noise::{Noise, Stream};
use crate::world::water::cells::Cells;
use crate::world::water::coloured_noise::{ColouredNoise, SIGNALS};
use crate::world::water::frame::FlowFrame;
use crate::world::water::mesh::{Mesh, Nodes};
use crate::world::water::{Flow, Meander};
use albacore_geometry::math::TAU;

/// A field in time: du/dt = -(u u_x + v u_y) + k/2 (u_xx + u_yy) and the same for v, centred differences in space, explicit
/// Euler in time; at the corners the mean plus coloured noise, on the edges linear between corners. It has no pressure and is
/// not free of divergence, like the original.
#[derive(Clone, Debug)]
pub struct Field {
    mesh: Mesh,
    mean: f64,
    half_viscosity: f64,
    step: f64,
    corners: ColouredNoise,
    /// The last states, each in the place of its time, so that a reader may lag.
    frames: Vec<Nodes>,
    /// Time of the newest state, in steps.
    newest: i64,
    /// What a step is cut with.
    between: Nodes,
}

impl Field {
    /// The field of a meander in a box, one advective time before `begin` seconds: [`Field::advance_to`] that time, and it has
    /// forgotten its start. Times up to `behind` seconds before the newest that was asked for stay known.
    pub fn new(meander: &Meander, frame: &FlowFrame, begin: f64, behind: f64, flow: &Flow, seed: u64) -> Self {
        let (mean_speed, speed) = (flow.mean.length(), flow.speed());
        let mesh = Mesh::new(meander, frame, speed);
        let (noise, step) = (Noise::new(seed, Stream::FlowCorners), meander.step());
        let sigma = meander.direction_sd * speed;
        let corners = ColouredNoise::new(noise, sigma, TAU / meander.period, meander.damping, step);
        let blank = Nodes { u: vec![0.0; mesh.nodes()], v: vec![0.0; mesh.nodes()] };
        let spin_up = (frame.length / speed / step).ceil();
        let mut field = Field {
            mesh,
            mean: mean_speed,
            half_viscosity: 0.5 * meander.viscosity,
            step,
            corners,
            frames: vec![blank.clone(); (behind / step).ceil() as usize + 3],
            between: blank,
            newest: ((begin / step).floor() - spin_up) as i64,
        };
        let start = field.boundary();
        field.frames.iter_mut().for_each(|nodes| fill(nodes, &field.mesh, &start, Part::All));
        field
    }

    /// Computes steps until the newest state is at `time` or later. `carried` is what the whole water does at a time, along the
    /// mean flow and to its right, m/s: it carries the field with it.
    pub fn advance_to(&mut self, time: f64, carried: impl Fn(f64) -> (f64, f64)) {
        while (self.newest as f64) * self.step < time {
            self.advance(carried((self.newest as f64) * self.step));
        }
    }

    /// Velocity along and to the right of the mean flow, m/s: bilinear in space, linear in time.
    pub fn velocity(&self, x: f64, y: f64, time: f64) -> (f64, f64) {
        let (late, share) = self.bracket(time);
        let [early, late] = [late - 1, late].map(|state| &self.frames[self.place(state)]);
        let m = &self.mesh;
        let (column, fx) = cell_of(x / m.dx, m.columns - 1);
        let (row, fy) = cell_of(y / m.dy, m.rows - 1);
        let node = row * m.columns + column;
        let at = |a: &[f64], b: &[f64]| {
            let blend = |i: usize| a[i] + share * (b[i] - a[i]);
            let near = blend(node) + fx * (blend(node + 1) - blend(node));
            let far = blend(node + m.columns) + fx * (blend(node + m.columns + 1) - blend(node + m.columns));
            near + fy * (far - near)
        };
        (at(&early.u, &late.u), at(&early.v, &late.v))
    }

    /// The state nearest to a time, as coefficients of cells: a step is short beside what the field changes over.
    pub fn frozen(&self, time: f64, cells: &mut Cells) {
        let state = ((time / self.step).round() as i64).clamp(self.oldest(), self.newest);
        cells.freeze(&self.mesh, state, &self.frames[self.place(state)]);
    }

    /// The later of the two states round a time, in steps, and how far the time is from the earlier to it.
    fn bracket(&self, time: f64) -> (i64, f64) {
        let steps = time / self.step;
        let late = (steps.ceil() as i64).clamp(self.oldest() + 1, self.newest);
        (late, (steps - (late - 1) as f64).clamp(0.0, 1.0))
    }

    fn oldest(&self) -> i64 {
        self.newest - (self.frames.len() as i64 - 1)
    }

    /// Where a state is among the last.
    fn place(&self, state: i64) -> usize {
        state.rem_euclid(self.frames.len() as i64) as usize
    }

    /// Velocity components at the corners: up-flow left, down-flow left, up-flow right, down-flow right.
    fn boundary(&self) -> [f64; SIGNALS] {
        let mut corners = self.corners.values();
        corners.iter_mut().step_by(2).for_each(|u| *u += self.mean);
        corners
    }

    fn advance(&mut self, carried: (f64, f64)) {
        self.corners.step();
        let boundary = self.boundary();
        let (old, place) = (self.place(self.newest), self.place(self.newest + 1));
        let mut new = std::mem::take(&mut self.frames[place]);
        fill(&mut new, &self.mesh, &boundary, Part::Edges);
        let time = self.step / self.mesh.substeps;
        euler(&self.frames[old], &mut new, &self.mesh, self.half_viscosity, time, carried);
        for _ in 1..self.mesh.substeps as usize {
            std::mem::swap(&mut self.between, &mut new);
            fill(&mut new, &self.mesh, &boundary, Part::Edges);
            euler(&self.between, &mut new, &self.mesh, self.half_viscosity, time, carried);
        }
        self.frames[place] = new;
        self.newest += 1;
    }
}

/// Which nodes are meant.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Part {
    Edges,
    All,
}

/// Sets nodes to the bilinear interpolation of the corners.
fn fill(nodes: &mut Nodes, mesh: &Mesh, corners: &[f64; SIGNALS], part: Part) {
    let [u00, v00, u10, v10, u01, v01, u11, v11] = *corners;
    let (last_column, last_row) = (mesh.columns - 1, mesh.rows - 1);
    for row in 0..mesh.rows {
        let fy = row as f64 / last_row as f64;
        let whole = part == Part::All || row == 0 || row == last_row;
        for column in (0..mesh.columns).step_by(if whole { 1 } else { last_column }) {
            let fx = column as f64 / last_column as f64;
            let bilinear = |a: f64, b: f64, c: f64, d: f64| {
                let (near, far) = (a + fx * (b - a), c + fx * (d - c));
                near + fy * (far - near)
            };
            let node = row * mesh.columns + column;
            nodes.u[node] = bilinear(u00, u10, u01, u11);
            nodes.v[node] = bilinear(v00, v10, v01, v11);
        }
    }
}

/// One explicit step of the inner nodes.
fn euler(old: &Nodes, new: &mut Nodes, mesh: &Mesh, half_viscosity: f64, time: f64, carried: (f64, f64)) {
    let (along, across) = (time / (2.0 * mesh.dx), time / (2.0 * mesh.dy));
    let (diffuse_x, diffuse_y) =
        (time * half_viscosity / (mesh.dx * mesh.dx), time * half_viscosity / (mesh.dy * mesh.dy));
    let n = mesh.columns;
    for row in 1..mesh.rows - 1 {
        // Slices of one length, so that their bounds are looked at once a row.
        let [u, v] = [&old.u, &old.v].map(|f| [row - 1, row, row + 1].map(|row| &f[row * n..(row + 1) * n]));
        let (new_u, new_v) = (&mut new.u[row * n..(row + 1) * n], &mut new.v[row * n..(row + 1) * n]);
        for i in 1..n - 1 {
            let (along, across) = (along * (u[1][i] + carried.0), across * (v[1][i] + carried.1));
            let step = |[north, here, south]: [&[f64]; 3]| {
                let (west, east, here, north, south) = (here[i - 1], here[i + 1], here[i], north[i], south[i]);
                here - (along * (east - west) + across * (south - north))
                    + (diffuse_x * (east - 2.0 * here + west) + diffuse_y * (south - 2.0 * here + north))
            };
            new_u[i] = step(u);
            new_v[i] = step(v);
        }
    }
}

/// The cell that holds a coordinate counted in cells, and the place in it; beyond the grid, the edge of the last cell.
fn cell_of(position: f64, cells: usize) -> (usize, f64) {
    let held = position.clamp(0.0, cells as f64);
    let cell = (held as usize).min(cells - 1);
    (cell, held - cell as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use albacore_geometry::{Area, Heading, Point};

    fn duck(meander: &Meander, seed: u64) -> Field {
        let direction = Heading::from_degrees(140.0);
        let flow = Flow { mean: 0.125 * direction.unit(), meander: Some(meander.clone()), ..Flow::default() };
        let region = Area::rectangle(Point::ORIGIN, direction, 1094.0, 367.0);
        let mut field = Field::new(meander, &FlowFrame::new(&flow, Some(&region)), 0.0, 10.0, &flow, seed);
        field.advance_to(0.0, STILL);
        field
    }

    const STILL: fn(f64) -> (f64, f64) = |_| (0.0, 0.0);

    fn squared(x: f64) -> f64 {
        x * x
    }

    #[test]
    fn frozen_cells_and_direct_look_up_agree() {
        let mut field = duck(&Meander::default(), 5);
        field.advance_to(48.0, STILL);
        let mut cells = Cells::default();
        for (time, nearest) in [(29.6, 20.0), (48.0, 40.0), (59.6, 60.0)] {
            field.frozen(time, &mut cells);
            for (x, y) in [(0.0, 0.0), (607.0, 243.0), (1213.9, 486.9), (20.3, 477.7), (333.3, 77.7)] {
                let (direct, frozen) = (field.velocity(x, y, nearest), cells.velocity(x, y));
                assert!((direct.0 - frozen.0).abs() < 1e-12 && (direct.1 - frozen.1).abs() < 1e-12);
            }
        }
    }

    /// At a corner the flow has the deviation asked for; within the region about half of it, along and across, as in the
    /// recorded plume of an independent model (`plume-recorded`: 0.0082 and 0.0058 m/s of 0.0175).
    #[test]
    fn the_flow_wanders_less_inside() {
        let (mut corner, mut along, mut across, mut n) = (0.0, 0.0, 0.0, 0.0);
        for seed in 0..10 {
            let mut field = duck(&Meander::default(), seed);
            for k in 1..=30 {
                let time = f64::from(k) * 400.0;
                field.advance_to(time, STILL);
                corner += squared(field.velocity(0.0, 0.0, time).1);
                for (x, y) in (0..60).map(|i| (60.0 + 120.0 * f64::from(i % 10), 60.0 + 73.0 * f64::from(i / 10))) {
                    let (u, v) = field.velocity(x, y, time);
                    along += squared(u - 0.125) / 60.0;
                    across += squared(v) / 60.0;
                }
                n += 1.0;
            }
        }
        let [corner, along, across] = [corner, along, across].map(|sum: f64| (sum / n).sqrt());
        assert!((0.015..0.020).contains(&corner), "{corner}");
        assert!((0.006..0.011).contains(&along), "{along}");
        assert!((0.004..0.009).contains(&across), "{across}");
    }

    /// Cells a quarter of the size need sub-steps, and give the same field but for its finer grain.
    #[test]
    fn finer_cells_give_the_same_field() {
        let (mut coarse, mut fine) =
            (duck(&Meander::default(), 3), duck(&Meander { cell: Some(10.0), ..Meander::default() }, 3));
        assert!(fine.mesh.substeps > coarse.mesh.substeps);
        coarse.advance_to(1000.0, STILL);
        fine.advance_to(1000.0, STILL);
        for (x, y) in [(607.0, 243.0), (300.0, 100.0), (900.0, 400.0)] {
            let (a, b) = (coarse.velocity(x, y, 1000.0), fine.velocity(x, y, 1000.0));
            assert!((a.0 - b.0).abs() < 2e-4 && (a.1 - b.1).abs() < 2e-4, "{a:?} {b:?}");
        }
    }
}
