//! What the machine calculates, and beside each operation what is known of its result before it is executed.
//!
//! An operation stands once, as an [`Operation`]: its execution, and its rule, which gives the range of results for ranges of
//! operands. The checker asks the rules, the machine calls the executions, and `tests/rules.rs` holds one against the other. No
//! operation can be added without both.
//!
//! Numbers are finite, of a magnitude of [`LARGEST`] at most. Where an execution is monotone in each operand, and every
//! rounding of IEEE arithmetic is, its results for ranges lie between those for the ends of the ranges: so most rules call the
//! execution itself, and agree with it to the last bit.

mod angle;
mod interval;
mod numbers;
mod operation;
mod time_and_counts;
mod transcendental;
mod vectors;
mod whole;

pub use angle::{Cos, Sin, WrapAngle, WrapHeading};
pub use interval::Interval;
pub use numbers::{Abs, Add, Div, Max, Min, Mul, Neg, Pow, Sqrt, Sub};
pub use operation::{Operation, Operator};
pub use time_and_counts::{Age, NEVER_S, Ticks, counted};
pub use transcendental::{Atan2, Exp, Ln};
pub use vectors::{Dot, Length, Spread};
pub use whole::{AddInt, Ceil, Floor, MulInt, Round, SubInt};

/// The largest magnitude of a number: its square is a number still.
pub const LARGEST: f64 = 1e150;

/// The largest magnitude of a whole number, 2^53: beyond it adding one changes nothing.
pub const INT_MAX: f64 = 9_007_199_254_740_992.0;

/// A result as it is kept: what is too large for a number is the largest. No arithmetic fails in the water.
#[inline]
pub fn bounded(x: f64) -> f64 {
    if x.abs() <= LARGEST {
        return x;
    }
    if x.is_nan() { 0.0 } else { LARGEST.copysign(x) }
}

/// A result of whole numbers as it is kept: what cannot be counted exactly is the largest that can.
#[inline]
fn whole(x: f64) -> f64 {
    x.clamp(-INT_MAX, INT_MAX)
}
