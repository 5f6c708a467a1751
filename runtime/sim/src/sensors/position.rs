//! What the vehicle believes of its position: dead reckoning with noisy velocity, and noisy acoustic fixes.

use crate::noise::{Noise, Stream};
use crate::scenario::{Lbl, Navigation};
use albacore_geometry::{Point, Vector};
use albacore_navigation::DeadReckoning;
use albacore_vehicle::TICK_S;

/// The vehicle's own navigation, or the truth where a scenario has none.
#[derive(Clone, Debug)]
pub struct Positioning(Option<Reckoned>);

#[derive(Clone, Debug)]
struct Reckoned {
    reckoning: DeadReckoning,
    /// Standard deviation of the measured velocity, m/s an axis.
    deviation: f64,
    velocity_noise: Noise,
    lbl: Option<Lbl>,
    fix_noise: Noise,
}

impl Positioning {
    /// Begins at the true start: the last thing a vehicle had before it dived was a satellite fix.
    pub fn new(navigation: Option<&Navigation>, start: Point, seed: u64) -> Self {
        Positioning(navigation.map(|navigation| Reckoned {
            reckoning: DeadReckoning::new(start, navigation.walk),
            // White noise of this deviation, held over a tick, integrates to a random walk of `walk`.
            deviation: navigation.walk / TICK_S.sqrt(),
            velocity_noise: Noise::new(seed, Stream::GroundVelocity),
            lbl: navigation.lbl.clone(),
            fix_noise: Noise::new(seed, Stream::Lbl),
        }))
    }

    /// Lets one tick go by, in which the vehicle moved with a velocity (m/s) and came to a point.
    pub fn step(&mut self, tick: u64, velocity: Vector, position: Point) {
        let Some(own) = &mut self.0 else { return };
        let pair = |noise: Noise| Vector::new(noise.gaussian(2 * tick), noise.gaussian(2 * tick + 1));
        if own.deviation > 0.0 {
            own.reckoning.advance(velocity + own.deviation * pair(own.velocity_noise), TICK_S);
        } else {
            own.reckoning.advance(velocity, TICK_S);
        }
        if let Some(lbl) = &own.lbl {
            let ticks = ((lbl.every / TICK_S).round() as u64).max(1);
            if tick.is_multiple_of(ticks) {
                own.reckoning.fix(position + lbl.sigma * pair(own.fix_noise), lbl.sigma, lbl.gate);
            }
        }
    }

    /// Where the vehicle believes it is, and the standard deviation it expects of that, m an axis.
    pub fn belief(&self, truth: Point) -> (Point, f64) {
        self.0.as_ref().map_or((truth, 0.0), |own| (own.reckoning.position(), own.reckoning.sigma()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Over many runs: the error before the first fix is the walk's, after it the fix's, and sigma tells both.
    #[test]
    fn sigma_is_the_error_to_expect() {
        let navigation = Navigation { walk: 0.05, lbl: Some(Lbl { every: 120.0, sigma: 2.0, gate: 0.0 }) };
        let mut errors = [0.0; 2];
        let mut sigmas = [0.0; 2];
        for seed in 0..400 {
            let mut own = Positioning::new(Some(&navigation), Point::ORIGIN, seed);
            let velocity = Vector::new(2.0, 0.0);
            for tick in 1..=1200 {
                let truth = Point::new(0.2 * tick as f64, 0.0);
                own.step(tick, velocity, truth);
                if tick >= 1199 {
                    let (position, sigma) = own.belief(truth);
                    let error = position - truth;
                    errors[tick as usize - 1199] += error.dot(error) / 800.0;
                    sigmas[tick as usize - 1199] = sigma;
                }
            }
        }
        for (error, sigma) in errors.into_iter().zip(sigmas) {
            assert!((f64::sqrt(error) / sigma - 1.0).abs() < 0.08, "{} where {sigma} is expected", f64::sqrt(error));
        }
        assert!((sigmas[0] - 0.5475).abs() < 0.001 && sigmas[1] == 2.0);
    }
}
