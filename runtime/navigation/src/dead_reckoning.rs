//! Dead reckoning with acoustic fixes: velocity over ground integrated from a known start, corrected by jumps.

use albacore_geometry::{Point, Vector};
use serde::{Deserialize, Serialize};

/// Where the vehicle believes it is (the 2005 paper, Sec. IV-B).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DeadReckoning {
    position: Point,
    /// Variance of the position error, m2 an axis.
    variance: f64,
    /// Growth of that variance, m2/s an axis.
    growth: f64,
}

impl DeadReckoning {
    /// Begins at a known point. The standard deviation of its error grows as `walk` (m/s^0.5) times the root of time.
    pub fn new(start: Point, walk: f64) -> Self {
        DeadReckoning { position: start, variance: 0.0, growth: walk * walk }
    }

    /// Integrates a measured velocity over ground (m/s) over `time` seconds.
    pub fn advance(&mut self, ground_velocity: Vector, time: f64) {
        self.position += time * ground_velocity;
        self.variance += self.growth * time;
    }

    /// Takes an acoustic fix with a standard deviation of `sigma` metres an axis, if it disagrees by more than `gate`
    /// metres: the position jumps to it. Tells whether it did.
    pub fn fix(&mut self, position: Point, sigma: f64, gate: f64) -> bool {
        // A gate of 0 takes every fix, also one that agrees exactly.
        let jumps = gate <= 0.0 || position.distance(self.position) > gate;
        if jumps {
            self.position = position;
            self.variance = sigma * sigma;
        }
        jumps
    }

    /// Where the vehicle believes it is.
    pub fn position(&self) -> Point {
        self.position
    }

    /// Standard deviation of the error it should expect, m an axis.
    pub fn sigma(&self) -> f64 {
        self.variance.sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn error_grows_with_the_root_of_time_until_a_fix() {
        let mut reckoning = DeadReckoning::new(Point::ORIGIN, 0.05);
        (0..1200).for_each(|_| reckoning.advance(Vector::new(2.0, 0.0), 0.1));
        assert!(reckoning.position().distance(Point::new(240.0, 0.0)) < 1e-9);
        assert!((reckoning.sigma() - 0.05 * 120.0_f64.sqrt()).abs() < 1e-9);
        assert!(reckoning.fix(Point::new(241.0, 1.0), 2.0, 0.0));
        assert_eq!((reckoning.position(), reckoning.sigma()), (Point::new(241.0, 1.0), 2.0));
    }

    #[test]
    fn a_gate_lets_only_large_disagreements_through() {
        let mut reckoning = DeadReckoning::new(Point::ORIGIN, 0.05);
        assert!(!reckoning.fix(Point::new(4.0, 0.0), 3.0, 5.0));
        assert_eq!(reckoning.position(), Point::ORIGIN);
        assert!(reckoning.fix(Point::new(6.0, 0.0), 3.0, 5.0));
    }
}
