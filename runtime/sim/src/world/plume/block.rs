//! Filaments that were released one after the other, and take their steps together.

use crate::world::plume::Origin;
use crate::world::water::Cells;

/// Filaments in a block.
const SIZE: usize = 64;

/// A puff of chemical at the end of its step, in the coordinates of the flow frame (m); one cache line.
#[derive(Clone, Copy, Debug)]
pub struct Filament {
    /// Which source released it, and as its how manieth.
    pub source: u32,
    pub number: u32,
    /// When, s.
    pub birth: f64,
    pub x: f64,
    pub y: f64,
    /// Height above the bottom, m.
    pub z: f64,
    /// Its mean velocity over the step, m/s: between steps it moves on a straight line.
    pub velocity: [f64; 3],
}

/// Neighbours in the order of their release, which stay neighbours in space.
#[derive(Clone, Debug)]
pub struct Block {
    pub filaments: Vec<Filament>,
    /// How many it still takes.
    room: usize,
    /// When its step ends: s, and in steps of the plume.
    pub end: f64,
    pub until: u64,
    /// Where it is along the flow during its step.
    along: Reach,
}

/// What the steps of all blocks at one time have in common.
pub struct Drift<'a> {
    pub origins: &'a [Origin],
    pub cells: &'a Cells,
    /// Which step of the plume it is.
    pub step: u64,
    /// Horizontal and vertical diffusivity, m2/s.
    pub diffusivity: (f64, f64),
    /// The top of the layer that they are mirrored at, m; none where their heights stay.
    pub ceiling: Option<f64>,
    /// What leaves this box leaves the plume, m.
    pub length: f64,
    pub width: f64,
}

/// An interval along the flow, m.
#[derive(Clone, Copy, Debug)]
struct Reach {
    low: f64,
    high: f64,
}

impl Block {
    /// An empty one, whose step ends at a time (s) with a step of the plume.
    pub fn new(end: f64, until: u64) -> Self {
        Block { filaments: Vec::with_capacity(SIZE), room: SIZE, end, until, along: Reach::default() }
    }

    /// Whether it takes more.
    pub fn is_open(&self) -> bool {
        self.room > 0
    }

    /// Takes a filament that was at `x` along the flow when the step began.
    pub fn add(&mut self, filament: Filament, x: f64) {
        self.room -= 1;
        self.along.extend(x);
        self.along.extend(filament.x);
        self.filaments.push(filament);
    }

    /// Whether any of it may be between two places along the flow during its step.
    pub fn is_between(&self, low: f64, high: f64) -> bool {
        self.along.low <= high && self.along.high >= low
    }

    /// One step of so many seconds; what has left is forgotten.
    pub fn advance(&mut self, dt: f64, drift: &Drift) {
        let per_dt = 1.0 / dt;
        let spread = (2.0 * drift.diffusivity.0 * dt).sqrt();
        let rise = (2.0 * drift.diffusivity.1 * dt).sqrt();
        let mut left = 0;
        self.along = Reach::default();
        for f in &mut self.filaments {
            let (horizontal, vertical) = drift.origins[f.source as usize].noises;
            let index = f.noise_index(drift.step);
            let (u, v) = drift.cells.velocity(f.x, f.y);
            let (nx, ny) = horizontal.nearly_gaussian_pair(index);
            let (dx, dy) = (u * dt + spread * nx, v * dt + spread * ny);
            self.along.extend(f.x);
            f.x += dx;
            f.y += dy;
            self.along.extend(f.x);
            (f.velocity[0], f.velocity[1]) = (dx * per_dt, dy * per_dt);
            if let Some(ceiling) = drift.ceiling {
                let z = reflected(f.z + rise * vertical.nearly_gaussian_pair(index).0, ceiling);
                f.velocity[2] = (z - f.z) * per_dt;
                f.z = z;
            }
            left += usize::from(drift.has_left(f));
        }
        if left > 0 {
            self.filaments.retain(|f| !drift.has_left(f));
        }
    }
}

impl Drift<'_> {
    #[inline]
    fn has_left(&self, f: &Filament) -> bool {
        let (half_length, half_width) = (0.5 * self.length, 0.5 * self.width);
        (f.x - half_length).abs() > half_length || (f.y - half_width).abs() > half_width
    }
}

impl Filament {
    /// The draws of a filament at a step are its own, whatever else is alive.
    pub fn noise_index(&self, step: u64) -> u64 {
        u64::from(self.number) << 32 | (step & 0xFFFF_FFFF)
    }

    /// Where it was some seconds before the end of its step.
    #[inline]
    pub fn at(&self, before: f64) -> [f64; 3] {
        let [u, v, w] = self.velocity;
        [self.x - before * u, self.y - before * v, self.z - before * w]
    }

    /// The same on its way, some seconds before the end of its step.
    pub fn back(mut self, before: f64) -> Self {
        [self.x, self.y, self.z] = self.at(before);
        self
    }
}

impl Default for Reach {
    fn default() -> Self {
        Reach { low: f64::INFINITY, high: f64::NEG_INFINITY }
    }
}

impl Reach {
    #[inline]
    fn extend(&mut self, x: f64) {
        // Not `min` and `max`: those also cater for what is not a number.
        self.low = if x < self.low { x } else { self.low };
        self.high = if x > self.high { x } else { self.high };
    }
}

/// A height mirrored at the bottom and at the ceiling of the layer.
pub fn reflected(z: f64, ceiling: f64) -> f64 {
    let up = z.abs();
    (if up > ceiling { 2.0 * ceiling - up } else { up }).clamp(0.0, ceiling)
}
