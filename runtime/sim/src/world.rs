//! The world: all that is there without the vehicle, in time. Water that flows, what is dissolved in it, a chemical plume, a bottom.
//! For each of them what a scenario says of it, what of that cannot be, and its physics.

pub(crate) mod bottom;
pub(crate) mod deepest;
pub(crate) mod plume;
pub(crate) mod recorded;
pub(crate) mod simulated;
pub(crate) mod stratification;
pub(crate) mod survey;
pub(crate) mod water;

use crate::scenario::Scenario;
use crate::world::bottom::Bottom;
use crate::world::recorded::Playback;
use crate::world::simulated::Simulated;
use crate::world::stratification::Stratification;
use crate::world::survey::Survey;
use crate::world::water::Sea;
use crate::world::water::UpperFlow;
use albacore_geometry::{Point, Vector};
use albacore_vehicle::TICK_S;

/// The world of a run.
#[derive(Clone, Debug)]
pub struct World {
    carrier: Carrier,
    upper: Option<UpperFlow>,
    sea: Option<Sea>,
    stratification: Stratification,
    bottom: Bottom,
}

/// The flow and the plume that it carries.
#[derive(Clone, Debug)]
enum Carrier {
    /// Computed as the run goes on.
    Simulated(Box<Simulated>),
    /// Computed elsewhere. It knows no heights.
    Recorded(Box<Playback>),
}

impl World {
    /// The world of a valid scenario at tick 0, with its flow wandering and its plume spread.
    pub fn new(scenario: &Scenario, seed: u64) -> Self {
        let carrier = match &scenario.recording {
            Some(recording) => Carrier::Recorded(Box::new(Playback::new(recording, seed))),
            None => Carrier::Simulated(Box::new(Simulated::new(scenario, seed))),
        };
        let (upper, bottom) = (scenario.flow.upper.clone(), scenario.bottom.clone());
        let depth = bottom.depth_at(scenario.vehicle.start);
        let sea = scenario.flow.waves.as_ref().map(|waves| Sea::new(waves, depth, seed));
        World { carrier, upper, sea, stratification: scenario.stratification.clone(), bottom }
    }

    /// Why the world cannot go on to a tick, if it cannot.
    pub fn end_before(&self, tick: u64) -> Option<String> {
        match &self.carrier {
            Carrier::Simulated(_) => None,
            Carrier::Recorded(playback) => playback.end_before(tick as f64 * TICK_S),
        }
    }

    /// Makes the world known up to a tick.
    pub fn advance_to(&mut self, tick: u64) {
        if let Carrier::Simulated(own) = &mut self.carrier {
            own.advance_to(tick);
        }
    }

    /// The water's velocity, m/s toward, at a point, a height above the bottom (m) and a time within the last tick: the flow,
    /// and the orbital motion of the waves.
    pub fn flow(&self, p: Point, height: f64, time: f64) -> Vector {
        let flow = match &self.upper {
            Some(upper) if height > upper.begins(time) => upper.mean,
            _ => self.carrying_flow(p, time),
        };
        self.sea.as_ref().map_or(flow, |sea| flow + sea.velocity(p, height, time))
    }

    /// The flow that carries the plume, m/s toward, at a point and a time within the last tick: below the upper layer, without
    /// waves.
    pub fn carrying_flow(&self, p: Point, time: f64) -> Vector {
        match &self.carrier {
            Carrier::Simulated(own) => own.flow(p, time),
            Carrier::Recorded(playback) => playback.flow(p, time),
        }
    }

    /// What waves make a pressure sensor read too deep, m, at a point, a height above the bottom (m) and a time.
    pub fn wave_head(&self, p: Point, height: f64, time: f64) -> f64 {
        self.sea.as_ref().map_or(0.0, |sea| sea.head(p, height, time))
    }

    /// Its temperature and salinity.
    pub fn stratification(&self) -> &Stratification {
        &self.stratification
    }

    /// The water's depth, m.
    pub fn water_depth(&self, p: Point) -> f64 {
        self.bottom.depth_at(p)
    }

    /// The concentration, as a ratio of the chemical sensor's full scale, at a point, a height above the bottom (m) and a
    /// time within the last tick.
    pub fn concentration(&mut self, p: Point, height: f64, time: f64) -> f64 {
        match &mut self.carrier {
            Carrier::Simulated(own) => own.concentration(p, height, time),
            Carrier::Recorded(playback) => playback.reading(p, time),
        }
    }

    /// The chemical at a time within the last tick, for looks at many places.
    pub fn survey(&self, time: f64) -> Survey {
        match &self.carrier {
            Carrier::Simulated(own) => own.survey(time),
            Carrier::Recorded(playback) => Survey::recorded(playback.still(time)),
        }
    }

    /// The concentration by the plainest means, that the others are held to: it searches the whole plume.
    pub fn look_up(&self, p: Point, height: f64, time: f64) -> f64 {
        match &self.carrier {
            Carrier::Simulated(own) => own.look_up(p, height, time),
            Carrier::Recorded(playback) => playback.look_up(p, time),
        }
    }

    /// The filaments alive at a time within the last tick: where they are and their radii, m.
    pub fn filaments(&self, time: f64) -> Box<dyn Iterator<Item = (Point, f64)> + '_> {
        match &self.carrier {
            Carrier::Simulated(own) => Box::new(own.filaments(time)),
            Carrier::Recorded(playback) => Box::new(playback.filaments(time)),
        }
    }
}
