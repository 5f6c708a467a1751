//! The command filter and the flow compensation.

use albacore_geometry::math::{degrees, radians};
use albacore_geometry::{Heading, Vector};
use albacore_guidance::parameters::TURN_RATE_MAX;
use albacore_guidance::{CommandFilter, through_water};

fn deg(x: f64) -> Heading {
    Heading::from_degrees(x)
}

#[test]
fn a_step_of_ninety_degrees_takes_nine_seconds() {
    let mut filter = CommandFilter::new(deg(0.0));
    let mut time = 0.0;
    while (deg(90.0) - filter.step(deg(90.0), TURN_RATE_MAX, 0.1)).abs() > radians(0.5) {
        time += 0.1;
    }
    // 8.8 s at 10 degrees per second, then the last 2 degrees fade with 0.2 s: 0.28 s to half a degree.
    assert!((8.95..9.25).contains(&time), "{time} s");
}

#[test]
fn it_never_overshoots_nor_turns_faster_than_its_limit() {
    for dt in [0.01, 0.1, 0.2, 1.0, 30.0] {
        for to in 0..72 {
            let target = deg(5.0 * f64::from(to));
            let mut filter = CommandFilter::new(deg(350.0));
            let mut error = target - filter.course;
            for _ in 0..200 {
                let before = filter.course;
                let turned = filter.step(target, TURN_RATE_MAX, dt) - before;
                let next = target - filter.course;
                assert!(turned.abs() <= radians(10.0) * dt + 1e-12, "{to}: rate");
                let same_side = next * error >= 0.0 || next.abs() < 1e-12;
                assert!(same_side && next.abs() <= error.abs() + 1e-12, "{to}: overshoot");
                error = next;
            }
            if dt >= 0.1 {
                assert!(error.abs() < radians(0.1), "{to}: settles");
            }
        }
    }
}

#[test]
fn it_goes_the_short_way_through_north() {
    let mut filter = CommandFilter::new(deg(350.0));
    let first = filter.step(deg(10.0), TURN_RATE_MAX, 0.1);
    assert!((first.degrees() - 351.0).abs() < 1e-9);
    let mut filter = CommandFilter::new(deg(10.0));
    assert!((filter.step(deg(350.0), TURN_RATE_MAX, 0.1).degrees() - 9.0).abs() < 1e-9);
}

#[test]
fn two_short_steps_are_one_long_step() {
    let (mut once, mut twice) = (CommandFilter::new(deg(0.0)), CommandFilter::new(deg(0.0)));
    once.step(deg(3.0), TURN_RATE_MAX, 0.4);
    twice.step(deg(3.0), TURN_RATE_MAX, 0.15);
    twice.step(deg(3.0), TURN_RATE_MAX, 0.25);
    assert!((once.course - twice.course).abs() < 1e-12);
    assert_eq!(CommandFilter::from_words(&once.to_words()), once);
}

/// What the vehicle does over the ground: its course off the one asked for, in degrees, and its speed along it.
fn over_ground(course: Heading, speed: f64, flow: Vector, speed_max: f64) -> (f64, f64, bool) {
    let asked = through_water(course, speed, flow, speed_max);
    assert!(asked.speed >= 0.0 && asked.speed <= speed_max + 1e-12);
    let ground = asked.speed * asked.heading.unit() + flow;
    (degrees(ground.toward() - course), ground.along(course), asked.holds_course)
}

#[test]
fn course_and_speed_are_kept_within_the_vehicle_s_means() {
    let mut slowed = 0;
    for i in 0..36 {
        for j in 0..12 {
            let (course, flow) = (deg(10.0 * f64::from(i)), 0.8 * deg(30.0 * f64::from(j)).unit());
            for speed in [0.9, 1.5, 2.0] {
                let (off, along, holds) = over_ground(course, speed, flow, 2.0);
                assert!(holds && off.abs() < 1e-9, "{course:?} {flow:?} {speed}: {off} degrees off");
                // Slower only at the vehicle's maximum.
                assert!(along <= speed + 1e-12);
                if along < speed - 1e-9 {
                    let asked = through_water(course, speed, flow, 2.0);
                    assert!((asked.speed - 2.0).abs() < 1e-12);
                    slowed += 1;
                }
            }
        }
    }
    assert!(slowed > 0, "the limit was met");
}

#[test]
fn a_crossing_current_too_strong_is_met_head_on() {
    // Eastward course northward; 2.5 m/s of current to the east, 2 m/s of vehicle: it heads west and loses 0.5 m/s.
    let asked = through_water(deg(0.0), 1.5, Vector::new(0.3, 2.5), 2.0);
    assert!((asked.heading.degrees() - 270.0).abs() < 1e-9);
    assert_eq!(asked.speed, 2.0);
    assert!(!asked.holds_course);
    // Next to nothing changes as the current falls below the vehicle's speed.
    let below = through_water(deg(0.0), 1.5, Vector::new(0.3, 2.0 - 1e-9), 2.0);
    assert!((below.heading - asked.heading).abs() < 1e-4);
}

#[test]
fn a_current_too_strong_ahead_carries_the_vehicle_back_along_its_course() {
    let (off, along, holds) = over_ground(deg(0.0), 1.5, Vector::new(-2.5, 0.5), 2.0);
    assert!(!holds && (off.abs() - 180.0).abs() < 1e-9 && along < 0.0, "{off} {along}");
}

#[test]
fn nothing_asked_or_nothing_needed() {
    for (speed, flow) in [(0.0, Vector::new(0.3, 0.2)), (0.5, 0.5 * deg(77.0).unit())] {
        let asked = through_water(deg(77.0), speed, flow, 2.0);
        assert_eq!((asked.heading, asked.speed, asked.holds_course), (deg(77.0), 0.0, true));
    }
}

#[test]
fn still_water_changes_nothing() {
    let asked = through_water(deg(123.0), 1.7, Vector::ZERO, 2.0);
    assert!((asked.heading - deg(123.0)).abs() < 1e-12 && (asked.speed - 1.7).abs() < 1e-12);
}
