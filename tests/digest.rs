//! The same script, scenario and seed give the same bytes: in every build profile, again, and among others.
//!
//! Run under `cargo test`, `--release` and `--profile plain`: the pinned value is one for all of them.

#![expect(clippy::unwrap_used, reason = "a test whose scripts cannot be read has failed")]

use albacore_session::{Plan, Run, Running, load};
use std::path::Path;

/// Of missions/box.alb with seed 1. It changes with the mission, the scenario, the simulator and the guidance, never with the
/// compiler or the machine: whoever changes it says why.
const BOX_SEED_1: &str = "ba30ab233cc6bff6";

fn box_plan() -> Plan {
    let path = Path::new("missions/box.alb");
    let script = load(path, None, &[]).unwrap();
    Plan::new(&script, "box.alb", None, None).unwrap()
}

fn digest(plan: &Plan, seed: u64) -> String {
    let mut run = Run::new(plan, seed).unwrap();
    while run.step() == Running::On {}
    run.summary(0.0).digest
}

#[test]
fn every_build_gives_the_pinned_bytes() {
    assert_eq!(digest(&box_plan(), 1), BOX_SEED_1);
}

#[test]
fn the_same_run_twice_gives_the_same_bytes() {
    let plan = box_plan();
    assert_eq!(digest(&plan, 7), digest(&plan, 7));
    assert_eq!(digest(&plan, 7), digest(&box_plan(), 7));
}

#[test]
fn a_run_is_the_same_alone_and_among_sixteen() {
    let plan = box_plan();
    let alone: Vec<String> = (1..=16).map(|seed| digest(&plan, seed)).collect();
    let among: Vec<String> = std::thread::scope(|scope| {
        let runs: Vec<_> = (1..=16)
            .map(|seed| {
                scope.spawn({
                    let plan = &plan;
                    move || digest(plan, seed)
                })
            })
            .collect();
        runs.into_iter().map(|run| run.join().unwrap()).collect()
    });
    assert_eq!(alone, among);
}
