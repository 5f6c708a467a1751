//! An unscented Kalman filter of the position, and of what turns and stretches the way that is reckoned.

use crate::navigator::{Estimate, Fix, Navigator, Sensed};
use crate::ukf::{Component, Measurement, Spread, Ukf, UkfError};
use albacore_geometry::math::{cos, ln, sin};
use albacore_geometry::{Point, Vector};
use nalgebra::{SMatrix, SVector};
use serde::Deserialize;

/// The states: where the vehicle is (m north and east), how far its compass is turned (rad, clockwise), and the error of its log (a share).
const STATES: usize = 4;
const NORTH: usize = 0;
const EAST: usize = 1;
const TURN: usize = 2;
const STRETCH: usize = 3;

const COMPONENTS: [Component; STATES] = [Component::Line, Component::Line, Component::Circle, Component::Line];

/// The start is known that well, m.
const START_SIGMA: f64 = 0.01;
/// Compass and log change by as much as they are off in this time, s.
const STEADY_S: f64 = 3600.0;
/// So many fixes in a row that are not believed are right, and the filter is not.
const DISBELIEVED_MAX: u32 = 4;

/// Where the vehicle is, by its reckoning and by fixes that each count as much as they are known: with the measured velocity over ground turned and
/// stretched by what fixes have told of compass and log. A fix too far off for its sigma and the filter's is not believed, unless too many in a row are:
/// then the filter begins anew there.
#[derive(Clone, Debug)]
pub struct Unscented {
    filter: Ukf<STATES>,
    /// Growth of the variance of the position, m2/s an axis, of the turn, rad2/s, and of the stretch, 1/s.
    growth: SVector<f64, STATES>,
    /// Normalised innovations squared above this are not believed.
    gate: f64,
    disbelieved: u32,
}

/// What it is told of the instruments.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Settings {
    /// The noise of the measured velocity, as the random walk that it integrates to, m/s^0.5; more than 0.
    pub walk: f64,
    /// How far the compass is turned, rad: a standard deviation, more than 0.
    pub turn: f64,
    /// How far off the log is, as a share: a standard deviation, more than 0.
    pub stretch: f64,
    /// The share of sound fixes that are believed, less than 1.
    pub believed: f64,
}

impl Unscented {
    /// Begins at a known point.
    ///
    /// # Errors
    ///
    /// Settings that make no filter: a standard deviation of 0, or what is not finite. The ranges of the clause leave them out.
    pub fn new(start: Point, settings: &Settings) -> Result<Self, UkfError> {
        let Settings { walk, turn, stretch, believed } = *settings;
        let deviations = SVector::from([START_SIGMA, START_SIGMA, turn, stretch]);
        let covariance = SMatrix::from_diagonal(&deviations.component_mul(&deviations));
        let state = SVector::from([start.north, start.east, 0.0, 0.0]);
        let steady = |deviation: f64| deviation * deviation / STEADY_S;
        Ok(Unscented {
            filter: Ukf::new(state, &covariance, Spread::default(), COMPONENTS)?,
            growth: SVector::from([walk * walk, walk * walk, steady(turn), steady(stretch)]),
            // The chi-square distribution of two degrees of freedom is an exponential one.
            gate: -2.0 * ln(1.0 - believed),
            disbelieved: 0,
        })
    }
}

/// The way over ground in some seconds: the compass that is turned makes the velocity turned as far.
fn way(state: &SVector<f64, STATES>, measured: Vector, time: f64) -> Vector {
    let (s, c) = (sin(state[TURN]), cos(state[TURN]));
    let true_velocity = Vector::new(c * measured.north + s * measured.east, c * measured.east - s * measured.north);
    (time * (1.0 - state[STRETCH])) * true_velocity
}

impl Navigator for Unscented {
    fn predict(&mut self, sensed: &Sensed, time: f64) {
        let process = |state: &SVector<f64, STATES>| {
            let way = way(state, sensed.ground_velocity, time);
            SVector::from([state[NORTH] + way.north, state[EAST] + way.east, state[TURN], state[STRETCH]])
        };
        // A velocity that is no number moves nothing: the filter is as it was.
        let _ = self.filter.predict(process, &SMatrix::from_diagonal(&(time * self.growth)));
    }

    fn update(&mut self, fix: &Fix) -> bool {
        let is_lost = self.disbelieved >= DISBELIEVED_MAX;
        if is_lost {
            // It may be as far off as the fix says, whatever it thought.
            let off = fix.position.distance(self.estimate().position);
            let doubt = SMatrix::from_diagonal(&SVector::from([off * off, off * off, 0.0, 0.0]));
            let _ = self.filter.predict(|state| *state, &doubt);
        }
        let measurement = Measurement {
            value: SVector::from([fix.position.north, fix.position.east]),
            // A fix without an error would leave nothing to weigh.
            noise: SMatrix::from_diagonal_element(fix.sigma.max(START_SIGMA) * fix.sigma.max(START_SIGMA)),
            components: [Component::Line; 2],
            gate: (!is_lost).then_some(self.gate),
        };
        let told = self.filter.update(&measurement, |state| SVector::from([state[NORTH], state[EAST]]));
        let is_believed = told.is_ok_and(|innovation| !innovation.gated);
        self.disbelieved = if is_believed { 0 } else { self.disbelieved + 1 };
        is_believed
    }

    fn estimate(&self) -> Estimate {
        let state = self.filter.state();
        let variance = 0.5 * (self.filter.variance(NORTH) + self.filter.variance(EAST));
        Estimate { position: Point::new(state[NORTH], state[EAST]), sigma: variance.sqrt() }
    }

    fn boxed(&self) -> Box<dyn Navigator> {
        Box::new(self.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use albacore_geometry::Heading;
    use albacore_geometry::math::radians;

    fn filter(walk: f64) -> Unscented {
        let settings = Settings { walk, turn: radians(3.0), stretch: 0.03, believed: 0.999 };
        Unscented::new(Point::ORIGIN, &settings).unwrap()
    }

    fn sensed(velocity: Vector) -> Sensed {
        Sensed { ground_velocity: velocity, heading: Heading::NORTH }
    }

    #[test]
    fn without_fixes_it_reckons_and_grows_unsure() {
        let mut filter = filter(0.05);
        (0..1200).for_each(|_| filter.predict(&sensed(Vector::new(2.0, 0.0)), 0.1));
        let Estimate { position, sigma } = filter.estimate();
        // A turn of 3 deg on 240 m is 12.6 m across, a stretch of 3 % 7.2 m along; a sine's mean is a little short.
        assert!(position.distance(Point::new(240.0, 0.0)) < 0.5, "{position:?}");
        assert!((sigma - (0.5f64 * (12.57 * 12.57 + 7.2 * 7.2)).sqrt()).abs() < 0.6, "{sigma}");
    }

    /// A compass turned by 2 degrees and a log that reads 2 % too much: exact fixes tell both, and the reckoning is right after them.
    #[test]
    fn fixes_tell_what_compass_and_log_are_off() {
        let mut filter = filter(0.02);
        let (mut truth, mut velocity) = (Point::ORIGIN, Vector::new(1.5, 0.0));
        for tick in 1..=12_000u32 {
            if tick % 1500 == 0 {
                velocity = Vector::new(-velocity.east, velocity.north);
            }
            truth += 0.1 * velocity;
            let (s, c) = (sin(radians(2.0)), cos(radians(2.0)));
            let measured =
                1.02 * Vector::new(c * velocity.north - s * velocity.east, c * velocity.east + s * velocity.north);
            filter.predict(&sensed(measured), 0.1);
            if tick % 600 == 0 && tick <= 9000 {
                assert!(filter.update(&Fix { position: truth, sigma: 0.5, gate: 0.0 }));
            }
        }
        let error = filter.estimate().position.distance(truth);
        // 5 min without a fix: 450 m of way, of which 2 deg would be 16 m.
        assert!(error < 3.0, "{error}");
        assert!((filter.filter.state()[TURN] - radians(2.0)).abs() < radians(0.3));
        assert!((filter.filter.state()[STRETCH] - 0.02).abs() < 0.005);
    }

    #[test]
    fn a_reflection_is_not_believed_and_a_lost_filter_is_found() {
        let mut filter = filter(0.05);
        let mut fix = |north| filter.update(&Fix { position: Point::new(north, 0.0), sigma: 2.0, gate: 0.0 });
        assert!(fix(1.0) && !fix(50.0) && fix(1.0));
        // What persists is so.
        assert_eq!([50.0; 6].map(&mut fix), [false, false, false, false, true, true]);
    }

    #[test]
    fn what_is_no_number_changes_nothing() {
        let mut filter = filter(0.05);
        let before = filter.estimate();
        filter.predict(&sensed(Vector::new(f64::NAN, 0.0)), 0.1);
        assert!(!filter.update(&Fix { position: Point::new(f64::NAN, 0.0), sigma: 2.0, gate: 0.0 }));
        assert_eq!(filter.estimate(), before);
    }
}
