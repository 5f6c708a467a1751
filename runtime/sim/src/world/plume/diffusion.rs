//! What pushes filaments about: draws that are their own, whatever else is alive.

use crate::noise::{Noise, Stream};
use crate::world::plume::Filament;

/// What pushes the filaments of a source about.
#[derive(Clone, Copy, Debug)]
pub struct Diffusion {
    noise: Noise,
    early: Noise,
    /// Whether they rise.
    rises: bool,
}

/// A filament's draws are its own, whatever else is alive.
#[inline]
fn index(filament: &Filament, step: u64) -> u64 {
    u64::from(filament.number) << 32 | (step & 0xFFFF_FFFF)
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
        let mut draws = self.quick(filament, step);
        if self.rises && Diffusion::is_young(age) {
            draws[2] = self.early_rise(filament, step);
        }
        draws
    }

    /// Whether a filament is so young, s, that its draws up and down are Gaussian to the last, if it has any.
    #[inline]
    pub fn is_young(age: f64) -> bool {
        age < EARLY_S
    }

    /// Whether filaments go up and down.
    #[inline]
    pub fn rises(&self) -> bool {
        self.rises
    }

    /// The draws where those up and down are like the others.
    #[inline]
    pub fn quick(&self, filament: &Filament, step: u64) -> [f64; 3] {
        self.noise.nearly_gaussian_triple(index(filament, step))
    }

    /// The draw up and down where it is Gaussian to the last.
    #[inline]
    pub fn early_rise(&self, filament: &Filament, step: u64) -> f64 {
        self.early.gaussian(index(filament, step))
    }
}
