//! A spill: chemical within an outline, such as oil or dye, rather than filaments that a source releases.
//!
//! Its outline is that of Jayasiri et al. (2016), an ellipse (Sec. 4.1) or a circle that is deformed by Fourier orders (Eq. 23).

mod outline;
mod roughness;

pub use outline::Outline;

use crate::noise::Noise;
use crate::scenario::{Scenario, ScenarioIssues, number};
use albacore_geometry::math::{exp, tanh};
use albacore_geometry::{Area, Heading, Point, Vector};
use outline::Radii;
use roughness::Roughness;
use serde::Deserialize;
use std::f64::consts::{FRAC_PI_2, LN_2};

/// Chemical within an outline, at every depth alike.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Spill {
    /// What it is called.
    pub name: String,
    /// The shape of its outline when the run begins.
    pub shape: Outline,
    /// Its centre when the run begins.
    pub at: Point,
    /// What the chemical sensor reads well inside, ratio of full scale.
    pub level: f64,
    /// How wide its edge is, m: on its outline the chemical changes as if all of the change were evenly spread over so much.
    pub edge: f64,
    /// How all of it moves, m/s toward.
    pub drift: Vector,
    /// How fast it is sheared, 1/s: what lies a metre to starboard of the line through its centre moves so much faster along that.
    pub shear: f64,
    /// The direction of that line.
    pub shear_along: Heading,
    /// In this time half of the chemical is gone, s.
    pub half_life: Option<f64>,
    /// How far its edge is off its outline, m: a standard deviation.
    pub roughness: f64,
    /// How far apart the edge is off otherwise, m.
    pub grain: f64,
    /// ... and how much later, s.
    pub flicker: f64,
}

/// An ellipse is so many times as long as wide at most: its outline is known at each degree about its centre.
const SLENDER_MAX: f64 = 20.0;

/// What of the spills cannot be.
pub(crate) fn check(scenario: &Scenario, objections: &mut ScenarioIssues) {
    let spills = &scenario.environment.spills;
    for (i, spill) in spills.iter().enumerate() {
        let mut of = objections.nth("spill", i);
        of.name(&spill.name, &spills[..i].iter().map(|other| other.name.as_str()).collect::<Vec<_>>());
        of.flow("drift", spill.drift);
        if let Outline::Ellipse { length, width, .. } = spill.shape {
            of.unless(
                Some("width"),
                length.max(width) <= SLENDER_MAX * length.min(width),
                format!("an ellipse of {} m by {} m is too slender to be a spill", number(length), number(width)),
                format!("make its longer axis {SLENDER_MAX} times the shorter one at most"),
            );
        }
        of.unless(
            None,
            scenario.environment.recording.is_none(),
            "a `recorded_plume` is the chemical of its world: there is no `spill` beside it",
            "leave one of them out",
        );
    }
}

/// A spill of a run: its outline is that of the run's seed.
#[derive(Clone, Debug)]
pub struct Slick {
    spill: Spill,
    radii: Radii,
    roughness: Option<Roughness>,
}

impl Slick {
    /// Those of a scenario, each with its number among them.
    pub fn all(spills: &[Spill], seed: u64) -> Vec<Slick> {
        spills.iter().zip(0..).map(|(spill, number)| Slick::new(spill, number, seed)).collect()
    }

    fn new(spill: &Spill, number: u32, seed: u64) -> Self {
        let noise = |what: &str| Noise::named(seed, &format!("{what} of spill {number}"));
        let roughness = (spill.roughness > 0.0)
            .then(|| Roughness::new(spill.roughness, spill.grain, spill.flicker, noise("roughness")));
        Slick { radii: Radii::new(&spill.shape, noise("outline")), roughness, spill: spill.clone() }
    }

    /// What it is called.
    pub fn name(&self) -> &str {
        &self.spill.name
    }

    /// How fast what lies so far from its centre is carried by the shear, per unit of time.
    fn sheared(&self, from_centre: Vector) -> Vector {
        let across = from_centre.dot((self.spill.shear_along + FRAC_PI_2).unit());
        self.spill.shear * across * self.spill.shear_along.unit()
    }

    fn centre(&self, time: f64) -> Point {
        self.spill.at + time * self.spill.drift
    }

    /// What a perfect chemical sensor would read of it at a place and a time (s of the run), ratio of full scale.
    pub fn concentration(&self, p: Point, time: f64) -> f64 {
        let now = p - self.centre(time);
        // The shear is along itself: what lies across does not change, and it is undone as it was done.
        let before = now - time * self.sheared(now);
        let rough = self.roughness.as_ref().map_or(0.0, |roughness| roughness.at(before, time));
        let inside = self.radii.inside(before) + rough;
        let share = match self.spill.edge {
            edge if edge > 0.0 => 0.5 * (1.0 + tanh(2.0 * inside / edge)),
            _ => f64::from(u8::from(inside >= 0.0)),
        };
        self.spill.level * share * self.left(time).unwrap_or(1.0)
    }

    /// What share of it is left at a time (s of the run); none where it stays.
    pub fn left(&self, time: f64) -> Option<f64> {
        self.spill.half_life.map(|half_life| exp(-LN_2 * time / half_life))
    }

    /// In what time half of it is gone, s; none where it stays.
    pub fn half_life(&self) -> Option<f64> {
        self.spill.half_life
    }

    /// Its outline at a time (s of the run), clockwise, without its roughness: there a sensor reads half of what it does inside. None where it is no area any
    /// more, because shear has drawn it out.
    pub fn outline(&self, time: f64) -> Option<Area> {
        Area::polygon(&self.corners(time)).ok()
    }

    /// The corners of that outline, whatever they make.
    pub fn corners(&self, time: f64) -> Vec<Point> {
        self.radii.corners().map(|before| self.centre(time) + before + time * self.sheared(before)).collect()
    }

    /// How fast each of its corners moves, m/s: all the time alike.
    pub fn motion(&self) -> impl Iterator<Item = Vector> + '_ {
        self.radii.corners().map(|before| self.spill.drift + self.sheared(before))
    }
}

#[cfg(test)]
mod tests;
