//! The missions off Duck: a plume is found, traced and declared, inside the operating area, on more than one seed.

#![expect(clippy::unwrap_used, clippy::expect_used, reason = "a test whose scripts cannot be read has failed")]

use albacore_session::{Outcome, Plan, Run, Summary, load};
use std::path::Path;

#[track_caller]
fn fly(mission: &str, scenario: &str, seed: u64) -> Summary {
    let path = format!("missions/{mission}.alb");
    let script = load(Path::new(&path), None, &[]).unwrap();
    let plan = Plan::new(&script, &path, None, Some(scenario)).unwrap();
    let mut run = Run::new(&plan, seed).unwrap();
    assert_eq!(run.to_end(), Outcome::Completed, "seed {seed}");
    run.summary(0.0)
}

/// Metres between the declared source and the true one.
#[track_caller]
fn error_m(summary: &Summary) -> f64 {
    let report = summary.reports.first().expect("nothing was declared");
    assert_eq!(report.name, "source");
    report.error_m.unwrap()
}

#[test]
fn our_strategy_declares_the_source() {
    for seed in 1..=4 {
        let error = error_m(&fly("duck_single", "duck_2003", seed));
        assert!(error < 30.0, "seed {seed}: {error} m");
    }
}

#[test]
fn our_strategy_is_nearer_where_the_plume_does_not_rise() {
    for seed in 1..=4 {
        let error = error_m(&fly("duck_single", "duck_2003_flat", seed));
        assert!(error < 15.0, "seed {seed}: {error} m");
    }
}

#[test]
fn the_printed_strategy_declares_the_source() {
    for seed in 1..=4 {
        let error = error_m(&fly("duck_single_2005", "duck_2003", seed));
        assert!(error < 50.0, "seed {seed}: {error} m");
    }
}
