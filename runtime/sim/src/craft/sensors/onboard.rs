//! What the vehicle's own navigation is made of: the compass, the Doppler log that it turns, and the position that comes of both.

use super::compass::MagneticCompass;
use super::dvl::DopplerLog;
use super::positioning::Positioning;
use super::{Instrument, InstrumentSetup, Surroundings};
use crate::craft::hull::Motion;
use albacore_geometry::{Heading, Point, Vector};
use albacore_navigation::Estimate;
use albacore_vehicle::Snapshot;
use albacore_vehicle::measurements::{COURSE, HEADING, POSITION, SPEED};

/// Compass, Doppler log and position, of which each needs another.
#[derive(Clone, Debug)]
pub struct OnboardNavigation {
    compass: MagneticCompass,
    dvl: DopplerLog,
    positioning: Positioning,
}

impl OnboardNavigation {
    /// That of a run, which begins at a place.
    pub fn new(setup: &InstrumentSetup, start: Point, seed: u64) -> Self {
        OnboardNavigation {
            compass: MagneticCompass::new(&setup.compass, seed),
            dvl: DopplerLog::new(&setup.dvl, seed),
            positioning: Positioning::new(setup.navigation.as_ref(), setup.gps.as_ref(), start, seed),
        }
    }

    /// Lets one tick go by, in which the vehicle moved and came to an altitude (m).
    pub fn step(&mut self, tick: u64, motion: &Motion, altitude: f64) {
        let velocity = || self.velocity(tick, motion.ground_velocity, motion.heading);
        let measured = self.dvl.has_lock(altitude).then(velocity);
        let heading = self.compass(tick, motion.heading);
        self.positioning.step(tick, measured, heading, motion.position, motion.depth);
    }

    /// Where it believes that a vehicle is which is at a place.
    pub fn belief(&self, truth: Point) -> Estimate {
        self.positioning.belief(truth)
    }

    /// What the compass reads at a tick on a heading.
    pub fn compass(&self, tick: u64, heading: Heading) -> Heading {
        heading + self.compass.error(tick, heading).unwrap_or(0.0)
    }

    /// The velocity over ground as the Doppler log measures it and the compass turns it, m/s.
    fn velocity(&self, tick: u64, over_ground: Vector, heading: Heading) -> Vector {
        let velocity = self.dvl.imperfect(tick, over_ground, heading).unwrap_or(over_ground);
        match self.compass.error(tick, heading) {
            Some(error) => velocity.length() * (velocity.toward() + error).unit(),
            None => velocity,
        }
    }
}

impl Instrument for OnboardNavigation {
    fn measure(&mut self, around: &mut Surroundings, snapshot: &mut Snapshot) {
        let (tick, truth) = (around.tick, around.truth);
        let Estimate { position, sigma } = self.belief(truth.position);
        snapshot.push(POSITION, &[position.north, position.east, sigma]);
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
