//! The plume: filaments released at the sources that drift with the water, diffuse, and grow (Farrell et al. 2002).

mod block;
mod index;
mod kernel;
mod nearby;
mod release;
mod settings;
mod source;
mod spin_up;
mod steps;

pub use index::Index;
pub use nearby::Nearby;
pub use settings::Plume;
pub(crate) use settings::check;
pub use source::{Leak, Patch, Source, Times};
pub(crate) use source::{SPIN_UP_MAX_S, check as check_sources};
pub use spin_up::begin as spin_up_begin;
pub use steps::{LONGEST_PLUME_STEP_S, LONGEST_STEP_S, stays_in_layer};

use crate::noise::{Noise, Stream};
use crate::scenario::Scenario;
use crate::world::water::{Cells, FlowFrame, Water};
use albacore_vehicle::TICK_S;
use block::{Block, Drift, Filament, reflected};
use kernel::Kernel;
use release::Release;
use steps::{Steps, longest};

/// The number of the first patch's streams: sources have those below.
const PATCH_STREAMS: u32 = 1 << 31;

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
pub struct FilamentPlume {
    settings: Plume,
    /// The sources, and after them the patches.
    origins: Vec<Origin>,
    /// All that are alive, in the order of their release; the last block takes what is released.
    blocks: Vec<Block>,
    steps_of: Steps,
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

impl FilamentPlume {
    /// The plume of a scenario, empty at `begin` seconds; none if the scenario has none.
    pub fn new(scenario: &Scenario, frame: &FlowFrame, begin: f64, seed: u64) -> Option<Self> {
        let settings = scenario.environment.plume.clone()?;
        let diffusion =
            |number| (Noise::sub(seed, Stream::Diffusion, number), Noise::sub(seed, Stream::VerticalDiffusion, number));
        let sources = scenario.environment.sources.iter().zip(0..).map(|(source, number)| {
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
        let patches = scenario.environment.patches.iter().zip(PATCH_STREAMS..).map(|(patch, number)| {
            let (x, y) = frame.to_local(patch.at);
            Origin {
                place: [x, y, patch.height],
                leak: None,
                release: None,
                kernel: Kernel::new(patch.peak, patch.reference_age, &settings),
                noises: diffusion(number),
            }
        });
        Some(FilamentPlume {
            origins: sources.chain(patches).collect(),
            blocks: Vec::new(),
            steps_of: Steps::new(scenario, &settings),
            oldest_patch: scenario.environment.patches.iter().map(|patch| -patch.age).fold(0.0, f64::min),
            length: frame.length,
            width: frame.width,
            end: begin,
            step: longest(scenario),
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

    /// Takes in a filament that was at `x` along the flow when the step began.
    fn add(&mut self, filament: Filament, x: f64) {
        if !self.blocks.last().is_some_and(Block::is_open) {
            self.blocks.push(Block::new(self.end, self.steps));
        }
        if let Some(block) = self.blocks.last_mut() {
            block.add(filament, x);
        }
    }

    /// Computes steps until the plume is known up to a tick, and with it the water.
    pub fn advance_to(&mut self, tick: u64, water: &mut Water) {
        while self.end_tick < tick {
            self.end_tick += self.step_ticks;
            self.advance(self.end_tick as f64 * TICK_S, water);
        }
    }

    /// The filaments alive at a time of the last step, and where they are then: m, in the flow frame.
    fn at(&self, time: f64) -> impl Iterator<Item = (&Filament, [f64; 3])> {
        let all = self.blocks.iter().flat_map(move |block| block.filaments.iter().map(move |f| (f, block.end - time)));
        all.filter(move |(f, _)| f.birth <= time).map(|(f, before)| (f, f.at(before)))
    }

    /// The filaments alive at a time of the last step: where (m, in the flow frame) and how large (m).
    pub fn alive(&self, time: f64) -> impl Iterator<Item = ([f64; 3], f64)> + '_ {
        self.at(time).map(move |(f, place)| {
            (place, self.origins[f.source as usize].kernel.squared_radius(time - f.birth).sqrt())
        })
    }

    /// A bound of the largest squared radius, m2. Filaments of sources stand in the order of the steps of their release, so that
    /// none is older than the first alive by more than one step; those of patches are as old as they were said to be.
    fn largest_squared_radius(&self) -> f64 {
        let first = self.blocks.iter().find_map(|block| block.filaments.first());
        let oldest = first.map_or(self.end, |f| f.birth - LONGEST_STEP_S).min(self.oldest_patch);
        self.settings.initial_radius * self.settings.initial_radius + self.settings.growth * (self.end - oldest)
    }

    /// One step, to a time.
    ///
    /// x += u dt + sqrt(2 K dt) N, Euler, with the flow in the middle of the step: a step is short beside what the flow changes
    /// over. (pompy multiplies the noise by dt, which makes the diffusivity depend on the time step.) Old filaments take several
    /// steps at once ([`Steps`]), in the flow of the first of them.
    fn advance(&mut self, end: f64, water: &mut Water) {
        (self.step, self.end) = (end - self.end, end);
        let middle = end - 0.5 * self.step;
        water.advance_to(middle);
        water.frozen(middle, &mut self.cells);
        self.steps += 1;
        self.drift();
        self.release();
    }

    /// Moves the blocks whose step is over.
    fn drift(&mut self) {
        let (dt, begin) = (self.step, self.end - self.step);
        let settings = &self.settings;
        let drift = Drift {
            origins: &self.origins,
            cells: &self.cells,
            step: self.steps,
            diffusivity: (settings.diffusivity, settings.vertical),
            ceiling: settings.layer.filter(|_| settings.vertical > 0.0),
            length: self.length,
            width: self.width,
        };
        for block in self.blocks.iter_mut().filter(|block| block.until < drift.step) {
            // What is released in the step joins the open block at its end.
            let youngest = block.filaments.last().filter(|_| !block.is_open());
            let at_once = youngest.map_or(1, |f| self.steps_of.at_once(begin - f.birth, dt));
            let step = at_once as f64 * dt;
            (block.until, block.end) = (drift.step + at_once - 1, self.end + (at_once - 1) as f64 * dt);
            block.advance(step, &drift);
        }
        self.blocks.retain(|block| block.is_open() || !block.filaments.is_empty());
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

#[cfg(test)]
mod tests;
