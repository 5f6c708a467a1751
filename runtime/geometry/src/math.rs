//! The only transcendental functions of the project, from one portable library, so that every machine gets the same bits.
//!
//! Square root, absolute value, floor and the four operations are exact in IEEE arithmetic and are used directly.

pub use std::f64::consts::{PI, TAU};

/// Sine of an angle in radians.
pub fn sin(angle_rad: f64) -> f64 {
    libm::sin(angle_rad)
}

/// Cosine of an angle in radians.
pub fn cos(angle_rad: f64) -> f64 {
    libm::cos(angle_rad)
}

/// Sine and cosine of an angle in radians, the same to the bit as [`sin`] and [`cos`], in little more than the time of one.
pub fn sin_cos(angle_rad: f64) -> (f64, f64) {
    libm::sincos(angle_rad)
}

/// Tangent of an angle in radians.
pub fn tan(angle_rad: f64) -> f64 {
    libm::tan(angle_rad)
}

/// Arc sine in radians; the argument is held within -1..1.
pub fn asin(x: f64) -> f64 {
    libm::asin(x.clamp(-1.0, 1.0))
}

/// Arc cosine in radians; the argument is held within -1..1.
pub fn acos(x: f64) -> f64 {
    libm::acos(x.clamp(-1.0, 1.0))
}

/// Arc tangent in radians, in [-pi/2, pi/2].
pub fn atan(x: f64) -> f64 {
    libm::atan(x)
}

/// Four-quadrant arc tangent of `y / x` in radians, in [-pi, pi]; 0 for the null vector.
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// Hyperbolic tangent.
pub fn tanh(x: f64) -> f64 {
    libm::tanh(x)
}

/// Hyperbolic sine.
pub fn sinh(x: f64) -> f64 {
    libm::sinh(x)
}

/// Hyperbolic cosine.
pub fn cosh(x: f64) -> f64 {
    libm::cosh(x)
}

/// Inverse hyperbolic sine.
pub fn asinh(x: f64) -> f64 {
    libm::asinh(x)
}

/// Inverse hyperbolic tangent; the argument lies within -1..1.
pub fn atanh(x: f64) -> f64 {
    libm::atanh(x)
}

/// The square root of the sum of two squares.
pub fn hypot(x: f64, y: f64) -> f64 {
    libm::hypot(x, y)
}

/// e to the power `x`.
pub fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// Natural logarithm.
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// `x` to the power `y`.
pub fn pow(x: f64, y: f64) -> f64 {
    libm::pow(x, y)
}

/// Degrees to radians: for the rim, where people write degrees.
pub fn radians(degrees: f64) -> f64 {
    degrees * (PI / 180.0)
}

/// Radians to degrees: for the rim, where people read degrees.
pub fn degrees(radians: f64) -> f64 {
    radians * (180.0 / PI)
}

/// -0.0 becomes 0.0, so that a zero prints and compares the same however it was reached.
pub fn canonical_zero(x: f64) -> f64 {
    x + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sine_and_cosine_together_are_each_to_the_bit() {
        for i in -2000..2000 {
            let angle = f64::from(i) * 0.0107;
            assert_eq!(sin_cos(angle), (sin(angle), cos(angle)), "{angle}");
        }
    }
}
