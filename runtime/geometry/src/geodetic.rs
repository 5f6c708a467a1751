//! Positions on the globe, and the local tangent plane in which a mission works.

use crate::math::{cos, degrees, radians, sin};
use crate::plane::Point;
use serde::{Deserialize, Serialize};

/// WGS 84 equatorial radius, in metres.
const SEMI_MAJOR_M: f64 = 6_378_137.0;
/// WGS 84 first eccentricity squared.
const ECCENTRICITY_SQUARED: f64 = 6.694_379_990_141_32e-3;

/// A position on the globe (WGS 84), in radians; north and east are positive.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Geodetic {
    /// Latitude in radians, north positive.
    pub latitude_rad: f64,
    /// Longitude in radians, east positive.
    pub longitude_rad: f64,
}

impl Geodetic {
    /// A position given in degrees.
    pub fn from_degrees(latitude_deg: f64, longitude_deg: f64) -> Self {
        Geodetic { latitude_rad: radians(latitude_deg), longitude_rad: radians(longitude_deg) }
    }

    /// Latitude in degrees.
    pub fn latitude_deg(self) -> f64 {
        degrees(self.latitude_rad)
    }

    /// Longitude in degrees.
    pub fn longitude_deg(self) -> f64 {
        degrees(self.longitude_rad)
    }
}

/// As scripts write it, to a thousandth of a minute: `36°11.035'N 75°44.621'W`.
impl std::fmt::Display for Geodetic {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let halves = [(self.latitude_deg(), 'N', 'S'), (self.longitude_deg(), 'E', 'W')];
        for (i, (angle_deg, positive, negative)) in halves.into_iter().enumerate() {
            // Rounded as a whole, so that no minutes are 60.
            let thousandths = (angle_deg.abs() * 60_000.0).round() as u64;
            let (whole, minutes) = (thousandths / 60_000, thousandths % 60_000);
            let half = if angle_deg < 0.0 { negative } else { positive };
            let blank = if i == 0 { "" } else { " " };
            write!(f, "{blank}{whole}°{}.{:03}'{half}", minutes / 1000, minutes % 1000)?;
        }
        Ok(())
    }
}

/// The plane that touches the ellipsoid at `origin`: north and east scale with the two radii of curvature there.
///
/// Over the few kilometres of an operating area the error against the geodesic is below a millimetre a kilometre.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TangentFrame {
    /// Where the plane touches: north 0, east 0.
    pub origin: Geodetic,
}

impl TangentFrame {
    /// The metres that one radian of latitude and one of longitude span at the origin.
    fn metres_per_radian(self) -> (f64, f64) {
        let s = sin(self.origin.latitude_rad);
        let w = 1.0 - ECCENTRICITY_SQUARED * s * s;
        let meridian = SEMI_MAJOR_M * (1.0 - ECCENTRICITY_SQUARED) / (w * w.sqrt());
        let prime_vertical = SEMI_MAJOR_M / w.sqrt();
        (meridian, prime_vertical * cos(self.origin.latitude_rad))
    }

    /// The point of the plane for a position.
    pub fn to_point(self, position: Geodetic) -> Point {
        let (north, east) = self.metres_per_radian();
        Point::new(
            (position.latitude_rad - self.origin.latitude_rad) * north,
            (position.longitude_rad - self.origin.longitude_rad) * east,
        )
    }

    /// The position of a point of the plane.
    pub fn to_geodetic(self, point: Point) -> Geodetic {
        let (north, east) = self.metres_per_radian();
        Geodetic {
            latitude_rad: self.origin.latitude_rad + point.north / north,
            longitude_rad: self.origin.longitude_rad + point.east / east,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The 2005 paper's Duck mission: it prints positions both ways (Sec. IV, Fig. 6).
    #[test]
    fn a_position_is_written_as_scripts_write_it() {
        let written = |latitude, longitude| Geodetic::from_degrees(latitude, longitude).to_string();
        assert_eq!(written(36.0 + 11.035 / 60.0, -(75.0 + 44.621 / 60.0)), "36°11.035'N 75°44.621'W");
        assert_eq!(written(-0.999_999_999, 12.05), "1°0.000'S 12°3.000'E");
    }

    #[test]
    fn declared_and_true_source_of_the_2003_trial() {
        let declared = Geodetic::from_degrees(36.0 + 11.028 / 60.0, -(75.0 + 44.620 / 60.0));
        let surveyed = Geodetic::from_degrees(36.0 + 11.035 / 60.0, -(75.0 + 44.621 / 60.0));
        let error = TangentFrame { origin: surveyed }.to_point(declared);
        assert!((error.north + 13.0).abs() < 0.5, "13 m south: {error:?}");
        assert!((error.east - 1.5).abs() < 0.5, "2 m east: {error:?}");
    }

    #[test]
    fn there_and_back() {
        let frame = TangentFrame { origin: Geodetic::from_degrees(36.18, -75.74) };
        let p = Point::new(414.0, -242.0);
        assert!(frame.to_point(frame.to_geodetic(p)).distance(p) < 1e-6);
    }
}
