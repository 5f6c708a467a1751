use super::*;
use albacore_vehicle::measurements::{BATTERY, COURSE, HEADING, SPEED, WATER_DEPTH};

/// What is withheld of samples, by tick and measurement, and what is told.
fn withheld(samples: impl Fn(u64) -> Vec<(u16, f64)>) -> (Vec<(u64, u16)>, Vec<String>) {
    let mut trust = Trust::default();
    let (mut withheld, mut told) = (Vec::new(), Vec::new());
    for tick in 0..100 {
        let mut snapshot = Snapshot::default();
        samples(tick).into_iter().for_each(|(measurement, number)| snapshot.push(measurement, &[number]));
        told.extend(trust.look(tick, &mut snapshot, None).into_iter().filter(|line| !line.starts_with("detected")));
        let measurements = [ALTITUDE, BATTERY, COURSE, DEPTH, HEADING, SPEED, WATER_DEPTH];
        let of = |measurement: &u16| snapshot.samples.iter().any(|sample| sample.is_withheld_of(*measurement));
        withheld.extend(measurements.into_iter().filter(of).map(|measurement| (tick, measurement)));
    }
    (withheld, told)
}

fn at(tick: u64, of: u64, wrong: f64, right: f64) -> f64 {
    if tick == of { wrong } else { right }
}

/// The attack: an abort on a wrong course, of a compass that was wrong once.
#[test]
fn a_course_is_doubtful_with_its_heading() {
    // At rest too, and whichever comes first.
    for speed in [0.0, 1.5] {
        let (withheld, told) =
            withheld(|tick| vec![(COURSE, at(tick, 50, 2.4, 0.1)), (SPEED, speed), (HEADING, at(tick, 50, 2.3, 0.0))]);
        assert_eq!(withheld, [(50, COURSE), (50, HEADING)]);
        assert_eq!(told, ["rejected: heading, 132 deg off in 0.1 s"]);
    }
}

/// A profiler that is wrong once turns the course for a second.
#[test]
fn a_course_is_judged_of_a_vehicle_under_way() {
    let of = |speed| {
        withheld(move |tick| {
            vec![(COURSE, if (50..60).contains(&tick) { 2.4 } else { 0.1 }), (HEADING, 0.0), (SPEED, speed)]
        })
    };
    let (withheld, told) = of(1.5);
    assert!((50..60).all(|tick| withheld.contains(&(tick, COURSE))), "{withheld:?}");
    assert_eq!(told[0], "rejected: course, 132 deg off in 0.1 s");
    assert_eq!(of(0.3), (vec![], vec![]), "against a current it may be any");
}

#[test]
fn a_battery_is_slow() {
    // Told every second.
    let of = |wrong: f64, first: f64| {
        withheld(move |tick| {
            let number = if tick == 0 { first } else { at(tick, 50, wrong, 0.6) };
            if tick.is_multiple_of(10) { vec![(BATTERY, number)] } else { vec![] }
        })
    };
    let (once, told) = of(0.0, 0.6);
    assert_eq!((once, told), (vec![(50, BATTERY)], vec!["rejected: battery, 60 % off in 1.0 s".to_string()]));
    assert_eq!(of(1.0, 0.6).0, [(50, BATTERY)], "nor is it charged at sea");
    assert_eq!(of(0.57, 0.6).0, [], "a gauge is coarse");
    assert_eq!(of(0.6, 0.0).0, [(0, BATTERY)], "a first one that is empty waits for a second");
}

#[test]
fn the_depth_of_the_water_is_doubtful_with_either() {
    for (depth, altitude) in [(100.0, 5.0), (5.0, 900.0)] {
        let (withheld, _) = withheld(|tick| {
            let (depth, altitude) = (at(tick, 50, depth, 5.0), at(tick, 50, altitude, 5.0));
            vec![(WATER_DEPTH, depth + altitude), (DEPTH, depth), (ALTITUDE, altitude)]
        });
        assert_eq!(withheld.len(), 2, "{withheld:?}");
        assert!(withheld.contains(&(50, WATER_DEPTH)), "{withheld:?}");
    }
}
