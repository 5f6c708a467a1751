//! The globe as a whole, where no plane will do: how far apart two positions are, and longitudes beside the 180th meridian.

use crate::geodetic::Geodetic;
use crate::math::{asin, cos, sin};

/// The mean radius of the Earth, m (WGS 84: a third of twice the equatorial and once the polar radius).
const MEAN_RADIUS_M: f64 = 6_371_008.8;

impl Geodetic {
    /// The distance along a great circle of the mean sphere, m; within 0.6 % of the geodesic's.
    pub fn great_circle(self, other: Geodetic) -> f64 {
        let half = |from: f64, to: f64| sin((to - from) / 2.0);
        let north = half(self.latitude_rad, other.latitude_rad);
        let east = half(self.longitude_rad, other.longitude_rad);
        let chord = north * north + cos(self.latitude_rad) * cos(other.latitude_rad) * east * east;
        2.0 * MEAN_RADIUS_M * asin(chord.sqrt())
    }
}

/// A longitude, in degrees, by the turn that is nearest to another: beside 179.9 stands 180.1 for -179.9. One that is no more
/// than half a turn away stays the same to the bit.
pub fn longitude_beside(longitude_deg: f64, other_deg: f64) -> f64 {
    match longitude_deg - other_deg {
        east if east > 180.0 => longitude_deg - 360.0,
        west if west < -180.0 => longitude_deg + 360.0,
        _ => longitude_deg,
    }
}

/// Whether the longitudes of a polygon's corners, in their order, go once round the globe: a pole lies in it.
pub fn goes_round_a_pole(longitudes_deg: &[f64]) -> bool {
    let next = longitudes_deg.iter().cycle().skip(1);
    let turned: f64 = longitudes_deg.iter().zip(next).map(|(&here, &there)| longitude_beside(there, here) - here).sum();
    turned.abs() > 180.0
}

/// A longitude, in degrees, in (-180, 180]; one that is there already stays the same to the bit.
pub fn longitude_within(longitude_deg: f64) -> f64 {
    if longitude_deg > -180.0 && longitude_deg <= 180.0 {
        return longitude_deg;
    }
    let turned = longitude_deg - 360.0 * (longitude_deg / 360.0).round();
    if turned <= -180.0 { turned + 360.0 } else { turned }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_those_of_the_sphere() {
        let of = |a: (f64, f64), b: (f64, f64)| {
            Geodetic::from_degrees(a.0, a.1).great_circle(Geodetic::from_degrees(b.0, b.1))
        };
        let quarter = MEAN_RADIUS_M * crate::math::PI / 2.0;
        assert!((of((0.0, 0.0), (90.0, 33.0)) - quarter).abs() < 1.0);
        assert!((of((0.0, 0.0), (0.0, 180.0)) - 2.0 * quarter).abs() < 1.0);
        // Two minutes of longitude on the equator, across the 180th meridian.
        assert!((of((0.0, 179.0 + 59.0 / 60.0), (0.0, -179.0 - 59.0 / 60.0)) - 3706.5).abs() < 0.1);
    }

    #[test]
    fn longitudes_stand_beside_each_other() {
        assert_eq!(longitude_beside(-179.5, 179.5), 180.5);
        assert_eq!(longitude_beside(179.5, -179.5), -180.5);
        assert_eq!(longitude_beside(-75.7, -75.8), -75.7);
        assert_eq!(longitude_within(180.5), -179.5);
        assert_eq!(longitude_within(-180.0), 180.0);
        assert_eq!(longitude_within(180.0), 180.0);
        assert_eq!(longitude_within(-540.0), 180.0);
        assert_eq!(longitude_within(-75.7), -75.7);
    }
}
