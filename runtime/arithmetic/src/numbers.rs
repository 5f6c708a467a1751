//! The arithmetic of quantities.

use crate::interval::corners;
use crate::transcendental::moved;
use crate::{Interval, LARGEST, Operation, bounded};
use albacore_geometry::math;

/// `a + b`.
pub struct Add;

impl Operation<2> for Add {
    #[inline]
    fn execute([a, b]: [f64; 2]) -> f64 {
        bounded(a + b)
    }

    fn rule([a, b]: [Interval; 2]) -> Interval {
        Interval::new(Self::execute([a.low, b.low]), Self::execute([a.high, b.high]))
    }
}

/// `a - b`.
pub struct Sub;

impl Operation<2> for Sub {
    #[inline]
    fn execute([a, b]: [f64; 2]) -> f64 {
        bounded(a - b)
    }

    fn rule([a, b]: [Interval; 2]) -> Interval {
        Interval::new(Self::execute([a.low, b.high]), Self::execute([a.high, b.low]))
    }
}

/// `a * b`. A product of small factors may be zero although no factor is: that it is not is known from their magnitudes alone.
pub struct Mul;

impl Operation<2> for Mul {
    #[inline]
    fn execute([a, b]: [f64; 2]) -> f64 {
        bounded(a * b)
    }

    fn rule([a, b]: [Interval; 2]) -> Interval {
        corners(a, b, |x, y| Self::execute([x, y])).without_below(Self::execute([a.least, b.least]))
    }
}

/// `a / b`. By zero it has no result: 0 stands for it.
pub struct Div;

impl Operation<2> for Div {
    #[inline]
    fn execute([a, b]: [f64; 2]) -> f64 {
        if b == 0.0 { 0.0 } else { bounded(a / b) }
    }

    fn rule([a, b]: [Interval; 2]) -> Interval {
        if b.excludes_zero() {
            let least = Self::execute([a.least, b.magnitudes().1]);
            return corners(a, b, |x, y| Self::execute([x, y])).without_below(least);
        }
        // Any magnitude, and the stand-in.
        match (a.low >= 0.0 && b.low >= 0.0, a.low >= 0.0 && b.high <= 0.0) {
            (true, _) => Interval::NOT_NEGATIVE,
            (_, true) => Interval::at_most(0.0),
            _ => Interval::ANY,
        }
    }

    fn is_defined([_, b]: [Interval; 2]) -> bool {
        b.excludes_zero()
    }
}

/// `a ^ b`, of a `b` that is not negative, and whole where `a` may be negative. Its rounding is the library's.
pub struct Pow;

impl Operation<2> for Pow {
    #[inline]
    fn execute([a, b]: [f64; 2]) -> f64 {
        bounded(math::pow(a, b))
    }

    fn rule([a, b]: [Interval; 2]) -> Interval {
        let Some(power) = b.constant().filter(|_| Self::is_defined([a, b])) else { return Interval::ANY };
        if let Some(base) = a.constant() {
            return Interval::exactly(Self::execute([base, power]));
        }
        let (least, most) = a.magnitudes();
        let below = moved(Self::execute([least, power]), f64::next_down).max(0.0);
        let above = |magnitude: f64| moved(Self::execute([magnitude, power]), f64::next_up);
        let is_odd = power % 2.0 == 1.0;
        match (a.low < 0.0 && is_odd, a.high < 0.0 && is_odd) {
            (_, true) => Interval::new(-above(-a.low), -below),
            (true, false) => Interval::new(-above(-a.low), above(a.high.max(0.0))).without_below(below),
            (false, false) => Interval::new(below, above(most)),
        }
    }

    fn is_defined([a, b]: [Interval; 2]) -> bool {
        b.low >= 0.0 && (a.low >= 0.0 || b.constant().is_some_and(|power| power.fract() == 0.0))
    }
}

/// `-a`.
pub struct Neg;

impl Operation<1> for Neg {
    #[inline]
    fn execute([a]: [f64; 1]) -> f64 {
        math::canonical_zero(-a)
    }

    fn rule([a]: [Interval; 1]) -> Interval {
        Interval::new(Self::execute([a.high]), Self::execute([a.low])).without_below(a.least)
    }
}

/// The magnitude of a number.
pub struct Abs;

impl Operation<1> for Abs {
    #[inline]
    fn execute([a]: [f64; 1]) -> f64 {
        a.abs()
    }

    fn rule([a]: [Interval; 1]) -> Interval {
        let (least, most) = a.magnitudes();
        Interval::new(least, most)
    }
}

/// The smaller of two.
pub struct Min;

impl Operation<2> for Min {
    #[inline]
    fn execute([a, b]: [f64; 2]) -> f64 {
        if b < a { b } else { a }
    }

    fn rule([a, b]: [Interval; 2]) -> Interval {
        Interval::new(Self::execute([a.low, b.low]), Self::execute([a.high, b.high]))
            .without_below(a.least.min(b.least))
    }
}

/// The larger of two.
pub struct Max;

impl Operation<2> for Max {
    #[inline]
    fn execute([a, b]: [f64; 2]) -> f64 {
        if b > a { b } else { a }
    }

    fn rule([a, b]: [Interval; 2]) -> Interval {
        Interval::new(Self::execute([a.low, b.low]), Self::execute([a.high, b.high]))
            .without_below(a.least.min(b.least))
    }
}

/// The square root. A negative number has none: 0 stands for it.
pub struct Sqrt;

impl Operation<1> for Sqrt {
    #[inline]
    fn execute([a]: [f64; 1]) -> f64 {
        if a > 0.0 { a.sqrt() } else { 0.0 }
    }

    fn rule([a]: [Interval; 1]) -> Interval {
        Interval::new(Self::execute([a.low]), Self::execute([a.high]))
    }

    fn is_defined([a]: [Interval; 1]) -> bool {
        a.low >= 0.0
    }
}

// The square of the largest is a number: a sum of two products is one too, before it is bounded.
const _: () = assert!(LARGEST * LARGEST + LARGEST * LARGEST < f64::INFINITY);
