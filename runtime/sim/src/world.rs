//! The world: all that is there without the vehicle, in time. Water that flows, what is dissolved in it, a chemical plume, a bottom.
//! For each of them what a scenario says of it, what of that cannot be, and its physics.

pub(crate) mod beacon;
pub(crate) mod bottom;
pub(crate) mod deepest;
pub(crate) mod front;
pub(crate) mod plume;
pub(crate) mod recorded;
pub(crate) mod simulated;
pub(crate) mod sound;
pub(crate) mod spill;
pub(crate) mod stratification;
pub(crate) mod survey;
pub(crate) mod transponder;
pub(crate) mod water;

use crate::scenario::{Scenario, ScenarioIssues};
use crate::world::beacon::Beacon;
use crate::world::bottom::{Bottom, Ground, NoGo, Pit, Plane, Seabed};
use crate::world::front::Front;
use crate::world::plume::{Leak, Patch, Plume, Source};
use crate::world::recorded::{Playback, RecordedPlume};
use crate::world::simulated::Simulated;
use crate::world::spill::{Slick, Spill};
use crate::world::stratification::Stratification;
use crate::world::survey::Survey;
use crate::world::transponder::Transponder;
use crate::world::water::{Flow, MeanFlow, Sea, Tide, Turning, UpperFlow, Waves};
use albacore_geometry::{Area, Point, Vector};
use albacore_vehicle::TICK_S;
use serde::Deserialize;

/// What a scenario says of all that is there without the vehicle.
///
/// The default is still water, 20 m deep, without a plume.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Environment {
    /// Where the flow meanders and filaments live, widened by [`crate::Meander::margin`]. A meander or a plume needs it.
    pub region: Option<Area>,
    /// The water's motion.
    pub flow: Flow,
    /// Its temperature and salinity.
    pub stratification: Stratification,
    /// The water's depth.
    pub bottom: Bottom,
    /// Where the vehicle must not be.
    pub no_go: Vec<NoGo>,
    /// A beacon; none: there is none to be heard.
    pub beacon: Option<Beacon>,
    /// A transponder; none: there is none to be heard.
    pub transponder: Option<Transponder>,
    /// How the chemical spreads; none: the chemical sensor reads only its noise.
    pub plume: Option<Plume>,
    /// What releases chemical.
    pub sources: Vec<Source>,
    /// What was left in the water before the run.
    pub patches: Vec<Patch>,
    /// Chemical within an outline.
    pub spills: Vec<Spill>,
    /// A plume that was computed elsewhere, and the flow that carries it, instead of those of our own.
    pub recording: Option<RecordedPlume>,
}

/// The clauses of the environment, by their names in a script, and what each sets.
macro_rules! clauses {
    ($($name:literal $clause:ident($settings:ty) => |$environment:ident, $given:ident| $set:expr;)*) => {
        /// A clause of a scenario that says how its environment is.
        #[derive(Clone, Debug, Deserialize)]
        #[allow(missing_docs, reason = "the standard library says what each clause is")]
        pub enum EnvironmentSetting { $(#[serde(rename = $name)] $clause($settings)),* }

        impl EnvironmentSetting {
            /// The names of the clauses.
            pub const NAMES: [&str; [$($name),*].len()] = [$($name),*];
        }

        impl Environment {
            /// Takes in a clause. What there is one of is as the last clause says.
            pub(crate) fn set(&mut self, setting: EnvironmentSetting) {
                match setting {
                    $(EnvironmentSetting::$clause($given) => {
                        let $environment = self;
                        $set;
                    })*
                }
            }
        }
    };
}

clauses! {
    "flow" Flow(MeanFlow) => |of, flow| (of.flow.mean, of.flow.meander) = flow.into();
    "turning" Turning(Turning) => |of, turning| of.flow.turning = turning.rate;
    "tide" Tide(Tide) => |of, tide| of.flow.tides.push(tide);
    "waves" Waves(Waves) => |of, waves| of.flow.waves = Some(waves);
    "upper_layer" UpperLayer(UpperFlow) => |of, upper| of.flow.upper = Some(upper);
    "stratification" Stratification(Stratification) => |of, layers| of.stratification = Stratification {
        front: of.stratification.front.take(),
        ..layers
    };
    "front" Front(Front) => |of, front| of.stratification.front = Some(front);
    "region" Region(Region) => |of, region| of.region = Some(region.area);
    "bottom" Bottom(Plane) => |of, plane| of.bottom.ground = Ground::Plane(plane);
    "pit" Pit(Pit) => |of, pit| of.bottom.pits.push(pit);
    "no_go" NoGo(NoGo) => |of, zone| of.no_go.push(zone);
    "beacon" Beacon(Beacon) => |of, beacon| of.beacon = Some(beacon);
    "transponder" Transponder(Transponder) => |of, transponder| of.transponder = Some(transponder);
    "plume" Plume(Plume) => |of, plume| of.plume = Some(plume);
    "source" Source(Source) => |of, source| of.sources.push(source);
    "leak" Leak(Leak) => |of, leak| of.sources.push(leak.into());
    "patch" Patch(Patch) => |of, patch| of.patches.push(patch);
    "spill" Spill(Spill) => |of, spill| of.spills.push(spill);
}

/// Where the flow meanders and filaments live.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Region {
    area: Area,
}

impl Environment {
    /// The clauses that may stand several times, and how many there are of each.
    pub(crate) fn counts(&self) -> [(&'static str, usize); 7] {
        let leaks = self.sources.iter().filter(|source| source.to.is_some()).count();
        [
            ("tide", self.flow.tides.len()),
            ("pit", self.bottom.pits.len()),
            ("no_go", self.no_go.len()),
            ("source", self.sources.len() - leaks),
            ("leak", leaks),
            ("patch", self.patches.len()),
            ("spill", self.spills.len()),
        ]
    }
}

/// What of the environment cannot be.
pub(crate) fn check(scenario: &Scenario, objections: &mut ScenarioIssues) {
    water::check(scenario, objections);
    stratification::check(scenario, objections);
    bottom::check(scenario, objections);
    beacon::check(scenario, objections);
    transponder::check(scenario, objections);
    spill::check(scenario, objections);
    // An area that was read from a file has not met its constructor.
    if let Some(Err(error)) = scenario.environment.region.as_ref().map(|region| Area::polygon(region.corners())) {
        let mut of = objections.of("region");
        of.unless(Some("area"), false, error.to_string(), "give its corners one after the other, round it");
    }
    for (i, zone) in scenario.environment.no_go.iter().enumerate() {
        if let Err(error) = Area::polygon(zone.area.corners()) {
            let mut of = objections.nth("no_go", i);
            of.unless(Some("area"), false, error.to_string(), "give its corners one after the other, round it");
        }
    }
    // What follows looks at the region and the flow's direction.
    if objections.0.is_empty() {
        water::check_meander(scenario, objections);
        plume::check(scenario, objections);
        plume::check_sources(scenario, objections);
        recorded::check(scenario, objections);
    }
}

/// The world of a run.
#[derive(Clone, Debug)]
pub struct World {
    carrier: Carrier,
    upper: Option<UpperFlow>,
    sea: Option<Sea>,
    stratification: Stratification,
    bottom: Seabed,
    beacon: Option<Beacon>,
    transponder: Option<Transponder>,
    slicks: Vec<Slick>,
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
        let carrier = match &scenario.environment.recording {
            Some(recording) => Carrier::Recorded(Box::new(Playback::new(recording, seed))),
            None => Carrier::Simulated(Box::new(Simulated::new(scenario, seed))),
        };
        let (upper, bottom) = (scenario.environment.flow.upper.clone(), scenario.environment.bottom.clone());
        let depth = bottom.depth_at(scenario.vehicle.start);
        let sea = scenario.environment.flow.waves.as_ref().map(|waves| Sea::new(waves, depth, seed));
        let stratification = scenario.environment.stratification.clone();
        let (beacon, transponder) = (scenario.environment.beacon.clone(), scenario.environment.transponder.clone());
        let slicks = Slick::all(&scenario.environment.spills, seed);
        World { carrier, upper, sea, stratification, bottom: Seabed::new(bottom), beacon, transponder, slicks }
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

    /// Where its beacon is at a time, s of the run, if it has one.
    pub fn beacon(&self, time: f64) -> Option<Point> {
        self.beacon.as_ref().map(|beacon| beacon.position(time))
    }

    /// Its transponder, if it has one.
    pub fn transponder(&self) -> Option<&Transponder> {
        self.transponder.as_ref()
    }

    /// The water's depth, m.
    pub fn water_depth(&self, p: Point) -> f64 {
        self.bottom.depth_at(p)
    }

    /// The concentration, as a ratio of the chemical sensor's full scale, at a point, a height above the bottom (m) and a
    /// time within the last tick.
    pub fn concentration(&mut self, p: Point, height: f64, time: f64) -> f64 {
        let carried = match &mut self.carrier {
            Carrier::Simulated(own) => own.concentration(p, height, time),
            Carrier::Recorded(playback) => playback.reading(p, time),
        };
        carried + self.spilled(p, time)
    }

    /// The chemical at a time within the last tick, for looks at many places.
    pub fn survey(&self, time: f64) -> Survey {
        match &self.carrier {
            Carrier::Simulated(own) => own.survey(&self.slicks, time),
            Carrier::Recorded(playback) => Survey::recorded(playback.still(time)),
        }
    }

    /// The concentration by the plainest means, that the others are held to: it searches the whole plume.
    pub fn look_up(&self, p: Point, height: f64, time: f64) -> f64 {
        let carried = match &self.carrier {
            Carrier::Simulated(own) => own.look_up(p, height, time),
            Carrier::Recorded(playback) => playback.look_up(p, time),
        };
        carried + self.spilled(p, time)
    }

    /// What of the concentration is of spills.
    fn spilled(&self, p: Point, time: f64) -> f64 {
        self.slicks.iter().map(|slick| slick.concentration(p, time)).sum()
    }

    /// Its spills.
    pub fn slicks(&self) -> &[Slick] {
        &self.slicks
    }

    /// The filaments alive at a time within the last tick: where they are and their radii, m.
    pub fn filaments(&self, time: f64) -> Box<dyn Iterator<Item = (Point, f64)> + '_> {
        match &self.carrier {
            Carrier::Simulated(own) => Box::new(own.filaments(time)),
            Carrier::Recorded(playback) => Box::new(playback.filaments(time)),
        }
    }
}
