//! When a source releases: a Poisson process that knows nothing of time steps.

use crate::noise::Noise;
use crate::world::plume::Times;
use albacore_geometry::math::ln;

/// The moments at which one source releases, in order.
#[derive(Clone, Debug)]
pub struct Release {
    noise: Noise,
    rate: f64,
    when: Times,
    number: u32,
    next: f64,
}

impl Release {
    /// Releases `rate` times a second, on average, from a moment on, while its times hold.
    pub fn new(noise: Noise, rate: f64, when: Times, begin: f64) -> Self {
        let mut release = Release { noise, rate, when, number: 0, next: begin };
        release.next = begin + release.gap();
        release
    }

    /// The number and moment of the next release, if it comes before `end` (s). What falls into a pause is left out: the others
    /// are the same as without one.
    pub fn before(&mut self, end: f64) -> Option<(u32, f64)> {
        while self.next < end {
            let (number, moment) = (self.number, self.next);
            self.number = self.number.wrapping_add(1);
            self.next += self.gap();
            if self.when.hold(moment) {
                return Some((number, moment));
            }
        }
        None
    }

    /// Time from the last release to the next, s: exponential.
    fn gap(&self) -> f64 {
        -ln(1.0 - self.noise.uniform(u64::from(self.number))) / self.rate
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise::Stream;

    #[test]
    fn counts_are_poisson_and_do_not_depend_on_the_step() {
        let counts = |step: f64| -> Vec<f64> {
            let mut release = Release::new(Noise::new(9, Stream::Release), 1.5, Times::default(), -100.0);
            let windows = (0..2000).map(|k| {
                let (begin, parts) = (-100.0 + 10.0 * f64::from(k), (10.0 / step) as i32);
                let ends = (1..=parts).map(|i| begin + f64::from(i) * step);
                ends.map(|end| std::iter::from_fn(|| release.before(end)).count()).sum::<usize>() as f64
            });
            windows.collect()
        };
        let coarse = counts(10.0);
        assert_eq!(coarse, counts(0.5));
        let mean = coarse.iter().sum::<f64>() / 2000.0;
        let variance = coarse.iter().map(|c| (c - mean) * (c - mean)).sum::<f64>() / 2000.0;
        assert!((mean - 15.0).abs() < 0.3 && (variance - 15.0).abs() < 1.5, "{mean} {variance}");
    }

    #[test]
    fn a_source_that_comes_and_goes_releases_while_it_is_on() {
        let moments = |when: Times| -> Vec<f64> {
            let mut release = Release::new(Noise::new(9, Stream::Release), 2.0, when, -1000.0);
            std::iter::from_fn(|| release.before(1000.0)).map(|(_, moment)| moment).collect()
        };
        let always = moments(Times::default());
        assert!(always.iter().any(|&t| t < 0.0));
        let pulses = Times { begins: Some(100.0), ends: Some(500.0), on: Some(30.0), off: Some(20.0) };
        let pulsed = moments(pulses);
        let on = |&t: &f64| (100.0..500.0).contains(&t) && (t - 100.0) % 50.0 < 30.0;
        assert_eq!(pulsed, always.iter().copied().filter(on).collect::<Vec<_>>());
        assert!((pulsed.len() as f64 - 480.0).abs() < 100.0);
    }
}
