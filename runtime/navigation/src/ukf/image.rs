//! What a function makes of sigma points: the unscented transform.
//!
//! The weighted sums are written with differences from the central point, in pairs. Of the points `x` and `x +- h a_i`, where `a_i` is
//! a column of the covariance's Cholesky factor and `h^2 = n + lambda`, a function makes `z` and `z + e_i`, `z + f_i`. With
//! `d_i = (e_i - f_i) / 2 h` and `s_i = (e_i + f_i) / 2 h` the mean is `z + m`, `m = sum s_i / h`, and the covariance
//!
//! ```text
//! sum d_i d_i' + sum s_i s_i' + (beta - alpha^2) m m'
//! ```
//!
//! which is the usual sum with its weights, those of the central point included, whose great negative weight has cancelled. All that
//! is left is positive where `beta >= alpha^2`. The covariance of what went in with what came out is `sum a_i d_i'`.

use super::component::Component;
use super::factor::{Columns, add_scaled, add_square, column};
use super::spread::Scale;
use nalgebra::SVector;

/// The image, of `M` numbers, of the sigma points of `N` states.
pub struct Image<const M: usize, const N: usize> {
    /// `z + m`.
    pub mean: [f64; M],
    /// `d_i`.
    pub odd: Columns<M, N>,
    /// `s_i`.
    even: Columns<M, N>,
    /// `m` by the root of its weight.
    shift: [f64; M],
    /// The sign of that weight.
    sign: f64,
}

impl<const M: usize, const N: usize> Image<M, N> {
    /// Draws sigma points and lets the function have them: the mean first, then those of each column, ahead and behind.
    #[inline]
    pub fn of(
        mean: &SVector<f64, N>,
        factor: &Columns<N, N>,
        scale: &Scale,
        components: &[Component; M],
        mut function: impl FnMut(&SVector<f64, N>) -> SVector<f64, M>,
    ) -> Self {
        let central = column(&function(mean));
        let per_distance = 1.0 / scale.distance;
        let mut image =
            Image { mean: central, odd: [[0.0; M]; N], even: [[0.0; M]; N], shift: [0.0; M], sign: scale.sign };
        for (i, factor) in factor.iter().enumerate() {
            let mut point = |distance: f64| {
                let point = SVector::from(std::array::from_fn(|row| mean[row] + distance * factor[row]));
                column(&function(&point))
            };
            let (ahead, behind) = (point(scale.distance), point(-scale.distance));
            for (row, component) in components.iter().enumerate() {
                let e = component.reduced(ahead[row] - central[row]);
                let f = component.reduced(behind[row] - central[row]);
                image.odd[i][row] = 0.5 * per_distance * (e - f);
                image.even[i][row] = 0.5 * per_distance * (e + f);
            }
            add_scaled(&mut image.shift, per_distance, &image.even[i]);
        }
        image.mean = std::array::from_fn(|row| components[row].reduced(central[row] + image.shift[row]));
        image.shift.iter_mut().for_each(|shift| *shift *= scale.shift);
        image
    }

    /// Adds what of the covariance is of second order: the sums without `d_i`.
    #[inline]
    pub fn add_curvature(&self, sum: &mut Columns<M, M>) {
        add_square(sum, &self.even);
        for (column, shift) in sum.iter_mut().zip(&self.shift) {
            // A weight apart from the product: both halves stay the same to the bit.
            column.iter_mut().zip(&self.shift).for_each(|(sum, other)| *sum += self.sign * (shift * other));
        }
    }
}
