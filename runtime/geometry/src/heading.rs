//! A direction on the compass, and the smallest angle between two.

use crate::math::{PI, TAU, atan2, degrees, radians, sin_cos};
use crate::plane::Vector;
use serde::{Deserialize, Serialize};
use std::ops::{Add, Sub};

/// Angles from 0 to this, which is below a full turn, and within this on either side of 0 are known to need no wrapping.
const WITHIN_TURN: f64 = 6.25;
const WITHIN_HALF_TURN: f64 = 3.125;

/// A compass direction, clockwise from north, always in [0, 2 pi).
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd, Serialize, Deserialize)]
pub struct Heading(f64);

impl Heading {
    /// North.
    pub const NORTH: Heading = Heading(0.0);

    /// The heading of an angle in radians, clockwise from north, wrapped.
    #[inline]
    pub fn from_radians(angle_rad: f64) -> Self {
        // Most angles lie within the turn already, and stay what they are to the bit: the whole turns below them are none.
        Heading(if (0.0..WITHIN_TURN).contains(&angle_rad) { angle_rad + 0.0 } else { within_turn(angle_rad) })
    }

    /// The heading of an angle in degrees, clockwise from north, wrapped.
    pub fn from_degrees(angle_deg: f64) -> Self {
        Self::from_radians(radians(angle_deg))
    }

    /// The direction of a vector; north for the null vector.
    pub fn of(vector: Vector) -> Self {
        if vector.north == 0.0 && vector.east == 0.0 {
            Self::NORTH
        } else {
            Self::from_radians(atan2(vector.east, vector.north))
        }
    }

    /// Radians in [0, 2 pi).
    pub fn radians(self) -> f64 {
        self.0
    }

    /// Degrees in [0, 360].
    pub fn degrees(self) -> f64 {
        degrees(self.0)
    }

    /// The unit vector in this direction.
    pub fn unit(self) -> Vector {
        let (sin, cos) = sin_cos(self.0);
        Vector::new(cos, sin)
    }

    /// The opposite direction.
    pub fn reverse(self) -> Self {
        Self::from_radians(self.0 + PI)
    }
}

/// Turned clockwise by an angle in radians.
impl Add<f64> for Heading {
    type Output = Heading;
    #[inline]
    fn add(self, angle_rad: f64) -> Heading {
        Heading::from_radians(self.0 + angle_rad)
    }
}

/// Turned counter-clockwise by an angle in radians.
impl Sub<f64> for Heading {
    type Output = Heading;
    #[inline]
    fn sub(self, angle_rad: f64) -> Heading {
        Heading::from_radians(self.0 - angle_rad)
    }
}

/// The angle in radians, in (-pi, pi], by which the right-hand heading must turn clockwise to become the left-hand one.
impl Sub for Heading {
    type Output = f64;
    #[inline]
    fn sub(self, other: Heading) -> f64 {
        wrap_angle(self.0 - other.0)
    }
}

/// The equivalent angle in (-pi, pi]: the paper's lim(x, -180, 180).
#[inline]
pub fn wrap_angle(angle_rad: f64) -> f64 {
    if angle_rad.abs() < WITHIN_HALF_TURN { angle_rad } else { within_half_turn(angle_rad) }
}

fn within_half_turn(angle_rad: f64) -> f64 {
    let wrapped = angle_rad - TAU * (angle_rad / TAU + 0.5).floor();
    let wrapped = if wrapped <= -PI { wrapped + TAU } else { wrapped };
    if wrapped > -PI && wrapped <= PI {
        return wrapped;
    }
    let turned = remainder(angle_rad);
    if turned > PI { turned - TAU } else { turned }
}

/// What an angle is beyond whole turns, in [0, 2 pi).
fn within_turn(angle_rad: f64) -> f64 {
    let wrapped = angle_rad - TAU * (angle_rad / TAU).floor();
    if (0.0..TAU).contains(&wrapped) { wrapped + 0.0 } else { remainder(angle_rad) }
}

/// The same, where so many turns round that a product of them would miss it.
fn remainder(angle_rad: f64) -> f64 {
    let rest = angle_rad.rem_euclid(TAU);
    // An angle a hair below a full turn rounds up to it; what is no number stays none.
    if rest >= TAU { 0.0 } else { rest + 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_take_the_short_way_round() {
        let difference = Heading::from_degrees(350.0) - Heading::from_degrees(10.0);
        assert!((degrees(difference) + 20.0).abs() < 1e-12);
        assert_eq!(wrap_angle(PI), PI);
        assert_eq!(wrap_angle(-PI), PI);
        assert_eq!(wrap_angle(3.0 * PI), PI);
    }

    #[test]
    fn headings_stay_within_one_turn() {
        assert_eq!(Heading::from_degrees(-0.0).radians(), 0.0);
        assert_eq!(Heading::from_radians(-1e-18).radians(), 0.0);
        assert!(Heading::from_radians(TAU).radians() < TAU);
        assert!((Heading::from_degrees(-90.0).degrees() - 270.0).abs() < 1e-12);
    }

    #[test]
    fn angles_of_any_size_lie_within_a_turn() {
        for exponent in -300..=150 {
            for k in [1.0, 3.7, 9.99] {
                let magnitude = k * crate::math::pow(10.0, f64::from(exponent));
                for angle in [magnitude, -magnitude] {
                    assert!((0.0..TAU).contains(&Heading::from_radians(angle).radians()), "{angle:e}");
                    let wrapped = wrap_angle(angle);
                    assert!(wrapped > -PI && wrapped <= PI, "{angle:e} becomes {wrapped:e}");
                }
            }
        }
        for turns in 1..1_000_000 {
            let angle = (f64::from(turns) * TAU).next_down();
            assert!((0.0..TAU).contains(&Heading::from_radians(angle).radians()), "{angle:e}");
        }
    }

    #[test]
    fn a_null_vector_points_north() {
        assert_eq!(Heading::of(Vector::new(0.0, 0.0)), Heading::NORTH);
        assert_eq!(Heading::of(Vector::new(0.0, -2.0)).degrees(), 270.0);
    }
}
