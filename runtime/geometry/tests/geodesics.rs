//! The local frame against values of independent libraries: `data/geodesics.csv`, made by `data/geodesics.py`.

use albacore_geometry::math::{atan2, cos, degrees, radians, sin};
use albacore_geometry::{Geodetic, Point, TangentFrame, metres_per_radian, wrap_angle};

const VALUES: &str = include_str!("data/geodesics.csv");

/// A row of the values.
struct Value {
    frame: TangentFrame,
    azimuth_rad: f64,
    distance: f64,
    position: Geodetic,
    point: Point,
    convergence_deg: f64,
}

fn values() -> Vec<Value> {
    let rows = VALUES.lines().skip(2).map(|row| {
        let x: Vec<f64> = row.split(',').map(|cell| cell.parse().unwrap_or(f64::NAN)).collect();
        Value {
            frame: TangentFrame { origin: Geodetic::from_degrees(x[0], x[1]) },
            azimuth_rad: radians(x[2]),
            distance: x[3],
            position: Geodetic::from_degrees(x[4], x[5]),
            point: Point::new(x[6], x[7]),
            convergence_deg: x[8],
        }
    });
    rows.collect()
}

/// A position in radians has bits of a nanometre, and so have the metres from the equator.
const SAME_M: f64 = 1e-8;

#[test]
fn points_are_those_of_another_transverse_mercator() {
    let values = values();
    assert_eq!(values.len(), 448);
    let worst = values.iter().map(|v| v.frame.to_point(v.position).distance(v.point)).fold(0.0, f64::max);
    assert!(worst < SAME_M, "{worst:e} m");
}

#[test]
fn there_and_back_is_where_it_began() {
    for v in values() {
        let back = v.frame.to_geodetic(v.point);
        let again = v.frame.to_point(back).distance(v.point);
        assert!(again < SAME_M, "{again:e} m: {:?}", v.point);
        let apart = TangentFrame { origin: v.position }.to_point(back).distance(Point::ORIGIN);
        assert!(apart < SAME_M, "{apart:e} m: {back:?}");
        assert!((-180.0..=180.0).contains(&back.longitude_deg()), "{back:?}");
    }
}

/// What the documentation says of distances from the origin: the error is below a millimetre a kilometre up to 9 km, and a third
/// of `east^2 / 2 R^2` at most farther out. The straight line of the plane leaves the origin beside the geodesic by
/// `north east / 6 R^2` at most, 0.2 microradians at 9 km, and by a sixth of `e^2 sin cos (east / R)^3` since the ellipsoid is no
/// sphere: 13 micrometres at 50 km.
#[test]
fn distances_from_the_origin_are_those_of_geodesics() {
    for v in values() {
        let p = v.frame.to_point(v.position);
        let error = p.distance(Point::ORIGIN) - v.distance;
        let off = p.east / 6.356e6;
        let expected = v.distance * off * off / 6.0;
        assert!((error - expected).abs() < 0.03 * expected + SAME_M, "{error:e}, {expected:e} m at {} m", v.distance);
        assert!(v.distance > 9_000.0 || error.abs() < 0.34e-6 * v.distance + SAME_M, "{error:e} m at {} m", v.distance);
        let azimuth = atan2(p.east, p.north);
        let turned = wrap_angle(azimuth - v.azimuth_rad).abs() * v.distance;
        let sphere = (p.north * p.east).abs() / (6.0 * 6.3e6 * 6.3e6);
        let latitude = v.frame.origin.latitude_rad;
        let ellipsoid = 6.694_38e-3 * (sin(latitude) * cos(latitude) * p.east * p.east * p.east / 2.5e20).abs() / 6.0;
        let most = v.distance * (sphere + ellipsoid);
        assert!(turned < 1.05 * most + 5.0 * SAME_M, "{turned:e} m at {} m", v.distance);
    }
}

/// A metre along the meridian and one along the parallel, by the two radii. Beside the pole, a parallel is no straight line over
/// a metre.
#[test]
fn radians_span_the_metres_of_geodesics() {
    let metres = values().into_iter().filter(|v| v.distance == 1.0 && v.frame.origin.latitude_deg().abs() < 89.0);
    let mut held = 0;
    for v in metres {
        let (north, east) = metres_per_radian(v.frame.origin.latitude_rad);
        let step = Point::new(
            (v.position.latitude_rad - v.frame.origin.latitude_rad) * north,
            wrap_angle(v.position.longitude_rad - v.frame.origin.longitude_rad) * east,
        );
        let expected = Point::new(cos(v.azimuth_rad), sin(v.azimuth_rad));
        // The second order, `tan / R`: 0.7 micrometres at 78 degrees.
        let bend = (expected.north.abs() + expected.east.abs() / 2.0) * expected.east.abs();
        let most = SAME_M + bend * albacore_geometry::math::tan(v.frame.origin.latitude_rad).abs() / 6.3e6;
        assert!(step.distance(expected) < most, "{step:?} for {expected:?} at {:?}", v.frame.origin);
        held += 1;
    }
    assert_eq!(held, 56);
}

/// North in the plane and true north differ by the convergence of the meridians.
#[test]
fn north_is_that_of_the_origin() {
    for v in values() {
        let a_little_north = Geodetic { latitude_rad: v.position.latitude_rad + 1e-6, ..v.position };
        let step = v.frame.to_point(a_little_north) - v.frame.to_point(v.position);
        let convergence = degrees(-atan2(step.east, step.north));
        let apart = degrees(wrap_angle(radians(convergence + v.convergence_deg))).abs();
        let other = degrees(wrap_angle(radians(convergence - v.convergence_deg))).abs();
        assert!(apart.min(other) < 2e-4, "{convergence} and {}", v.convergence_deg);
    }
    // As the documentation has it, a kilometre east.
    for (latitude, per_km) in [(36.0, 0.0065), (60.0, 0.0156), (80.0, 0.051)] {
        let frame = TangentFrame { origin: Geodetic::from_degrees(latitude, 10.0) };
        let here = frame.to_geodetic(Point::new(0.0, 1000.0));
        let north = frame.to_point(Geodetic { latitude_rad: here.latitude_rad + 1e-6, ..here });
        let convergence = degrees(atan2(1000.0 - north.east, north.north));
        assert!((convergence / per_km - 1.0).abs() < 0.01, "{convergence}");
    }
}

/// Between any two points of a mission's waters lengths are those of the documentation's table.
#[test]
fn lengths_off_the_meridian_are_as_stated() {
    let frame = TangentFrame { origin: Geodetic::from_degrees(36.18, -75.74) };
    for (east, mm_per_km) in [(1_000.0, 0.0123), (9_000.0, 0.998), (50_000.0, 30.8), (100_000.0, 123.1)] {
        // In a frame of its own the kilometre has its true length, within micrometres.
        let (a, b) = (Point::new(-500.0, east), Point::new(500.0, east));
        let own = TangentFrame { origin: frame.to_geodetic(Point::new(0.0, east)) };
        let [a_own, b_own] = [a, b].map(|p| own.to_point(frame.to_geodetic(p)));
        let error = 1e3 * (1000.0 - a_own.distance(b_own));
        assert!((error / mm_per_km - 1.0).abs() < 0.02, "{error} mm at {east} m");
    }
}

#[test]
fn a_frame_lies_across_the_meridian_of_the_date_and_over_a_pole() {
    let frame = TangentFrame { origin: Geodetic::from_degrees(-17.0, 180.0) };
    let (west, east) = (Geodetic::from_degrees(-17.0, 179.99), Geodetic::from_degrees(-17.0, -179.99));
    assert!((frame.to_point(east).east + frame.to_point(west).east).abs() < SAME_M);
    assert!((frame.to_point(east).east - 1065.0).abs() < 1.0, "{:?}", frame.to_point(east));
    let pole = TangentFrame { origin: Geodetic::from_degrees(90.0, 0.0) };
    for p in [Point::new(300.0, 400.0), Point::new(-300.0, 400.0), Point::new(0.0, -5.0)] {
        assert!(pole.to_point(pole.to_geodetic(p)).distance(p) < SAME_M, "{:?}", pole.to_geodetic(p));
    }
}

/// Whatever a vehicle says of its position, the point is a number.
#[test]
fn every_position_has_a_point() {
    let frame = TangentFrame { origin: Geodetic::from_degrees(0.0, 0.0) };
    for latitude in [-90.0, -45.0, 0.0, 1e-9, 90.0] {
        for longitude in [-180.0, -90.0, -89.9, 90.0, 91.0, 180.0] {
            let p = frame.to_point(Geodetic::from_degrees(latitude, longitude));
            assert!(p.north.abs() < 1e9 && p.east.abs() < 1e9, "{latitude} {longitude}: {p:?}");
            let back = frame.to_geodetic(Point::new(1e12 * latitude, 1e12 * longitude));
            assert!(back.latitude_rad.is_finite() && back.longitude_rad.is_finite());
        }
    }
}
