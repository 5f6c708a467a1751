//! The reading at a point: the sum over the filaments near it, found once a plume step for the whole neighbourhood.

use crate::world::plume::kernel::CUT_RADII;
use crate::world::plume::way::{Near, Way};
use crate::world::plume::{Filament, FilamentPlume};

/// Queries within this distance of each other in one step share one search, m: a vehicle's way in a step of 1 s.
const NEIGHBOURHOOD_M: f64 = 2.2;
/// A search looks through what a wider one has found, which is for so many steps of the plume and for all places within this distance of its
/// middle, m: the wider and the longer, the more it finds, and the fewer halves it knows. The widest comes first.
const WIDER: [(u64, f64); 2] = [(16, 14.0), (4, 6.5)];

/// Copies of the filaments that can matter within a neighbourhood during one step.
///
/// One vehicle asks ten times a step and within a few metres, so that one search a step, of those that wider ones have found in the
/// blocks of filaments that reach this far, costs less than the upkeep of a grid. It leaves out only what reads exactly zero and keeps the
/// order: the sum has the same bits as one over all filaments.
#[derive(Clone, Debug, Default)]
pub struct Nearby {
    center: [f64; 2],
    /// The plume's step that the search was made in; none before the first.
    step: Option<u64>,
    /// As they are at the end of that step.
    filaments: Vec<Filament>,
    wider: [Wide; WIDER.len()],
    /// The step with which the stride ends that all of it is of: before the first stride the last step is that with which it begins, too.
    until: u64,
}

/// The ways of all filaments that can matter farther round, during several steps.
#[derive(Clone, Debug, Default)]
struct Wide {
    center: [f64; 2],
    /// The first of the plume's steps that it was made for; none before the first search.
    first: Option<u64>,
    ways: Vec<Way>,
}

impl Nearby {
    /// The reading, as a ratio of full scale, at a place (m, in the flow frame; height above the bottom) and a time of the
    /// plume's last stride. It is not limited to full scale. Above the plume's layer it is zero.
    pub fn reading(&mut self, plume: &FilamentPlume, place: [f64; 3], time: f64) -> f64 {
        if plume.settings.layer.is_some_and(|ceiling| place[2] > ceiling) {
            return 0.0;
        }
        if self.until != plume.until {
            *self = Nearby { until: plume.until, ..Nearby::default() };
        }
        let [x, y, _] = place;
        let step = plume.step_at(time);
        if self.step != Some(step) || !is_within(NEIGHBOURHOOD_M, [x, y], self.center) {
            self.search(plume, [x, y], step);
        }
        let before = plume.time(step + 1) - time;
        let (initial, growth) = (plume.settings.initial_radius * plume.settings.initial_radius, plume.settings.growth);
        let mut sum = 0.0;
        for f in &self.filaments {
            let age = time - f.birth;
            // Most of them are too far away: what such a filament reads is exactly zero.
            let (dx, dy) = (f.x - before * f.velocity[0] - place[0], f.y - before * f.velocity[1] - place[1]);
            if age >= 0.0 && dx * dx + dy * dy <= CUT_RADII * CUT_RADII * (initial + growth * age) {
                sum += plume.origins[f.source as usize].kernel.reading(f, before, age, place);
            }
        }
        sum
    }

    fn search(&mut self, plume: &FilamentPlume, center: [f64; 2], step: u64) {
        (self.center, self.step) = (center, Some(step));
        for level in 0..WIDER.len() {
            let (wider, rest) = self.wider.split_at_mut(level);
            rest[0].search(plume, center, step, level, wider.last());
        }
        let step_s = plume.settings.step;
        let near = Near { center, within: NEIGHBOURHOOD_M };
        self.filaments.clear();
        let ways = self.wider.last().map_or(&[][..], |wide| &wide.ways);
        for way in ways {
            if let Some(part) = plume.bridge.part(&plume.origins, way, step, 1, Some(near)) {
                let of_step = part.last_step((part.end() as f64 - (step + 1) as f64) * step_s, step_s);
                if of_step.reaches(near) {
                    self.filaments.push(of_step.filament);
                }
            }
        }
    }
}

impl Wide {
    /// Searches for the steps of its level around a given one, through what a wider search has found or through the whole plume, unless
    /// what it found before still holds.
    fn search(&mut self, plume: &FilamentPlume, center: [f64; 2], step: u64, level: usize, wider: Option<&Wide>) {
        let (steps, distance) = WIDER[level];
        let steps = steps.min(plume.stride()).max(1);
        let first = step - step % steps;
        if self.first == Some(first) && is_within(distance, center, self.center) {
            return;
        }
        (self.center, self.first) = (center, Some(first));
        self.ways.clear();
        // What is searched within it has its middle within the distance of this, and so on.
        let near =
            Near { center, within: NEIGHBOURHOOD_M + WIDER[level..].iter().map(|(_, distance)| distance).sum::<f64>() };
        let part = |way: &Way| plume.bridge.part(&plume.origins, way, step, steps, Some(near));
        if let Some(wider) = wider {
            self.ways.extend(wider.ways.iter().filter_map(part));
            return;
        }
        // What no filament exceeds tells of most that they are far, sooner than their ways do.
        let aside = CUT_RADII * plume.largest_squared_radius().sqrt() + plume.bridge.farthest_off(plume.stride(), 1);
        let (most, half) = (near.within + aside, 0.5 * plume.stride() as f64 * plume.settings.step);
        for block in plume.blocks.iter().filter(|block| block.comes_near(center, most)) {
            let filaments = block.filaments.iter().filter(|f| f.comes_near(center, most, half));
            self.ways.extend(filaments.filter_map(|f| part(&plume.way(f))));
        }
    }
}

fn is_within(distance: f64, a: [f64; 2], b: [f64; 2]) -> bool {
    let (dx, dy) = (a[0] - b[0], a[1] - b[1]);
    dx * dx + dy * dy <= distance * distance
}
