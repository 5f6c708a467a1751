//! How far the edge of a spill is off its outline: a random field over place and time.

use crate::noise::Noise;
use albacore_geometry::Vector;
use albacore_geometry::math::{TAU, cos};

/// Waves that make the field: enough for it to be nearly Gaussian.
const WAVES: usize = 32;

/// A field of mean 0 whose covariance falls with distance and time as a Gaussian: a sum of waves with random numbers, frequencies and phases
/// (Kraichnan 1970, Phys. Fluids 13, 22-31).
#[derive(Clone, Debug)]
pub(super) struct Roughness {
    amplitude: f64,
    waves: Vec<Wave>,
}

#[derive(Clone, Copy, Debug)]
struct Wave {
    /// Wave number, rad/m, and angular frequency, rad/s.
    number: Vector,
    omega: f64,
    phase: f64,
}

impl Roughness {
    /// Of a standard deviation (m), a length (m) and a time (s) over which it is alike.
    pub fn new(deviation: f64, length: f64, time: f64, noise: Noise) -> Self {
        let wave = |i: usize| {
            let draw = |nth: u64| noise.gaussian(4 * i as u64 + nth);
            Wave {
                number: Vector::new(draw(0) / length, draw(1) / length),
                omega: draw(2) / time,
                phase: TAU * noise.uniform(4 * i as u64 + 3),
            }
        };
        Roughness { amplitude: deviation * (2.0 / WAVES as f64).sqrt(), waves: (0..WAVES).map(wave).collect() }
    }

    /// The field at a place, from the centre of the spill, and a time (s): m.
    pub fn at(&self, place: Vector, time: f64) -> f64 {
        let sum: f64 = self.waves.iter().map(|w| cos(w.number.dot(place) + w.omega * time + w.phase)).sum();
        self.amplitude * sum
    }
}
