use super::*;
use albacore_geometry::{Heading, Point};
use albacore_vehicle::measurements::CHEMICAL;
use albacore_vehicle::{TICK_S, Vertical};

/// What a healthy vehicle tells that swims a square at 2 m/s, 3 m deep, and what one of them makes of it.
fn watched(ticks: u64, mut spoil: impl FnMut(u64, &mut Snapshot)) -> Vec<(u64, String)> {
    let mut health = HealthMonitor::default();
    let mut position = Point::ORIGIN;
    let mut told = Vec::new();
    for tick in 0..ticks {
        let heading = Heading::from_degrees(90.0 * (tick / 300) as f64);
        position += TICK_S * 2.0 * heading.unit();
        let wobble = (tick * 7_919 % 101) as f64 / 1000.0;
        let mut snapshot = Snapshot { control: Control::InControl, ..Snapshot::default() };
        snapshot.push(POSITION, &[position.north, position.east, 0.5]);
        snapshot.push(COURSE, &[heading.radians()]);
        snapshot.push(HEADING, &[heading.radians()]);
        snapshot.push(SPEED, &[2.0]);
        snapshot.push(DEPTH, &[3.0]);
        snapshot.push(ALTITUDE, &[5.0 + wobble]);
        snapshot.push(WATER_DEPTH, &[8.0 + wobble]);
        snapshot.push(CHEMICAL, &[wobble / 10.0]);
        if tick % 20 == 0 {
            snapshot.push(FLOW, &[wobble / 10.0, 0.0]);
        }
        spoil(tick, &mut snapshot);
        let command = Command::new(heading, 2.0, Vertical::Depth(3.0));
        let sightings = health.look(tick, &snapshot, Some(&command));
        told.extend(sightings.iter().map(|s| (tick, s.to_string())));
    }
    // A corner is turned at once here, which no vehicle does.
    told.retain(|(_, what)| !what.ends_with("heading jumps"));
    told
}

/// Spoils the readings of a measurement from tick 1000 to 1999.
fn spoilt(measurement: u16, mut spoil: impl FnMut(u64, &mut Reading) -> bool) -> Vec<(u64, String)> {
    watched(4000, |tick, snapshot| {
        if (1000..2000).contains(&tick) {
            snapshot.samples.retain_mut(|s| s.measurement != measurement || spoil(tick, &mut s.reading));
        }
    })
}

#[test]
fn a_healthy_vehicle_is_left_alone() {
    assert_eq!(watched(20_000, |_, _| {}), []);
}

/// A level bottom, an echo sounder without noise, and a swell that the pressure gauge feels.
#[test]
fn waves_are_no_fault() {
    let told = watched(20_000, |tick, snapshot| {
        let depth = 3.0 + 1.6 * albacore_geometry::math::sin(tick as f64 * TICK_S / 9.0 * 2.0 * std::f64::consts::PI);
        for sample in &mut snapshot.samples {
            match sample.measurement {
                DEPTH => sample.reading[0] = depth,
                ALTITUDE => sample.reading[0] = 5.0,
                WATER_DEPTH => sample.reading[0] = depth + 5.0,
                _ => {}
            }
        }
    });
    assert_eq!(told, []);
}

#[test]
fn silence_is_told_after_five_periods_and_two_seconds() {
    let told = |tick, what: &str| (tick, what.to_string());
    let expected = [told(1020, "detected: depth silent"), told(2149, "again well: depth silent")];
    assert_eq!(spoilt(DEPTH, |_, _| false), expected);
    let expected = [told(1081, "detected: flow silent"), told(2149, "again well: flow silent")];
    assert_eq!(spoilt(FLOW, |_, _| false), expected);
}

#[test]
fn each_trouble_has_its_name() {
    let first = |measurement, spoil: &mut dyn FnMut(u64, &mut Reading) -> bool| {
        let told = spoilt(measurement, spoil);
        let over = told.iter().filter(|(_, what)| what.starts_with("again well")).count();
        assert_eq!(2 * over, told.len(), "{told:?}");
        told.first().map(|(tick, what)| (*tick, what.clone()))
    };
    let set = |value: f64| {
        move |_: u64, reading: &mut Reading| {
            reading[0] = value;
            true
        }
    };
    let told = |tick, what: &str| Some((tick, format!("detected: {what}")));
    assert_eq!(first(SPEED, &mut set(f64::NAN)), told(1000, "speed not a number"));
    assert_eq!(first(CHEMICAL, &mut set(1.5)), told(1000, "chemical out of range"));
    assert_eq!(first(POSITION, &mut set(5000.0)), told(1000, "position jumps"));
    assert_eq!(first(CHEMICAL, &mut set(0.004)), told(1050, "chemical stuck"));
    assert_eq!(first(ALTITUDE, &mut set(5.02)), told(1050, "altitude stuck"));
    assert_eq!(first(SPEED, &mut set(2.6)).map(|(_, what)| what), told(0, "speed and position disagree").map(|t| t.1));
    assert_eq!(first(DEPTH, &mut set(7.0)), told(1000, "depth jumps"));
    let slowly = &mut |tick: u64, reading: &mut Reading| {
        reading[0] = 3.0 + 0.01 * (tick - 1000) as f64;
        true
    };
    assert!(spoilt(DEPTH, slowly).iter().any(|(_, what)| what == "detected: depth not as commanded"));
    let mut frozen = None;
    let stuck = &mut |_: u64, reading: &mut Reading| {
        *reading = *frozen.get_or_insert(*reading);
        true
    };
    assert_eq!(first(POSITION, stuck), told(1050, "position stuck"));
    let aside = &mut |_: u64, reading: &mut Reading| {
        reading[0] += 0.35;
        true
    };
    assert_eq!(first(COURSE, aside).map(|(_, what)| what), told(0, "course and position disagree").map(|t| t.1));
}

/// A vehicle that is held 4 m above the bottom by an altitude with noise, and then by its depth, and what its gauge tells.
fn held_above_the_bottom(mut gauge: impl FnMut(u64, f64) -> f64) -> Vec<(u64, String)> {
    let (mut depth, mut noise): (f64, f64) = (4.0, 0.0);
    watched(4000, |tick, snapshot| {
        let goal = if tick < 2000 { 4.0 + noise } else { 3.0 };
        depth += (goal - depth).clamp(-0.03, 0.03);
        noise = (tick * 7_919 % 101) as f64 / 500.0 - 0.1;
        for sample in &mut snapshot.samples {
            match sample.measurement {
                DEPTH => sample.reading[0] = gauge(tick, depth),
                ALTITUDE => sample.reading[0] = 8.0 - depth + noise,
                WATER_DEPTH => sample.reading[0] = 8.0 + noise,
                _ => {}
            }
        }
    })
}

#[test]
fn a_zigzag_of_the_vehicle_is_no_noise_of_its_gauge() {
    assert_eq!(held_above_the_bottom(|_, depth| depth), []);
    let mut last = 0.0;
    let told = held_above_the_bottom(|tick, depth| {
        last = if tick < 3000 { depth + (tick * 7_919 % 97) as f64 / 1000.0 } else { last };
        last
    });
    assert_eq!(told, [(3049, "detected: depth stuck".to_string())]);
}

/// A sounder of 1 Hz above a bottom that goes up and down by more than its noise.
#[test]
fn a_noise_is_known_beside_a_motion_and_of_what_comes_seldom() {
    let mut last = 0.0;
    let told = watched(1000, |tick, snapshot| {
        let bottom = albacore_geometry::math::sin(tick as f64 / 100.0);
        last = if tick < 500 { 8.0 + bottom + (tick * 7_919 % 97) as f64 / 1000.0 } else { last };
        snapshot.samples.retain_mut(|sample| {
            if sample.measurement == ALTITUDE {
                sample.reading[0] = last;
            }
            sample.measurement != WATER_DEPTH && (sample.measurement != ALTITUDE || tick % 10 == 0)
        });
    });
    assert_eq!(told, [(550, "detected: altitude stuck".to_string())]);
}

/// A compass and a log of 1 Hz without noise, of a vehicle that steers by positions that wander, across north and back.
#[test]
fn what_a_vehicle_steers_is_no_noise_however_seldom_it_is_told() {
    let (mut heading, mut speed) = (0.0, 1.5);
    let told = watched(6000, |tick, snapshot| {
        let mut drawn = (tick + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        drawn = (drawn ^ (drawn >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let step = ((drawn ^ (drawn >> 27)) >> 40) as f64 / (1 << 24) as f64 - 0.5;
        if tick % 10 == 0 && tick % 1500 < 1000 {
            heading += step / 10.0;
            speed += step / 100.0;
        }
        snapshot.samples.retain_mut(|sample| {
            match sample.measurement {
                HEADING => sample.reading[0] = Heading::from_radians(heading).radians(),
                SPEED => sample.reading[0] = speed,
                _ => return sample.measurement != COURSE && sample.measurement != POSITION,
            }
            tick % 10 == 0
        });
    });
    assert!(!told.iter().any(|(_, told)| told.contains("stuck")), "{told:?}");
}

/// A vehicle that wobbles, by no more than it may: where it rests at that, its sounder, which has no noise, does too.
#[test]
fn a_wobble_that_rests_is_no_fault() {
    let mut off: f64 = 0.0;
    let told = watched(20_000, |tick, snapshot| {
        let mut drawn = (tick + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        drawn = (drawn ^ (drawn >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let step = (((drawn ^ (drawn >> 27)) >> 40) as f64 / (1 << 24) as f64 - 0.5) / 10.0;
        off = if tick % 400 < 340 { (off + step).clamp(-0.7, 0.7) } else { off };
        for sample in &mut snapshot.samples {
            if [ALTITUDE, WATER_DEPTH].contains(&sample.measurement) {
                sample.reading[0] = if sample.measurement == ALTITUDE { 5.0 } else { 8.0 } + off;
            }
        }
    });
    assert_eq!(told, []);
}

/// A value that a link tells in steps: it flickers between two of them for minutes, and then rests.
#[test]
fn a_flicker_between_two_steps_is_no_noise() {
    let told = watched(20_000, |tick, snapshot| {
        let flickers = tick < 12_000 && (tick * 7_919 % 101).is_multiple_of(2);
        for sample in &mut snapshot.samples {
            if sample.measurement == SPEED {
                sample.reading[0] = if flickers { 2.01 } else { 2.0 };
            }
        }
    });
    assert_eq!(told, []);
}

/// The last bits of a course that is computed are no noise of a sensor.
#[test]
fn rounding_is_no_noise() {
    let told = watched(20_000, |tick, snapshot| {
        let last_bits = if tick < 12_000 { (tick * 7_919 % 101) as f64 * 1e-15 } else { 0.0 };
        for sample in &mut snapshot.samples {
            if sample.measurement == COURSE {
                sample.reading[0] += last_bits;
            }
        }
    });
    assert_eq!(told, []);
}

/// Over level ground an altitude may well rest, whatever its sounder told before.
#[test]
fn garbage_is_no_noise_by_which_a_rest_is_stuck() {
    let mut health = HealthMonitor::default();
    for tick in 0..1200_u64 {
        let garbage =
            ((tick + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15).rotate_left(31).wrapping_mul(0xBF58_476D_1CE4_E5B9) >> 51)
                as f64;
        let altitude = match tick {
            0..200 => 22.0 - 0.05 * tick as f64,
            200..600 => garbage,
            _ => 12.0,
        };
        let mut snapshot = Snapshot::default();
        snapshot.push(ALTITUDE, &[altitude]);
        let sighted = health.look(tick, &snapshot, None);
        assert!(sighted.iter().all(|told| told.anomaly != Anomaly::Stuck(ALTITUDE)), "{tick}: {sighted:?}");
    }
}

/// A vehicle rises from 8 m to 1 m and stays there, in a swell that the pressure gauge feels. Its sounder has no noise.
#[test]
fn who_has_just_risen_is_not_rising() {
    let told = watched(4_000, |tick, snapshot| {
        let rise = (0.05 * tick.saturating_sub(1_000) as f64).min(7.0);
        let swell = 0.9 * albacore_geometry::math::sin(tick as f64 * TICK_S / 9.0 * 2.0 * std::f64::consts::PI);
        for sample in &mut snapshot.samples {
            match sample.measurement {
                DEPTH => sample.reading[0] = 8.0 - rise + swell,
                ALTITUDE => sample.reading[0] = 5.0 + rise,
                WATER_DEPTH => sample.reading[0] = 13.0 + swell,
                _ => {}
            }
        }
    });
    let stuck: Vec<_> = told.iter().filter(|(_, what)| what.contains("stuck")).collect();
    assert!(stuck.is_empty(), "{stuck:?}");
}

/// What is told of a vehicle that is to turn right about after 10 s, and heads as a function of the tick and of its last heading.
fn heads(mut heading: impl FnMut(u64, Heading) -> Heading) -> Vec<String> {
    let (mut health, mut told, mut at) = (HealthMonitor::default(), Vec::new(), Heading::from_degrees(0.0));
    for tick in 0..1_500 {
        at = heading(tick, at);
        let mut snapshot = Snapshot { control: Control::InControl, ..Snapshot::default() };
        snapshot.push(HEADING, &[at.radians()]);
        snapshot.push(SPEED, &[2.0]);
        // No course is commanded to turn faster than 10 deg/s.
        let commanded = Heading::from_degrees((tick.saturating_sub(100) as f64).min(180.0));
        let command = Command::new(commanded, 2.0, Vertical::Depth(3.0));
        told.extend(health.look(tick, &snapshot, Some(&command)).iter().map(ToString::to_string));
    }
    told
}

#[test]
fn a_hull_that_turns_slowly_follows_and_one_that_circles_does_not() {
    let turns = |tick: u64, at: Heading, rate: f64| {
        let step = if tick < 100 { 0.0 } else { TICK_S * rate };
        Heading::from_degrees((at.degrees() + step).min(180.0))
    };
    for rate in [1.0, 2.0, 4.0, 10.0] {
        assert_eq!(heads(|tick, at| turns(tick, at, rate)), [""; 0], "{rate} deg/s");
    }
    for rate in [-10.0, -4.0, 0.01, 4.0, 10.0] {
        let circles = |tick: u64, _: Heading| Heading::from_degrees(TICK_S * rate * tick as f64);
        assert!(heads(circles).contains(&"detected: heading not as commanded".into()), "{rate} deg/s");
    }
}
