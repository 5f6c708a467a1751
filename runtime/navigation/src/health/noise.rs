//! The noise of a sensor, told from the motion of what it measures by the differences of what it tells.

/// Differences from which it is learnt: so many at least, and the latest of these.
const CHANGES_MIN: u64 = 100;
const CHANGES: u64 = 300;
/// Of what comes so seldom, in ticks, fewer have to do: 100 would be minutes in which nothing can be said of it.
const SELDOM_TICKS: u64 = 10;
const CHANGES_MIN_SELDOM: u64 = 30;
/// Third differences of white noise correlate with their neighbours by -3/4, and 3/4 of them are of another sign than the one before; those
/// of a motion that is smooth from sample to sample by 1, and beside a noise little is left of them. That a motion has zigzagged once is no
/// noise, nor that it often does.
const THIRD: Bounds = Bounds { correlation: -0.35, alternates: 0.6 };
/// ... of which as many come before the first.
const BEFORE_THIRD: u64 = 3;
/// The variance of the third differences of what goes to and fro between two values, as a multiple of the square of its step.
const FLICKER_GAIN: f64 = 16.0;
/// First differences of white noise correlate by -1/2, and 2/3 of them alternate; those of a random walk, such as a vehicle that wobbles, by 0,
/// which third differences do not tell from noise. They count for what comes in each tick, of which the motion is small beside them, and for
/// what the vehicle steers, however seldom it comes: a course by positions that wander, or a speed against a flow that does. What they are on
/// the mean of so many, and as that changes, counts as no difference: a dive hides no noise, nor does its beginning or its end.
const FIRST: Bounds = Bounds { correlation: -0.25, alternates: 0.5 };
const DRIFT_CHANGES: u64 = 20;
/// A noise is larger than the rounding of the last bits, in SI units, and than the smallest change, which may be the step in which a link
/// tells numbers: a value between two steps flickers like noise and then rests for minutes.
const SMALLEST: f64 = 1e-4;
const STEPS: f64 = 1.2;

/// How near to white noise a series has to be.
struct Bounds {
    /// Neighbours correlate by less than this.
    correlation: f64,
    /// More than this share of them is of another sign than the one before.
    alternates: f64,
}

/// What is known of the noise in a series of numbers.
#[derive(Clone, Debug)]
pub(super) struct Noise {
    changes: u64,
    /// The smallest change.
    step: f64,
    /// The mean of the latest differences, and by how much it changes from one to the next.
    drift: f64,
    trend: f64,
    /// The latest differences of the first and second order.
    differences: [f64; 2],
    first: Series,
    third: Series,
}

/// Means over the latest numbers of a series.
#[derive(Clone, Debug, Default)]
struct Series {
    last: f64,
    /// Of their squares, and of the products of neighbours.
    variance: f64,
    covariance: f64,
    /// The share that is of another sign than the one before, and larger than rounding.
    alternates: f64,
}

impl Default for Noise {
    fn default() -> Self {
        let none = Series::default;
        Noise {
            changes: 0,
            step: f64::INFINITY,
            drift: 0.0,
            trend: 0.0,
            differences: [0.0; 2],
            first: none(),
            third: none(),
        }
    }
}

impl Noise {
    /// Takes in a difference of neighbours.
    pub fn learn(&mut self, difference: f64) {
        self.changes += 1;
        self.step = if difference == 0.0 { self.step } else { self.step.min(difference.abs()) };
        let off = difference - (self.drift + self.trend);
        let drift = share(self.changes, DRIFT_CHANGES);
        self.drift += self.trend + drift * (2.0 - drift) * off;
        if self.changes > DRIFT_CHANGES {
            self.trend += drift * drift * off;
        }
        self.first.take(off, share(self.changes, CHANGES));
        let second = difference - self.differences[0];
        let third = second - self.differences[1];
        self.differences = [difference, second];
        if let Some(changes @ 1..) = self.changes.checked_sub(BEFORE_THIRD) {
            self.third.take(third, share(changes, CHANGES));
        }
    }

    /// Whether it is noise by which the series never stays the same, where a sample comes in every so many ticks, of what the vehicle
    /// steers or not.
    pub fn is_shown(&self, period_ticks: u64, is_steered: bool) -> bool {
        let least = SMALLEST.max(STEPS * self.step);
        let changes_min = if period_ticks >= SELDOM_TICKS { CHANGES_MIN_SELDOM } else { CHANGES_MIN };
        self.changes >= changes_min
            && self.third.is_white(&THIRD, FLICKER_GAIN * least * least)
            && (period_ticks > 1 && !is_steered || self.first.is_white(&FIRST, least * least))
    }
}

/// What the latest of so many counts for in a mean over so many at most.
#[inline]
pub(super) fn share(numbers: u64, most: u64) -> f64 {
    // Almost always there are more: a quotient of constants costs nothing.
    if numbers < most { 1.0 / numbers as f64 } else { 1.0 / most as f64 }
}

impl Series {
    fn take(&mut self, number: f64, share: f64) {
        let product = number * self.last;
        self.variance += share * (number * number - self.variance);
        self.covariance += share * (product - self.covariance);
        self.alternates += share * (f64::from(product < -SMALLEST * SMALLEST) - self.alternates);
        self.last = number;
    }

    fn is_white(&self, bounds: &Bounds, variance_min: f64) -> bool {
        self.covariance < bounds.correlation * self.variance
            && self.alternates > bounds.alternates
            && self.variance > variance_min
    }
}
