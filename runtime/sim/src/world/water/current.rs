//! What the whole water does alike: tides, and the slow turning of the mean flow.

use crate::world::water::{Flow, Tide};
use albacore_geometry::Vector;
use albacore_geometry::math::{TAU, cos, sin};

/// The flow that is the same everywhere, in time.
#[derive(Clone, Debug)]
pub struct Current {
    mean: Vector,
    /// Rate at which the mean turns, rad/s clockwise.
    turning: f64,
    tides: Vec<Tide>,
}

impl Current {
    /// That of a scenario.
    pub fn new(flow: &Flow) -> Self {
        Current { mean: flow.mean, turning: flow.turning, tides: flow.tides.clone() }
    }

    /// Whether it is the mean flow at all times.
    pub fn is_steady(&self) -> bool {
        self.turning == 0.0 && self.tides.is_empty()
    }

    /// What it adds to the mean flow at a time (s), m/s toward.
    pub fn beyond_mean(&self, time: f64) -> Vector {
        let mut sum = Vector::ZERO;
        if self.turning != 0.0 {
            let (s, c) = (sin(self.turning * time), cos(self.turning * time));
            let Vector { north, east } = self.mean;
            sum = Vector::new(c * north - s * east, s * north + c * east) - self.mean;
        }
        self.tides.iter().fold(sum, |sum, tide| sum + cos(TAU * (time - tide.high) / tide.period) * tide.amplitude)
    }

    /// The velocity at a time, m/s toward.
    pub fn velocity(&self, time: f64) -> Vector {
        self.mean + self.beyond_mean(time)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use albacore_geometry::Heading;

    #[test]
    fn a_tide_runs_strongest_at_high_and_turns_half_a_period_later() {
        let tide = Tide { amplitude: Vector::new(0.3, 0.0), period: 44_700.0, high: 7200.0, ..Tide::default() };
        let flow = Flow { mean: Vector::new(0.0, 0.1), tides: vec![tide.clone(), tide], ..Flow::default() };
        let current = Current::new(&flow);
        let at = |time| current.velocity(time);
        assert!((at(7200.0) - Vector::new(0.6, 0.1)).length() < 1e-12, "two of them add up");
        assert!((at(7200.0 + 22_350.0) - Vector::new(-0.6, 0.1)).length() < 1e-12);
        assert!((at(7200.0 + 11_175.0) - Vector::new(0.0, 0.1)).length() < 1e-12);
        assert!(!current.is_steady() && Current::new(&Flow::default()).is_steady());
    }

    #[test]
    fn the_mean_turns_clockwise_and_keeps_its_speed() {
        let mean = 0.2 * Heading::from_degrees(350.0).unit();
        let current = Current::new(&Flow { mean, turning: 0.001, ..Flow::default() });
        let later = current.velocity(500.0);
        assert!((later.length() - 0.2).abs() < 1e-12);
        assert!((later.toward() - mean.toward() - 0.5).abs() < 1e-12);
        assert_eq!(current.beyond_mean(0.0), Vector::ZERO);
    }
}
