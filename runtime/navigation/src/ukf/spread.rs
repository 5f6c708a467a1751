//! How far sigma points lie from the mean, and what each weighs.

/// The parameters of the scaled unscented transform.
///
/// With `n` states, `lambda = alpha^2 (n + kappa) - n`. The weights are `lambda / (n + lambda)` of the central point's mean, the same
/// and `1 - alpha^2 + beta` of its covariance, and `1 / (2 (n + lambda))` of every other point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// How far the points lie from the mean; positive. With very small ones, such as 1e-3, differences of points lose their digits.
    pub alpha: f64,
    /// What is known of the distribution: 2 for a normal one. From `alpha^2` on no covariance can lose its sign by it.
    pub beta: f64,
    /// More than `-n`; often 0 or `3 - n`.
    pub kappa: f64,
}

impl Default for Spread {
    fn default() -> Self {
        Spread { alpha: 0.1, beta: 2.0, kappa: 0.0 }
    }
}

/// What a transform needs of a spread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    /// Distance of a sigma point from the mean, in columns of the covariance's factor: the root of `n + lambda`.
    pub distance: f64,
    /// The root of what the square of the mean's shift weighs in a covariance, `beta - alpha^2`, without its sign.
    pub shift: f64,
    /// That sign: 1 or -1.
    pub sign: f64,
}

impl Spread {
    /// For so many states; nothing where no points can be drawn.
    pub(super) fn scale(self, states: usize) -> Option<Scale> {
        let Spread { alpha, beta, kappa } = self;
        let distance = alpha * (states as f64 + kappa).sqrt();
        let shift = beta - alpha * alpha;
        let drawn = distance > 0.0 && distance.is_finite() && shift.is_finite();
        drawn.then(|| Scale { distance, shift: shift.abs().sqrt(), sign: 1.0_f64.copysign(shift) })
    }
}
