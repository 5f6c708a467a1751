//! Angles and headings.

use crate::{Interval, Operation};
use albacore_geometry::math::{PI, TAU};
use albacore_geometry::{Heading, math, wrap_angle};

/// The sine of an angle.
pub struct Sin;

impl Operation<1> for Sin {
    #[inline]
    fn execute([a]: [f64; 1]) -> f64 {
        math::sin(a)
    }

    fn rule([a]: [Interval; 1]) -> Interval {
        a.constant().map_or(Interval::new(-1.0, 1.0), |a| Interval::exactly(Self::execute([a])))
    }
}

/// The cosine of an angle.
pub struct Cos;

impl Operation<1> for Cos {
    #[inline]
    fn execute([a]: [f64; 1]) -> f64 {
        math::cos(a)
    }

    fn rule([a]: [Interval; 1]) -> Interval {
        a.constant().map_or(Interval::new(-1.0, 1.0), |a| Interval::exactly(Self::execute([a])))
    }
}

/// An angle as a heading, in [0, 2 pi).
pub struct WrapHeading;

impl Operation<1> for WrapHeading {
    #[inline]
    fn execute([a]: [f64; 1]) -> f64 {
        Heading::from_radians(a).radians()
    }

    fn rule([a]: [Interval; 1]) -> Interval {
        a.constant().map_or(Interval::new(0.0, TAU), |a| Interval::exactly(Self::execute([a])))
    }
}

/// An angle as the smallest that turns as far, in (-pi, pi].
pub struct WrapAngle;

impl Operation<1> for WrapAngle {
    #[inline]
    fn execute([a]: [f64; 1]) -> f64 {
        wrap_angle(a)
    }

    fn rule([a]: [Interval; 1]) -> Interval {
        a.constant().map_or(Interval::new(-PI, PI), |a| Interval::exactly(Self::execute([a])))
    }
}
