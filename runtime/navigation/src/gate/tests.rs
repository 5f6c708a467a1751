use super::*;

/// Feeds one measurement with readings, one a tick, and gives which ticks were withheld and what was told.
fn judged(measurement: u16, readings: impl IntoIterator<Item = (u64, [f64; 3])>) -> (Vec<u64>, Vec<(u64, String)>) {
    let mut gate = Gate::default();
    let (mut withheld, mut told) = (Vec::new(), Vec::new());
    for (tick, [a, b, c]) in readings {
        if !gate.believes(tick, measurement, [a, b, c, 0.0]) {
            withheld.push(tick);
        }
        told.extend(gate.take_events().iter().map(|doubt| (tick, doubt.to_string())));
    }
    (withheld, told)
}

fn told(lines: &[(u64, &str)]) -> Vec<(u64, String)> {
    lines.iter().map(|(tick, line)| (*tick, (*line).to_string())).collect()
}

#[test]
fn one_wrong_sample_is_withheld_and_told() {
    let positions = (0..100).map(|tick| (tick, [if tick == 50 { 5000.0 } else { 0.2 * tick as f64 }, 0.0, 1.0]));
    let (withheld, said) = judged(POSITION, positions);
    assert_eq!(withheld, [50]);
    assert_eq!(said, told(&[(50, "rejected: position, 4990 m away in 0.1 s")]));
}

#[test]
fn what_persists_is_believed_after_two_seconds() {
    let positions = (0..100).map(|tick| (tick, [if tick < 50 { 0.0 } else { 60.0 }, 0.0, 1.0]));
    let (withheld, said) = judged(POSITION, positions);
    assert_eq!(withheld, (50..70).collect::<Vec<_>>());
    let lines = [(50, "rejected: position, 60 m away in 0.1 s"), (70, "believed: position, 60 m away for 2.0 s")];
    assert_eq!(said, told(&lines));
}

/// Their standard deviations are as random as themselves, and excuse nothing.
#[test]
fn two_random_positions_at_the_start_do_not_agree() {
    let random = [[359_000.0, 0.0, 700_000.0], [-120_000.0, 235_000.0, 900_000.0]];
    let after = |first: u64, count: u64| {
        let place = move |tick: u64| match tick.checked_sub(first) {
            Some(at) if at < count => random[at as usize % 2],
            _ => [0.2 * tick as f64, 0.0, 1.0],
        };
        judged(POSITION, (0..100).map(move |tick| (tick, place(tick)))).0
    };
    assert_eq!(after(1, 2), [1, 2]);
    assert_eq!(after(0, 2), [0, 1]);
    assert_eq!(after(1, 10), (1..12).collect::<Vec<_>>());
}

/// Dead reckoning whose own error lets expect it is corrected at once.
#[test]
fn a_fix_within_the_errors_of_both_is_believed_at_once() {
    let positions = (0..100).map(|tick| (tick, if tick < 50 { [0.0, 0.0, 20.0] } else { [80.0, 0.0, 2.0] }));
    assert_eq!(judged(POSITION, positions), (vec![], vec![]));
}

/// An attack: satellite fixes that scatter by 5 m, each second another, came after a dead reckoning that was sure of itself, and the mission
/// was aborted. Each was held against the one before as if that were exact.
#[test]
fn fixes_that_scatter_as_they_say_persist_together() {
    for shift in 0..200u64 {
        let scatter = |n: u64| ((n * 7_919 + shift * 104_729) % 1009) as f64 / 1009.0 * 24.0 - 12.0;
        let positions = (0..200u64).map(|tick| match tick.checked_sub(10) {
            None => (tick, [0.0, 0.0, 0.05]),
            Some(after) => (tick, [scatter(2 * (after / 10)), scatter(2 * (after / 10) + 1), 5.0]),
        });
        let (withheld, _) = judged(POSITION, positions);
        assert!(withheld.iter().all(|tick| *tick <= 50), "{shift}: {withheld:?}");
    }
}

#[test]
fn noise_all_over_the_place_is_never_believed_and_told_once() {
    let places = (0..300u64).map(|tick| {
        let far = (tick * 7_919 % 1009) as f64 * 90.0 - 45_000.0;
        (tick, if tick < 50 { [0.0, 0.0, 1.0] } else { [far, -far, 1.0] })
    });
    let (withheld, said) = judged(POSITION, places);
    assert_eq!(withheld, (50..300).collect::<Vec<_>>());
    assert_eq!(said.len(), 1, "{said:?}");
}

#[test]
fn a_bottom_that_comes_nearer_is_believed_with_the_second_sample() {
    let altitudes = |after: f64| (0..100).map(move |tick| (tick, [if tick < 50 { 20.0 } else { after }, 0.0, 0.0]));
    assert_eq!(judged(ALTITUDE, altitudes(4.0)).0, [50]);
    assert_eq!(judged(ALTITUDE, altitudes(40.0)).0, (50..70).collect::<Vec<_>>());
    assert_eq!(judged(ALTITUDE, altitudes(-40.0)).0, (50..100).collect::<Vec<_>>());
}

/// A sample with an error of its own that would allow anything excuses itself no more than another.
#[test]
fn a_sample_does_not_excuse_itself() {
    let positions = (0..100).map(|tick| (tick, if tick == 50 { [5000.0, 0.0, 900.0] } else { [0.0, 0.0, 1.0] }));
    assert_eq!(judged(POSITION, positions).0, [50]);
}

/// A first sample that is far from where missions begin waits for the second; one that is near gives way to the two after it.
#[test]
fn a_first_sample_is_held_against_those_that_follow() {
    let first = |first: f64| (0..10).map(move |tick| (tick, [if tick == 0 { first } else { 3.0 }, 0.0, 1.0]));
    assert_eq!(judged(POSITION, first(5000.0)).0, [0]);
    assert_eq!(judged(POSITION, first(500.0)).0, [1]);
    assert_eq!(judged(DEPTH, first(500.0)).0, [0]);
    let far = (0..10).map(|tick| (tick, [5000.0, 0.0, 1.0]));
    assert_eq!(judged(POSITION, far).0, [0]);
}

/// Echoes all over the place, within what an altitude can be: that now and then one fits does not make it true.
#[test]
fn one_that_fits_among_many_that_do_not_is_not_believed() {
    let mut seed = 1u64;
    let echoes = (0..3000u64).map(|tick| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (tick, [if tick < 50 { 17.0 } else { (seed >> 33) as f64 % 40.0 }, 0.0, 0.0])
    });
    let (withheld, said) = judged(ALTITUDE, echoes);
    let deeper = said.iter().filter(|(_, what)| what.starts_with("believed")).count();
    assert!(withheld.len() > 2700, "{}: {deeper}", withheld.len());
}

/// After a silence more can have happened.
#[test]
fn time_without_samples_counts() {
    let depths = [(0, 3.0), (1, 3.0), (300, 40.0), (301, 80.0)].map(|(tick, depth)| (tick, [depth, 0.0, 0.0]));
    assert_eq!(judged(DEPTH, depths).0, [301]);
}

/// A sigma excuses a position as far as it can be true; what no sensor can measure is not believed of a course at rest either.
#[test]
fn what_cannot_be_is_no_excuse() {
    let positions = (0..100).map(|tick| (tick, if tick == 50 { [4e5, -7e5, -2e5] } else { [0.0, 0.0, 1.0] }));
    let (withheld, said) = judged(POSITION, positions);
    assert_eq!(withheld, [50]);
    assert_eq!(said, told(&[(50, "rejected: position, a sigma of -200000.0 m cannot be")]));
    let courses = (0..100).map(|tick| (tick, [if tick == 50 { 4e3 } else { 0.1 }, 0.0, 0.0]));
    let (withheld, said) = judged(COURSE, courses);
    assert_eq!(withheld, [50]);
    assert_eq!(said, told(&[(50, "rejected: course, 4000.0 cannot be")]));
}
