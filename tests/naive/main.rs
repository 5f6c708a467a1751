//! A second opinion on the rules of time: a naive evaluator of the checked program, held against the machine.

#![allow(
    clippy::expect_used,
    clippy::panic,
    clippy::unwrap_used,
    missing_docs,
    reason = "a test whose scripts cannot be run has failed"
)]

mod compare;
mod evaluator;
mod events;

use albacore_session::{Plan, load};
use albacore_sim::Simulator;
use std::path::{Path, PathBuf};

/// No rule needs more ticks than this to be shown.
const TICKS_MAX: u64 = 1_000;

/// The scripts that show the rules of time: both sides say the same of each, in the simulated world.
#[test]
fn rules() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/rules");
    let mut scripts: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    scripts.retain(|path| path.extension().is_some_and(|extension| extension == "alb"));
    scripts.sort();
    let mut differences = Vec::new();
    for path in &scripts {
        let script = load(path, None, &[]).unwrap();
        let name = script.missions().next().unwrap().name.clone();
        let plan = Plan::new(&script, &path.display().to_string(), Some(&name), None).unwrap();
        let mut vehicle = Simulator::new(&plan.scenario, 1).unwrap();
        let run = compare::compare(&script, &name, &mut vehicle, TICKS_MAX);
        differences.extend(run.difference.map(|difference| format!("{}: {difference}", path.display())));
    }
    assert!(differences.is_empty(), "{} of {} differ\n{}", differences.len(), scripts.len(), differences.join("\n\n"));
}
