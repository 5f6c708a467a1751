//! Exponential, logarithm, and the angle of two parts. Their rounding is the library's.

use crate::{Interval, Operation, bounded};
use albacore_geometry::math::{self, PI};

/// How many units in the last place a function of the library may be off, with room to spare.
const ULPS: usize = 4;

/// A bound of a result, moved outward by what the library's rounding may be.
pub(crate) fn moved(x: f64, outward: impl Fn(f64) -> f64) -> f64 {
    bounded((0..ULPS).fold(x, |x, _| outward(x)))
}

/// The range of a function that grows with its operand.
fn growing(a: Interval, execute: impl Fn(f64) -> f64) -> Interval {
    match a.constant() {
        Some(a) => Interval::exactly(execute(a)),
        None => Interval::new(moved(execute(a.low), f64::next_down), moved(execute(a.high), f64::next_up)),
    }
}

/// e to the power `a`.
pub struct Exp;

impl Operation<1> for Exp {
    #[inline]
    fn execute([a]: [f64; 1]) -> f64 {
        bounded(math::exp(a))
    }

    fn rule(operands: [Interval; 1]) -> Interval {
        growing(operands[0], |a| Self::execute([a])).and(Interval::NOT_NEGATIVE)
    }
}

/// The natural logarithm. What is not positive has none: 0 stands for it.
pub struct Ln;

impl Operation<1> for Ln {
    #[inline]
    fn execute([a]: [f64; 1]) -> f64 {
        if a > 0.0 { math::ln(a) } else { 0.0 }
    }

    fn rule([a]: [Interval; 1]) -> Interval {
        let least = if a.low > 0.0 { a.low } else { a.least.max(f64::from_bits(1)) };
        let positive = Interval { low: least, high: a.high.max(least), least };
        let rule = growing(positive, |a| Self::execute([a]));
        match (a.low > 0.0, a.high > 0.0) {
            (true, _) => rule,
            // The stand-in.
            (_, true) => rule.or(Interval::exactly(0.0)),
            _ => Interval::exactly(0.0),
        }
    }

    fn is_defined([a]: [Interval; 1]) -> bool {
        a.low > 0.0
    }
}

/// The angle in [-pi, pi] whose sine is to its cosine as `y` to `x`, with the signs of both; 0 of two zeros.
pub struct Atan2;

impl Operation<2> for Atan2 {
    #[inline]
    fn execute([y, x]: [f64; 2]) -> f64 {
        // Zero has no sign here: what prints the same gives the same.
        math::atan2(math::canonical_zero(y), math::canonical_zero(x))
    }

    fn rule([y, x]: [Interval; 2]) -> Interval {
        if let (Some(y), Some(x)) = (y.constant(), x.constant()) {
            return Interval::exactly(Self::execute([y, x]));
        }
        let most = if x.low >= 0.0 { PI / 2.0 } else { PI };
        let low = if y.low >= 0.0 { 0.0 } else { -most };
        let high = if y.high < 0.0 { 0.0 } else { most };
        Interval::new(low, high)
    }
}
