//! The same script, scenario and seed give the same bytes: in every build profile, again, and among others.
//!
//! Run under `cargo test`, with `--config .ci/plain.toml`, `--config .ci/optimised.toml` and `--release`: the pinned value is one for all
//! of them.

#![expect(clippy::unwrap_used, reason = "a test whose scripts cannot be read has failed")]

use albacore_session::{Plan, Run, Running, load};
use std::path::Path;

/// Missions with seed 1. A digest changes with the mission, the scenario, the simulator and the guidance, never with the
/// compiler or the machine: whoever changes it says why.
const PINNED: [(&str, &str); 4] = [
    ("missions/box.alb", "83c8b3d1fef02bc9"),
    ("missions/deepest_point.alb", "9b860c85d172e365"),
    ("missions/duck_single.alb", "fbb9956c72aa8d4f"),
    ("missions/duck_single_2005.alb", "f8c7119b1888a29a"),
];

fn plan(path: &str) -> Plan {
    let script = load(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path), None, &[]).unwrap();
    Plan::new(&script, path, None, None).unwrap()
}

fn box_plan() -> Plan {
    plan("missions/box.alb")
}

fn digest(plan: &Plan, seed: u64) -> String {
    let mut run = Run::new(plan, seed).unwrap();
    while run.step() == Running::On {}
    run.summary(0.0).digest
}

#[test]
fn every_build_gives_the_pinned_bytes() {
    let given = PINNED.map(|(path, _)| (path, digest(&plan(path), 1)));
    assert_eq!(given, PINNED.map(|(path, pinned)| (path, pinned.to_string())));
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
