//! How well a position is known, in each direction.

use albacore_geometry::Heading;
use albacore_geometry::math::atan2;

/// An ellipse of standard deviations: the error is expected to be in it in 39 % of cases, and in one three times as large in 99 %.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorEllipse {
    /// Half its length, m.
    pub major: f64,
    /// Half its width, m.
    pub minor: f64,
    /// Where its length points, within half a turn from north.
    pub toward: Heading,
}

impl ErrorEllipse {
    /// Of the variances of north and east and their covariance, m2.
    pub fn of(north: f64, east: f64, both: f64) -> Self {
        let (mean, half) = (0.5 * (north + east), 0.5 * (north - east));
        let radius = (half * half + both * both).sqrt();
        let angle = 0.5 * atan2(both, half);
        ErrorEllipse {
            major: (mean + radius).sqrt(),
            // Rounding may leave a little less than nothing.
            minor: (mean - radius).max(0.0).sqrt(),
            toward: Heading::from_radians(if angle < 0.0 { angle + std::f64::consts::PI } else { angle }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_and_direction_are_those_of_the_covariance() {
        let told = |north, east, both| {
            let ErrorEllipse { major, minor, toward } = ErrorEllipse::of(north, east, both);
            [major, minor, toward.degrees()].map(|x| (x * 1e6).round() / 1e6)
        };
        assert_eq!(told(9.0, 4.0, 0.0), [3.0, 2.0, 0.0]);
        assert_eq!(told(4.0, 9.0, 0.0), [3.0, 2.0, 90.0]);
        assert_eq!(told(2.5, 2.5, 1.5), [2.0, 1.0, 45.0]);
        assert_eq!(told(2.5, 2.5, -1.5), [2.0, 1.0, 135.0]);
        assert_eq!(told(8.0, 8.0, 8.0), [4.0, 0.0, 45.0]);
    }
}
