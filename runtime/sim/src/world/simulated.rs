//! Water and plume as they are computed while a run goes on.

use crate::scenario::Scenario;
use crate::world::plume::{FilamentPlume, Index, Nearby, ahead as plume_ahead, spin_up_begin};
use crate::world::spill::Slick;
use crate::world::survey::Survey;
use crate::world::water::Water;
use albacore_geometry::{Point, Vector};
use albacore_vehicle::TICK_S;

/// The moving water, and the plume that it carries.
#[derive(Clone, Debug)]
pub struct Simulated {
    water: Water,
    plume: Option<FilamentPlume>,
    nearby: Nearby,
}

impl Simulated {
    /// Those of a valid scenario at tick 0, with its flow wandering and its plume spread.
    pub fn new(scenario: &Scenario, seed: u64) -> Self {
        let (begin, behind) = (spin_up_begin(scenario), plume_ahead(scenario));
        let (flow, region) = (&scenario.environment.flow, scenario.environment.region.as_ref());
        let mut water = Water::new(flow, region, begin, behind, seed);
        let mut plume = FilamentPlume::new(scenario, water.frame(), begin, seed);
        if let Some(plume) = &mut plume {
            plume.spin_up(&mut water, &scenario.environment.patches, seed);
        }
        Simulated { water, plume, nearby: Nearby::default() }
    }

    /// Makes both known up to a tick.
    pub fn advance_to(&mut self, tick: u64) {
        self.water.advance_to(tick as f64 * TICK_S);
        if let Some(plume) = &mut self.plume {
            plume.advance_to(tick, &mut self.water);
        }
    }

    /// The water's velocity, m/s toward, at a point and a time within the last tick.
    pub fn flow(&self, p: Point, time: f64) -> Vector {
        self.water.velocity(p, time)
    }

    /// The concentration, as a ratio of the chemical sensor's full scale, at a point, a height above the bottom (m) and a
    /// time within the last tick.
    pub fn concentration(&mut self, p: Point, height: f64, time: f64) -> f64 {
        let Some(plume) = &self.plume else { return 0.0 };
        let (x, y) = self.water.frame().to_local(p);
        self.nearby.reading(plume, [x, y, height], time)
    }

    /// The chemical at a time within the last tick, for looks at many places.
    pub fn survey(&self, slicks: &[Slick], time: f64) -> Survey {
        let index = self.plume.as_ref().map(|plume| Index::new(plume, time));
        Survey::simulated(self.water.frame(), index, slicks, time)
    }

    /// The concentration by the plainest means, that the others are held to: it searches the whole plume.
    pub fn look_up(&self, p: Point, height: f64, time: f64) -> f64 {
        let (x, y) = self.water.frame().to_local(p);
        self.plume.as_ref().map_or(0.0, |plume| Nearby::default().reading(plume, [x, y, height], time))
    }

    /// The filaments alive at a time within the last tick: where they are and their radii, m.
    pub fn filaments(&self, time: f64) -> impl Iterator<Item = (Point, f64)> + '_ {
        let frame = self.water.frame();
        let alive = self.plume.iter().flat_map(move |plume| plume.alive(time));
        alive.map(|([x, y, _], radius)| (frame.to_point(x, y), radius))
    }
}
