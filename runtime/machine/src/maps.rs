//! Maps in words: a grid (the side of a cell, the corner of the first, which way a row goes, rows, columns), then the list of what its cells hold.

use crate::compute::place;
use crate::state::Run;
use albacore_geometry::Grid;
use albacore_program::{GRID_WORDS, MapOp, Slot};

impl Run {
    pub(crate) fn on_map(&mut self, op: MapOp, base: Slot) {
        let b = |slot: Slot| place(slot, base);
        match op {
            MapOp::Lay { to, area, value, words, capacity } => self.lay(b(to), b(area), b(value), words, capacity),
            MapOp::CellOf { to, map, point } => {
                let index = self.grid(b(map)).index_of(self.point(b(point)));
                self.set(b(to), index.map_or(-1.0, f64::from));
            }
            MapOp::CenterOf { to, map, index } => {
                let center = self.grid(b(map)).center(self.get(b(index)) as u32);
                self.set_point(b(to), center);
            }
        }
    }

    fn lay(&mut self, to: Slot, area: Slot, value: Slot, words: u32, capacity: u32) {
        let grid = Grid::over(self.edges_of(area).map(|edge| edge.line), capacity);
        let value = self.slice(value, words).to_vec();
        self.state.words[to as usize..(to + GRID_WORDS + 1 + capacity * words) as usize].fill(0.0);
        let Some(grid) = grid else { return };
        self.set(to, grid.cell);
        self.set_point(to + 1, grid.corner);
        self.set_vector(to + 3, grid.along);
        self.set(to + 5, f64::from(grid.rows));
        self.set(to + 6, f64::from(grid.columns));
        let cells = grid.rows * grid.columns;
        self.set(to + GRID_WORDS, f64::from(cells));
        for at in (to + GRID_WORDS + 1..).step_by(words.max(1) as usize).take(cells as usize) {
            self.state.words[at as usize..(at + words) as usize].copy_from_slice(&value);
        }
    }

    fn grid(&self, map: Slot) -> Grid {
        Grid {
            cell: self.get(map),
            corner: self.point(map + 1),
            along: self.vector(map + 3),
            rows: self.get(map + 5) as u32,
            columns: self.get(map + 6) as u32,
        }
    }
}
