//! Faults of what an inertial navigator takes: each is named, no run fails, and where the place is beyond what is expected of it something has
//! been told.

use super::DISORDERS;
use albacore_session::{Faults, Outcome, Plan, Run, Summary, load, load_faults};
use std::path::Path;

const SURVEY: &str = "tests/faults/inertial.alb";
/// What is told within this time is told soon, s: the place may be beyond what is expected until then.
const SOON_S: f64 = 60.0;

/// A run with a fault: its result and its trace.
fn run(fault: Option<&str>, seed: u64) -> (Summary, String) {
    let script = load(Path::new(SURVEY), None, &[]).unwrap();
    assert!(script.is_sound() && script.findings.is_empty(), "{:?}", script.findings);
    let plan = Plan::new(&script, SURVEY, None, None).unwrap();
    let text = fault.map(|fault| format!("fault({fault}, from: 100 s, to: 200 s)"));
    let faults = load_faults(&text.into_iter().collect::<Vec<_>>());
    assert!(faults.is_sound(), "{fault:?}: {:?}", faults.findings);
    let mut run = Run::new(&plan.with_faults(&Faults::of(&faults).unwrap()).unwrap(), seed).unwrap();
    assert_ne!(run.to_end(), Outcome::Failed, "{fault:?}");
    (run.summary(0.0), run.trace().to_string())
}

#[test]
fn every_fault_of_inertial_navigation_is_survived_and_told() {
    let sensors = ["gyroscope", "accelerometer", "receivers", "heading", "speed", "depth", "acoustic_fixes"];
    for sensor in sensors {
        for disorder in DISORDERS {
            let (summary, trace) = run(Some(&format!("{sensor}, {disorder}")), 1);
            let what = format!("{sensor} {}", disorder.replace('_', " "));
            assert!(trace.contains(&format!("fault: {what}")), "{trace}");
            assert_ne!(summary.outcome, Outcome::Aground.name(), "{what}");
            let unnoticed = summary.navigation.as_ref().map_or(0.0, |navigation| navigation.unnoticed_s);
            assert!(unnoticed <= SOON_S, "{what}: {unnoticed} s\n{trace}");
        }
    }
}

#[test]
fn nothing_is_told_of_sound_instruments() {
    for seed in 1..=3 {
        let (summary, trace) = run(None, seed);
        assert!(!trace.contains("navigation:"), "{trace}");
        let navigation = summary.navigation.unwrap();
        assert!(navigation.position_error_max_m < 6.0 && navigation.unnoticed_s < 5.0, "{navigation:?}");
    }
}
