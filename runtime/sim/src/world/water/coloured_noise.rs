//! Coloured noise for the corners of the flow field: damped oscillators driven by white noise, stepped exactly.

use crate::noise::Noise;
use albacore_geometry::math::{cos, exp, sin};

/// Two velocity components at four corners.
pub const SIGNALS: usize = 8;

/// Eight independent signals of Farrell et al. 2002: x'' + 2 zeta w x' + w^2 x = white noise.
///
/// Printed with a gain G, whose meaning depends on the discretisation (their own code scales it with the root of the time
/// step); here the stationary standard deviation is the parameter and the step is the exact transition of the stochastic
/// differential equation, so that the law depends on no time step.
#[derive(Clone, Debug)]
pub struct ColouredNoise {
    noise: Noise,
    /// Value and rate of each signal.
    states: [[f64; 2]; SIGNALS],
    transition: [[f64; 2]; 2],
    /// Lower triangular root of the covariance that a step adds: first row, then second.
    kick: (f64, [f64; 2]),
    steps: u64,
}

impl ColouredNoise {
    /// Signals of standard deviation `sigma`, bandwidth `w` (rad/s) and damping ratio `zeta` in 0..1, in steps of `time`
    /// seconds. They begin in their stationary law.
    pub fn new(noise: Noise, sigma: f64, w: f64, zeta: f64, time: f64) -> Self {
        let (decay, natural) = (zeta * w, w * (1.0 - zeta * zeta).sqrt());
        let (c, s, e) = (cos(natural * time), sin(natural * time), exp(-decay * time));
        let transition = [
            [e * (c + decay / natural * s), e * s / natural],
            [-e * w * w / natural * s, e * (c - decay / natural * s)],
        ];
        // Stationary covariance P = diag(sigma^2, (sigma w)^2); a step adds Q = P - A P A^T.
        let (p0, p1) = (sigma * sigma, sigma * sigma * w * w);
        let [a, b] = transition;
        let q00 = (p0 - (a[0] * a[0] * p0 + a[1] * a[1] * p1)).max(0.0);
        let q01 = -(a[0] * b[0] * p0 + a[1] * b[1] * p1);
        let q11 = (p1 - (b[0] * b[0] * p0 + b[1] * b[1] * p1)).max(0.0);
        let l00 = q00.sqrt();
        let l10 = if l00 > 0.0 { q01 / l00 } else { 0.0 };
        let l11 = (q11 - l10 * l10).max(0.0).sqrt();
        let mut states = [[0.0; 2]; SIGNALS];
        for (i, state) in states.iter_mut().enumerate() {
            let draw = 2 * i as u64;
            *state = [sigma * noise.gaussian(draw), sigma * w * noise.gaussian(draw + 1)];
        }
        ColouredNoise { noise, states, transition, kick: (l00, [l10, l11]), steps: 0 }
    }

    /// Lets one step go by.
    pub fn step(&mut self) {
        self.steps += 1;
        let first = self.steps * (2 * SIGNALS as u64);
        let [a, b] = self.transition;
        let (l0, l1) = self.kick;
        for (i, [x, rate]) in self.states.iter_mut().enumerate() {
            let draw = first + 2 * i as u64;
            let (n0, n1) = (self.noise.gaussian(draw), self.noise.gaussian(draw + 1));
            (*x, *rate) = (a[0] * *x + a[1] * *rate + l0 * n0, b[0] * *x + b[1] * *rate + l1[0] * n0 + l1[1] * n1);
        }
    }

    /// The signals now.
    pub fn values(&self) -> [f64; SIGNALS] {
        self.states.map(|[x, _]| x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise::Stream;

    /// Over many runs the deviation is the one asked for at the start and later, for small steps as for large ones.
    #[test]
    fn the_deviation_is_the_parameter() {
        for (time, steps) in [(5.0, 0), (5.0, 200), (0.5, 400), (50.0, 40)] {
            let (mut sum, mut n) = (0.0, 0.0);
            for seed in 0..500 {
                let mut signals = ColouredNoise::new(Noise::new(seed, Stream::FlowCorners), 0.0175, 0.0023, 0.1, time);
                (0..steps).for_each(|_| signals.step());
                for x in signals.values() {
                    sum += x * x;
                    n += 1.0;
                }
            }
            let deviation = f64::sqrt(sum / n);
            assert!((deviation / 0.0175 - 1.0).abs() < 0.05, "{deviation} with steps of {time} s");
        }
    }

    /// The autocorrelation after half a damped period is -exp(-pi zeta / sqrt(1 - zeta^2)) = -0.73.
    #[test]
    fn the_period_is_the_parameter() {
        let w = 0.0023;
        let half = std::f64::consts::PI / (w * f64::sqrt(0.99));
        let time = half / 300.0;
        let mut sum = 0.0;
        for seed in 0..400 {
            let mut signals = ColouredNoise::new(Noise::new(seed, Stream::FlowCorners), 1.0, w, 0.1, time);
            let before = signals.values();
            (0..300).for_each(|_| signals.step());
            sum += before.iter().zip(signals.values()).map(|(a, b)| a * b).sum::<f64>() / 8.0;
        }
        let correlation = sum / 400.0;
        assert!((correlation + 0.729).abs() < 0.05, "{correlation}");
    }
}
