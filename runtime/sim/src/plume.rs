//! The plume: filaments released at the sources that drift with the water, diffuse, and grow (Farrell et al. 2002).

mod index;
mod kernel;
mod nearby;
mod release;
mod spin_up;

pub use index::Index;
pub use nearby::Nearby;
pub use spin_up::{LONGEST_STEP_S, begin as spin_up_begin, stays_in_layer};

use crate::noise::{Noise, Stream};
use crate::scenario::{self, Patch, Scenario};
use crate::water::{Cells, FlowFrame, Water};
use albacore_vehicle::TICK_S;
use kernel::Kernel;
use release::Release;

/// The number of the first patch's streams: sources have those below.
const PATCH_STREAMS: u32 = 1 << 31;

/// The birth of a filament that has left the plume: later than any time.
const GONE: f64 = f64::INFINITY;
/// The ranks are closed when more than one in this many is gone.
const GONE_SHARE: usize = 32;

/// Filaments in a block.
const BLOCK: usize = 64;

/// An interval along the flow, m.
#[derive(Clone, Copy, Debug)]
struct Reach {
    low: f64,
    high: f64,
}

/// A puff of chemical at the end of the last step, in the coordinates of the flow frame (m); one cache line.
#[derive(Clone, Copy, Debug)]
pub struct Filament {
    /// Which source released it, and as its how manieth.
    source: u32,
    number: u32,
    /// When, s; [`GONE`] once it has left.
    birth: f64,
    x: f64,
    y: f64,
    /// Height above the bottom, m.
    z: f64,
    /// Its mean velocity over the step, m/s: between steps it moves on a straight line.
    velocity: [f64; 3],
}

/// What a source or a patch needs for its filaments.
#[derive(Clone, Debug)]
struct Origin {
    place: [f64; 3],
    /// The way to the other end of a leak, and what tells where along it.
    leak: Option<([f64; 2], Noise)>,
    /// None of a patch: it has released all.
    release: Option<Release>,
    kernel: Kernel,
    /// Horizontal and vertical diffusion of its filaments.
    noises: (Noise, Noise),
}

/// All filaments of a run.
#[derive(Clone, Debug)]
pub struct Plume {
    settings: scenario::Plume,
    /// The sources, and after them the patches.
    origins: Vec<Origin>,
    filaments: Vec<Filament>,
    /// Where each [`BLOCK`] of filaments is along the flow during the step: what was released together stays together.
    blocks: Vec<Reach>,
    /// How many have left and still stand in the ranks.
    gone: usize,
    /// The birth of the oldest patch, s; 0 without any.
    oldest_patch: f64,
    /// Filaments leave the plume where they leave this box, m.
    length: f64,
    width: f64,
    /// Time at the end of the last step, and how long that step was, s.
    end: f64,
    step: f64,
    /// The same time in ticks, and the ticks of a step.
    end_tick: u64,
    step_ticks: u64,
    /// Steps so far, spin-up included: the second half of every noise index.
    steps: u64,
    cells: Cells,
}

impl Plume {
    /// The plume of a scenario, empty at `begin` seconds; none if the scenario has none.
    pub fn new(scenario: &Scenario, frame: &FlowFrame, begin: f64, seed: u64) -> Option<Self> {
        let settings = scenario.plume.clone()?;
        let diffusion =
            |number| (Noise::sub(seed, Stream::Diffusion, number), Noise::sub(seed, Stream::VerticalDiffusion, number));
        let sources = scenario.sources.iter().zip(0..).map(|(source, number)| {
            let (x, y) = frame.to_local(source.at);
            let noise = Noise::sub(seed, Stream::Release, number);
            let leak = source.to.map(|to| {
                let (u, v) = frame.of_vector(to - source.at);
                ([u, v], Noise::sub(seed, Stream::Leak, number))
            });
            Origin {
                place: [x, y, source.height],
                leak,
                release: Some(Release::new(noise, source.rate, source.when, begin)),
                kernel: Kernel::new(source.peak, source.reference_age, &settings),
                noises: diffusion(number),
            }
        });
        let patches = scenario.patches.iter().zip(PATCH_STREAMS..).map(|(patch, number)| {
            let (x, y) = frame.to_local(patch.at);
            Origin {
                place: [x, y, patch.height],
                leak: None,
                release: None,
                kernel: Kernel::new(patch.peak, patch.reference_age, &settings),
                noises: diffusion(number),
            }
        });
        Some(Plume {
            origins: sources.chain(patches).collect(),
            filaments: Vec::new(),
            blocks: Vec::new(),
            gone: 0,
            oldest_patch: scenario.patches.iter().map(|patch| -patch.age).fold(0.0, f64::min),
            length: frame.length,
            width: frame.width,
            end: begin,
            step: spin_up::step(scenario),
            end_tick: 0,
            step_ticks: (settings.step / TICK_S).round() as u64,
            steps: 0,
            cells: Cells::default(),
            settings,
        })
    }

    /// Fills the region: everything that was released before time 0, and the patches.
    pub fn spin_up(&mut self, water: &mut Water, patches: &[Patch], seed: u64) {
        let step = self.step;
        let steps = (-self.end / step).round() as u64;
        for left in (0..steps).rev() {
            self.advance(-(left as f64) * step, water);
        }
        let first = self.origins.len() - patches.len();
        for ((patch, source), number) in patches.iter().zip(first..).zip(0..) {
            self.scatter(patch, source, Noise::sub(seed, Stream::Patch, number));
        }
    }

    /// Adds the filaments of a patch.
    fn scatter(&mut self, patch: &Patch, source: usize, noise: Noise) {
        let [x, y, z] = self.origins[source].place;
        for number in 0..patch.filaments {
            let draw = |axis: u64| patch.radius * noise.gaussian(2 * u64::from(number) + axis);
            let (x, y) = (x + draw(0), y + draw(1));
            let birth = -patch.age;
            self.add(Filament { source: source as u32, number, birth, x, y, z, velocity: [0.0; 3] }, x);
        }
    }

    /// Takes a filament into the ranks, that was at `x` along the flow when the step began.
    fn add(&mut self, filament: Filament, x: f64) {
        if self.filaments.len().is_multiple_of(BLOCK) {
            self.blocks.push(Reach::default());
        }
        if let Some(block) = self.blocks.last_mut() {
            block.extend(x);
            block.extend(filament.x);
        }
        self.filaments.push(filament);
    }

    /// Computes steps until the plume is known up to a tick, and with it the water.
    pub fn advance_to(&mut self, tick: u64, water: &mut Water) {
        while self.end_tick < tick {
            self.end_tick += self.step_ticks;
            self.advance(self.end_tick as f64 * TICK_S, water);
        }
    }

    /// The filaments alive at a time of the last step: where (m, in the flow frame) and how large (m).
    pub fn alive(&self, time: f64) -> impl Iterator<Item = ([f64; 3], f64)> + '_ {
        self.filaments.iter().filter(move |f| f.birth <= time).map(move |f| {
            let place = f.at(self.end - time);
            (place, self.origins[f.source as usize].kernel.squared_radius(time - f.birth).sqrt())
        })
    }

    /// A bound of the largest squared radius, m2. Filaments of sources stand in the order of the steps of their release, so that
    /// none is older than the first alive by more than one step; those of patches are as old as they were said to be.
    fn largest_squared_radius(&self) -> f64 {
        let first = self
            .filaments
            .iter()
            .find(|f| f.birth < GONE)
            .map_or(self.end, |f| f.birth - spin_up::LONGEST_SPIN_UP_STEP_S);
        let oldest = first.min(self.oldest_patch);
        self.settings.initial_radius * self.settings.initial_radius + self.settings.growth * (self.end - oldest)
    }

    /// One step, to a time.
    ///
    /// x += u dt + sqrt(2 K dt) N, Euler, with the flow in the middle of the step: a step is short beside what the flow changes
    /// over. (pompy multiplies the noise by dt, which makes the diffusivity depend on the time step.)
    fn advance(&mut self, end: f64, water: &mut Water) {
        (self.step, self.end) = (end - self.end, end);
        let middle = end - 0.5 * self.step;
        water.advance_to(middle);
        water.frozen(middle, &mut self.cells);
        self.steps += 1;
        self.drift();
        self.release();
    }

    /// Moves what is alive and forgets what has left.
    fn drift(&mut self) {
        let (dt, per_dt, steps) = (self.step, 1.0 / self.step, self.steps);
        let spread = (2.0 * self.settings.diffusivity * dt).sqrt();
        let rise = (2.0 * self.settings.vertical * dt).sqrt();
        let ceiling = self.settings.layer.filter(|_| rise > 0.0);
        let (half_length, half_width) = (0.5 * self.length, 0.5 * self.width);
        // Closing the ranks costs as much as a step: not for every one that leaves.
        if self.gone * GONE_SHARE > self.filaments.len() {
            self.filaments.retain(|f| f.birth < GONE);
        }
        self.gone = 0;
        self.blocks.clear();
        for block in self.filaments.chunks_mut(BLOCK) {
            let mut reach = Reach::default();
            for f in block {
                let (horizontal, vertical) = self.origins[f.source as usize].noises;
                let index = f.noise_index(steps);
                let (u, v) = self.cells.velocity(f.x, f.y);
                let (nx, ny) = horizontal.nearly_gaussian_pair(index);
                let (dx, dy) = (u * dt + spread * nx, v * dt + spread * ny);
                reach.extend(f.x);
                f.x += dx;
                f.y += dy;
                reach.extend(f.x);
                (f.velocity[0], f.velocity[1]) = (dx * per_dt, dy * per_dt);
                if let Some(ceiling) = ceiling {
                    let z = reflected(f.z + rise * vertical.nearly_gaussian_pair(index).0, ceiling);
                    f.velocity[2] = (z - f.z) * per_dt;
                    f.z = z;
                }
                if (f.x - half_length).abs() > half_length || (f.y - half_width).abs() > half_width {
                    f.birth = GONE;
                    self.gone += 1;
                }
            }
            self.blocks.push(reach);
        }
    }

    /// Adds what was released during the step, each filament moved from its own moment of release on.
    fn release(&mut self) {
        for source in 0..self.origins.len() {
            let Origin { place: [x, y, z], leak, noises: (horizontal, vertical), .. } = self.origins[source];
            while let Some((number, birth)) = self.origins[source].release.as_mut().and_then(|r| r.before(self.end)) {
                let (x, y) = match leak {
                    None => (x, y),
                    Some(([along, aside], noise)) => {
                        let share = noise.uniform(u64::from(number));
                        (x + share * along, y + share * aside)
                    }
                };
                let (u, v) = self.cells.velocity(x, y);
                let age = (self.end - birth).max(f64::MIN_POSITIVE);
                let mut f = Filament { source: source as u32, number, birth, x, y, z, velocity: [0.0; 3] };
                let index = f.noise_index(self.steps);
                let (nx, ny) = horizontal.nearly_gaussian_pair(index);
                let spread = (2.0 * self.settings.diffusivity * age).sqrt();
                f.x += u * age + spread * nx;
                f.y += v * age + spread * ny;
                if let Some(ceiling) = self.settings.layer {
                    let rise = (2.0 * self.settings.vertical * age).sqrt();
                    f.z = reflected(z + rise * vertical.nearly_gaussian_pair(index).0, ceiling);
                }
                f.velocity = [(f.x - x) / age, (f.y - y) / age, (f.z - z) / age];
                self.add(f, x);
            }
        }
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

impl Filament {
    /// The draws of a filament at a step are its own, whatever else is alive.
    fn noise_index(&self, step: u64) -> u64 {
        u64::from(self.number) << 32 | (step & 0xFFFF_FFFF)
    }

    /// Where it was some seconds before the end of the step.
    #[inline]
    fn at(&self, before: f64) -> [f64; 3] {
        let [u, v, w] = self.velocity;
        [self.x - before * u, self.y - before * v, self.z - before * w]
    }
}

/// A height mirrored at the bottom and at the ceiling of the layer.
fn reflected(z: f64, ceiling: f64) -> f64 {
    let up = z.abs();
    (if up > ceiling { 2.0 * ceiling - up } else { up }).clamp(0.0, ceiling)
}

#[cfg(test)]
mod tests;
