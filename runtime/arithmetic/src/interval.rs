//! The values that a number can have, as far as is known.

use crate::{INT_MAX, LARGEST};

/// The least magnitude of a number that is not zero.
const TINIEST: f64 = f64::from_bits(1);

/// Bounds of a number, ends included, without what lies nearer to zero than the least magnitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The least value.
    pub low: f64,
    /// The greatest value.
    pub high: f64,
    /// The least magnitude: where it is above 0, zero is not among the values, although it may lie between them.
    pub least: f64,
}

impl Interval {
    /// Any number.
    pub const ANY: Interval = Interval { low: -LARGEST, high: LARGEST, least: 0.0 };
    /// Any whole number.
    pub const INT: Interval = Interval { low: -INT_MAX, high: INT_MAX, least: 0.0 };
    /// 1 or -1.
    pub const SIGN: Interval = Interval { low: -1.0, high: 1.0, least: 1.0 };
    /// Any number but zero.
    pub const NOT_ZERO: Interval = Interval { low: -LARGEST, high: LARGEST, least: TINIEST };
    /// Any number from zero on.
    pub const NOT_NEGATIVE: Interval = Interval { low: 0.0, high: LARGEST, least: 0.0 };

    /// One number.
    pub const fn exactly(value: f64) -> Self {
        Interval { low: value, high: value, least: value.abs() }
    }

    /// From one number to another, ends included.
    pub const fn new(low: f64, high: f64) -> Self {
        let least = if low > 0.0 {
            low
        } else if high < 0.0 {
            -high
        } else {
            0.0
        };
        Interval { low, high, least }
    }

    /// A number and all above it.
    pub const fn at_least(low: f64) -> Self {
        Self::new(low, LARGEST)
    }

    /// A number and all below it.
    pub const fn at_most(high: f64) -> Self {
        Self::new(-LARGEST, high)
    }

    /// The same without what is of a smaller magnitude.
    pub fn without_below(self, magnitude: f64) -> Self {
        let least = self.least.max(magnitude);
        let low = if least > 0.0 && self.low > -least { self.low.max(least) } else { self.low };
        let high = if least > 0.0 && self.high < least { self.high.min(-least) } else { self.high };
        Interval { low, high, least }
    }

    /// The number, when it can be only one.
    pub fn constant(self) -> Option<f64> {
        (self.low == self.high).then_some(self.low)
    }

    /// Whether there is no such number: its ends have changed places.
    pub fn is_empty(self) -> bool {
        self.low > self.high
    }

    /// Whether zero is impossible.
    pub fn excludes_zero(self) -> bool {
        self.least > 0.0
    }

    /// Whether a number is among the values.
    pub fn holds(self, x: f64) -> bool {
        x >= self.low && x <= self.high && x.abs() >= self.least
    }

    /// Whether all values of another are among its own.
    pub fn covers(self, other: Interval) -> bool {
        other.low >= self.low && other.high <= self.high && other.least >= self.least
    }

    /// What is in either.
    pub fn or(self, other: Interval) -> Self {
        Interval { low: self.low.min(other.low), high: self.high.max(other.high), least: self.least.min(other.least) }
    }

    /// What is in both. Where nothing is, its ends have changed places.
    pub fn and(self, other: Interval) -> Self {
        Self::new(self.low.max(other.low), self.high.min(other.high)).without_below(self.least.max(other.least))
    }

    /// The least and the greatest magnitude.
    pub(crate) fn magnitudes(self) -> (f64, f64) {
        (self.least, self.low.abs().max(self.high.abs()))
    }

    /// Its parts on either side of zero, ends first; one part when zero is among its values.
    pub(crate) fn parts(self) -> [(f64, f64); 2] {
        if self.least > 0.0 && self.low < 0.0 && self.high > 0.0 {
            [(self.low, -self.least), (self.least, self.high)]
        } else {
            [(self.low, self.high); 2]
        }
    }
}

/// All that an execution gives which is monotone in each of its operands, on either side of zero.
pub(crate) fn corners(a: Interval, b: Interval, execute: impl Fn(f64, f64) -> f64) -> Interval {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for (b_low, b_high) in b.parts() {
        for (x, y) in [(a.low, b_low), (a.low, b_high), (a.high, b_low), (a.high, b_high)] {
            let result = execute(x, y);
            low = low.min(result);
            high = high.max(result);
        }
    }
    Interval::new(low, high)
}
