//! How a body lies in space: Euler angles zyx, and what they do to vectors.

use crate::math::sin_cos;

/// Nose up or down by a right angle, roll and yaw are one: the cosine of pitch is held off 0 by this where rates are divided by it.
const COS_PITCH_MIN: f64 = 1e-6;

/// Sines and cosines of roll, pitch and yaw. Frames: north-east-down, and the body's own, x forward, y to starboard, z down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attitude {
    /// Of roll.
    pub sin_roll: f64,
    /// Of roll.
    pub cos_roll: f64,
    /// Of pitch.
    pub sin_pitch: f64,
    /// Of pitch.
    pub cos_pitch: f64,
    /// Of yaw.
    pub sin_yaw: f64,
    /// Of yaw.
    pub cos_yaw: f64,
}

impl Attitude {
    /// Of roll, pitch and yaw, rad.
    #[inline]
    pub fn of(roll: f64, pitch: f64, yaw: f64) -> Self {
        let ((sin_roll, cos_roll), (sin_pitch, cos_pitch), (sin_yaw, cos_yaw)) =
            (sin_cos(roll), sin_cos(pitch), sin_cos(yaw));
        Attitude { sin_roll, cos_roll, sin_pitch, cos_pitch, sin_yaw, cos_yaw }
    }

    /// A vector of the body in the frame of north, east and down: `J1` of Jayasiri et al. (2016), Eq. (3).
    #[inline]
    pub fn to_ned(self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        // Roll, then pitch, then yaw.
        let starboard = self.cos_roll * y - self.sin_roll * z;
        let down = self.sin_roll * y + self.cos_roll * z;
        let ahead = self.cos_pitch * x + self.sin_pitch * down;
        [
            self.cos_yaw * ahead - self.sin_yaw * starboard,
            self.sin_yaw * ahead + self.cos_yaw * starboard,
            self.cos_pitch * down - self.sin_pitch * x,
        ]
    }

    /// A vector of north, east and down in the frame of the body: `J1` transposed.
    #[inline]
    pub fn to_body(self, [north, east, down]: [f64; 3]) -> [f64; 3] {
        let ahead = self.cos_yaw * north + self.sin_yaw * east;
        let starboard = self.cos_yaw * east - self.sin_yaw * north;
        let below = self.sin_pitch * ahead + self.cos_pitch * down;
        [
            self.cos_pitch * ahead - self.sin_pitch * down,
            self.cos_roll * starboard + self.sin_roll * below,
            self.cos_roll * below - self.sin_roll * starboard,
        ]
    }

    /// The cosine of pitch, held off 0, so that rates of turn can be divided by it.
    #[inline]
    pub fn divisor(self) -> f64 {
        COS_PITCH_MIN.max(self.cos_pitch.abs()).copysign(self.cos_pitch)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    fn near(a: [f64; 3], b: [f64; 3]) -> bool {
        a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-15)
    }

    #[test]
    fn the_nose_points_where_yaw_and_pitch_say() {
        assert!(near(Attitude::of(0.3, 0.0, FRAC_PI_2).to_ned([1.0, 0.0, 0.0]), [0.0, 1.0, 0.0]));
        assert!(near(Attitude::of(0.0, FRAC_PI_2, 0.0).to_ned([1.0, 0.0, 0.0]), [0.0, 0.0, -1.0]));
        assert!(near(Attitude::of(FRAC_PI_2, 0.0, 0.0).to_ned([0.0, 1.0, 0.0]), [0.0, 0.0, 1.0]));
    }

    #[test]
    fn one_direction_undoes_the_other() {
        let attitude = Attitude::of(0.4, -0.7, 2.0);
        let back = attitude.to_body(attitude.to_ned([1.0, -2.0, 3.0]));
        assert!(back.iter().zip([1.0, -2.0, 3.0]).all(|(a, b)| (a - b).abs() < 1e-14), "{back:?}");
    }

    #[test]
    fn the_divisor_is_never_zero() {
        for pitch in [FRAC_PI_2, -FRAC_PI_2, FRAC_PI_2 + 1e-9] {
            assert!(Attitude::of(0.0, pitch, 0.0).divisor().abs() >= COS_PITCH_MIN);
        }
        assert_eq!(Attitude::of(0.0, 1.0, 0.0).divisor(), Attitude::of(0.0, 1.0, 0.0).cos_pitch);
    }
}
