//! The arithmetic of covariances: sums of squares, their Cholesky factors, and equations solved with these.
//!
//! Matrices are arrays of columns. Inner loops run over whole columns, also where half would do: they have a fixed length, and
//! compilers make vector instructions of them.

use nalgebra::{SMatrix, SVector};

/// Columns of `M` rows.
pub type Columns<const M: usize, const N: usize> = [[f64; M]; N];

/// Adds `a b'` for each column `a` and the row of `b` that belongs to it: `sum += left right'`.
#[inline]
pub fn add_product<const M: usize, const N: usize, const K: usize>(
    sum: &mut Columns<M, N>,
    left: &Columns<M, K>,
    right: &Columns<N, K>,
) {
    for (j, column) in sum.iter_mut().enumerate() {
        for (left, right) in left.iter().zip(right) {
            add_scaled(column, right[j], left);
        }
    }
}

/// Adds `a a'`: as symmetric as the sum was, to the bit, since both halves are made of the same products in the same order.
#[inline]
pub fn add_square<const M: usize, const K: usize>(sum: &mut Columns<M, M>, a: &Columns<M, K>) {
    add_product(sum, a, a);
}

/// Adds `factor x`.
#[inline]
pub fn add_scaled<const M: usize>(sum: &mut [f64; M], factor: f64, x: &[f64; M]) {
    sum.iter_mut().zip(x).for_each(|(sum, x)| *sum += factor * x);
}

/// The mean of a matrix and its transpose: symmetric to the bit.
#[inline]
pub fn symmetric<const M: usize>(a: &Columns<M, M>) -> Columns<M, M> {
    std::array::from_fn(|j| std::array::from_fn(|i| 0.5 * (a[j][i] + a[i][j])))
}

/// The lower Cholesky factor of a symmetric matrix, of which the lower half is read; nothing where it is not positive definite to
/// working precision, or not finite.
#[inline]
pub fn cholesky<const M: usize>(a: &Columns<M, M>) -> Option<Columns<M, M>> {
    let mut lower = [[0.0; M]; M];
    for j in 0..M {
        let mut column = a[j];
        for before in &lower[..j] {
            add_scaled(&mut column, -before[j], before);
        }
        let pivot = column[j];
        if !(pivot > 0.0 && pivot < f64::INFINITY) {
            return None;
        }
        let root = pivot.sqrt();
        lower[j][j..].iter_mut().zip(&column[j..]).for_each(|(to, from)| *to = from / root);
    }
    Some(lower)
}

/// `lower^-1 x`.
#[inline]
pub fn solve<const M: usize>(lower: &Columns<M, M>, mut x: [f64; M]) -> [f64; M] {
    for j in 0..M {
        x[j] /= lower[j][j];
        let solved = x[j];
        x[j + 1..].iter_mut().zip(&lower[j][j + 1..]).for_each(|(x, below)| *x -= below * solved);
    }
    x
}

/// `x (lower lower')^-1`: the gain, of a covariance with what is measured and the factor of the innovation's.
#[inline]
pub fn divide<const N: usize, const M: usize>(mut x: Columns<N, M>, lower: &Columns<M, M>) -> Columns<N, M> {
    for j in 0..M {
        let (solved, rest) = x.split_at_mut(j);
        solved.iter().zip(lower).for_each(|(y, l)| add_scaled(&mut rest[0], -l[j], y));
        rest[0].iter_mut().for_each(|x| *x /= lower[j][j]);
    }
    for j in (0..M).rev() {
        let (rest, solved) = x.split_at_mut(j + 1);
        solved.iter().zip(&lower[j][j + 1..]).for_each(|(y, l)| add_scaled(&mut rest[j], -l, y));
        rest[j].iter_mut().for_each(|x| *x /= lower[j][j]);
    }
    x
}

/// A vector as one column.
#[inline]
pub fn column<const M: usize>(x: &SVector<f64, M>) -> [f64; M] {
    x.data.0[0]
}

/// Columns as a matrix.
#[inline]
pub fn matrix<const M: usize, const N: usize>(columns: Columns<M, N>) -> SMatrix<f64, M, N> {
    SMatrix::from_data(nalgebra::ArrayStorage(columns))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Positive, and not symmetric about anything.
    fn example() -> Columns<4, 4> {
        let mut sum = [[0.1, 0.0, 0.0, 0.0], [0.0, 0.2, 0.0, 0.0], [0.0, 0.0, 0.3, 0.0], [0.0, 0.0, 0.0, 0.4]];
        add_square(&mut sum, &[[1.0, -2.0, 3.0, 0.7], [0.3, 5.0, -1.1, 2.0], [4.0, 0.1, 0.2, -0.3]]);
        sum
    }

    #[test]
    fn a_factor_gives_its_matrix_back() {
        let a = example();
        let lower = cholesky(&a).unwrap();
        let mut back = [[0.0; 4]; 4];
        add_square(&mut back, &lower);
        assert!((matrix(back) - matrix(a)).amax() < 1e-13);
        assert_eq!(matrix(a), matrix(a).transpose());
        assert!((0..4).all(|j| lower[j][..j].iter().all(|x| *x == 0.0)));
    }

    #[test]
    fn what_is_not_positive_or_not_finite_has_no_factor() {
        assert_eq!(cholesky(&[[1.0, 2.0], [2.0, 1.0]]), None);
        assert_eq!(cholesky(&[[0.0]]), None);
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(cholesky(&[[1.0, bad], [bad, 1.0]]), None);
            assert_eq!(cholesky(&[[1.0, 0.0], [0.0, bad]]), None);
        }
    }

    #[test]
    fn equations_are_solved() {
        let a = example();
        let lower = cholesky(&a).unwrap();
        let x = SVector::from([1.0, -2.0, 0.5, 3.0]);
        let whole: SVector<f64, 4> = matrix(lower) * SVector::from(solve(&lower, x.into()));
        assert!((whole - x).amax() < 1e-12);
        let gain = divide([[1.0, 2.0], [3.0, 4.0], [5.0, 6.0], [-7.0, 8.0]], &lower);
        let back = matrix(gain) * matrix(a);
        assert!((back - SMatrix::<f64, 2, 4>::new(1.0, 3.0, 5.0, -7.0, 2.0, 4.0, 6.0, 8.0)).amax() < 1e-10);
    }
}
