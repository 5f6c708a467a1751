//! What is not a number is never an arrival, and never a panic.

use albacore_geometry::{Heading, Line, Point, Vector};
use albacore_guidance::dubins::{Pose, Words};
use albacore_guidance::parameters::TURN_RATE_MAX;
use albacore_guidance::{Circling, CommandFilter, FollowLine, Goto, GotoPose, Guidance, Law, Loiter, through_water};

const NOWHERE: Point = Point::new(f64::NAN, f64::NAN);

/// Steps three times with a good position and with none, and with each state read back from words that are no numbers.
fn check(mut step: impl FnMut(Point, Heading) -> Guidance) {
    for position in [Point::ORIGIN, NOWHERE, Point::new(5.0, 5.0)] {
        assert!(!step(position, Heading::from_radians(f64::NAN)).arrived);
    }
}

#[test]
fn goals_that_are_nowhere() {
    let goal = Pose { point: NOWHERE, heading: Heading::from_radians(f64::NAN) };
    let start = Pose { point: Point::ORIGIN, heading: Heading::NORTH };
    let mut goto = Goto::new(NOWHERE, 10.0, 12.6);
    check(|p, c| goto.step(p, c));
    let mut pose = GotoPose::new(start, goal, 12.6, Words::Full, 0.5);
    check(|p, c| pose.step(p, c));
    let mut line = FollowLine::new(Line { start: Point::ORIGIN, end: NOWHERE }, 12.6, 0.5);
    check(|p, c| line.step(p, c));
    let mut loiter = Loiter::new(NOWHERE, f64::NAN, Circling::Clockwise, 1.0, f64::NAN, f64::NAN);
    check(|p, c| loiter.step(p, c));
}

#[test]
fn words_that_are_no_numbers() {
    let mut goto = Goto::from_words(&[f64::NAN; Goto::WORDS]);
    check(|p, c| goto.step(p, c));
    let mut pose = GotoPose::from_words(&[f64::NAN; GotoPose::WORDS]);
    check(|p, c| pose.step(p, c));
    let mut line = FollowLine::from_words(&[f64::NAN; FollowLine::WORDS]);
    check(|p, c| line.step(p, c));
    let mut loiter = Loiter::from_words(&[f64::NAN; Loiter::WORDS]);
    check(|p, c| loiter.step(p, c));
}

#[test]
fn commands_that_are_no_numbers() {
    let nan = Heading::from_radians(f64::NAN);
    // A time that is none does not move the filter.
    let mut filter = CommandFilter::new(Heading::NORTH);
    assert_eq!(filter.step(Heading::from_degrees(90.0), TURN_RATE_MAX, f64::NAN), Heading::NORTH);
    // The speed stays one the vehicle can be asked for.
    let flow = Vector::new(f64::NAN, 0.0);
    for (course, speed, flow) in [(nan, 1.0, Vector::ZERO), (Heading::NORTH, f64::NAN, Vector::ZERO), (nan, 1.0, flow)]
    {
        let asked = through_water(course, speed, flow, 2.0);
        assert!(asked.speed <= 2.0, "{asked:?}");
    }
}
