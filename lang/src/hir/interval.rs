//! The values that a number can have, as far as is known.

/// Bounds of a number, ends included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The least value.
    pub low: f64,
    /// The greatest value.
    pub high: f64,
    /// Zero is not among them although it lies between them.
    pub not_zero: bool,
}

impl Interval {
    /// Any number.
    pub const ANY: Interval = Interval { low: f64::NEG_INFINITY, high: f64::INFINITY, not_zero: false };

    /// One number.
    pub fn exactly(value: f64) -> Self {
        Interval { low: value, high: value, not_zero: value != 0.0 }
    }

    /// From one number to another, ends included.
    pub fn new(low: f64, high: f64) -> Self {
        Interval { low, high, not_zero: low > 0.0 || high < 0.0 }
    }

    /// The number, when it can be only one.
    pub fn constant(self) -> Option<f64> {
        (self.low == self.high).then_some(self.low)
    }

    /// Whether zero is impossible.
    pub fn excludes_zero(self) -> bool {
        self.not_zero || self.low > 0.0 || self.high < 0.0
    }
}
