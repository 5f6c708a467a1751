//! The WGS 84 ellipsoid.

use crate::math::{cos, sin};

/// Equatorial radius, in metres.
pub(crate) const SEMI_MAJOR_M: f64 = 6_378_137.0;
/// Flattening.
pub(crate) const FLATTENING: f64 = 1.0 / 298.257_223_563;
/// First eccentricity squared.
pub(crate) const ECCENTRICITY_SQUARED: f64 = FLATTENING * (2.0 - FLATTENING);

/// The metres that a radian of latitude and one of longitude span at a latitude, in radians, on WGS 84: the meridional radius of
/// curvature `M = a (1 - e^2) / (1 - e^2 sin^2 latitude)^(3/2)`, and the radius of the parallel `N cos latitude` with
/// `N = a / sqrt(1 - e^2 sin^2 latitude)`.
///
/// True at that latitude only. A place `n` metres north and `e` metres east of the point they are taken at comes to lie about
/// `e^2 tan(latitude) / 2 R` south and `n e tan(latitude) / R` east or west of its place in a
/// [`TangentFrame`](crate::TangentFrame): for small or scaled grids, not for positions.
pub fn metres_per_radian(latitude_rad: f64) -> (f64, f64) {
    let s = sin(latitude_rad);
    let w = 1.0 - ECCENTRICITY_SQUARED * s * s;
    let prime_vertical = SEMI_MAJOR_M / w.sqrt();
    (prime_vertical * (1.0 - ECCENTRICITY_SQUARED) / w, prime_vertical * cos(latitude_rad))
}
