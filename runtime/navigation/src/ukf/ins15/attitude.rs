//! The attitude of a state, and what rates of turn do to it.

use super::kinematics::{ATTITUDE, part};
use albacore_geometry::Attitude;
use nalgebra::{Matrix3, SVector, Vector3};

/// The last attitude with its sines and cosines: most sigma points differ from the mean in other states only.
#[derive(Clone, Copy, Debug, Default)]
pub struct Trigonometry(Option<(Vector3<f64>, Attitude)>);

impl Trigonometry {
    /// Of a state.
    #[inline]
    pub fn of(&mut self, state: &SVector<f64, 15>) -> Attitude {
        let angles = part(state, ATTITUDE);
        match self.0 {
            Some((last, attitude)) if last == angles => attitude,
            _ => {
                let attitude = Attitude::of(angles.x, angles.y, angles.z);
                self.0 = Some((angles, attitude));
                attitude
            }
        }
    }
}

/// What of rates of turn in the body's frame are rates of roll, pitch and yaw: `J2`, Eq. (3).
#[inline]
pub fn rates(of: Attitude) -> Matrix3<f64> {
    let (tan_pitch, sec_pitch) = (of.sin_pitch / of.divisor(), 1.0 / of.divisor());
    Matrix3::new(
        1.0,
        of.sin_roll * tan_pitch,
        of.cos_roll * tan_pitch,
        0.0,
        of.cos_roll,
        -of.sin_roll,
        0.0,
        of.sin_roll * sec_pitch,
        of.cos_roll * sec_pitch,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn rates_are_finite_also_with_the_nose_up() {
        assert!(rates(Attitude::of(0.0, FRAC_PI_2, 0.0)).iter().all(|x| x.is_finite()));
    }
}
