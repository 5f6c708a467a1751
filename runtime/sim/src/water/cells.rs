//! A flow field frozen in time, made for the thousands of look-ups of a plume's step.

use crate::water::mesh::{Mesh, Nodes};

/// A field frozen in time: in each cell the coefficients of both bilinear velocities.
#[derive(Clone, Debug, Default)]
pub struct Cells {
    columns: i32,
    rows: i32,
    per_x: f64,
    per_y: f64,
    /// u = c0 + c1 x + c2 y + c3 x y, v likewise from c4; x and y from the grid's corner, m.
    coefficients: Vec<[f64; 8]>,
    /// The coefficients at two states of the field, made once for the pair.
    early: Vec<[f64; 8]>,
    late: Vec<[f64; 8]>,
    /// Which pair: the time of the later, in steps.
    pair: Option<i64>,
}

impl Cells {
    /// One cell of uniform flow.
    pub fn uniform(&mut self, speed: f64) {
        let only = [speed, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        *self = Cells { columns: 1, rows: 1, coefficients: vec![only], ..Cells::default() };
    }

    /// The field part of the way from one of its states to the next. `pair` is a number of the later that grows by one a step.
    pub fn freeze(&mut self, mesh: &Mesh, pair: i64, [early, late]: [&Nodes; 2], share: f64) {
        if self.pair != Some(pair) {
            // Time goes on: the later state of the last pair is mostly the earlier of this.
            if self.pair == Some(pair - 1) {
                std::mem::swap(&mut self.early, &mut self.late);
            } else {
                self.fit(mesh);
                fill(&mut self.early, mesh, early);
            }
            fill(&mut self.late, mesh, late);
            self.pair = Some(pair);
        }
        for ((c, early), late) in self.coefficients.iter_mut().zip(&self.early).zip(&self.late) {
            for i in 0..c.len() {
                c[i] = early[i] + share * (late[i] - early[i]);
            }
        }
    }

    /// Adds the same velocity everywhere to what was frozen last.
    pub fn shift(&mut self, (u, v): (f64, f64)) {
        for c in &mut self.coefficients {
            c[0] += u;
            c[4] += v;
        }
    }

    /// Velocity along and to the right of the mean flow, m/s, at a place within the grid.
    #[inline]
    pub fn velocity(&self, x: f64, y: f64) -> (f64, f64) {
        // The cast saturates: what is beyond the grid takes the nearest cell. (To a signed integer it is one instruction.)
        let column = ((x * self.per_x) as i32).min(self.columns - 1).max(0);
        let row = ((y * self.per_y) as i32).min(self.rows - 1).max(0);
        let c = &self.coefficients[(row * self.columns + column) as usize];
        let xy = x * y;
        (c[0] + c[1] * x + (c[2] * y + c[3] * xy), c[4] + c[5] * x + (c[6] * y + c[7] * xy))
    }

    /// Takes the shape of a grid.
    fn fit(&mut self, mesh: &Mesh) {
        let (columns, rows) = (mesh.columns - 1, mesh.rows - 1);
        (self.columns, self.rows) = (columns as i32, rows as i32);
        (self.per_x, self.per_y) = (1.0 / mesh.dx, 1.0 / mesh.dy);
        for coefficients in [&mut self.coefficients, &mut self.early, &mut self.late] {
            coefficients.resize(columns * rows, [0.0; 8]);
        }
    }
}

/// The coefficients of both velocities in all cells.
fn fill(cells: &mut [[f64; 8]], mesh: &Mesh, nodes: &Nodes) {
    let columns = mesh.columns - 1;
    let (per_x, per_y) = (1.0 / mesh.dx, 1.0 / mesh.dy);
    for (row, cells) in cells.chunks_mut(columns).enumerate() {
        let y = row as f64 * mesh.dy;
        for (column, cell) in cells.iter_mut().enumerate() {
            let (x, node) = (column as f64 * mesh.dx, row * mesh.columns + column);
            let one = |f: &[f64]| {
                let (f00, f10, f01, f11) = (f[node], f[node + 1], f[node + mesh.columns], f[node + mesh.columns + 1]);
                let by_xy = (f00 - f10 - f01 + f11) * per_x * per_y;
                let (by_x, by_y) = ((f10 - f00) * per_x - by_xy * y, (f01 - f00) * per_y - by_xy * x);
                [f00 - by_x * x - by_y * y - by_xy * x * y, by_x, by_y, by_xy]
            };
            let ([a, b, c, d], [e, f, g, h]) = (one(&nodes.u), one(&nodes.v));
            *cell = [a, b, c, d, e, f, g, h];
        }
    }
}
