//! What the vehicle's own navigation is made of: the compass, the Doppler log that it turns, what an inertial unit adds, and the position that
//! comes of them.

use super::compass::MagneticCompass;
use super::dvl::DopplerLog;
use super::inertial::{InertialSuite, departure, ground_velocity};
use super::positioning::Positioning;
use super::raw::RawSample;
use super::{Instrument, InstrumentSetup, Surroundings};
use crate::craft::fault::Faults;
use crate::craft::hull::{Misjudged, Motion, StartPose, State, Track};
use crate::craft::setup::HullSetup;
use crate::world::World;
use albacore_geometry::{Heading, Point, Vector, wrap_angle};
use albacore_navigation::{ErrorEllipse, Estimate, Inertial, InertialSettings};
use albacore_vehicle::measurements::{
    COURSE, DEPTH, HEADING, NAVIGATION_STATE, POSITION, SALINITY, SIGMA_MAJOR, SIGMA_MINOR, SIGMA_TOWARD, SPEED,
    TEMPERATURE,
};
use albacore_vehicle::{NavigationErrors, Sample, Snapshot};

/// Ticks between what is told of how well the position is known: a second.
const UNCERTAINTY_TICKS: u64 = 10;

/// Compass, Doppler log and position, of which each needs another.
#[derive(Clone, Debug)]
pub struct OnboardNavigation {
    compass: MagneticCompass,
    dvl: DopplerLog,
    positioning: Positioning,
    /// The instruments of an inertial navigator, where the vehicle has one.
    suite: Option<InertialSuite>,
    /// What came in a tick as it was measured.
    raw: Vec<RawSample>,
}

impl OnboardNavigation {
    /// That of a run.
    pub fn new(setup: &InstrumentSetup, hull: &HullSetup, world: &World, start: &StartPose, seed: u64) -> Self {
        let inertial = setup.inertial();
        let sigma = inertial.map_or(0.0, |InertialSettings { start, .. }| *start);
        let departure = departure(setup, world, start, sigma, seed);
        OnboardNavigation {
            compass: MagneticCompass::new(&setup.compass, seed),
            dvl: DopplerLog::new(&setup.dvl, seed),
            positioning: Positioning::new(setup.navigation.as_ref(), setup.gps.as_ref(), &departure, seed),
            suite: inertial.map(|settings| InertialSuite::new(setup, hull, settings, seed)),
            raw: Vec::new(),
        }
    }

    /// Lets one tick go by, in which the vehicle moved and came to an altitude (m).
    pub fn step(&mut self, step: &Step, world: &World, faults: &mut Faults) {
        let Step { tick, motion, altitude, track } = *step;
        let velocity = || self.velocity(tick, motion.ground_velocity, motion.heading);
        let measured = self.dvl.has_lock(altitude).then(velocity);
        let heading = self.compass(tick, motion.heading);
        self.positioning.reckon(tick, measured, heading);
        self.raw.clear();
        if let (Some(suite), Some(track)) = (&self.suite, track) {
            suite.measure(tick, track, altitude, world, &mut self.raw);
        }
        self.positioning.measure(tick, motion.position, motion.depth, &mut self.raw);
        faults.filter_raw(tick, &mut self.raw);
        if let (Some(suite), Some(navigator), Some(track)) = (&mut self.suite, self.positioning.navigator(), track) {
            suite.feed(tick, &self.raw, track, navigator);
        }
        self.positioning.take(&self.raw);
    }

    /// Hears what the vehicle is told at a tick, faults and all: of the water.
    pub fn hear(&mut self, told: &[Sample]) {
        let last = |measurement| told.iter().rfind(|s| s.measurement == measurement).map(|s| s.reading[0]);
        if let (Some(temperature), Some(salinity)) = (last(TEMPERATURE), last(SALINITY))
            && let (Some(suite), Some(navigator)) = (&self.suite, self.positioning.navigator())
            && let Some(inertial) = navigator.inertial_mut()
        {
            suite.hear(inertial, temperature, salinity);
        }
    }

    /// Where it believes that a vehicle is which is at a place.
    pub fn belief(&self, truth: Point) -> Estimate {
        self.positioning.belief(truth)
    }

    /// All that it believes, where it is inertial.
    pub fn inertial(&self) -> Option<&Inertial> {
        self.positioning.inertial()
    }

    /// How far that is off, of a hull in a state.
    pub fn errors(&self, state: &State) -> Option<NavigationErrors> {
        Some(self.suite.as_ref()?.errors(self.inertial()?, state))
    }

    /// What an autopilot goes by that is told by an inertial navigator, of a hull in a state: heading, pitch, their rates and depth, and while an
    /// instrument contradicts the navigator the heading alone.
    pub fn misjudged(&self, state: &State) -> Option<Misjudged> {
        let inertial = self.inertial()?;
        let believed = inertial.state();
        let heading = wrap_angle(believed.attitude[2] - state.pose[5]);
        // While it is contradicted, and without gyroscopes to navigate by, an autopilot has gauges of its own.
        let Some(rates) = inertial.rates().filter(|_| !inertial.is_contradicted()) else {
            return Some(Misjudged { heading, ..Misjudged::default() });
        };
        Some(Misjudged {
            heading,
            pitch: believed.attitude[1] - state.pose[4],
            pitch_rate: rates[1] - state.velocity[4],
            yaw_rate: rates[2] - state.velocity[5],
            depth: believed.position[2] - state.pose[2],
        })
    }

    /// What it has noticed since this was last asked.
    pub fn take_notices(&mut self) -> Vec<String> {
        self.positioning.navigator().map_or_else(Vec::new, |navigator| navigator.take_notices())
    }

    /// Where the nose points at a tick on a heading, as the compass reads it or an inertial navigator has it.
    pub fn compass(&self, tick: u64, heading: Heading) -> Heading {
        match self.inertial() {
            Some(inertial) => Heading::from_radians(inertial.state().attitude[2]),
            None => heading + self.compass.error(tick, heading).unwrap_or(0.0),
        }
    }

    /// The velocity over ground as the Doppler log measures it and the compass turns it, m/s.
    fn velocity(&self, tick: u64, over_ground: Vector, heading: Heading) -> Vector {
        let velocity = self.dvl.imperfect(tick, over_ground, heading).unwrap_or(over_ground);
        match self.compass.error(tick, heading) {
            Some(error) => velocity.length() * (velocity.toward() + error).unit(),
            None => velocity,
        }
    }

    /// What an inertial navigator tells beside the position: at every tick, and once a second how well it knows that.
    fn tell_inertial(tick: u64, inertial: &Inertial, snapshot: &mut Snapshot) {
        let state = inertial.state();
        let velocity = ground_velocity(&state);
        snapshot.push(COURSE, &[velocity.toward().radians()]);
        snapshot.push(HEADING, &[Heading::from_radians(state.attitude[2]).radians()]);
        snapshot.push(SPEED, &[velocity.length()]);
        snapshot.push(DEPTH, &[state.position[2].max(0.0)]);
        if tick.is_multiple_of(UNCERTAINTY_TICKS) {
            let ErrorEllipse { major, minor, toward } = inertial.ellipse();
            snapshot.push(SIGMA_MAJOR, &[major]);
            snapshot.push(SIGMA_MINOR, &[minor]);
            snapshot.push(SIGMA_TOWARD, &[toward.radians()]);
            snapshot.push(NAVIGATION_STATE, &[f64::from(u8::from(inertial.is_doubted()))]);
        }
    }
}

impl Instrument for OnboardNavigation {
    fn measure(&mut self, around: &mut Surroundings, snapshot: &mut Snapshot) {
        let (tick, truth) = (around.tick, around.truth);
        let Estimate { position, sigma } = self.belief(truth.position);
        snapshot.push(POSITION, &[position.north, position.east, sigma]);
        if let Some(inertial) = self.inertial() {
            return Self::tell_inertial(tick, inertial, snapshot);
        }
        let velocity = self.velocity(tick, around.ground_velocity, truth.heading);
        let velocity = self.dvl.sample(tick, truth.altitude, velocity);
        if let Some(velocity) = velocity {
            snapshot.push(COURSE, &[velocity.toward().radians()]);
        }
        if let Some(heading) = self.compass.sample(tick, around.compass) {
            snapshot.push(HEADING, &[heading.radians()]);
        }
        if let Some(velocity) = velocity {
            snapshot.push(SPEED, &[velocity.length()]);
        }
    }
}

/// A tick as the instruments go through it.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a> {
    /// Which.
    pub tick: u64,
    /// Where it led.
    pub motion: &'a Motion,
    /// The height above the bottom there, m.
    pub altitude: f64,
    /// How the hull moved within it, where that is asked for.
    pub track: Option<&'a Track>,
}
