//! The transverse Mercator projection of the WGS 84 ellipsoid with unit scale on its central meridian, by Krueger's series to the
//! sixth order in the third flattening: C. F. F. Karney, "Transverse Mercator with an accuracy of a few nanometers", Journal of
//! Geodesy 85 (2011), equations 7 to 11, 14, 19 to 21, 35 and 36.

use crate::ellipsoid::{ECCENTRICITY_SQUARED, FLATTENING, SEMI_MAJOR_M};
use crate::math::{asinh, atan, atan2, atanh, cos, cosh, hypot, sin, sinh, tan};

/// The third flattening.
const N: f64 = FLATTENING / (2.0 - FLATTENING);
const N2: f64 = N * N;
const N3: f64 = N2 * N;
const N4: f64 = N2 * N2;
const N5: f64 = N4 * N;
const N6: f64 = N3 * N3;
/// The radius of the circle that is as long round as a meridian, in metres.
const RECTIFYING_M: f64 = SEMI_MAJOR_M / (1.0 + N) * (1.0 + N2 / 4.0 + N4 / 64.0 + N6 / 256.0);

/// From the sphere of the conformal latitude to the plane.
const ALPHA: [f64; 6] = [
    N / 2.0 - 2.0 * N2 / 3.0 + 5.0 * N3 / 16.0 + 41.0 * N4 / 180.0 - 127.0 * N5 / 288.0 + 7_891.0 * N6 / 37_800.0,
    13.0 * N2 / 48.0 - 3.0 * N3 / 5.0 + 557.0 * N4 / 1_440.0 + 281.0 * N5 / 630.0 - 1_983_433.0 * N6 / 1_935_360.0,
    61.0 * N3 / 240.0 - 103.0 * N4 / 140.0 + 15_061.0 * N5 / 26_880.0 + 167_603.0 * N6 / 181_440.0,
    49_561.0 * N4 / 161_280.0 - 179.0 * N5 / 168.0 + 6_601_661.0 * N6 / 7_257_600.0,
    34_729.0 * N5 / 80_640.0 - 3_418_889.0 * N6 / 1_995_840.0,
    212_378_941.0 * N6 / 319_334_400.0,
];

/// And back.
const BETA: [f64; 6] = [
    N / 2.0 - 2.0 * N2 / 3.0 + 37.0 * N3 / 96.0 - N4 / 360.0 - 81.0 * N5 / 512.0 + 96_199.0 * N6 / 604_800.0,
    N2 / 48.0 + N3 / 15.0 - 437.0 * N4 / 1_440.0 + 46.0 * N5 / 105.0 - 1_118_711.0 * N6 / 3_870_720.0,
    17.0 * N3 / 480.0 - 37.0 * N4 / 840.0 - 209.0 * N5 / 4_480.0 + 5_569.0 * N6 / 90_720.0,
    4_397.0 * N4 / 161_280.0 - 11.0 * N5 / 504.0 - 830_251.0 * N6 / 7_257_600.0,
    4_583.0 * N5 / 161_280.0 - 108_847.0 * N6 / 3_991_680.0,
    20_648_693.0 * N6 / 638_668_800.0,
];

/// Beyond this easting, in radians of the rectifying circle, the series tell nothing: what lies farther is held there. That is
/// 84 degrees from the central meridian.
const EASTING_MAX: f64 = 3.0;

/// Rounds of Newton's method for a latitude; two reach the last bits.
const ROUNDS: usize = 4;

/// Metres north of the equator and east of the central meridian, of a latitude and a longitude from that meridian, in radians.
pub fn forward(latitude: f64, longitude: f64) -> (f64, f64) {
    let tau = conformal(tan(latitude));
    let (s, c) = (sin(longitude), cos(longitude));
    let xi = atan2(tau, c);
    let eta = asinh(s / hypot(tau, c)).clamp(-EASTING_MAX, EASTING_MAX);
    let (mut north, mut east) = (xi, eta);
    for (j, alpha) in (1..).zip(ALPHA) {
        let twice = 2.0 * f64::from(j);
        north += alpha * sin(twice * xi) * cosh(twice * eta);
        east += alpha * cos(twice * xi) * sinh(twice * eta);
    }
    (RECTIFYING_M * north, RECTIFYING_M * east)
}

/// The latitude, and the longitude from the central meridian, in radians, of metres north of the equator and east of it.
pub fn inverse(north: f64, east: f64) -> (f64, f64) {
    let (xi, eta) = (north / RECTIFYING_M, (east / RECTIFYING_M).clamp(-EASTING_MAX, EASTING_MAX));
    let (mut xi_sphere, mut eta_sphere) = (xi, eta);
    for (j, beta) in (1..).zip(BETA) {
        let twice = 2.0 * f64::from(j);
        xi_sphere -= beta * sin(twice * xi) * cosh(twice * eta);
        eta_sphere -= beta * cos(twice * xi) * sinh(twice * eta);
    }
    let (s, c) = (sinh(eta_sphere), cos(xi_sphere));
    (atan(geodetic(sin(xi_sphere) / hypot(s, c))), atan2(s, c))
}

/// The tangent of the conformal latitude, of that of the geodetic one.
fn conformal(tau: f64) -> f64 {
    let e = ECCENTRICITY_SQUARED.sqrt();
    let root = hypot(1.0, tau);
    let sigma = sinh(e * atanh(e * tau / root));
    tau * hypot(1.0, sigma) - sigma * root
}

/// The tangent of the geodetic latitude, of that of the conformal one.
fn geodetic(conformal_tau: f64) -> f64 {
    let mut tau = conformal_tau / (1.0 - ECCENTRICITY_SQUARED);
    for _ in 0..ROUNDS {
        let here = conformal(tau);
        let slope = (1.0 - ECCENTRICITY_SQUARED) * hypot(1.0, here) * hypot(1.0, tau)
            / (1.0 + (1.0 - ECCENTRICITY_SQUARED) * tau * tau);
        let step = (conformal_tau - here) / slope;
        if !step.is_finite() {
            break;
        }
        tau += step;
    }
    tau
}
