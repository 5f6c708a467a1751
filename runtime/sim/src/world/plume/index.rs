//! The filaments at one moment, indexed for looks at many places.

use crate::world::plume::FilamentPlume;
use crate::world::plume::kernel::{CUT_RADII, share};

/// Cells across the reach of the largest filament: more of them are looked into, and less beside what matters.
const CELLS_A_REACH: f64 = 2.0;
/// The index has this many cells at most; where the plume is larger, they are.
const CELLS_MAX: f64 = 1e6;

/// A filament as it is at the moment.
#[derive(Clone, Copy, Debug)]
struct Puff {
    center: [f64; 3],
    squared_radius: f64,
    /// What it reads in its middle.
    strength: f64,
}

/// The filaments at one moment. A look costs what lies near the place, not what is alive.
#[derive(Clone, Debug)]
pub struct Index {
    layer: Option<f64>,
    /// The corner of the first cell and the side of each, m; cells along the flow and across it.
    corner: [f64; 2],
    side: f64,
    columns: usize,
    rows: usize,
    /// How far a filament reaches at most, m.
    reach: f64,
    /// Where each cell's filaments begin among `puffs`, and where the last's end.
    begins: Vec<u32>,
    /// Cell by cell; within a cell in the order of their release.
    puffs: Vec<Puff>,
}

impl Index {
    /// The plume at a time of its last stride, s.
    pub fn new(plume: &FilamentPlume, time: f64) -> Self {
        let alive: Vec<Puff> = plume
            .at(time)
            .map(|(f, center)| {
                let kernel = &plume.origins[f.source as usize].kernel;
                let squared_radius = kernel.squared_radius(time - f.birth);
                Puff { center, squared_radius, strength: kernel.strength(squared_radius) }
            })
            .collect();
        let largest = alive.iter().map(|puff| puff.squared_radius).fold(0.0, f64::max);
        let reach = CUT_RADII * largest.sqrt();
        let bound = |axis: usize, start: f64, pick: fn(f64, f64) -> f64| {
            alive.iter().map(|puff| puff.center[axis]).fold(start, pick)
        };
        let low = [0, 1].map(|axis| bound(axis, f64::INFINITY, f64::min));
        let high = [0, 1].map(|axis| bound(axis, f64::NEG_INFINITY, f64::max));
        let (length, width) = ((high[0] - low[0]).max(0.0), (high[1] - low[1]).max(0.0));
        let side = (reach / CELLS_A_REACH).max((length * width / CELLS_MAX).sqrt()).max(f64::MIN_POSITIVE);
        let (columns, rows) = ((length / side) as usize + 1, (width / side) as usize + 1);
        let mut index = Index {
            layer: plume.settings.layer,
            corner: low,
            side,
            columns,
            rows,
            reach,
            begins: vec![0; columns * rows + 1],
            puffs: Vec::new(),
        };
        index.sort(&alive);
        index
    }

    /// What a perfect sensor without saturation would read, as a ratio of full scale, at a place (m, in the flow frame; height
    /// above the bottom). Above the plume's layer it is zero.
    pub fn reading(&self, place: [f64; 3]) -> f64 {
        if self.puffs.is_empty() || self.layer.is_some_and(|ceiling| place[2] > ceiling) {
            return 0.0;
        }
        let cells = |axis: usize, count: usize| {
            let at = |offset: f64| (place[axis] + offset - self.corner[axis]) / self.side;
            let (first, last) = (at(-self.reach), at(self.reach));
            // Casts saturate: what lies before the first cell begins at it.
            (last >= 0.0 && first < count as f64).then_some((first as usize, (last as usize).min(count - 1)))
        };
        let (Some((left, right)), Some((near, far))) = (cells(0, self.columns), cells(1, self.rows)) else {
            return 0.0;
        };
        let mut sum = 0.0;
        for row in near..=far {
            let cell = |column: usize| self.begins[row * self.columns + column] as usize;
            for puff in &self.puffs[cell(left)..cell(right + 1)] {
                let share = share(puff.center, puff.squared_radius, self.layer, place);
                if share > 0.0 {
                    sum += puff.strength * share;
                }
            }
        }
        sum
    }

    /// How many filaments there are.
    pub fn len(&self) -> usize {
        self.puffs.len()
    }

    /// Puts filaments into their cells: a counting sort.
    fn sort(&mut self, alive: &[Puff]) {
        let cell = |puff: &Puff| {
            let column = ((puff.center[0] - self.corner[0]) / self.side) as usize;
            let row = ((puff.center[1] - self.corner[1]) / self.side) as usize;
            row.min(self.rows - 1) * self.columns + column.min(self.columns - 1)
        };
        let places: Vec<usize> = alive.iter().map(cell).collect();
        for &place in &places {
            self.begins[place + 1] += 1;
        }
        for i in 1..self.begins.len() {
            self.begins[i] += self.begins[i - 1];
        }
        let mut next = self.begins.clone();
        let Some(&first) = alive.first() else { return };
        self.puffs = vec![first; alive.len()];
        for (puff, &place) in alive.iter().zip(&places) {
            self.puffs[next[place] as usize] = *puff;
            next[place] += 1;
        }
    }
}
