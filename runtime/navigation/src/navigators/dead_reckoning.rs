//! Dead reckoning with acoustic fixes: velocity over ground integrated from a known start, corrected by jumps.

use crate::navigator::{Estimate, Fix, Navigator, Sensed};
use albacore_geometry::Point;

/// Where the vehicle believes it is (the 2005 paper, Sec. IV-B).
#[derive(Clone, Debug, PartialEq)]
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
}

impl Navigator for DeadReckoning {
    /// Integrates the measured velocity over ground.
    fn predict(&mut self, sensed: &Sensed, time: f64) {
        self.position += time * sensed.ground_velocity;
        self.variance += self.growth * time;
    }

    /// The position jumps to a fix that its gate lets through.
    fn update(&mut self, fix: &Fix) -> bool {
        let Fix { position, sigma, gate } = *fix;
        // A gate of 0 takes every fix, also one that agrees exactly.
        let jumps = gate <= 0.0 || position.distance(self.position) > gate;
        if jumps {
            self.position = position;
            self.variance = sigma * sigma;
        }
        jumps
    }

    fn estimate(&self) -> Estimate {
        Estimate { position: self.position, sigma: self.variance.sqrt() }
    }

    fn boxed(&self) -> Box<dyn Navigator> {
        Box::new(self.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use albacore_geometry::{Heading, Vector};

    #[test]
    fn error_grows_with_the_root_of_time_until_a_fix() {
        let mut reckoning = DeadReckoning::new(Point::ORIGIN, 0.05);
        let sensed = Sensed { ground_velocity: Vector::new(2.0, 0.0), heading: Heading::NORTH };
        (0..1200).for_each(|_| reckoning.predict(&sensed, 0.1));
        let Estimate { position, sigma } = reckoning.estimate();
        assert!(position.distance(Point::new(240.0, 0.0)) < 1e-9);
        assert!((sigma - 0.05 * 120.0_f64.sqrt()).abs() < 1e-9);
        assert!(reckoning.update(&Fix { position: Point::new(241.0, 1.0), sigma: 2.0, gate: 0.0 }));
        assert_eq!(reckoning.estimate(), Estimate { position: Point::new(241.0, 1.0), sigma: 2.0 });
    }

    #[test]
    fn a_gate_lets_only_large_disagreements_through() {
        let mut reckoning = DeadReckoning::new(Point::ORIGIN, 0.05);
        let mut fix = |north| reckoning.update(&Fix { position: Point::new(north, 0.0), sigma: 3.0, gate: 5.0 });
        assert!(!fix(4.0) && fix(6.0));
        assert_eq!(reckoning.estimate().position, Point::new(6.0, 0.0));
    }
}
