//! Filaments that were released one after the other, and stay neighbours in space.

use crate::world::plume::Origin;
use crate::world::water::Cells;

/// Filaments in a block.
const SIZE: usize = 64;

/// A puff of chemical at the end of its stride, in the coordinates of the flow frame (m); one cache line.
#[derive(Clone, Copy, Debug)]
pub struct Filament {
    /// Which source released it, and as its how manieth.
    pub source: u32,
    pub number: u32,
    /// When, s.
    pub birth: f64,
    pub x: f64,
    pub y: f64,
    /// Height above the bottom, m, as if there were neither that nor the top of a layer: see [`folded`].
    pub z: f64,
    /// Its mean velocity over the stride, m/s.
    pub velocity: [f64; 3],
}

/// Neighbours in the order of their release.
#[derive(Clone, Debug)]
pub struct Block {
    pub filaments: Vec<Filament>,
    /// How many it still takes.
    room: usize,
    /// What holds where they are when the stride ends.
    ends: Extent,
    /// The same, and where they are when it begins.
    extent: Extent,
}

/// What the strides of all filaments have in common.
pub struct Drift<'a> {
    pub origins: &'a [Origin],
    pub cells: &'a Cells,
    /// When the stride begins, s, and the plume's step with which it ends.
    pub begun: f64,
    pub until: u64,
    /// How long it is, s.
    pub time: f64,
    /// How far the water goes in half of it but for its meanders, m: the flow that moves a filament is that half-way.
    pub half: (f64, f64),
    /// Horizontal and vertical diffusivity, m2/s.
    pub diffusivity: (f64, f64),
    /// What leaves this box leaves the plume, m.
    pub length: f64,
    pub width: f64,
}

impl Block {
    /// An empty one.
    pub fn new() -> Self {
        Block { filaments: Vec::with_capacity(SIZE), room: SIZE, ends: Extent::default(), extent: Extent::default() }
    }

    /// Whether it takes more.
    pub fn is_open(&self) -> bool {
        self.room > 0
    }

    /// Takes a filament that was at a place when its stride began.
    pub fn add(&mut self, filament: Filament, from: [f64; 2]) {
        self.room -= 1;
        self.ends.extend(filament.x, filament.y);
        self.extent.extend(from[0], from[1]);
        self.extent = self.extent.with(&self.ends);
        self.filaments.push(filament);
    }

    /// Whether any of it may come so near to a place in its stride, m.
    pub fn comes_near(&self, center: [f64; 2], near: f64) -> bool {
        self.extent.comes_near(center, near)
    }

    /// A stride of all; what has left the plume before it is forgotten.
    ///
    /// x += u dt + sqrt(2 K dt) N, with the flow half-way in time and space. (pompy multiplies the noise by dt, which makes the
    /// diffusivity depend on the time step.)
    pub fn advance(&mut self, drift: &Drift) {
        let (dt, per_dt) = (drift.time, 1.0 / drift.time);
        let spread = (2.0 * drift.diffusivity.0 * dt).sqrt();
        let rise = (2.0 * drift.diffusivity.1 * dt).sqrt();
        // Hardly ever has any of a block left.
        if !self.ends.lies_within(drift.length, drift.width) {
            self.filaments.retain(|f| !drift.has_left(f));
        }
        // Most plumes have one source.
        let (only, mut ends) =
            (if let [only] = drift.origins { Some(&only.diffusion) } else { None }, Extent::default());
        for f in &mut self.filaments {
            let diffusion = only.unwrap_or_else(|| &drift.origins[f.source as usize].diffusion);
            let (u, v) = drift.cells.velocity(f.x + drift.half.0, f.y + drift.half.1);
            let [nx, ny, nz] = diffusion.draw(f, drift.until, drift.begun - f.birth);
            let (dx, dy) = (u * dt + spread * nx, v * dt + spread * ny);
            f.x += dx;
            f.y += dy;
            ends.extend(f.x, f.y);
            (f.velocity[0], f.velocity[1]) = (dx * per_dt, dy * per_dt);
            f.z += rise * nz;
            f.velocity[2] = rise * nz * per_dt;
        }
        self.extent = ends.with(&self.ends);
        self.ends = ends;
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
    /// Where it was some seconds before.
    #[inline]
    pub fn at(&self, before: f64) -> [f64; 3] {
        let [u, v, w] = self.velocity;
        [self.x - before * u, self.y - before * v, self.z - before * w]
    }

    /// Whether it comes so near to a place along both axes, m, in its last stride, of which the half lasts so many seconds.
    #[inline]
    pub fn comes_near(&self, center: [f64; 2], near: f64, half: f64) -> bool {
        let along = |end: f64, velocity: f64, center: f64| {
            let way = half * velocity;
            (end - way - center).abs() <= near + way.abs()
        };
        along(self.x, self.velocity[0], center[0]) && along(self.y, self.velocity[1], center[1])
    }

    /// The same on its way, some seconds before.
    pub fn back(mut self, before: f64) -> Self {
        [self.x, self.y, self.z] = self.at(before);
        self
    }
}

/// A box along the flow and across it, m.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    low: [f64; 2],
    high: [f64; 2],
}

impl Default for Extent {
    fn default() -> Self {
        Extent { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] }
    }
}

impl Extent {
    /// Holds a place, too.
    #[inline]
    pub fn extend(&mut self, x: f64, y: f64) {
        // Not `min` and `max`: those also cater for what is not a number.
        let (low, high) = (&mut self.low, &mut self.high);
        low[0] = if x < low[0] { x } else { low[0] };
        low[1] = if y < low[1] { y } else { low[1] };
        high[0] = if x > high[0] { x } else { high[0] };
        high[1] = if y > high[1] { y } else { high[1] };
    }

    /// One that holds another, too.
    fn with(self, other: &Extent) -> Self {
        Extent {
            low: [0, 1].map(|axis| self.low[axis].min(other.low[axis])),
            high: [0, 1].map(|axis| self.high[axis].max(other.high[axis])),
        }
    }

    /// Whether it lies within a box that begins at the origin, m.
    fn lies_within(&self, length: f64, width: f64) -> bool {
        self.low.iter().all(|low| *low >= 0.0) && self.high[0] <= length && self.high[1] <= width
    }

    /// Whether it comes so near to a place along both axes, m.
    pub fn comes_near(&self, center: [f64; 2], near: f64) -> bool {
        (0..2).all(|axis| self.low[axis] <= center[axis] + near && self.high[axis] >= center[axis] - near)
    }
}

/// A height between the bottom and the top of a layer, mirrored at both as often as it takes: a walk that is folded is one between
/// walls that throw it back.
#[inline]
pub fn folded(z: f64, ceiling: f64) -> f64 {
    let up = z.abs();
    if up <= ceiling {
        return up;
    }
    let within = up % (2.0 * ceiling);
    if within > ceiling { 2.0 * ceiling - within } else { within }
}
