use super::*;
use albacore_geometry::Heading;

/// What is told of altitudes, one for each depth, while a depth is commanded.
fn told(goal: Vertical, soundings: impl IntoIterator<Item = (f64, f64)>) -> Vec<(usize, String)> {
    let mut sounding = Sounding::default();
    let command = Command::new(Heading::NORTH, 1.0, goal);
    let mut told = Vec::new();
    for (i, (depth, altitude)) in soundings.into_iter().enumerate() {
        sounding.dive(depth);
        sounding.believes(i as u64, altitude, Some(&command), false);
        told.extend(sounding.take_event().map(|what| (i, what)));
    }
    told
}

fn wobble(i: usize) -> f64 {
    if i.is_multiple_of(2) { 0.0 } else { 0.01 }
}

/// A dive by 5 cm a tick.
fn dive(altitude: impl Fn(usize, f64) -> f64) -> Vec<(f64, f64)> {
    (0..200).map(|i| (3.0 + 0.05 * i as f64, altitude(i, 3.0 + 0.05 * i as f64))).collect()
}

#[test]
fn an_echo_of_the_bottom_is_believed_in_a_dive() {
    let down = Vertical::Depth(40.0);
    assert_eq!(told(down, dive(|i, depth| 20.0 + wobble(i) - depth)), []);
    assert_eq!(told(down, dive(|i, depth| 20.0 + wobble(i) - 0.4 * depth)), [], "a bottom that falls away");
}

#[test]
fn an_altitude_that_stays_the_same_in_a_dive_is_not_believed() {
    for altitude in [0.3, 50.0, 9000.0] {
        let told = told(Vertical::Depth(40.0), dive(|i, _| altitude + wobble(i)));
        assert_eq!(told, [(30, String::from("rejected: altitude, no less after a dive of 1.5 m"))], "{altitude}");
    }
    let told = told(Vertical::Altitude(2.0), dive(|i, _| 5.0 + wobble(i)));
    assert_eq!(told.len(), 1, "{told:?}");
}

/// One that is told late tells of the climb before.
#[test]
fn one_that_grows_in_a_dive_is_not_believed() {
    assert_eq!(told(Vertical::Depth(40.0), dive(|_, depth| 2.0 + 0.5 * depth)).len(), 1);
}

#[test]
fn one_that_fails_in_the_middle_of_a_dive_is_not_believed_either() {
    let told = told(Vertical::Depth(40.0), dive(|i, depth| if i < 100 { 20.0 - depth } else { 12.0 + wobble(i) }));
    assert_eq!(told.len(), 1, "{told:?}");
    assert!((100..=160).contains(&told[0].0), "{told:?}");
}

#[test]
fn what_follows_a_rise_is_believed_again() {
    let same = (30, String::from("rejected: altitude, no less after a dive of 1.5 m"));
    let down_and_up = |altitude: fn(usize, f64) -> f64| {
        let depth = |i: usize| if i < 100 { 3.0 + 0.05 * i as f64 } else { 8.0 - 0.05 * (i - 100) as f64 };
        told(Vertical::Depth(40.0), (0..160).map(|i| (depth(i), altitude(i, depth(i)))).collect::<Vec<_>>())
    };
    let same_until_80 = down_and_up(|i, depth| if i < 80 { 12.0 } else { 20.0 - depth });
    assert_eq!(same_until_80, [same.clone(), (140, String::from("believed: altitude, grows in a rise of 2.0 m"))]);
    let moved = down_and_up(|i, _| 12.0 + if i < 80 { 0.0 } else { 5.0 });
    assert_eq!(moved, std::slice::from_ref(&same), "a change is no echo");
    assert_eq!(down_and_up(|i, depth| if i < 80 { 12.0 } else { 12.0 + 0.2 * (8.0 - depth) }), [same]);
}

/// From a dive that began at the surface there is less to rise.
#[test]
fn a_rise_to_the_surface_is_long_enough() {
    let depth = |i: usize| if i < 38 { 0.05 * i as f64 } else { (1.9 - 0.05 * (i - 38) as f64).max(0.2) };
    let altitude = |i: usize| if i < 38 { 12.0 } else { 20.0 - depth(i) };
    assert_eq!(told(Vertical::Depth(40.0), (0..80).map(|i| (depth(i), altitude(i))).collect::<Vec<_>>()).len(), 2);
}

#[test]
fn a_vehicle_on_the_bottom_has_no_altitude() {
    let mut sounding = Sounding::default();
    sounding.dive(20.0);
    assert!(sounding.believes(0, 0.4, None, true), "a sounder sits above the keel");
    assert!(!sounding.believes(1, 10.0, None, true));
    assert_eq!(sounding.take_event().unwrap(), "rejected: altitude, 10.0 m of a vehicle on the bottom");
    assert!(!sounding.believes(2, 10.0, None, false), "nor when it is free again");
}

/// Along a slope, by altitude or by the limit of one, it stays the same while the depth changes; so it does at rest, and in a swell.
#[test]
fn what_is_kept_may_stay_the_same() {
    assert_eq!(told(Vertical::Altitude(2.0), dive(|i, _| 2.1 + wobble(i))), []);
    let mut sounding = Sounding::default();
    for (tick, (depth, altitude)) in (0..).zip(dive(|i, _| 2.0 + wobble(i))) {
        let command = Command::new(Heading::NORTH, 1.0, Vertical::Depth(depth + 0.1));
        sounding.dive(depth);
        assert!(sounding.believes(tick, altitude, Some(&command), false));
    }
    let swell = (0..2000).map(|i| (3.0 + if i / 45 % 2 == 0 { 1.6 } else { -1.6 }, 5.0));
    assert_eq!(told(Vertical::Depth(3.0), swell), []);
}

/// One that comes back at the surface after a silence in which the vehicle dived tells of no depth that it has left.
#[test]
fn a_silence_that_ends_where_it_began_says_nothing() {
    let mut sounding = Sounding::default();
    let mut hear = |tick: u64, depth: f64, echo: bool| {
        sounding.dive(depth);
        !echo || sounding.believes(tick, 20.0 - depth, None, false)
    };
    assert!((0..20).all(|tick| hear(tick, 0.0, true)));
    for (tick, depth) in (20..60).zip((0..20).chain((0..20).rev())) {
        hear(tick, 0.2 * f64::from(depth), false);
    }
    assert!((60..80).all(|tick| hear(tick, 0.0, true)), "at the surface again");
    for (tick, depth) in (80..100).zip(0..20) {
        hear(tick, 0.2 * f64::from(depth), false);
    }
    assert!(!hear(100, 4.0, true), "4 m deeper than when it fell silent");
}
