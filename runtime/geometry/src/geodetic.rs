//! Positions on the globe, and the local tangent plane in which a mission works.

use crate::heading::wrap_angle;
use crate::math::{degrees, radians};
use crate::mercator;
use crate::plane::Point;
use serde::{Deserialize, Serialize};

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

/// The plane in which a mission works: the transverse Mercator projection of the WGS 84 ellipsoid whose central meridian is that
/// of `origin`, with unit scale on it.
///
/// Angles are true, and so is the scale on the meridian of the origin. Off it lengths are too long by `east^2 / 2 R^2`: 0.01 mm a
/// kilometre at 1 km east or west of it, 1.0 mm at 9 km, 31 mm at 50 km, 123 mm at 100 km. From the origin itself the error of a
/// distance is a third of that at most. North in the plane is true north on that meridian; `east` metres off it the two differ by
/// the convergence of the meridians, `east tan(latitude) / R`: 0.0065 degrees a kilometre at 36 degrees of latitude, 0.0156 at 60
/// and 0.051 at 80. Headings are those of the plane.
///
/// Both directions agree within nanometres up to 3000 km from the meridian. Positions more than 84 degrees off it are held there.
/// Held against geodesics and PROJ in `tests/geodesics.rs`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TangentFrame {
    /// Where the plane touches: north 0, east 0.
    pub origin: Geodetic,
}

impl TangentFrame {
    /// Metres from the equator to the origin.
    fn northing(self) -> f64 {
        mercator::forward(self.origin.latitude_rad, 0.0).0
    }

    /// The point of the plane for a position.
    pub fn to_point(self, position: Geodetic) -> Point {
        let longitude = wrap_angle(position.longitude_rad - self.origin.longitude_rad);
        let (north, east) = mercator::forward(position.latitude_rad, longitude);
        Point::new(north - self.northing(), east)
    }

    /// The position of a point of the plane.
    pub fn to_geodetic(self, point: Point) -> Geodetic {
        let (latitude_rad, longitude) = mercator::inverse(point.north + self.northing(), point.east);
        Geodetic { latitude_rad, longitude_rad: wrap_angle(self.origin.longitude_rad + longitude) }
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
