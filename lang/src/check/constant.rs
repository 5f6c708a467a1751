//! Ranges of numbers: what an operation can give for what its operands can be. A constant is a range of one number.

use crate::hir::{Builtin, Interval};
use albacore_geometry::math;

/// The range of a built-in operation's result.
pub(super) fn range(op: Builtin, operands: &[Interval]) -> Interval {
    let a = operands.first().copied().unwrap_or(Interval::ANY);
    let b = operands.get(1).copied().unwrap_or(Interval::ANY);
    let result = match op {
        Builtin::Add => Interval::new(a.low + b.low, a.high + b.high),
        Builtin::Sub => Interval::new(a.low - b.high, a.high - b.low),
        Builtin::Neg => Interval { low: -a.high, high: -a.low, not_zero: a.not_zero },
        Builtin::Mul => {
            let product = corners(a, b, |x, y| x * y);
            Interval { not_zero: a.excludes_zero() && b.excludes_zero(), ..product }
        }
        Builtin::Div if b.low > 0.0 || b.high < 0.0 => {
            let quotient = corners(a, b, |x, y| x / y);
            Interval { not_zero: a.excludes_zero(), ..quotient }
        }
        Builtin::Abs if a.low >= 0.0 => a,
        Builtin::Abs if a.high <= 0.0 => range(Builtin::Neg, &[a]),
        Builtin::Abs => Interval { low: 0.0, high: a.high.max(-a.low), not_zero: a.not_zero },
        Builtin::Min => Interval::new(a.low.min(b.low), a.high.min(b.high)),
        Builtin::Max => Interval::new(a.low.max(b.low), a.high.max(b.high)),
        Builtin::Sqrt => Interval::new(a.low.max(0.0).sqrt(), a.high.max(0.0).sqrt()),
        Builtin::Floor => Interval::new(a.low.floor(), a.high.floor()),
        Builtin::Ceil => Interval::new(a.low.ceil(), a.high.ceil()),
        Builtin::Round => Interval::new(a.low.round(), a.high.round()),
        Builtin::Pow => match (a.constant(), b.constant()) {
            (Some(x), Some(y)) => Interval::exactly(math::pow(x, y)),
            _ => Interval::ANY,
        },
        Builtin::Heading | Builtin::Angle => match a.constant() {
            Some(x) if op == Builtin::Heading => {
                Interval::exactly(albacore_geometry::Heading::from_radians(x).radians())
            }
            Some(x) => Interval::exactly(albacore_geometry::wrap_angle(x)),
            None => Interval::ANY,
        },
        _ => Interval::ANY,
    };
    if result.low.is_nan() || result.high.is_nan() { Interval::ANY } else { result }
}

fn corners(a: Interval, b: Interval, f: impl Fn(f64, f64) -> f64) -> Interval {
    let mut low = f64::INFINITY;
    let mut high = f64::NEG_INFINITY;
    for x in [a.low, a.high] {
        for y in [b.low, b.high] {
            let value = f(x, y);
            if value.is_nan() {
                return Interval::ANY;
            }
            low = low.min(value);
            high = high.max(value);
        }
    }
    Interval::new(low, high)
}
