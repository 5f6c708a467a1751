//! Where a survey comes to lie in a mission's plane.

#![expect(clippy::unwrap_used, reason = "a test whose survey cannot be placed has failed")]

use albacore_bathymetry::{Placing, Survey, read};
use albacore_geometry::{Geodetic, Point, TangentFrame};

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
    let corner = frame.to_point(Geodetic::from_degrees(10.0, 141.0));
    assert!(true_place.south_west.distance(corner) < 1e-6);
    let counted_west = geodetic(-219.0).extent(&made, Some(frame)).unwrap();
    assert!(counted_west.south_west.distance(corner) < 1e-6, "{counted_west:?}");

    let nowhere = geodetic(141.0).extent(&made, None).unwrap_err();
    assert_eq!(nowhere.message, "the survey lies on the globe, and the scenario has no place there");
    let scaled = local().extent(&Placing { scale: 0.5, ..made }, None).unwrap_err();
    assert_eq!(scaled.message, "a survey scaled by 0.5 lies nowhere by itself");
}
