//! All that is there without the vehicle: water, plume and bottom, in time.

use crate::plume::{Index, Nearby, Plume, spin_up_begin};
use crate::scenario::{Bottom, Scenario, UpperFlow};
use crate::survey::Survey;
use crate::water::{Sea, Water};
use albacore_geometry::{Point, Vector};
use albacore_vehicle::TICK_S;

/// The world of a run.
#[derive(Clone, Debug)]
pub struct World {
    water: Water,
    plume: Option<Plume>,
    nearby: Nearby,
    upper: Option<UpperFlow>,
    sea: Option<Sea>,
    bottom: Bottom,
}

impl World {
    /// The world of a valid scenario at tick 0, with its flow wandering and its plume spread.
    pub fn new(scenario: &Scenario, seed: u64) -> Self {
        let begin = spin_up_begin(scenario);
        let mut water = Water::new(&scenario.flow, scenario.region.as_ref(), begin, seed);
        let mut plume = Plume::new(scenario, water.frame(), begin, seed);
        if let Some(plume) = &mut plume {
            plume.spin_up(&mut water, &scenario.patches, seed);
        }
        let (upper, bottom) = (scenario.flow.upper.clone(), scenario.bottom.clone());
        let depth = bottom.depth_at(scenario.vehicle.start);
        let sea = scenario.flow.waves.as_ref().map(|waves| Sea::new(waves, depth, seed));
        World { water, plume, nearby: Nearby::default(), upper, sea, bottom }
    }

    /// Makes the world known up to a tick.
    pub fn advance_to(&mut self, tick: u64) {
        self.water.advance_to(tick as f64 * TICK_S);
        if let Some(plume) = &mut self.plume {
            plume.advance_to(tick, &mut self.water);
        }
    }

    /// The water's velocity, m/s toward, at a point, a height above the bottom (m) and a time within the last tick: the flow,
    /// and the orbital motion of the waves.
    pub fn flow(&self, p: Point, height: f64, time: f64) -> Vector {
        let flow = match &self.upper {
            Some(upper) if height > upper.begins(time) => upper.mean,
            _ => self.water.velocity(p, time),
        };
        self.sea.as_ref().map_or(flow, |sea| flow + sea.velocity(p, height, time))
    }

    /// What waves make a pressure sensor read too deep, m, at a point, a height above the bottom (m) and a time.
    pub fn wave_head(&self, p: Point, height: f64, time: f64) -> f64 {
        self.sea.as_ref().map_or(0.0, |sea| sea.head(p, height, time))
    }

    /// The water's depth, m.
    pub fn water_depth(&self, p: Point) -> f64 {
        self.bottom.depth_at(p)
    }

    /// The concentration, as a ratio of the chemical sensor's full scale, at a point, a height above the bottom (m) and a
    /// time within the last tick.
    pub fn concentration(&mut self, p: Point, height: f64, time: f64) -> f64 {
        let Some(plume) = &self.plume else { return 0.0 };
        let (x, y) = self.water.frame().to_local(p);
        self.nearby.reading(plume, [x, y, height], time)
    }

    /// The chemical at a time within the last tick, for looks at many places.
    pub fn survey(&self, time: f64) -> Survey {
        let index = self.plume.as_ref().map(|plume| Index::new(plume, time));
        Survey { frame: self.water.frame().clone(), index }
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
