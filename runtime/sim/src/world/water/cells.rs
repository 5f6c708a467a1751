//! A flow field frozen in time, made for the thousands of look-ups of a plume's step.

use crate::world::water::mesh::{Mesh, Nodes};

/// A field frozen in time: in each cell the coefficients of both bilinear velocities.
#[derive(Clone, Debug, Default)]
pub struct Cells {
    columns: i32,
    rows: i32,
    per_x: f64,
    per_y: f64,
    /// u = c0 + c1 x + c2 y + c3 x y, v likewise from c4; x and y from the grid's corner, m.
    coefficients: Vec<[f64; 8]>,
    /// Which of the field's states they are made from: its number.
    state: Option<i64>,
    /// What is added everywhere, m/s.
    carried: (f64, f64),
}

impl Cells {
    /// One cell of uniform flow.
    pub fn uniform(&mut self, speed: f64) {
        let only = [speed, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        *self = Cells { columns: 1, rows: 1, coefficients: vec![only], ..Cells::default() };
    }

    /// A state of the field, which has a number of its own.
    pub fn freeze(&mut self, mesh: &Mesh, state: i64, nodes: &Nodes) {
        if self.state != Some(state) {
            self.fit(mesh);
            fill(&mut self.coefficients, mesh, nodes);
            self.state = Some(state);
        }
    }

    /// The same velocity is added everywhere.
    pub fn carry(&mut self, velocity: (f64, f64)) {
        self.carried = velocity;
    }

    /// What is added everywhere, m/s.
    pub fn carried(&self) -> (f64, f64) {
        self.carried
    }

    /// Velocity along and to the right of the mean flow, m/s, at a place within the grid.
    #[inline]
    pub fn velocity(&self, x: f64, y: f64) -> (f64, f64) {
        // The cast saturates: what is beyond the grid takes the nearest cell. (To a signed integer it is one instruction.)
        let column = ((x * self.per_x) as i32).min(self.columns - 1).max(0);
        let row = ((y * self.per_y) as i32).min(self.rows - 1).max(0);
        let c = &self.coefficients[(row * self.columns + column) as usize];
        let xy = x * y;
        let (u, v) = (c[0] + c[1] * x + (c[2] * y + c[3] * xy), c[4] + c[5] * x + (c[6] * y + c[7] * xy));
        (u + self.carried.0, v + self.carried.1)
    }

    /// Takes the shape of a grid.
    fn fit(&mut self, mesh: &Mesh) {
        let (columns, rows) = (mesh.columns - 1, mesh.rows - 1);
        (self.columns, self.rows) = (columns as i32, rows as i32);
        (self.per_x, self.per_y) = (1.0 / mesh.dx, 1.0 / mesh.dy);
        self.coefficients.resize(columns * rows, [0.0; 8]);
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
