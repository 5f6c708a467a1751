//! How good the navigation of a run was: errors of an inertial navigator against what it expected of them, looked at once a second.

use crate::summary::NavigationSummary;
use albacore_geometry::math::degrees;
use albacore_vehicle::{NAVIGATION_STATES, NavigationErrors};
use std::ops::RangeInclusive;

/// Errors count from here on, s: until then biases are being found.
const SETTLED_S: f64 = 30.0;
/// The share of samples that percentiles are of.
const SHARE: f64 = 0.99;
/// A horizontal error whose square by its covariance is more than this is beyond what is expected: one in 3000 is where the filter is
/// right.
const BEYOND: f64 = 16.0;
/// Between these lie 95 % of a chi-square distribution over its degrees of freedom: 15 of the states, 3, 1, 3 and 5 of the innovations.
const NEES_95: RangeInclusive<f64> = 0.417_5..=1.832_6;
const NIS_95: [RangeInclusive<f64>; 4] = [0.071_9..=3.116_1, 0.000_982..=5.023_9, 0.071_9..=3.116_1, 0.166_2..=2.566_5];
/// What is expected holds errors of so many standard deviations.
const DEVIATIONS: f64 = 3.0;

/// Squares by their covariance.
#[derive(Clone, Copy, Debug, Default)]
struct Normalised {
    sum: f64,
    count: u32,
    /// So many between the bounds.
    within: u32,
}

impl Normalised {
    fn take(&mut self, value: f64, bounds: &RangeInclusive<f64>) {
        self.sum += value;
        self.count += 1;
        self.within += u32::from(bounds.contains(&value));
    }

    /// The mean, and the share between the bounds; none of none.
    fn summary(&self) -> Option<[f64; 2]> {
        let count = f64::from(self.count);
        (self.count > 0).then(|| [self.sum / count, f64::from(self.within) / count])
    }
}

/// What is gathered of a run.
#[derive(Clone, Debug, Default)]
pub(crate) struct NavigationAccount {
    looks: u32,
    settled: u32,
    nees: Normalised,
    nis: [Normalised; 4],
    /// Horizontal errors: their sum, and the greatest, m.
    horizontal: (f64, f64),
    /// The sum of the squares of errors of depth, m2, and the greatest, m.
    depth: (f64, f64),
    /// Sizes of errors of roll, pitch and yaw, rad.
    attitude: [Vec<f64>; 3],
    /// The greatest of any axis: rad/s and m/s2.
    gyro_bias: f64,
    accelerometer_bias: f64,
    /// How many errors of each group of three states were within what is expected.
    within: [u32; NAVIGATION_STATES / 3],
    /// Looks at which the place was beyond what is expected, and nothing was told of it.
    unnoticed: u32,
    /// All at which it was.
    beyond: u32,
}

impl NavigationAccount {
    /// A look at a time, s.
    pub fn take(&mut self, t_s: f64, errors: &NavigationErrors) {
        for ((gathered, bounds), nis) in self.nis.iter_mut().zip(&NIS_95).zip(errors.nis) {
            nis.into_iter().for_each(|nis| gathered.take(nis, bounds));
        }
        let [north, east, depth] = errors.of(NavigationErrors::PLACE);
        let horizontal = (north * north + east * east).sqrt();
        self.looks += 1;
        self.nees.take(errors.nees, &NEES_95);
        self.horizontal = (self.horizontal.0 + horizontal, self.horizontal.1.max(horizontal));
        for (i, (error, sigma)) in errors.error.iter().zip(errors.sigma).enumerate() {
            self.within[i / 3] += u32::from(error.abs() <= DEVIATIONS * sigma);
        }
        self.beyond += u32::from(beyond(errors));
        self.unnoticed += u32::from(!errors.doubted && beyond(errors));
        if t_s < SETTLED_S {
            return;
        }
        self.settled += 1;
        let attitude = errors.of(NavigationErrors::ATTITUDE);
        self.attitude.iter_mut().zip(attitude).for_each(|(list, error)| list.push(error.abs()));
        self.gyro_bias = self.gyro_bias.max(errors.greatest(NavigationErrors::GYRO_BIAS));
        self.accelerometer_bias = self.accelerometer_bias.max(errors.greatest(NavigationErrors::ACCELEROMETER_BIAS));
        self.depth = (self.depth.0 + depth * depth, self.depth.1.max(depth.abs()));
    }

    /// What came of it; none where there was no look.
    pub fn summary(&self) -> Option<NavigationSummary> {
        let looks = f64::from(self.looks);
        if self.looks == 0 {
            return None;
        }
        let [roll, pitch, yaw] = [0, 1, 2].map(|axis| degrees(percentile(&self.attitude[axis])));
        let [attitude, gyro_bias, position, velocity, accelerometer_bias] =
            self.within.map(|within| f64::from(within) / (3.0 * looks));
        Some(NavigationSummary {
            position_error_mean_m: self.horizontal.0 / looks,
            position_error_max_m: self.horizontal.1,
            depth_error_rms_m: (self.depth.0 / f64::from(self.settled.max(1))).sqrt(),
            depth_error_max_m: self.depth.1,
            roll_error_99_deg: roll,
            pitch_error_99_deg: pitch,
            yaw_error_99_deg: yaw,
            gyro_bias_error_max_deg_s: degrees(self.gyro_bias),
            accelerometer_bias_error_max_m_s2: self.accelerometer_bias,
            within_3_sigma: [attitude, gyro_bias, position, velocity, accelerometer_bias],
            nees: self.nees.summary()?,
            nis: self.nis.map(|nis| nis.summary()),
            beyond_s: f64::from(self.beyond),
            unnoticed_s: f64::from(self.unnoticed),
        })
    }
}

/// Whether the place is farther off than is expected.
fn beyond(errors: &NavigationErrors) -> bool {
    let [north, east, _] = errors.of(NavigationErrors::PLACE);
    let [a, b, _] = errors.expected(NavigationErrors::PLACE).map(|sigma| sigma * sigma);
    let c = errors.north_east;
    let determinant = a * b - c * c;
    north * north * b - 2.0 * north * east * c + east * east * a > BEYOND * determinant
}

/// The least size that so many of the sizes do not exceed; 0 of none.
fn percentile(sizes: &[f64]) -> f64 {
    let mut sizes = sizes.to_vec();
    sizes.sort_by(f64::total_cmp);
    let place = (SHARE * sizes.len() as f64).ceil() as usize;
    sizes.get(place.saturating_sub(1)).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn errors(north: f64, sigma: f64, doubted: bool) -> NavigationErrors {
        let mut errors = NavigationErrors {
            error: [0.0; NAVIGATION_STATES],
            sigma: [sigma; NAVIGATION_STATES],
            north_east: 0.0,
            nees: 1.0,
            nis: [Some(2.0), None, None, None],
            doubted,
        };
        errors.error[NavigationErrors::PLACE] = north;
        errors
    }

    #[test]
    fn what_is_beyond_and_not_told_is_counted() {
        let mut account = NavigationAccount::default();
        assert!(account.summary().is_none());
        [(3.0, false), (5.0, false), (5.0, true), (0.0, false)]
            .into_iter()
            .zip(40..)
            .for_each(|((north, doubted), t)| account.take(f64::from(t), &errors(north, 1.0, doubted)));
        let summary = account.summary().unwrap();
        assert_eq!((summary.beyond_s, summary.unnoticed_s, summary.position_error_mean_m), (2.0, 1.0, 3.25));
        assert_eq!(summary.nis, [Some([2.0, 1.0]), None, None, None]);
        // Two of twelve numbers of places.
        assert!((summary.within_3_sigma[2] - 10.0 / 12.0).abs() < 1e-12);
    }

    #[test]
    fn percentiles_are_of_what_is_there() {
        assert_eq!(percentile(&[]), 0.0);
        let sizes: Vec<f64> = (1..=200).rev().map(f64::from).collect();
        assert_eq!(percentile(&sizes), 198.0);
    }
}
