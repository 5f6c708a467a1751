//! The way of a filament within a stride: a Brownian bridge between its ends, found half by half where somebody looks.
//!
//! A place half-way is the middle of the straight line and a draw of variance K T / 2 for T seconds (Levy's construction), whose number
//! is that of the plume's step. So the water is the same wherever, and in whatever order, one looks.

use crate::world::plume::block::Filament;
use crate::world::plume::diffusion::Diffusion;
use crate::world::plume::kernel::CUT_RADII;
use crate::world::plume::{Origin, Plume, Steps};

/// The bound of a diffusion's draw, in standard deviations ([`Noise::nearly_gaussian_triple`](crate::Noise)).
const LARGEST_DRAW: f64 = 2.98;
/// A bridge is off its line by this many of the largest draws half-way, at most: 1 + 1/sqrt 2 + 1/2 + … = 1 / (1 - 1/sqrt 2).
const HALVES: f64 = 3.4143;
/// No stride has more steps than two to this.
const DEEPEST: usize = 12;

/// A part of a filament's way, between two steps of the plume.
#[derive(Clone, Copy, Debug)]
pub struct Way {
    /// As it is at the end, with the mean velocity.
    pub filament: Filament,
    /// From this step, or its birth since, until that. In 32 bits, with which a way is as large as is copied quickly: two cache lines.
    begin: u32,
    end: u32,
    /// How many steps it goes straight on in the stride.
    straight: u32,
    /// Whether it is young when the stride begins: see [`Diffusion::is_young`].
    is_young: bool,
    /// How long, s.
    time: f64,
    /// How far from its middle it reads anything, m.
    reach: f64,
    /// Where it may read anything, along the flow and across it: the middle, and how far to either side, m.
    middle: [f64; 2],
    extent: [f64; 2],
}

/// A place, and how near to it something must reach, m.
#[derive(Clone, Copy, Debug)]
pub struct Near {
    pub center: [f64; 2],
    pub within: f64,
}

/// What the ways of a plume's filaments have in common.
#[derive(Clone, Debug)]
pub struct Bridge {
    steps: Steps,
    /// Horizontal and vertical diffusivity, m2/s.
    diffusivity: (f64, f64),
    /// Squared radius at release and its growth, m2 and m2/s.
    initial: f64,
    growth: f64,
    /// Of half a way of 2^i steps that begins and ends with one.
    halves: [Half; DEEPEST],
}

/// Half a way.
#[derive(Clone, Copy, Debug, Default)]
struct Half {
    /// How long, s, and its inverse.
    time: f64,
    per_time: f64,
    /// The deviations of the place at which it begins or ends, horizontally and up and down, m.
    spread: f64,
    rise: f64,
    /// What a way of so many steps is off at most where it goes straight nowhere, m.
    off: f64,
}

impl Bridge {
    /// That of a plume.
    pub fn new(plume: &Plume, steps: Steps) -> Self {
        let half = |i: usize| {
            let time = (1u64 << i) as f64 * steps.step;
            // 2 K T1 T2 / (T1 + T2), where both are T.
            let spread = (plume.diffusivity * time).sqrt();
            let off = LARGEST_DRAW * HALVES * (0.5 * plume.diffusivity * time).sqrt();
            Half { time, per_time: 1.0 / time, spread, rise: (plume.vertical * time).sqrt(), off }
        };
        Bridge {
            steps,
            diffusivity: (plume.diffusivity, plume.vertical),
            initial: plume.initial_radius * plume.initial_radius,
            growth: plume.growth,
            halves: std::array::from_fn(half),
        }
    }

    /// The way of a filament in a stride of so many steps, which ends with one at a time (s).
    pub fn whole(&self, filament: &Filament, steps: u64, end: u64, end_s: f64) -> Way {
        let (time, age) = (steps as f64 * self.steps.step, end_s - filament.birth);
        let straight = self.steps.straight((age - time).max(0.0));
        let way = Way {
            filament: *filament,
            begin: (end - steps) as u32,
            end: end as u32,
            straight: straight as u32,
            is_young: Diffusion::is_young(age - time),
            time: time.min(age),
            reach: CUT_RADII * (self.initial + self.growth * age).sqrt(),
            middle: [0.0; 2],
            extent: [0.0; 2],
        };
        way.with_bounds(self.farthest_off(steps, straight))
    }

    /// The part of a way in which a filament is at a step of the plume: of so many steps, or of as many as it goes straight on. None if it
    /// reaches nothing near in it.
    #[inline]
    pub fn part(&self, origins: &[Origin], way: &Way, step: u64, steps: u64, near: Option<Near>) -> Option<Way> {
        // Most are far.
        if near.is_some_and(|near| !way.reaches(near)) { None } else { self.part_of(origins, way, step, steps, near) }
    }

    /// The same of one that is not far as a whole.
    #[inline(never)]
    fn part_of(&self, origins: &[Origin], way: &Way, step: u64, steps: u64, near: Option<Near>) -> Option<Way> {
        let (whole, mut way, most) = (way, *way, way.straight.max(steps as u32));
        let diffusion = &origins[way.filament.source as usize].diffusion;
        while way.end - way.begin > most {
            let half = self.half(&way, step);
            if let Some(halved) = &half.halved {
                let [nx, ny, nz] = diffusion.quick(&way.filament, u64::from(half.middle));
                let f = &mut way.filament;
                (f.x, f.velocity[0]) = halved.moved((f.x, f.velocity[0]), halved.spread * nx);
                (f.y, f.velocity[1]) = halved.moved((f.y, f.velocity[1]), halved.spread * ny);
                (f.z, f.velocity[2]) = halved.moved((f.z, f.velocity[2]), halved.rise * nz);
            }
            half.take(&mut way);
            way = way.with_bounds(self.farthest_off(u64::from(way.end - way.begin), u64::from(way.straight)));
            if near.is_some_and(|near| !way.reaches(near)) {
                return None;
            }
        }
        if way.is_young && diffusion.rises() {
            self.rise(diffusion, whole, &mut way, step, most);
        }
        Some(way)
    }

    /// The heights of a part that is near, where their draws are dear: most are far, whatever their height.
    fn rise(&self, diffusion: &Diffusion, whole: &Way, part: &mut Way, step: u64, most: u32) {
        let mut way = *whole;
        while way.end - way.begin > most {
            let half = self.half(&way, step);
            if let Some(halved) = &half.halved {
                let off = halved.rise * diffusion.early_rise(&way.filament, u64::from(half.middle));
                let f = &mut way.filament;
                (f.z, f.velocity[2]) = halved.moved((f.z, f.velocity[2]), off);
            }
            half.take(&mut way);
        }
        (part.filament.z, part.filament.velocity[2]) = (way.filament.z, way.filament.velocity[2]);
    }

    /// The half of a way in which a step is.
    #[inline]
    fn half(&self, way: &Way, step: u64) -> PartOfWay {
        let middle = way.begin.midpoint(way.end);
        let depth = (way.end - middle).ilog2() as usize;
        let Half { time: after, per_time, mut spread, mut rise, .. } = self.halves[depth.min(DEEPEST - 1)];
        let before = way.time - after;
        let mut per_before = per_time;
        let is_first = step < u64::from(middle);
        if before < 0.999 * after {
            // Released in the second half.
            if before <= 0.0 {
                return PartOfWay { middle, is_first: false, time: way.time, halved: None };
            }
            let variance = 2.0 * before * after / way.time;
            (spread, rise) = ((variance * self.diffusivity.0).sqrt(), (variance * self.diffusivity.1).sqrt());
            per_before = 1.0 / before;
        }
        let halved = Halved {
            after: is_first.then_some(after),
            spread,
            rise,
            per_time: if is_first { per_before } else { per_time },
        };
        PartOfWay { middle, is_first, time: if is_first { before } else { after }, halved: Some(halved) }
    }

    /// How far off its line in so many steps a filament can be along an axis, m, that goes straight on in parts of them.
    pub fn farthest_off(&self, steps: u64, straight: u64) -> f64 {
        // The halves are off by a geometric series.
        let root = |steps: u64| self.halves[(steps.max(1).ilog2() as usize).min(DEEPEST - 1)].off;
        (root(steps) - root(straight)).max(0.0)
    }
}

/// The half of a way in which a step is: the first or the second, and how long it lasts, s.
struct PartOfWay {
    middle: u32,
    is_first: bool,
    time: f64,
    /// None of a filament that is released in the second half, of which the way is the whole.
    halved: Option<Halved>,
}

/// How the ends of a way are moved to those of its half.
struct Halved {
    /// Of the first half: how long the second lasts, s.
    after: Option<f64>,
    /// The deviations of the place half-way, horizontally and up and down, m.
    spread: f64,
    rise: f64,
    /// The inverse of the half's time, 1/s.
    per_time: f64,
}

impl Halved {
    /// A coordinate at the end of a half, and its velocity, of those of the whole, where half-way it is so far off the line, m.
    #[inline]
    fn moved(&self, (end, velocity): (f64, f64), off: f64) -> (f64, f64) {
        match self.after {
            Some(after) => (end - after * velocity + off, velocity + off * self.per_time),
            None => (end, velocity - off * self.per_time),
        }
    }
}

impl PartOfWay {
    /// Makes of a way its half, but for the filament's place.
    #[inline]
    fn take(&self, way: &mut Way) {
        if self.is_first {
            way.end = self.middle;
        } else {
            way.begin = self.middle;
        }
        way.time = self.time;
    }
}

impl Way {
    /// The same with the bounds of where it reads anything, so far off its straight line along an axis at most, m.
    #[inline]
    fn with_bounds(mut self, off: f64) -> Self {
        let (half, f) = (0.5 * self.time, &self.filament);
        self.middle = [f.x - half * f.velocity[0], f.y - half * f.velocity[1]];
        let aside = off + self.reach;
        self.extent = [aside + half * f.velocity[0].abs(), aside + half * f.velocity[1].abs()];
        self
    }

    /// Whether it may reach something near along both axes.
    #[inline]
    pub fn reaches(&self, near: Near) -> bool {
        (0..2).all(|axis| (self.middle[axis] - near.center[axis]).abs() <= near.within + self.extent[axis])
    }

    /// The step of the plume with which it ends.
    pub fn end(&self) -> u64 {
        u64::from(self.end)
    }

    /// The last step of a part that goes straight on, which ends so many seconds later than that step.
    pub fn last_step(&self, later: f64, step_s: f64) -> Way {
        Way { filament: self.filament.back(later), time: step_s, ..*self }.with_bounds(0.0)
    }
}
