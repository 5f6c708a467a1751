//! Surface waves: how they move the water below, and what they do to the pressure there. Airy's linear theory.

use crate::noise::{Noise, Stream};
use crate::world::water::Waves;
use albacore_geometry::math::{TAU, cos, exp, ln};
use albacore_geometry::{Point, Vector};

/// Standard gravity, m/s2.
const GRAVITY: f64 = 9.81;
/// Waves over less water than this, m, are computed for so much.
const LEAST_DEPTH: f64 = 0.5;
/// Waves in a sea.
const WAVES: usize = 16;
/// Newton's method for the dispersion relation ends after so many steps; it needs five.
const STEPS_MAX: usize = 30;

/// One long-crested wave.
#[derive(Clone, Copy, Debug)]
struct Wave {
    /// Amplitude at the surface, m.
    amplitude: f64,
    /// Angular frequency, rad/s, and wave number, rad/m.
    omega: f64,
    number: f64,
    phase: f64,
}

/// A sea: waves of many periods that all run one way.
///
/// The spectrum is Bretschneider's, of a significant height and a peak period, cut into parts of equal energy. Of orbital motion
/// the horizontal part is given; no current comes of it (Stokes' drift is left out), so that a plume does not feel it.
#[derive(Clone, Debug)]
pub struct Sea {
    toward: Vector,
    /// The depth of water that it is computed for, m.
    depth: f64,
    waves: [Wave; WAVES],
}

impl Sea {
    /// The waves of a scenario over water of a depth, m.
    pub fn new(settings: &Waves, depth: f64, seed: u64) -> Self {
        let depth = depth.max(LEAST_DEPTH);
        let noise = Noise::new(seed, Stream::Waves);
        let peak = TAU / settings.period;
        let mut waves = [Wave { amplitude: 0.0, omega: 0.0, number: 0.0, phase: 0.0 }; WAVES];
        for (i, wave) in waves.iter_mut().enumerate() {
            // The share of the energy below a frequency is exp(-5/4 (peak / omega)^4).
            let share = (i as f64 + 0.5) / WAVES as f64;
            let omega = peak * (-1.25 / ln(share)).sqrt().sqrt();
            // The variance of the surface is (height / 4)^2, in equal parts.
            let amplitude = 0.25 * settings.height * (2.0 / WAVES as f64).sqrt();
            *wave = Wave { amplitude, omega, number: wave_number(omega, depth), phase: TAU * noise.uniform(i as u64) };
        }
        Sea { toward: settings.toward.unit(), depth, waves }
    }

    /// The water's horizontal orbital velocity, m/s, at a point, a height above the bottom (m) and a time (s).
    pub fn velocity(&self, p: Point, height: f64, time: f64) -> Vector {
        let along = (p - Point::ORIGIN).dot(self.toward);
        let height = height.clamp(0.0, self.depth);
        let sum: f64 = self
            .waves
            .iter()
            .map(|wave| {
                let (up, down, whole) = self.decay(wave, height);
                // cosh(k height) / sinh(k depth), without either growing beyond all bounds.
                wave.amplitude * wave.omega * (up + down) / (1.0 - whole) * wave.swing(along, time)
            })
            .sum();
        sum * self.toward
    }

    /// What a pressure sensor reads too much, as metres of water, at a point, a height above the bottom (m) and a time (s).
    pub fn head(&self, p: Point, height: f64, time: f64) -> f64 {
        let along = (p - Point::ORIGIN).dot(self.toward);
        let height = height.clamp(0.0, self.depth);
        self.waves
            .iter()
            .map(|wave| {
                let (up, down, whole) = self.decay(wave, height);
                wave.amplitude * (up + down) / (1.0 + whole) * wave.swing(along, time)
            })
            .sum()
    }

    /// exp(k (height - depth)), exp(-k (height + depth)), exp(-2 k depth).
    fn decay(&self, wave: &Wave, height: f64) -> (f64, f64, f64) {
        let k = wave.number;
        (exp(k * (height - self.depth)), exp(-k * (height + self.depth)), exp(-2.0 * k * self.depth))
    }
}

impl Wave {
    fn swing(&self, along: f64, time: f64) -> f64 {
        cos(self.number * along - self.omega * time + self.phase)
    }
}

/// The wave number of a frequency: omega^2 = g k tanh(k depth), by Newton's method.
fn wave_number(omega: f64, depth: f64) -> f64 {
    let deep = omega * omega * depth / GRAVITY;
    // x = k depth: x tanh x = deep. Long waves begin at the root, short ones at the value itself.
    let mut x = deep.max(deep.sqrt());
    for _ in 0..STEPS_MAX {
        let whole = exp(-2.0 * x);
        let tanh = (1.0 - whole) / (1.0 + whole);
        let step = (x * tanh - deep) / (tanh + x * (1.0 - tanh * tanh));
        x -= step;
        if step.abs() < 1e-14 * x {
            break;
        }
    }
    x / depth
}

#[cfg(test)]
mod tests {
    use super::*;
    use albacore_geometry::Heading;

    fn sea(depth: f64) -> Sea {
        let settings = Waves { height: 1.0, period: 8.0, toward: Heading::from_degrees(90.0) };
        Sea::new(&settings, depth, 3)
    }

    #[test]
    fn wave_numbers_obey_the_dispersion_relation() {
        for (omega, depth) in [(0.2, 4.0), (0.8, 6.0), (0.8, 1000.0), (3.0, 20.0)] {
            let k = wave_number(omega, depth);
            let tanh = (1.0 - exp(-2.0 * k * depth)) / (1.0 + exp(-2.0 * k * depth));
            let right = GRAVITY * k * tanh;
            assert!((right / (omega * omega) - 1.0).abs() < 1e-12, "{omega} {depth}: {k}");
        }
    }

    /// Over a long time the surface's standard deviation is a quarter of the significant height; below it is less, and at the
    /// bottom there is still some of both where the water is shallow.
    #[test]
    fn the_sea_is_as_high_as_asked_and_fades_with_depth() {
        let sea = sea(6.0);
        let deviation = |height: f64, of: &dyn Fn(Point, f64, f64) -> f64| {
            let n = 200_000;
            let sum: f64 = (0..n).map(|i| of(Point::ORIGIN, height, 0.37 * f64::from(i))).map(|x| x * x).sum();
            (sum / f64::from(n)).sqrt()
        };
        let head = |height| deviation(height, &|p, h, t| sea.head(p, h, t));
        let speed = |height| deviation(height, &|p, h, t| sea.velocity(p, h, t).east);
        assert!((head(6.0) - 0.25).abs() < 0.005, "{}", head(6.0));
        assert!(head(0.0) < head(3.0) && head(3.0) < head(6.0));
        // Long waves over 6 m: u = a sqrt(g / h) at any height, within a fifth.
        let shallow = head(6.0) * (GRAVITY / 6.0).sqrt();
        assert!(speed(0.0) > 0.6 * shallow && speed(6.0) < 1.6 * shallow, "{} {} {shallow}", speed(0.0), speed(6.0));
        assert!(deviation(3.0, &|p, h, t| sea.velocity(p, h, t).north) < 1e-12, "crests run east");
    }

    #[test]
    fn deep_water_is_still_below() {
        let sea = sea(500.0);
        assert!(
            sea.velocity(Point::ORIGIN, 0.0, 7.0).length() < 1e-6 && sea.head(Point::ORIGIN, 0.0, 7.0).abs() < 1e-6
        );
    }
}
