//! Shares with their intervals, and quantiles.

use serde::Serialize;

/// What an interval about a share is.
pub const INTERVAL: &str = "Wilson, 95 %";
/// What a quantile is.
pub const QUANTILE: &str = "nearest rank";

/// The standard normal distribution has 2.5 % beyond this, on either side.
const Z: f64 = 1.959_963_984_540_054;

/// How many of how many, and where the true share lies with 95 % confidence: Wilson's score interval, which stays
/// within 0 and 1 and is of use where nearly all runs succeed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Share {
    /// How many.
    pub count: usize,
    /// The same as a share of all, from 0 to 1.
    pub share: f64,
    /// The lower end of the interval.
    pub low: f64,
    /// Its upper end.
    pub high: f64,
}

impl Share {
    /// The share of a count in a total; of nothing, nothing is known.
    pub fn of(count: usize, total: usize) -> Self {
        if total == 0 {
            return Share { count, share: 0.0, low: 0.0, high: 1.0 };
        }
        let (n, p) = (total as f64, count as f64 / total as f64);
        let spread = Z * (p * (1.0 - p) / n + Z * Z / (4.0 * n * n)).sqrt();
        let (middle, scale) = (p + Z * Z / (2.0 * n), 1.0 + Z * Z / n);
        // At either end the interval is exact but for rounding.
        let low = if count == 0 { 0.0 } else { (middle - spread) / scale };
        let high = if count == total { 1.0 } else { (middle + spread) / scale };
        Share { count, share: p, low, high }
    }
}

/// Two quantiles, and the mean. Each quantile is one of the values: the smallest that so large a share of them does not exceed (nearest rank).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Quantiles {
    /// Half of the values do not exceed it.
    pub median: f64,
    /// Nine in ten do not exceed it.
    pub p90: f64,
    /// Their mean, which a few large ones decide.
    pub mean: f64,
}

impl Quantiles {
    /// The quantiles of some values, in any order; of none there are none.
    pub fn of(values: &[f64]) -> Option<Self> {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        // In whole numbers: 0.9 * 10 is not quite 9.
        let rank = |tenths: usize| (sorted.len() * tenths).div_ceil(10);
        let at = |tenths| sorted.get(rank(tenths).checked_sub(1)?).copied();
        let mean = sorted.iter().sum::<f64>() / sorted.len() as f64;
        Some(Quantiles { median: at(5)?, p90: at(9)?, mean })
    }
}

#[cfg(test)]
mod tests {
    use super::{Quantiles, Share};

    /// Wilson's interval as R's `prop.test(correct = FALSE)` gives it.
    #[test]
    fn a_share_has_wilsons_interval() {
        let close = |a: f64, b: f64| (a - b).abs() < 5e-5;
        let share = Share::of(99, 100);
        assert!(close(share.share, 0.99) && close(share.low, 0.9455) && close(share.high, 0.9982), "{share:?}");
        let all = Share::of(20, 20);
        assert!(close(all.low, 0.8389) && all.high == 1.0, "{all:?}");
        let none = Share::of(0, 20);
        assert!(none.low == 0.0 && close(none.high, 0.1611), "{none:?}");
        assert_eq!((Share::of(0, 0).low, Share::of(0, 0).high), (0.0, 1.0));
    }

    #[test]
    fn a_quantile_is_the_value_of_the_nearest_rank() {
        let upto = |n: u32| (1..=n).rev().map(f64::from).collect::<Vec<_>>();
        let quantiles = |n| Quantiles::of(&upto(n)).map(|q| (q.median, q.p90));
        assert_eq!(quantiles(0), None);
        assert_eq!(quantiles(1), Some((1.0, 1.0)));
        assert_eq!(quantiles(10), Some((5.0, 9.0)));
        assert_eq!(quantiles(11), Some((6.0, 10.0)));
        assert_eq!(quantiles(100), Some((50.0, 90.0)));
    }
}
