//! Where a survey comes to lie in a mission's plane.

#![expect(clippy::unwrap_used, reason = "a test whose survey cannot be placed has failed")]

use albacore_formats::survey::{Placing, Survey, read};
use albacore_geometry::math::{degrees, radians};
use albacore_geometry::{Geodetic, Point, TangentFrame, metres_per_radian};

const MIDDLE: Placing = Placing { at: Some(Point { north: 10.0, east: -20.0 }), share: (0.5, 0.5), scale: 1.0 };

fn local() -> Survey {
    read(b"# east 0..20 n=3 north -5..5 n=2 depth in metres\n1,2,3\n4,5,6\n").unwrap()
}

/// Two degrees by two about 11 N 142 E, or as far west as 218 W.
fn geodetic(west: f64) -> Survey {
    let head = format!("# lon {west}..{} n=2 lat 10..12 n=2 depth in metres", west + 2.0);
    read(format!("{head}\n1,2\n4,5\n").as_bytes()).unwrap()
}

#[test]
fn a_chosen_point_of_it_lies_where_it_is_told_to() {
    let extent = local().extent(&MIDDLE, None).unwrap();
    assert_eq!((extent.south_west, extent.north_east), (Point::new(5.0, -30.0), Point::new(15.0, -10.0)));
    let corner = Placing { share: (1.0, 0.0), scale: 0.1, ..MIDDLE };
    let extent = local().extent(&corner, None).unwrap();
    assert_eq!((extent.south_west, extent.north_east), (Point::new(9.0, -20.0), Point::new(10.0, -18.0)));
}

/// At 11 degrees a degree of latitude is 110.61 km and one of longitude 109.29 km (WGS 84).
#[test]
fn degrees_become_metres_at_the_point_that_is_placed() {
    let extent = geodetic(141.0).extent(&Placing { scale: 0.01, ..MIDDLE }, None).unwrap();
    let size = extent.north_east - extent.south_west;
    assert!((size.north - 2.0 * 1106.1).abs() < 0.1 && (size.east - 2.0 * 1092.9).abs() < 0.5, "{size:?}");
    let middle = extent.south_west + 0.5 * size;
    assert!(middle.distance(Point::new(10.0, -20.0)) < 1e-6, "{middle:?}");
}

#[test]
fn without_a_place_it_lies_where_it_was_made() {
    let made = Placing { at: None, ..MIDDLE };
    assert_eq!(local().extent(&made, None).unwrap().south_west, Point::new(-5.0, 0.0));
    let frame = TangentFrame { origin: Geodetic::from_degrees(11.0, 142.0) };
    let true_place = geodetic(141.0).extent(&made, Some(frame)).unwrap();
    let per_degree = Point::new(110_614.7, 109_287.6);
    let corner = Point::new(-per_degree.north, -per_degree.east);
    assert!(true_place.south_west.distance(corner) < 1.0, "{true_place:?}");
    let counted_west = geodetic(-219.0).extent(&made, Some(frame)).unwrap();
    assert!(counted_west.south_west.distance(true_place.south_west) < 1e-6, "{counted_west:?}");
    assert!(counted_west.north_east.distance(true_place.north_east) < 1e-6, "{counted_west:?}");

    let nowhere = geodetic(141.0).extent(&made, None).unwrap_err();
    assert_eq!(nowhere.message, "the survey lies on the globe, and the scenario has no place there");
    let scaled = local().extent(&Placing { scale: 0.5, ..made }, None).unwrap_err();
    assert_eq!(scaled.message, "a survey scaled by 0.5 lies nowhere by itself");
}

/// Across the 180th meridian the count of longitudes begins anew, and the survey goes on.
#[test]
fn a_survey_lies_on_both_sides_of_the_180th_meridian() {
    let survey = |lon: &str| read(format!("# lon {lon} n=3 lat 10..12 n=2 depth in metres\n1,2,3\n4,5,6\n").as_bytes());
    let across = survey("179..-179").unwrap();
    assert_eq!(across, survey("179..181").unwrap());
    assert_eq!(survey("359..1").unwrap(), survey("-1..1").unwrap());
    assert_eq!(survey("359..361").unwrap(), survey("-1..1").unwrap());
    for longitude in [179.9, -179.9] {
        let frame = TangentFrame { origin: Geodetic::from_degrees(11.0, longitude) };
        let extent = across.extent(&Placing { at: None, ..MIDDLE }, Some(frame)).unwrap();
        assert!(extent.south_west.east < -90_000.0 && extent.north_east.east > 90_000.0, "{extent:?}");
    }
    assert!(survey("-179..-181").is_err(), "it descends");
}

/// How far off its place in the mission's frame the north-eastern corner of a survey comes to lie, `d` degrees of both from the
/// point where degrees become metres.
fn bend(latitude: f64, (north, east): (f64, f64)) -> f64 {
    let (north_east, of) = ((latitude + north, 20.0 + east), (latitude, 20.0));
    let head = format!("# lon {}..{} n=2 lat {}..{} n=2 depth in metres", of.1, north_east.1, of.0, north_east.0);
    let survey = read(format!("{head}\n1,2\n4,5\n").as_bytes()).unwrap();
    let frame = TangentFrame { origin: Geodetic::from_degrees(of.0, of.1) };
    let made = survey.extent(&Placing { at: None, ..MIDDLE }, Some(frame)).unwrap();
    let laid = Placing { at: Some(Point::ORIGIN), share: (0.0, 0.0), scale: 1.0 };
    assert!(survey.extent(&laid, None).unwrap().north_east.distance(made.north_east) < 1e-6);
    made.north_east.distance(frame.to_point(Geodetic::from_degrees(north_east.0, north_east.1)))
}

/// As `Survey::extent` and `docs/language.md` state it.
#[test]
fn an_even_grid_is_bent_by_as_much_as_is_stated() {
    for (latitude, metres, stated) in
        [(36.0, 1e3, 0.13), (36.0, 1e4, 13.0), (36.0, 1e5, 1.3e3), (60.0, 1e3, 0.30), (60.0, 1e4, 30.0)]
    {
        let (north, east) = metres_per_radian(radians(latitude));
        let bent = bend(latitude, (degrees(metres / north), degrees(metres / east)));
        assert!((bent / stated - 1.0).abs() < 0.03, "{bent} m at {latitude} degrees for {metres} m");
    }
    for (apart, stated) in [((0.000_001, 30.0), 165e3), ((90.0, 80.0), 8_906e3)] {
        let bent = bend(0.0, apart);
        assert!((bent / stated - 1.0).abs() < 0.003, "{bent} m for {apart:?} degrees");
    }
}
