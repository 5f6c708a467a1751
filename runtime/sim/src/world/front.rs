//! A front: a line across which the water's temperature and salinity change, at every depth alike.

use albacore_geometry::math::{sin, tanh};
use albacore_geometry::{Heading, Point, Vector};
use serde::Deserialize;
use std::f64::consts::{FRAC_PI_2, TAU};

/// A line between two water masses that lie beside one another. Across it temperature and salinity go as the hyperbolic tangent
/// of the distance, as they do over the depth in a thermocline.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Front {
    /// A place on it at the beginning of a run.
    pub at: Point,
    /// Where it leads: the other water lies to starboard of it.
    pub along: Heading,
    /// The other water is so much warmer, degrees Celsius.
    pub warmer: f64,
    /// And so much saltier, practical salinity.
    pub saltier: f64,
    /// Its width, m: in its middle the temperature changes as if all of the change were evenly spread over so much.
    pub width: f64,
    /// How all of it moves, m/s toward.
    pub drift: Vector,
    /// It bends by so much to either side, m.
    pub swing: f64,
    /// The length of a bend to either side, along it, m.
    pub wavelength: f64,
}

impl Front {
    /// How far a place lies to starboard of it at a time (s of the run), m: straight across the way that it leads.
    pub fn across(&self, p: Point, time: f64) -> f64 {
        let from = p - (self.at + time * self.drift);
        let along = from.dot(self.along.unit());
        from.dot((self.along + FRAC_PI_2).unit()) - self.swing * sin(TAU * along / self.wavelength)
    }

    /// How much warmer (degrees Celsius) and saltier the water is at a place and a time (s of the run) than without it.
    pub fn adds(&self, p: Point, time: f64) -> (f64, f64) {
        // How much of the other water it is, 0 to 1.
        let other = 0.5 * (1.0 + tanh(2.0 * self.across(p, time) / self.width));
        (other * self.warmer, other * self.saltier)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn front() -> Front {
        Front {
            at: Point::new(0.0, 20.0),
            along: Heading::NORTH,
            warmer: 2.0,
            saltier: -1.0,
            width: 40.0,
            drift: Vector::new(0.0, 0.1),
            swing: 0.0,
            wavelength: 400.0,
        }
    }

    #[test]
    fn the_other_water_lies_to_starboard_and_goes_where_the_front_does() {
        let near = |(t, s): (f64, f64), (t0, s0): (f64, f64)| (t - t0).abs() < 1e-6 && (s - s0).abs() < 1e-6;
        let front = front();
        assert!(near(front.adds(Point::new(300.0, 20.0), 0.0), (1.0, -0.5)));
        assert!(near(front.adds(Point::new(0.0, 400.0), 0.0), (2.0, -1.0)));
        assert!(near(front.adds(Point::new(0.0, -400.0), 0.0), (0.0, 0.0)));
        assert!(near(front.adds(Point::new(0.0, 30.0), 100.0), (1.0, -0.5)));
        let slope = (front.adds(Point::new(0.0, 20.01), 0.0).0 - front.adds(Point::new(0.0, 19.99), 0.0).0) / 0.02;
        assert!((slope - 2.0 / 40.0).abs() < 1e-6, "{slope}");
    }

    #[test]
    fn it_bends_to_either_side() {
        let front = Front { swing: 30.0, ..front() };
        for (north, east) in [(0.0, 20.0), (100.0, 50.0), (200.0, 20.0), (300.0, -10.0)] {
            assert!(front.across(Point::new(north, east), 0.0).abs() < 1e-9, "{north} {east}");
        }
    }
}
