//! The inverse of a mass matrix.

use super::six_dof::Six;
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

/// The inverse of the mass matrix of a body that is alike to port and starboard: surge, heave and pitch push one another, and
/// sway, roll and yaw do, but no two across.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InverseMass {
    longitudinal: Matrix3<f64>,
    lateral: Matrix3<f64>,
}

/// Surge, heave and pitch.
const LONGITUDINAL: [usize; 3] = [0, 2, 4];
/// Sway, roll and yaw.
const LATERAL: [usize; 3] = [1, 3, 5];

impl InverseMass {
    /// Of a regular matrix (by a singular one no force would accelerate anything); what couples the two groups is left out.
    pub fn of(mass: &Matrix6<f64>) -> Self {
        let inverse = |of: [usize; 3]| Matrix3::from_fn(|i, j| mass[(of[i], of[j])]).try_inverse().unwrap_or_default();
        InverseMass { longitudinal: inverse(LONGITUDINAL), lateral: inverse(LATERAL) }
    }

    /// The acceleration that a force makes.
    #[inline]
    pub fn accelerate(&self, force: &Six) -> Six {
        let [surge, sway, heave, roll, pitch, yaw] = (*force).into();
        let longitudinal = self.longitudinal * Vector3::new(surge, heave, pitch);
        let lateral = self.lateral * Vector3::new(sway, roll, yaw);
        Vector6::new(longitudinal.x, lateral.x, longitudinal.y, lateral.y, longitudinal.z, lateral.z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_matrix_times_the_acceleration_is_the_force() {
        let mut mass = Matrix6::from_fn(|i, j| if i == j { 5.0 + i as f64 } else { 0.0 });
        for (i, j, value) in
            [(0, 4, 0.6), (4, 0, 0.7), (2, 4, 1.9), (4, 2, -0.3), (1, 3, -0.6), (5, 1, 1.2), (1, 5, -1.9)]
        {
            mass[(i, j)] = value;
        }
        let force = Vector6::new(1.0, -2.0, 3.0, 0.5, -0.25, 4.0);
        let back = mass * InverseMass::of(&mass).accelerate(&force);
        assert!((back - force).amax() < 1e-14, "{back} {force}");
    }
}
