//! `hold` keeps its place in a current; `wait` goes with it.

#![expect(clippy::unwrap_used, reason = "a test whose scripts cannot be read has failed")]

use albacore_session::{Outcome, Plan, Run, Running, Source, load_text};

/// A mission of some statements in a current toward the east, and how far the vehicle is at most from its start, in metres.
fn farthest(current: &str, body: &str) -> (Run, f64) {
    let text = format!(
        "scenario stream {{
            flow({current} toward 90 deg)
            bottom(from: 20 m, to: 20 m)
            vehicle(kinematic, start: point(north: 0 m, east: 0 m), heading: 0 deg)
        }}
        mission stay in stream within 30 min {{
            area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 2 km, width: 2 km)
            limits {{ altitude >= 2 m, speed <= 1.5 m/s }}
            requires {{
                position, course, heading fresh 5 s, else abort
                flow fresh 5 min, at first 0 m/s toward 0 deg, else abort
            }}
            recovery within 5 min {{ goto op.center at depth 3 m, speed 1 m/s }}
            with depth 3 m
            {body}
        }}"
    );
    let script = load_text(Source { name: "stay.alb".into(), text: text.into() });
    assert!(script.is_sound(), "{:?}", script.findings);
    let mut run = Run::new(&Plan::new(&script, "stay.alb", None, None).unwrap(), 1).unwrap();
    let (start, mut farthest) = (run.start(), 0.0_f64);
    loop {
        if let Running::Over(outcome) = run.step() {
            assert_eq!(outcome, Outcome::Completed, "{}", run.trace());
            return (run, farthest);
        }
        farthest = farthest.max(run.true_position().distance(start));
    }
}

#[test]
fn a_hold_keeps_its_place_in_a_current() {
    for current in ["0 m/s", "10 cm/s", "30 cm/s", "80 cm/s"] {
        let (_, farthest) = farthest(current, "hold for 10 min");
        assert!(farthest < 20.0, "{farthest:.1} m in {current}");
    }
}

#[test]
fn a_hold_goes_back_as_fast_as_it_is_told() {
    let (_, farthest) = farthest("30 cm/s", "hold for 10 min at speed 0.6 m/s");
    assert!(farthest < 20.0, "{farthest:.1} m");
}

#[test]
fn a_current_that_is_too_strong_is_told() {
    let (run, farthest) = farthest("1.8 m/s", "hold for 5 min");
    assert!(run.trace().to_string().contains("adrift: carried off although it goes back"));
    // It is carried at 0.3 m/s instead of 1.8, once it has turned against the current.
    assert!(farthest < 200.0, "{farthest:.1} m");
}

#[test]
fn a_wait_and_what_comes_after_a_hold_go_with_the_current() {
    let (_, farthest) = farthest("30 cm/s", "hold for 1 s; wait for 5 min");
    assert!(farthest > 80.0, "{farthest:.1} m");
}
