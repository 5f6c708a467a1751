//! Circling a point.

#![expect(
    clippy::panic,
    clippy::print_stdout,
    reason = "a helper of tests panics as they do; --nocapture shows the figures"
)]

use crate::vehicle::{SPEED, Vehicle, lead, scattered};
use albacore_geometry::math::TAU;
use albacore_geometry::{Heading, Point, Vector};
use albacore_guidance::{Circling, Law, Loiter};

const CENTER: Point = Point::new(20.0, -10.0);

/// Loiters two turns from many starts: the worst distance from the circle while turns are counted, and the longest
/// time.
fn worst(radius: f64, circling: Circling, current: Vector, compensated: bool, reach: f64) -> (f64, f64) {
    let (mut off, mut longest) = (0.0_f64, 0.0_f64);
    for i in 0..100 {
        let start = scattered(i, 0, reach);
        let mut vehicle = Vehicle::at(start.point, start.heading).in_current(current, compensated);
        let mut loiter = Loiter::new(CENTER, radius, circling, 2.0, lead(), crate::vehicle::radius());
        let (mut swept, mut last) = (0.0, start.point);
        let guided = |p: Point, c: Heading| {
            let guidance = loiter.step(p, c);
            if loiter.turned() > 0.0 {
                swept += (p - CENTER).toward() - (last - CENTER).toward();
            }
            // The last turn only: entering may overshoot.
            if loiter.turned() > 1.0 {
                off = off.max((p.distance(CENTER) - radius).abs());
            }
            last = p;
            let back = Loiter::from_words(&loiter.to_words());
            assert_eq!(back, loiter);
            loiter = back;
            guidance
        };
        let time = vehicle.run(1000.0, guided, |_| ()).unwrap_or_else(|| panic!("never from {start:?}"));
        let turns = swept / TAU * if circling == Circling::Clockwise { 1.0 } else { -1.0 };
        assert!((turns - 2.0).abs() < 0.05, "{turns} turns, the right way round");
        longest = longest.max(time);
    }
    println!("{radius} m {circling:?} in {current:?}: off {off:.2} m, {longest:.0} s");
    (off, longest)
}

#[test]
fn two_turns_either_way() {
    for circling in [Circling::Clockwise, Circling::Anticlockwise] {
        let (off, longest) = worst(20.0, circling, Vector::ZERO, true, 150.0);
        // Without the lead 0.29 m.
        assert!(off < 0.05, "{off} m");
        // 250 m of way, 251 m of circle, one circle more to get in line.
        assert!(longest < (250.0 + 251.0 + 126.0) / SPEED, "{longest} s");
    }
}

#[test]
fn in_currents() {
    let (off, _) = worst(20.0, Circling::Clockwise, Vector::new(0.0, 0.5), true, 100.0);
    assert!(off < 1.0, "{off} m");
    // Unknown, the current is leaned against with an offset: 2.9 m across, as along a line.
    let (off, _) = worst(30.0, Circling::Anticlockwise, Vector::new(0.4, 0.3), false, 100.0);
    assert!(off < 5.0, "{off} m");
}

#[test]
fn a_circle_too_narrow_to_drive_still_ends() {
    let (_, longest) = worst(5.0, Circling::Clockwise, Vector::ZERO, true, 60.0);
    assert!(longest < 300.0, "{longest} s");
}

#[test]
fn it_starts_from_the_centre_too() {
    let mut vehicle = Vehicle::at(CENTER, Heading::from_degrees(200.0));
    let mut loiter = Loiter::new(CENTER, 30.0, Circling::Clockwise, 1.0, lead(), crate::vehicle::radius());
    assert_eq!(loiter.step(vehicle.position, vehicle.course).course, vehicle.course);
    assert!(vehicle.run(300.0, |p, c| loiter.step(p, c), |_| ()).is_some());
}

#[test]
fn for_ever_is_for_ever() {
    let mut vehicle = Vehicle::at(Point::ORIGIN, Heading::NORTH);
    let mut loiter = Loiter::new(CENTER, 20.0, Circling::Clockwise, f64::INFINITY, lead(), crate::vehicle::radius());
    assert!(vehicle.run(1000.0, |p, c| loiter.step(p, c), |_| ()).is_none());
    // 2 m/s round 126 m: 15 turns in 1000 s.
    assert!(loiter.turned() > 14.0);
    assert_eq!(Loiter::from_words(&loiter.to_words()), loiter);
}

#[test]
fn it_enters_along_the_tangent() {
    // From 40 m south of the centre of a circle of 20 m, clockwise (centre on the right): 30 degrees left of the
    // centre.
    let mut loiter = Loiter::new(Point::ORIGIN, 20.0, Circling::Clockwise, 1.0, 0.0, crate::vehicle::radius());
    let course = loiter.step(Point::new(-40.0, 0.0), Heading::NORTH).course;
    assert!((course.degrees() - 330.0).abs() < 1e-9, "{}", course.degrees());
    let mut loiter = Loiter::new(Point::ORIGIN, 20.0, Circling::Anticlockwise, 1.0, 0.0, crate::vehicle::radius());
    let course = loiter.step(Point::new(-40.0, 0.0), Heading::NORTH).course;
    assert!((course.degrees() - 30.0).abs() < 1e-9, "{}", course.degrees());
}

/// A vehicle that turns about the centre as it begins, the other way than it should, cannot help going on so: it drives off once it has
/// been round, and comes back.
#[test]
fn a_centre_beside_a_turning_vehicle_is_circled_the_right_way_round() {
    let radius = crate::vehicle::radius();
    let mut longest = 0.0_f64;
    let ways = [(Circling::Clockwise, -1.0), (Circling::Anticlockwise, 1.0)];
    for ((circling, side), east) in ways.into_iter().flat_map(|way| [0.0, 0.5].map(|east| (way, east))) {
        for narrow in [0.1, 1.0, 3.0, 6.0, 10.0, 11.5, 13.0, 16.0] {
            for beside in [0.2, 0.5, 0.8, 0.9, 1.0, 1.1, 1.3, 2.0] {
                let centre = Point::new(0.0, side * beside * radius);
                let vehicle = Vehicle::at(Point::ORIGIN, Heading::NORTH);
                let mut vehicle = vehicle.in_current(Vector::new(0.0, east), true);
                let mut loiter = Loiter::new(centre, narrow, circling, 2.0, lead(), radius);
                let time = vehicle.run(1000.0, |p, c| loiter.step(p, c), |_| ());
                let time =
                    time.unwrap_or_else(|| panic!("never: {narrow} m, {beside} turning radii beside, {east} m/s"));
                longest = longest.max(time);
                assert!((loiter.turned() - 2.0).abs() < 0.05, "{}", loiter.turned());
            }
        }
    }
    println!("{longest:.0} s");
    assert!(longest < 400.0, "{longest} s");
}

/// A hull that turns no faster than it can, whatever the mission allows, circles beside a centre that is told to lie within its reach.
#[test]
fn how_tightly_the_vehicle_turns_is_learnt() {
    for planned in [0.4, 2.0, 7.0] {
        for i in 0..100 {
            let start = scattered(i, 0, 30.0);
            let mut vehicle = Vehicle::at(start.point, start.heading);
            let mut loiter = Loiter::new(CENTER, 0.1, Circling::Clockwise, 1.0, lead(), planned);
            let time = vehicle.run(2000.0, |p, c| loiter.step(p, c), |_| ());
            assert!(time.is_some(), "never from {start:?}, {planned} m planned");
        }
    }
}

/// Positions that are told wrong by some metres in each tick make no way: the vehicle goes round all the same.
#[test]
fn noisy_positions_are_no_way_in_vain() {
    let mut vehicle = Vehicle::at(Point::new(20.0, 10.0), Heading::NORTH);
    let mut loiter = Loiter::new(CENTER, 20.0, Circling::Clockwise, 2.0, lead(), crate::vehicle::radius());
    let mut tick = 0;
    let time = vehicle.run(
        1000.0,
        |p, c| {
            tick += 1;
            loiter.step(p + (scattered(tick, 1, 8.0).point - Point::ORIGIN), c)
        },
        |_| (),
    );
    // Two turns of 126 m at 2 m/s, and the way in.
    assert!(time.is_some_and(|time| time < 200.0), "{time:?}");
}
