//! The plume: filaments released at the sources that drift with the water, diffuse, and grow (Farrell et al. 2002).

mod block;
mod diffusion;
mod index;
mod kernel;
mod nearby;
mod release;
mod settings;
mod source;
mod spin_up;
mod steps;
mod way;

pub use index::Index;
pub use nearby::Nearby;
pub use settings::Plume;
pub(crate) use settings::check;
pub use source::{Leak, Patch, Source, Times};
pub(crate) use source::{SPIN_UP_MAX_S, check as check_sources};
pub use spin_up::begin as spin_up_begin;
pub use steps::{LONGEST_STEP_S, ahead};

use crate::noise::{Noise, Stream};
use crate::scenario::Scenario;
use crate::world::water::{Cells, FlowFrame, Water};
use albacore_vehicle::TICK_S;
use block::{Block, Drift, Filament, folded};
use diffusion::Diffusion;
use kernel::Kernel;
use release::Release;
use steps::Steps;
use way::{Bridge, Way};

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
    diffusion: Diffusion,
}

/// All filaments of a run.
#[derive(Clone, Debug)]
pub struct FilamentPlume {
    settings: Plume,
    /// The sources, and after them the patches.
    origins: Vec<Origin>,
    /// All that are alive, in the order of their release; the last block takes what is released.
    blocks: Vec<Block>,
    steps: Steps,
    bridge: Bridge,
    /// The birth of the oldest patch, s; 0 without any.
    oldest_patch: f64,
    /// Filaments leave the plume where they leave this box, m.
    length: f64,
    width: f64,
    /// The speed of the mean flow, m/s.
    mean: f64,
    /// The plume's step that tick 0 begins: the spin-up has those before.
    zero: u64,
    /// The steps with which the last stride began and ended.
    begun: u64,
    until: u64,
    cells: Cells,
}

impl FilamentPlume {
    /// The plume of a scenario, empty at `begin` seconds; none if the scenario has none.
    pub fn new(scenario: &Scenario, frame: &FlowFrame, begin: f64, seed: u64) -> Option<Self> {
        let settings = scenario.environment.plume.clone()?;
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
                diffusion: Diffusion::new(seed, number, settings.vertical > 0.0),
            }
        });
        let patches = scenario.environment.patches.iter().zip(PATCH_STREAMS..).map(|(patch, number)| {
            let (x, y) = frame.to_local(patch.at);
            Origin {
                place: [x, y, patch.height],
                leak: None,
                release: None,
                kernel: Kernel::new(patch.peak, patch.reference_age, &settings),
                diffusion: Diffusion::new(seed, number, settings.vertical > 0.0),
            }
        });
        let steps = Steps::new(scenario, &settings);
        Some(FilamentPlume {
            origins: sources.chain(patches).collect(),
            blocks: Vec::new(),
            bridge: Bridge::new(&settings, steps),
            steps,
            oldest_patch: scenario.environment.patches.iter().map(|patch| -patch.age).fold(0.0, f64::min),
            length: frame.length,
            width: frame.width,
            mean: scenario.environment.flow.mean.length(),
            zero: (-begin / settings.step).round() as u64,
            begun: 0,
            until: 0,
            cells: Cells::default(),
            settings,
        })
    }

    /// Fills the region: everything that was released before time 0, and the patches.
    pub fn spin_up(&mut self, water: &mut Water, patches: &[Patch], seed: u64) {
        while self.until < self.zero {
            self.advance(self.steps.of_spin_up.min(self.zero - self.until), water);
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
            self.add(Filament { source: source as u32, number, birth, x, y, z, velocity: [0.0; 3] }, [x, y]);
        }
    }

    /// Takes in a filament that was at a place when the stride began.
    fn add(&mut self, filament: Filament, from: [f64; 2]) {
        if !self.blocks.last().is_some_and(Block::is_open) {
            self.blocks.push(Block::new());
        }
        if let Some(block) = self.blocks.last_mut() {
            block.add(filament, from);
        }
    }

    /// Computes strides until the plume is known up to a tick, and with it the water.
    pub fn advance_to(&mut self, tick: u64, water: &mut Water) {
        let step_ticks = (self.settings.step / TICK_S).round() as u64;
        while (self.until - self.zero) * step_ticks < tick {
            self.advance(self.steps.stride, water);
        }
    }

    /// When a step begins, s.
    fn time(&self, step: u64) -> f64 {
        (step as f64 - self.zero as f64) * self.settings.step
    }

    /// The step of the last stride that a time is in.
    fn step_at(&self, time: f64) -> u64 {
        // The cast saturates.
        let step = (time / self.settings.step + self.zero as f64) as u64;
        step.clamp(self.begun, self.until.saturating_sub(1).max(self.begun))
    }

    /// Steps in the last stride.
    fn stride(&self) -> u64 {
        self.until - self.begun
    }

    /// The way of a filament in the last stride.
    fn way(&self, filament: &Filament) -> Way {
        self.bridge.whole(filament, self.stride(), self.until, self.time(self.until))
    }

    /// The filaments alive at a time of the last stride, and where they are then: m, in the flow frame.
    fn at(&self, time: f64) -> impl Iterator<Item = (&Filament, [f64; 3])> {
        let step = self.step_at(time);
        let all = self.blocks.iter().flat_map(|block| &block.filaments).filter(move |f| f.birth <= time);
        all.filter_map(move |f| {
            let way = self.bridge.part(&self.origins, &self.way(f), step, 1, None)?;
            let [x, y, z] = way.filament.at(self.time(way.end()) - time);
            Some((f, [x, y, self.height(z)]))
        })
    }

    /// The height above the bottom of a filament whose walk knows no walls, m.
    fn height(&self, z: f64) -> f64 {
        self.settings.layer.map_or(z, |ceiling| folded(z, ceiling))
    }

    /// The filaments alive at a time of the last stride: where (m, in the flow frame) and how large (m).
    pub fn alive(&self, time: f64) -> impl Iterator<Item = ([f64; 3], f64)> + '_ {
        self.at(time).map(move |(f, place)| {
            (place, self.origins[f.source as usize].kernel.squared_radius(time - f.birth).sqrt())
        })
    }

    /// A bound of the largest squared radius, m2. Filaments of sources stand in the order of the strides of their release, so that
    /// none is older than the first alive by more than one stride; those of patches are as old as they were said to be.
    fn largest_squared_radius(&self) -> f64 {
        let (first, end) = (self.blocks.iter().find_map(|block| block.filaments.first()), self.time(self.until));
        let oldest = first.map_or(end, |f| f.birth - self.longest_stride()).min(self.oldest_patch);
        self.settings.initial_radius * self.settings.initial_radius + self.settings.growth * (end - oldest)
    }

    fn longest_stride(&self) -> f64 {
        self.steps.of_spin_up as f64 * self.settings.step
    }

    /// A stride of so many steps.
    fn advance(&mut self, stride: u64, water: &mut Water) {
        (self.begun, self.until) = (self.until, self.until + stride);
        let middle = 0.5 * (self.time(self.begun) + self.time(self.until));
        water.advance_to(middle);
        water.frozen(middle, &mut self.cells);
        let drift = Drift {
            origins: &self.origins,
            cells: &self.cells,
            begun: self.time(self.begun),
            until: self.until,
            time: stride as f64 * self.settings.step,
            half: self.half_way(0.5 * stride as f64 * self.settings.step),
            diffusivity: (self.settings.diffusivity, self.settings.vertical),
            length: self.length,
            width: self.width,
        };
        self.blocks.iter_mut().for_each(|block| block.advance(&drift));
        self.blocks.retain(|block| block.is_open() || !block.filaments.is_empty());
        self.release();
    }

    /// How far the water goes in some time but for its meanders, m.
    fn half_way(&self, time: f64) -> (f64, f64) {
        let (u, v) = self.cells.carried();
        (time * (self.mean + u), time * v)
    }

    /// Adds what was released during the stride, each filament moved from its own moment of release on.
    fn release(&mut self) {
        let end = self.time(self.until);
        for source in 0..self.origins.len() {
            let Origin { place: [x, y, z], leak, diffusion, .. } = self.origins[source];
            while let Some((number, birth)) = self.origins[source].release.as_mut().and_then(|r| r.before(end)) {
                let (x, y) = match leak {
                    None => (x, y),
                    Some(([along, aside], noise)) => {
                        let share = noise.uniform(u64::from(number));
                        (x + share * along, y + share * aside)
                    }
                };
                let age = (end - birth).max(f64::MIN_POSITIVE);
                let half = self.half_way(0.5 * age);
                let (u, v) = self.cells.velocity(x + half.0, y + half.1);
                let mut f = Filament { source: source as u32, number, birth, x, y, z, velocity: [0.0; 3] };
                let [nx, ny, nz] = diffusion.draw(&f, self.until, -age);
                let spread = (2.0 * self.settings.diffusivity * age).sqrt();
                f.x += u * age + spread * nx;
                f.y += v * age + spread * ny;
                f.z += (2.0 * self.settings.vertical * age).sqrt() * nz;
                f.velocity = [(f.x - x) / age, (f.y - y) / age, (f.z - z) / age];
                self.add(f, [x, y]);
            }
        }
    }
}

#[cfg(test)]
mod tests;
