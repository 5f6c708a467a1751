//! Where a transponder is from aboard, by times of arrival alone: what a filter begins anew with that does not know its place.

use nalgebra::{Matrix3, SVector, Vector3};

/// The way to a transponder, m, body, of which so many receivers tell the range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bearing {
    /// From the vehicle to the transponder.
    pub way: Vector3<f64>,
    /// The covariance of its error, m2.
    pub covariance: Matrix3<f64>,
    /// The sum of the squares of the residuals by their noise: chi-square with two degrees of freedom where the ranges are right.
    pub residual: f64,
}

/// The steps of Newton's method; from afar three do.
const STEPS: usize = 10;

impl Bearing {
    /// The least-squares solution of five ranges, m, with a standard deviation, m; none where they are no ranges, or all receivers lie in a plane.
    pub fn of(ranges: &[f64; 5], receivers: &[[f64; 3]; 5], sigma: f64) -> Option<Bearing> {
        let receivers = receivers.map(Vector3::from);
        let centre: Vector3<f64> = receivers.iter().sum::<Vector3<f64>>() / 5.0;
        let mean = ranges.iter().sum::<f64>() / 5.0;
        // From afar wave fronts are flat: the direction is that along which ranges fall.
        let (mut square, mut fall) = (Matrix3::zeros(), Vector3::zeros());
        for (receiver, range) in receivers.iter().zip(ranges) {
            let arm = receiver - centre;
            square += arm * arm.transpose();
            fall += arm * (mean - range);
        }
        let direction: Vector3<f64> = square.try_inverse()? * fall;
        let mut way = centre + direction.try_normalize(f64::MIN_POSITIVE)? * mean;
        let (mut best, mut best_residual) = (way, f64::INFINITY);
        for _ in 0..=STEPS {
            let (information, pull, residual) = fit(&way, ranges, &receivers)?;
            // From nearby a step may lead astray: the best so far counts.
            if residual < best_residual {
                (best, best_residual) = (way, residual);
            }
            way += information.try_inverse()? * pull;
        }
        let (information, _, residual) = fit(&best, ranges, &receivers)?;
        let covariance = information.try_inverse()? * (sigma * sigma);
        let is_sound = best.iter().chain(covariance.iter()).all(|x| x.is_finite());
        is_sound.then_some(Bearing { way: best, covariance, residual: residual / (sigma * sigma) })
    }

    /// The greatest variance of the way across itself, m2.
    pub fn across(&self) -> f64 {
        let unit = self.way / self.way.norm();
        let across = Matrix3::identity() - unit * unit.transpose();
        let values: SVector<f64, 3> = (across * self.covariance * across).symmetric_eigenvalues();
        values.max()
    }
}

/// The information that ranges have of a way, what they pull it by, and the sum of the squares of what they are off by, m2.
fn fit(
    way: &Vector3<f64>,
    ranges: &[f64; 5],
    receivers: &[Vector3<f64>; 5],
) -> Option<(Matrix3<f64>, Vector3<f64>, f64)> {
    let (mut information, mut pull, mut residual) = (Matrix3::zeros(), Vector3::zeros(), 0.0);
    for (receiver, range) in receivers.iter().zip(ranges) {
        let arm = way - receiver;
        let (off, unit) = (range - arm.norm(), arm.try_normalize(f64::MIN_POSITIVE)?);
        information += unit * unit.transpose();
        pull += unit * off;
        residual += off * off;
    }
    Some((information, pull, residual))
}

#[cfg(test)]
mod tests {
    use super::super::Ins15Setup;
    use super::*;

    #[test]
    fn exact_ranges_give_the_way_back_and_a_wrong_one_does_not_fit() {
        let receivers = Ins15Setup::default().receivers;
        for way in [Vector3::new(300.0, -200.0, -8.0), Vector3::new(-5.0, 1.0, 3.0), Vector3::new(0.0, 900.0, 20.0)] {
            let mut ranges = receivers.map(|receiver| (way - Vector3::from(receiver)).norm());
            let found = Bearing::of(&ranges, &receivers, 0.001).unwrap();
            assert!((found.way - way).norm() < 1e-3 * way.norm() && found.residual < 1e-3, "{found:?}");
            // 1 mm over a tenth of a metre.
            let spread = found.across().sqrt() / way.norm();
            assert!((0.005..0.03).contains(&spread), "{spread}");
            ranges[2] += 0.05;
            assert!(Bearing::of(&ranges, &receivers, 0.001).unwrap().residual > 100.0);
        }
        assert_eq!(Bearing::of(&[f64::NAN; 5], &receivers, 0.001), None);
    }
}
