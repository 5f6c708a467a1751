//! An acoustic transponder that answers a vehicle's receivers: where it is, when it is heard, and how fast its sound is.

use super::sound::sound_speed;
use super::stratification::Stratification;
use crate::scenario::{Scenario, ScenarioIssues};
use albacore_geometry::{Point, Vector};
use serde::Deserialize;

/// A transponder. Its place is known; that it drifts is not.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Transponder {
    /// Where it is when a run begins.
    pub at: Point,
    /// And how deep, m.
    pub depth: f64,
    /// Where it drifts, m/s toward. Default nowhere.
    pub drift: Vector,
    /// It is heard for so long, s, ...
    pub heard: Option<f64>,
    /// ... and then silent for so long, s, by turns. Default never.
    pub silent: f64,
    /// How fast sound is between it and the vehicle, m/s. Default as temperature, salinity and depth at the vehicle make it.
    pub sound_speed: Option<f64>,
}

impl Transponder {
    /// Where it is at a time, s of the run: north, east and down, m.
    pub fn place(&self, time: f64) -> [f64; 3] {
        let Point { north, east } = self.at + time * self.drift;
        [north, east, self.depth]
    }

    /// Whether it is heard at a time, s of the run.
    pub fn is_heard(&self, time: f64) -> bool {
        self.heard.is_none_or(|heard| time.rem_euclid(heard + self.silent) < heard)
    }

    /// How fast its sound is to a vehicle at a place, a depth (m) and a time (s of the run), m/s.
    pub fn sound_speed(&self, water: &Stratification, p: Point, depth: f64, time: f64) -> f64 {
        self.sound_speed.unwrap_or_else(|| {
            let (temperature, salinity) = water.at(p, depth, time);
            sound_speed(temperature, salinity, depth)
        })
    }
}

/// No transponder drifts faster, m/s.
const DRIFT_MAX: f64 = 1.0;

/// What of it cannot be.
pub(crate) fn check(scenario: &Scenario, objections: &mut ScenarioIssues) {
    let Some(transponder) = &scenario.environment.transponder else { return };
    objections.of("transponder").at_most("drift", transponder.drift.length(), DRIFT_MAX);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_heard_and_silent_by_turns() {
        let transponder = Transponder {
            at: Point::new(10.0, 20.0),
            depth: 2.0,
            drift: Vector::new(0.1, 0.0),
            heard: Some(50.0),
            silent: 50.0,
            sound_speed: None,
        };
        assert_eq!(
            [0.0, 49.9, 50.0, 99.9, 100.0].map(|time| transponder.is_heard(time)),
            [true, true, false, false, true]
        );
        assert_eq!(transponder.place(100.0), [20.0, 20.0, 2.0]);
    }
}
