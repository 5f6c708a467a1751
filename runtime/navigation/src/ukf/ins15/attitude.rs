//! Euler angles zyx: what they do to vectors, and what rates of turn do to them.

use super::kinematics::{ATTITUDE, part};
use albacore_geometry::math::sin_cos;
use nalgebra::{Matrix3, SVector, Vector3};

/// Nose up or down by a right angle, roll and yaw are one: the cosine of pitch is held off 0 by this.
const COS_PITCH_MIN: f64 = 1e-6;

/// Sines and cosines of the Euler angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Angles {
    sin_roll: f64,
    cos_roll: f64,
    sin_pitch: f64,
    cos_pitch: f64,
    sin_yaw: f64,
    cos_yaw: f64,
}

/// The last angles with their sines and cosines: most sigma points differ from the mean in other states only.
#[derive(Clone, Copy, Debug, Default)]
pub struct Trigonometry(Option<(Vector3<f64>, Angles)>);

impl Trigonometry {
    /// Of a state.
    #[inline]
    pub fn of(&mut self, state: &SVector<f64, 15>) -> Angles {
        let attitude = part(state, ATTITUDE);
        match self.0 {
            Some((last, angles)) if last == attitude => angles,
            _ => {
                let angles = Angles::of(&attitude);
                self.0 = Some((attitude, angles));
                angles
            }
        }
    }
}

impl Angles {
    /// Of roll, pitch and yaw, rad.
    fn of(attitude: &Vector3<f64>) -> Self {
        let ((sin_roll, cos_roll), (sin_pitch, cos_pitch), (sin_yaw, cos_yaw)) =
            (sin_cos(attitude.x), sin_cos(attitude.y), sin_cos(attitude.z));
        Angles { sin_roll, cos_roll, sin_pitch, cos_pitch, sin_yaw, cos_yaw }
    }

    /// A vector of the body in the frame of north, east and down: the paper's `J1`.
    #[inline]
    pub fn to_ned(self, v: &Vector3<f64>) -> Vector3<f64> {
        let starboard = self.cos_roll * v.y - self.sin_roll * v.z;
        let down = self.sin_roll * v.y + self.cos_roll * v.z;
        let ahead = self.cos_pitch * v.x + self.sin_pitch * down;
        Vector3::new(
            self.cos_yaw * ahead - self.sin_yaw * starboard,
            self.sin_yaw * ahead + self.cos_yaw * starboard,
            self.cos_pitch * down - self.sin_pitch * v.x,
        )
    }

    /// A vector of north, east and down in the frame of the body: `J1` transposed.
    #[inline]
    pub fn to_body(self, v: &Vector3<f64>) -> Vector3<f64> {
        let ahead = self.cos_yaw * v.x + self.sin_yaw * v.y;
        let starboard = self.cos_yaw * v.y - self.sin_yaw * v.x;
        let below = self.sin_pitch * ahead + self.cos_pitch * v.z;
        Vector3::new(
            self.cos_pitch * ahead - self.sin_pitch * v.z,
            self.cos_roll * starboard + self.sin_roll * below,
            self.cos_roll * below - self.sin_roll * starboard,
        )
    }

    /// What of rates of turn in the body's frame are rates of roll, pitch and yaw: `J2`.
    #[inline]
    pub fn rates(self) -> Matrix3<f64> {
        let cos_pitch = COS_PITCH_MIN.max(self.cos_pitch.abs()).copysign(self.cos_pitch);
        let (tan_pitch, sec_pitch) = (self.sin_pitch / cos_pitch, 1.0 / cos_pitch);
        Matrix3::new(
            1.0,
            self.sin_roll * tan_pitch,
            self.cos_roll * tan_pitch,
            0.0,
            self.cos_roll,
            -self.sin_roll,
            0.0,
            self.sin_roll * sec_pitch,
            self.cos_roll * sec_pitch,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn the_nose_points_where_yaw_and_pitch_say() {
        let ahead = Vector3::new(1.0, 0.0, 0.0);
        let east = Angles::of(&Vector3::new(0.3, 0.0, FRAC_PI_2)).to_ned(&ahead);
        assert!((east - Vector3::new(0.0, 1.0, 0.0)).amax() < 1e-15);
        let up = Angles::of(&Vector3::new(0.0, FRAC_PI_2, 0.0)).to_ned(&ahead);
        assert!((up - Vector3::new(0.0, 0.0, -1.0)).amax() < 1e-15);
    }

    #[test]
    fn one_direction_undoes_the_other() {
        let angles = Angles::of(&Vector3::new(0.4, -0.7, 2.0));
        let v = Vector3::new(1.0, -2.0, 3.0);
        assert!((angles.to_body(&angles.to_ned(&v)) - v).amax() < 1e-15);
    }

    #[test]
    fn rates_are_finite_also_with_the_nose_up() {
        assert!(Angles::of(&Vector3::new(0.0, FRAC_PI_2, 0.0)).rates().iter().all(|x| x.is_finite()));
    }
}
