//! The reading at a point: the sum over the filaments near it, found once a plume step for the whole neighbourhood.

use crate::world::plume::kernel::CUT_RADII;
use crate::world::plume::{Filament, FilamentPlume};

/// Queries within this distance of each other in one step share one search, m: a vehicle's way in a step of 1 s.
const NEIGHBOURHOOD_M: f64 = 3.0;

/// Copies of the filaments that can matter within a neighbourhood during one step.
///
/// One vehicle asks ten times a step and within a few metres, so that one search a step, of the blocks of filaments that
/// reach this far, costs less than the upkeep of a grid. It leaves out only what reads exactly zero and keeps the order: the
/// sum has the same bits as one over all filaments.
#[derive(Clone, Debug, Default)]
pub struct Nearby {
    center: [f64; 2],
    /// The plume's step that the search was made in; 0 before the first.
    steps: u64,
    /// As they are at the end of that step.
    filaments: Vec<Filament>,
}

impl Nearby {
    /// The reading, as a ratio of full scale, at a place (m, in the flow frame; height above the bottom) and a time of the
    /// plume's last step. It is not limited to full scale. Above the plume's layer it is zero.
    pub fn reading(&mut self, plume: &FilamentPlume, place: [f64; 3], time: f64) -> f64 {
        if plume.settings.layer.is_some_and(|ceiling| place[2] > ceiling) {
            return 0.0;
        }
        let [x, y, _] = place;
        let (dx, dy) = (x - self.center[0], y - self.center[1]);
        if self.steps != plume.steps || dx * dx + dy * dy > NEIGHBOURHOOD_M * NEIGHBOURHOOD_M {
            self.search(plume, [x, y]);
        }
        let before = plume.end - time;
        let mut sum = 0.0;
        for f in &self.filaments {
            let age = time - f.birth;
            if age >= 0.0 {
                sum += plume.origins[f.source as usize].kernel.reading(f, before, age, place);
            }
        }
        sum
    }

    fn search(&mut self, plume: &FilamentPlume, center: [f64; 2]) {
        (self.center, self.steps) = (center, plume.steps);
        let reach = NEIGHBOURHOOD_M + CUT_RADII * plume.largest_squared_radius().sqrt();
        let half = 0.5 * plume.step;
        // The interval of a coordinate over the step: its middle, give or take half the way.
        let within = |end: f64, velocity: f64, center: f64| {
            (end - half * velocity - center).abs() <= reach + half * velocity.abs()
        };
        self.filaments.clear();
        for block in plume.blocks.iter().filter(|block| block.is_between(center[0] - reach, center[0] + reach)) {
            let before = block.end - plume.end;
            let alongside = block.filaments.iter().map(|f| f.back(before));
            self.filaments.extend(
                alongside.filter(|f| within(f.x, f.velocity[0], center[0]) && within(f.y, f.velocity[1], center[1])),
            );
        }
    }
}
