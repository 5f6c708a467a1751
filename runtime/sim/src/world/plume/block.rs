//! Filaments that were released one after the other, and stay neighbours in space.

use crate::noise::{Noise, Stream};
use crate::world::plume::Origin;
use crate::world::plume::way::Extent;
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
    /// What holds where they are when the stride begins and when it ends.
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
        Block { filaments: Vec::with_capacity(SIZE), room: SIZE, extent: Extent::default() }
    }

    /// Whether it takes more.
    pub fn is_open(&self) -> bool {
        self.room > 0
    }

    /// Takes a filament that was at a place when its stride began.
    pub fn add(&mut self, filament: Filament, from: [f64; 2]) {
        self.room -= 1;
        self.extent.extend(from[0], from[1]);
        self.extent.extend(filament.x, filament.y);
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
        if self.filaments.iter().any(|f| drift.has_left(f)) {
            self.filaments.retain(|f| !drift.has_left(f));
        }
        let mut extent = Extent::default();
        for f in &mut self.filaments {
            let diffusion = &drift.origins[f.source as usize].diffusion;
            let (u, v) = drift.cells.velocity(f.x + drift.half.0, f.y + drift.half.1);
            let [nx, ny, nz] = diffusion.draw(f, drift.until, drift.begun - f.birth);
            let (dx, dy) = (u * dt + spread * nx, v * dt + spread * ny);
            extent.extend(f.x, f.y);
            f.x += dx;
            f.y += dy;
            extent.extend(f.x, f.y);
            (f.velocity[0], f.velocity[1]) = (dx * per_dt, dy * per_dt);
            f.z += rise * nz;
            f.velocity[2] = rise * nz * per_dt;
        }
        self.extent = extent;
    }
}

/// What pushes the filaments of a source about.
#[derive(Clone, Copy, Debug)]
pub struct Diffusion {
    noise: Noise,
    early: Noise,
    /// Whether they rise.
    rises: bool,
}

/// Until a filament has this age when a stride begins, s, its draws up and down are Gaussian to the last: where the plume rises to a vehicle
/// first is told by the few that rise fastest, and they have had few draws.
const EARLY_S: f64 = 512.0;

impl Diffusion {
    /// That of a source by its number, in a plume that rises or does not.
    pub fn new(seed: u64, number: u32, rises: bool) -> Self {
        Diffusion {
            noise: Noise::sub(seed, Stream::Diffusion, number),
            early: Noise::sub(seed, Stream::VerticalDiffusion, number),
            rises,
        }
    }

    /// The draws of a filament for a step of the plume, along the flow, across it and up, where it has an age when the stride begins, s.
    #[inline]
    pub fn draw(&self, filament: &Filament, step: u64, age: f64) -> [f64; 3] {
        // They are its own, whatever else is alive.
        let index = u64::from(filament.number) << 32 | (step & 0xFFFF_FFFF);
        let mut draws = self.noise.nearly_gaussian_triple(index);
        if self.rises && age < EARLY_S {
            draws[2] = self.early.gaussian(index);
        }
        draws
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

    /// The same on its way, some seconds before.
    pub fn back(mut self, before: f64) -> Self {
        [self.x, self.y, self.z] = self.at(before);
        self
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
