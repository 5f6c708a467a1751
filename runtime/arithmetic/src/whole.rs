//! The arithmetic of whole numbers, which end at 2^53: beyond it they could not be counted.

use crate::interval::corners;
use crate::{Interval, Operation, whole};

/// `a + b` of whole numbers.
pub struct AddInt;

impl Operation<2> for AddInt {
    #[inline]
    fn execute([a, b]: [f64; 2]) -> f64 {
        whole(a + b)
    }

    fn rule([a, b]: [Interval; 2]) -> Interval {
        Interval::new(Self::execute([a.low, b.low]), Self::execute([a.high, b.high]))
    }
}

/// `a - b` of whole numbers.
pub struct SubInt;

impl Operation<2> for SubInt {
    #[inline]
    fn execute([a, b]: [f64; 2]) -> f64 {
        whole(a - b)
    }

    fn rule([a, b]: [Interval; 2]) -> Interval {
        Interval::new(Self::execute([a.low, b.high]), Self::execute([a.high, b.low]))
    }
}

/// `a * b` of whole numbers.
pub struct MulInt;

impl Operation<2> for MulInt {
    #[inline]
    fn execute([a, b]: [f64; 2]) -> f64 {
        whole(a * b)
    }

    fn rule([a, b]: [Interval; 2]) -> Interval {
        corners(a, b, |x, y| Self::execute([x, y])).without_below(Self::execute([a.least, b.least]))
    }
}

/// The whole number below.
pub struct Floor;

impl Operation<1> for Floor {
    #[inline]
    fn execute([a]: [f64; 1]) -> f64 {
        whole(a.floor())
    }

    fn rule([a]: [Interval; 1]) -> Interval {
        Interval::new(Self::execute([a.low]), Self::execute([a.high]))
    }
}

/// The whole number above.
pub struct Ceil;

impl Operation<1> for Ceil {
    #[inline]
    fn execute([a]: [f64; 1]) -> f64 {
        whole(a.ceil() + 0.0)
    }

    fn rule([a]: [Interval; 1]) -> Interval {
        Interval::new(Self::execute([a.low]), Self::execute([a.high]))
    }
}

/// The nearest whole number; of two the one farther from zero.
pub struct Round;

impl Operation<1> for Round {
    #[inline]
    fn execute([a]: [f64; 1]) -> f64 {
        whole(a.round() + 0.0)
    }

    fn rule([a]: [Interval; 1]) -> Interval {
        Interval::new(Self::execute([a.low]), Self::execute([a.high]))
    }
}
