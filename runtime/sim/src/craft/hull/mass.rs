//! The inverse of a mass matrix.

use super::six_dof::Six;

/// The inverse of the mass matrix of a body that is alike to port and starboard: surge, heave and pitch push one another, and
/// sway, roll and yaw do, but no two across.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InverseMass {
    longitudinal: [[f64; 3]; 3],
    lateral: [[f64; 3]; 3],
}

/// Surge, heave and pitch.
const LONGITUDINAL: [usize; 3] = [0, 2, 4];
/// Sway, roll and yaw.
const LATERAL: [usize; 3] = [1, 3, 5];

impl InverseMass {
    /// Of a regular matrix; what couples the two groups is left out.
    pub fn of(mass: &[Six; 6]) -> Self {
        let block = |of: [usize; 3]| inverse(&of.map(|i| of.map(|j| mass[i][j])));
        InverseMass { longitudinal: block(LONGITUDINAL), lateral: block(LATERAL) }
    }

    /// The acceleration that a force makes.
    #[inline]
    pub fn accelerate(&self, force: &Six) -> Six {
        let product = |m: &[[f64; 3]; 3], f: [f64; 3]| m.map(|row| row[0] * f[0] + row[1] * f[1] + row[2] * f[2]);
        let [surge, heave, pitch] = product(&self.longitudinal, LONGITUDINAL.map(|i| force[i]));
        let [sway, roll, yaw] = product(&self.lateral, LATERAL.map(|i| force[i]));
        [surge, sway, heave, roll, pitch, yaw]
    }
}

/// The inverse of a regular matrix: its adjugate over its determinant.
fn inverse(m: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let cofactor = |i: usize, j: usize| {
        let (a, b, c, d) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
        m[a][c] * m[b][d] - m[a][d] * m[b][c]
    };
    let determinant = (0..3).map(|j| m[0][j] * cofactor(0, j)).sum::<f64>();
    std::array::from_fn(|i| std::array::from_fn(|j| cofactor(j, i) / determinant))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_matrix_times_the_acceleration_is_the_force() {
        let mut mass: [Six; 6] =
            std::array::from_fn(|i| std::array::from_fn(|j| if i == j { 5.0 + i as f64 } else { 0.0 }));
        for (i, j, value) in
            [(0, 4, 0.6), (4, 0, 0.7), (2, 4, 1.9), (4, 2, -0.3), (1, 3, -0.6), (5, 1, 1.2), (1, 5, -1.9)]
        {
            mass[i][j] = value;
        }
        let force = [1.0, -2.0, 3.0, 0.5, -0.25, 4.0];
        let acceleration = InverseMass::of(&mass).accelerate(&force);
        for (row, force) in mass.iter().zip(force) {
            let back: f64 = row.iter().zip(acceleration).map(|(m, a)| m * a).sum();
            assert!((back - force).abs() < 1e-14, "{back} {force}");
        }
    }
}
