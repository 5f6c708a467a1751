//! Two campaigns over the same seeds, compared run by run: in one world the same seed is the same water.

use super::statistics::{Quantiles, Share};
use albacore_geometry::math::{exp, ln};
use serde::Serialize;

/// What an interval about a difference of shares is.
pub const SHARE_INTERVAL: &str = "Newcombe's for paired shares, 95 %";
/// What an interval about a median difference is.
pub const MEDIAN_INTERVAL: &str = "of the median by order statistics, 95 % or more";
/// What the probability is.
pub const TEST: &str = "McNemar, exact, two-sided";

/// An interval leaves out no more than this on either side.
const TAIL: f64 = 0.025;

/// How many of the pairs have something on either side.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PairedShare {
    /// On the first side.
    pub a: Share,
    /// On the second.
    pub b: Share,
    /// On the first alone.
    pub only_a: usize,
    /// On the second alone.
    pub only_b: usize,
    /// The share of the second less that of the first.
    pub difference: f64,
    /// The lower end of its interval.
    pub low: f64,
    /// The upper end.
    pub high: f64,
    /// How probable pairs as different as these are, or more so, where both sides are alike.
    pub p: f64,
}

impl PairedShare {
    /// Of pairs; of none, nothing is known.
    pub fn of(pairs: &[(bool, bool)]) -> Self {
        let count = |wanted: (bool, bool)| pairs.iter().filter(|pair| **pair == wanted).count();
        let (both, only_a, only_b, neither) =
            (count((true, true)), count((true, false)), count((false, true)), count((false, false)));
        let (a, b) = (Share::of(both + only_a, pairs.len()), Share::of(both + only_b, pairs.len()));
        let difference = b.share - a.share;
        // Newcombe (1998), Statistics in Medicine 17, 2635-2650, method 10: Wilson's intervals of both, and how they go together.
        let [e, f, g, h] = [both, only_a, only_b, neither].map(|count| count as f64);
        let product = (e + f) * (g + h) * (e + g) * (f + h);
        let together = e * h - f * g;
        let corrected = if together > 0.0 { (together - pairs.len() as f64 / 2.0).max(0.0) } else { together };
        let phi = if product > 0.0 { corrected / product.sqrt() } else { 0.0 };
        let spread = |x: f64, y: f64| (x * x - 2.0 * phi * x * y + y * y).max(0.0).sqrt();
        PairedShare {
            low: difference - spread(b.share - b.low, a.high - a.share),
            high: difference + spread(b.high - b.share, a.share - a.low),
            p: (2.0 * binomial_tail(only_a + only_b, only_a.min(only_b))).min(1.0),
            a,
            b,
            only_a,
            only_b,
            difference,
        }
    }
}

/// What the second side has more than the first, over the pairs in which both have it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PairedDifference {
    /// How many pairs that are.
    pub pairs: usize,
    /// The median on the first side.
    pub a: f64,
    /// The median on the second.
    pub b: f64,
    /// The median of the differences.
    pub difference: f64,
    /// The interval about that; of fewer than six pairs there is none.
    pub interval: Option<(f64, f64)>,
}

impl PairedDifference {
    /// Of pairs; of none there is none.
    pub fn of(pairs: &[(f64, f64)]) -> Option<Self> {
        let median = |values: Vec<f64>| Quantiles::of(&values).map(|quantiles| quantiles.median);
        let mut differences: Vec<f64> = pairs.iter().map(|(a, b)| b - a).collect();
        differences.sort_by(f64::total_cmp);
        let count = differences.len();
        // So many values at either end leave out no more than the tail.
        let left_out = ranks_left_out(count);
        let interval = left_out.and_then(|out| Some((*differences.get(out)?, *differences.get(count - 1 - out)?)));
        Some(PairedDifference {
            pairs: count,
            a: median(pairs.iter().map(|(a, _)| *a).collect())?,
            b: median(pairs.iter().map(|(_, b)| *b).collect())?,
            difference: median(differences)?,
            interval,
        })
    }
}

/// How many values at either end of so many lie outside of the interval of the median.
fn ranks_left_out(count: usize) -> Option<usize> {
    let mut tail = BinomialTail::new(count);
    (0..count / 2).take_while(|_| tail.next() <= TAIL).last()
}

/// How probable it is that of so many fair coins so many or fewer show heads.
fn binomial_tail(coins: usize, heads: usize) -> f64 {
    let mut tail = BinomialTail::new(coins);
    (0..=heads).map(|_| tail.next()).last().unwrap_or(1.0)
}

/// The probabilities of 0 heads of so many fair coins, of 1 or fewer, of 2 or fewer, …
struct BinomialTail {
    coins: f64,
    /// The heads of the next, and the logarithm of their probability.
    heads: f64,
    ln_next: f64,
    sum: f64,
}

impl BinomialTail {
    fn new(coins: usize) -> Self {
        BinomialTail { coins: coins as f64, heads: 0.0, ln_next: -(coins as f64) * ln(2.0), sum: 0.0 }
    }

    fn next(&mut self) -> f64 {
        self.sum += exp(self.ln_next);
        self.ln_next += ln(self.coins - self.heads) - ln(self.heads + 1.0);
        self.heads += 1.0;
        self.sum
    }
}

#[cfg(test)]
mod tests {
    use super::{PairedDifference, PairedShare, binomial_tail, ranks_left_out};

    fn pairs(both: usize, only_a: usize, only_b: usize, neither: usize) -> Vec<(bool, bool)> {
        let of = |pair, count| std::iter::repeat_n(pair, count);
        of((true, true), both)
            .chain(of((true, false), only_a))
            .chain(of((false, true), only_b))
            .chain(of((false, false), neither))
            .collect()
    }

    /// The probabilities are sums of the binomial distribution, computed in whole numbers.
    #[test]
    fn mcnemars_test_is_exact() {
        let p = |only_a, only_b| PairedShare::of(&pairs(50, only_a, only_b, 10)).p;
        let close = |p: f64, known: f64| assert!((p - known).abs() < 5e-7, "{p} is not {known}");
        close(p(0, 0), 1.0);
        close(p(3, 3), 1.0);
        close(p(1, 9), 0.021_484_375);
        close(p(9, 1), 0.021_484_375);
        close(p(0, 6), 0.03125);
        close(p(12, 30), 0.007_915_9);
        close(binomial_tail(1_000_000, 500_000), 0.500_398_9);
    }

    /// The intervals of method 10 as another program computes them, written from the same formulas in another language.
    #[test]
    fn the_interval_of_a_difference_is_newcombes() {
        let check = |(both, only_a, only_b, neither): (usize, usize, usize, usize), low: f64, high: f64| {
            // The difference here is of the second less the first.
            let share = PairedShare::of(&pairs(both, only_b, only_a, neither));
            assert!((share.low - low).abs() < 5e-5 && (share.high - high).abs() < 5e-5, "{share:?}");
        };
        check((36, 12, 2, 0), 0.0569, 0.3404);
        check((20, 12, 2, 16), 0.0562, 0.3292);
    }

    #[test]
    fn what_differs_by_the_same_differs_by_that() {
        let shifted: Vec<(f64, f64)> = (0..30).map(|i| (f64::from(i), f64::from(i) + 2.0)).collect();
        let difference = PairedDifference::of(&shifted).unwrap();
        assert_eq!((difference.pairs, difference.difference, difference.interval), (30, 2.0, Some((2.0, 2.0))));
        assert_eq!(PairedDifference::of(&[]), None);
        assert_eq!(PairedDifference::of(&shifted[..5]).unwrap().interval, None);
    }

    /// The ranks of the interval of a median, as tables of the sign test have them.
    #[test]
    fn the_interval_of_a_median_is_that_of_the_sign_test() {
        let ranks = [5, 6, 8, 9, 12, 20, 30, 100].map(ranks_left_out);
        assert_eq!(ranks, [None, Some(0), Some(0), Some(1), Some(2), Some(5), Some(9), Some(39)]);
    }
}
