//! Driving to a point always ends, however small the circle to be reached.

#![expect(
    clippy::panic,
    clippy::print_stdout,
    reason = "a helper of tests panics as they do; --nocapture shows the figures"
)]

use crate::vehicle::{Vehicle, radius, scattered};
use albacore_geometry::{Heading, Point, Vector};
use albacore_guidance::{Goto, Law};

/// The slowest of many arrivals from up to 100 m away.
fn worst(within: f64, current: Vector, compensated: bool) -> f64 {
    let mut worst: f64 = 0.0;
    for i in 0..400 {
        // Half of the starts close by, where the turning circle is in the way.
        let start = scattered(i, 0, if i % 2 == 0 { 25.0 } else { 100.0 });
        let mut vehicle = Vehicle::at(start.point, start.heading).in_current(current, compensated);
        let mut goto = Goto::new(Point::ORIGIN, within, radius());
        let time = vehicle.run(2000.0, |p, c| goto.step(p, c), |_| ());
        let time = time.unwrap_or_else(|| panic!("never within {within} m from {start:?} in {current:?}"));
        // A tenth of a metre for what is driven between two ticks.
        assert!(vehicle.position.distance(Point::ORIGIN) <= 1.5 * within + 0.1);
        worst = worst.max(time);
    }
    worst
}

/// What an arrival may take at most, in seconds, from 141 m away at 2 m/s over ground and 10 degrees per second: 71
/// driven straight, 18 to turn toward the goal, 36 for one orbit, 18 to turn away, 19 to leave, 18 to turn back, 19
/// to return.
const LIMIT_S: f64 = 200.0;

#[track_caller]
fn check_arrivals(current: Vector, compensated: bool) {
    for within in [1.0, 5.0, 10.0] {
        let worst = worst(within, current, compensated);
        println!("within {within} m, {current:?}, compensated {compensated}: {worst:.1} s at worst");
        assert!(worst < LIMIT_S, "within {within} m: {worst} s");
    }
}

#[test]
fn a_goal_is_reached_in_bounded_time() {
    check_arrivals(Vector::ZERO, true);
}

#[test]
fn a_goal_is_reached_in_bounded_time_across_a_current() {
    check_arrivals(Vector::new(0.0, 0.5), true);
    check_arrivals(Vector::new(0.35, -0.35), true);
}

#[test]
fn a_goal_is_reached_in_bounded_time_across_a_current_unknown() {
    check_arrivals(Vector::new(0.0, 0.5), false);
}

#[test]
fn a_goal_is_reached_though_the_navigation_jumps() {
    for i in 0..200 {
        let start = scattered(i, 0, 100.0);
        let mut vehicle = Vehicle::at(start.point, start.heading);
        let mut goto = Goto::new(Point::ORIGIN, 5.0, radius());
        let mut tick = 0;
        // 15 m to some side every 20 s: each may put the goal inside the turning circle.
        let jump = |v: &mut Vehicle| {
            tick += 1;
            if tick % 200 == 0 {
                v.position += 15.0 * scattered(i, tick / 200, 1.0).heading.unit();
            }
        };
        let time = vehicle.run(600.0, |p, c| goto.step(p, c), jump);
        assert!(time.is_some(), "never from {start:?}");
    }
}

#[test]
fn a_goal_at_the_centre_of_the_turning_circle_is_not_orbited() {
    // 2 m/s and 10 degrees per second turn round a point 11.46 m abeam: outside 5 m, outside 10 m, within 1.5 x 10 m.
    let goal = Point::new(0.0, 11.46);
    let approach = |within: f64| {
        let mut vehicle = Vehicle::at(Point::ORIGIN, Heading::NORTH);
        let mut goto = Goto::new(goal, within, radius());
        let time = vehicle.run(1000.0, |p, c| goto.step(p, c), |_| ()).unwrap();
        (time, vehicle.position.distance(goal))
    };
    // One orbit is 36 s; after it 11.46 m is near enough to 10 m, but not to 5 m.
    let (time, range) = approach(10.0);
    assert!((36.0..37.0).contains(&time) && range > 11.0, "{time} s, {range} m");
    let (time, range) = approach(5.0);
    assert!((36.0..120.0).contains(&time) && range <= 5.0, "{time} s, {range} m");
}

#[test]
fn a_goal_passed_between_two_ticks_counts() {
    let mut goto = Goto::new(Point::new(0.0, 0.01), 0.05, radius());
    assert!(!goto.step(Point::new(-0.1, 0.0), Heading::NORTH).arrived);
    assert!(goto.step(Point::new(0.1, 0.0), Heading::NORTH).arrived);
    // But a jump of the navigation past the goal is not a visit.
    let mut goto = Goto::new(Point::ORIGIN, 5.0, radius());
    assert!(!goto.step(Point::new(-8.0, 0.0), Heading::NORTH).arrived);
    assert!(!goto.step(Point::new(8.0, 0.0), Heading::NORTH).arrived);
}

#[test]
fn the_course_is_the_bearing_of_the_goal() {
    // The sign that is misprinted in the paper: a goal to the east is driven at eastward.
    let mut goto = Goto::new(Point::new(0.0, 100.0), 10.0, radius());
    assert!((goto.step(Point::ORIGIN, Heading::NORTH).course.degrees() - 90.0).abs() < 1e-9);
    // On the goal itself there is no bearing: the course is kept.
    let guidance = Goto::new(Point::ORIGIN, 10.0, radius()).step(Point::ORIGIN, Heading::from_degrees(123.0));
    assert!(guidance.arrived);
    assert_eq!(guidance.course, Heading::from_degrees(123.0));
}

#[test]
fn numbers_and_back_at_every_tick() {
    let mut goto = Goto::new(Point::new(0.0, 11.46), 5.0, radius());
    let mut vehicle = Vehicle::at(Point::ORIGIN, Heading::NORTH);
    let guide = |p: Point, c: Heading| {
        let guidance = goto.step(p, c);
        let back = Goto::from_words(&goto.to_words());
        assert_eq!(back, goto);
        goto = back;
        guidance
    };
    let time = vehicle.run(1000.0, guide, |_| ()).unwrap();
    // Long enough to have orbited, left and come back: all of the state has been used.
    assert!(time > 60.0, "{time} s");
}
