//! Every fault of every sensor, and of the vehicle, on a mission that uses them all: nothing panics or hangs, no command is out of
//! its limits, and each fault is named in the trace. More seeds, and the page of what was noticed, are made by
//!
//! ```text
//! FAULT_SEEDS=100 FAULT_PAGE=docs/faults.md cargo test --release --test scripts faults::
//! ```

#![expect(clippy::unwrap_used, reason = "a test whose scripts cannot be read has failed")]

mod guard;
mod inertial;
mod page;

use albacore_session::{Diagnostic, Faults, Outcome, Plan, PlanError, Run, Running, load, load_faults};
use albacore_sim::Sensor;
use albacore_vehicle::measurements::ALL;
use guard::{Guard, Problems};
use std::path::Path;

const SURVEY: &str = "tests/faults/survey.alb";
/// A run that lasts longer hangs: the mission's limit of 10 min, its recovery of 3 min, and what a hold may add, in ticks.
const TICKS_MAX: u64 = 9_000;

const DISORDERS: [&str; 8] = ["off", "stuck", "garbage", "wrong", "slow", "delayed", "intermittent", "not_a_number"];
/// What else can go wrong.
const OTHERS: [&str; 9] = [
    "position, jump(10 m)",
    "position, jump(200 m)",
    "position, jump(10 km)",
    "heading, saturated(3 deg/s)",
    "ignored_commands",
    "leak",
    "stuck_rudder(at: 30 %)",
    "strong_current(1.5 m/s toward 90 deg)",
    "strong_current(4 m/s toward 30 deg)",
];

/// Those that can fail, of what a mission is told.
fn sensors() -> impl Iterator<Item = &'static str> {
    Sensor::all().filter(|sensor| sensor.is_told()).map(Sensor::name)
}

/// What came of a run.
struct Told {
    outcome: Outcome,
    reason: String,
    /// What was detected while the fault lasted: what, and so many seconds after its begin.
    detected: Vec<(String, f64)>,
    /// What was wrong with the run itself.
    broken: Vec<String>,
}

/// The fault lasts from here to there, s.
const FROM: f64 = 120.0;
const TO: f64 = 360.0;

fn run(plan: &Plan, seed: u64) -> Told {
    let problems = Problems::default();
    let vehicle = Guard::new(plan, seed, &problems);
    let mut run = Run::on_link(plan, seed, Box::new(vehicle)).unwrap();
    let mut outcome = None;
    for _ in 0..TICKS_MAX {
        if let Running::Over(over) = run.step() {
            outcome = Some(over);
            break;
        }
    }
    let mut broken = problems.take();
    if outcome.is_none() {
        broken.push(format!("it has not ended after {TICKS_MAX} ticks"));
    }
    let trace = run.trace().to_string();
    let line = |line: &str| {
        let (time, what) = line.trim().split_once(" s  vehicle  ")?;
        Some((time.trim().parse::<f64>().ok()?, what.to_string()))
    };
    let notices: Vec<(f64, String)> = trace.lines().filter_map(line).collect();
    let ended = run.tick() as f64 / 10.0;
    for fault in &plan.scenario.faults {
        let named = |what: &str, at: f64| notices.contains(&(at, format!("{what}: {fault}")));
        if !named("fault", FROM) || (ended > TO + 0.2 && !named("fault over", TO)) {
            broken.push(format!("the trace does not name `{fault}`"));
        }
    }
    let detected =
        notices.iter().filter_map(|(at, what)| Some((what.strip_prefix("detected: ")?.to_string(), at - FROM)));
    Told {
        outcome: outcome.unwrap_or(Outcome::Failed),
        reason: run.summary(0.0).reason,
        detected: detected.filter(|(_, after)| *after < TO - FROM).collect(),
        broken,
    }
}

fn plan(fault: Option<&str>) -> Plan {
    let script = load(Path::new(SURVEY), None, &[]).unwrap();
    assert!(script.is_sound() && script.findings.is_empty(), "{:?}", script.findings);
    let plan = Plan::new(&script, SURVEY, None, None).unwrap();
    let text = fault.map(|fault| format!("fault({fault}, from: {FROM} s, to: {TO} s)"));
    let faults = load_faults(&text.into_iter().collect::<Vec<_>>());
    assert!(faults.is_sound(), "{fault:?}: {:?}", faults.findings);
    plan.with_faults(&Faults::of(&faults).unwrap()).unwrap()
}

fn seeds() -> u64 {
    std::env::var("FAULT_SEEDS").ok().map_or(2, |text| text.parse().unwrap())
}

/// One clause each; gives what was told, seed by seed.
fn all_seeds(fault: &str) -> Vec<Told> {
    let plan = plan(Some(fault));
    assert_eq!(plan.scenario.faults.len(), 1);
    (1..=seeds()).map(|seed| run(&plan, seed)).collect()
}

#[test]
fn nothing_is_detected_where_nothing_is_wrong() {
    let plan = plan(None);
    for seed in 1..=seeds() {
        let told = run(&plan, seed);
        assert_eq!((told.outcome, &told.detected, &told.broken), (Outcome::Completed, &vec![], &vec![]), "seed {seed}");
    }
}

/// Sensors that are well, in what once looked like a fault.
#[test]
fn nothing_is_taken_for_stuck_that_rests() {
    let mut runs = 0;
    insta::glob!("faults/none/*.alb", |path| {
        let script = load(path, None, &[]).unwrap();
        assert!(script.is_sound(), "{:?}", script.findings);
        let plan = Plan::new(&script, &path.to_string_lossy(), None, None).unwrap();
        for seed in 1..=5 {
            let mut run = Run::new(&plan, seed).unwrap();
            run.to_end();
            let trace = run.trace().to_string();
            assert!(!trace.contains("stuck"), "{}, seed {seed}: {trace}", path.display());
            runs += 1;
        }
    });
    assert!(runs >= 35);
}

/// An attack: six of sixty seeds aborted for want of a `course` that was rejected.
#[test]
fn a_course_that_swings_in_waves_is_believed() {
    let path = Path::new("tests/faults/waves.alb");
    let plan = Plan::new(&load(path, None, &[]).unwrap(), "waves.alb", None, None).unwrap();
    for seed in [5402, 5433, 5440, 5442] {
        let mut run = Run::new(&plan, seed).unwrap();
        assert_eq!(run.to_end(), Outcome::Completed, "seed {seed}: {}", run.trace());
    }
}

#[test]
fn every_fault_is_survived_and_named() {
    let matrix = sensors().flat_map(|sensor| DISORDERS.map(|disorder| format!("{sensor}, {disorder}")));
    let all: Vec<String> = matrix.chain(OTHERS.map(String::from)).collect();
    let (mut rows, mut broken) = (Vec::new(), Vec::new());
    for fault in &all {
        let told = all_seeds(fault);
        for (told, seed) in told.iter().zip(1..) {
            broken.extend(told.broken.iter().map(|what| format!("{fault}, seed {seed}: {what}")));
        }
        rows.push(page::row(fault, &told));
    }
    assert_eq!(all.len(), sensors().count() * DISORDERS.len() + OTHERS.len());
    assert!(broken.is_empty(), "{} violations:\n{}", broken.len(), broken.join("\n"));
    if let Ok(page) = std::env::var("FAULT_PAGE") {
        page::write(Path::new(&page), &rows, seeds());
    }
}

/// These must be noticed on every seed, and soon: what they change can be seen. Of a channel that comes and goes it may take until
/// it stays away for five of its periods. A CTD is not watched: at the surface it is dry, and tells nothing.
#[test]
fn what_can_be_seen_is_detected() {
    let is_watched = |name: &&str| ALL.iter().any(|row| row.name == *name && row.is_watched);
    for sensor in sensors().filter(is_watched) {
        for disorder in ["off", "garbage", "slow", "delayed", "intermittent", "not_a_number"] {
            let fault = format!("{sensor}, {disorder}");
            for (told, seed) in all_seeds(&fault).iter().zip(1..) {
                let own = told.detected.iter().find(|(what, _)| what.starts_with(sensor));
                let soon = if disorder == "intermittent" { TO - FROM } else { 40.0 };
                assert!(own.is_some_and(|(_, after)| *after <= soon), "{fault}, seed {seed}: {:?}", told.detected);
            }
        }
    }
}

/// Three kilograms are held, with the nose up and somewhat too deep; nine sink the vehicle. A kinematic vehicle has no weight and
/// refuses them.
#[test]
fn a_flooded_vehicle_holds_its_depth_or_sinks() {
    let path = "tests/faults/flooded.alb";
    let script = load(Path::new(path), None, &[]).unwrap();
    assert!(script.is_sound() && script.findings.is_empty(), "{:?}", script.findings);
    let trace = |kilograms: u32, seed: u64, outcome: Outcome| {
        let text = format!("flooding({kilograms} kg, within: 30 s), from: 2 min, to: 5 min");
        let faults = Faults::of(&load_faults(&[text])).unwrap();
        let plan = Plan::new(&script, path, None, None).unwrap().with_faults(&faults).unwrap();
        let mut run = Run::new(&plan, seed).unwrap();
        assert_eq!(run.to_end(), outcome);
        run.trace().to_string()
    };
    for seed in 1..=seeds() {
        let (held, sunk) = (trace(3, seed, Outcome::Completed), trace(9, seed, Outcome::Aground));
        for trace in [&held, &sunk] {
            for what in [
                "  120.0 s  vehicle  fault: flooding",
                "  300.0 s  vehicle  fault over: flooding",
                "detected: depth not as commanded",
            ] {
                assert!(trace.contains(what), "{what}, seed {seed}:\n{trace}");
            }
        }
        assert!(held.contains("again well: depth not as commanded") && !held.contains("grounded"), "{held}");
        assert!(sunk.contains("grounded at") && !sunk.contains("came free"), "{sunk}");
    }
    let faults = Faults::of(&load_faults(&["flooding".into()])).unwrap();
    match plan(None).with_faults(&faults) {
        Err(PlanError::Script(findings, _)) => {
            assert!(findings[0].help.as_ref().unwrap().contains("a `fossen`"), "{findings:?}");
        }
        _ => unreachable!("a kinematic vehicle took in water"),
    }
}

#[test]
fn what_is_no_fault_is_told_with_what_would_be_one() {
    let load = |text: &str| load_faults(&[text.to_string()]);
    let told = |text: &str| {
        let script = load(text);
        let errors: Vec<String> = script.findings.iter().map(|f| format!("{} {:?}", f.message, f.help)).collect();
        errors.join("\n")
    };
    assert!(told("position, stuk").contains("did you mean `stuck`?"), "{}", told("position, stuk"));
    assert!(told("heding, stuck").contains("did you mean `heading`?"), "{}", told("heding, stuck"));
    assert!(told("leak, from: 5 m").contains("Length"), "{}", told("leak, from: 5 m"));
    assert!(told("pit(\"a\")").contains("takes no `pit`"), "{}", told("pit(\"a\")"));
    assert_eq!(told("flow, off"), "");
    // What each part is by itself, and what they are together.
    let refused = |text: &str| {
        let script = albacore_session::load(Path::new(SURVEY), None, &[]).unwrap();
        let plan = Plan::new(&script, SURVEY, None, None).unwrap();
        assert_eq!(told(text), "", "{text}");
        match Faults::of(&load(text)).and_then(|faults| plan.with_faults(&faults)) {
            Err(PlanError::Asked(_, help)) => help.unwrap_or_default(),
            Err(PlanError::Script(findings, _)) => {
                let said = |f: &Diagnostic| format!("{}: {}", f.message, f.help.clone().unwrap_or_default());
                findings.iter().map(said).collect()
            }
            Ok(_) => String::from("nothing"),
        }
    };
    for (text, why) in [
        ("off", "`off` is a trouble of a sensor"),
        ("position", "does not say what is wrong"),
        ("position, leak", "leave `position` out"),
        ("chemical, jump(10 m)", "only `position` can"),
        ("speed, saturated", "only `heading` can"),
        ("flow, off, from: 9 s, to: 8 s", "make `to` later than `from`"),
    ] {
        assert!(refused(text).contains(why), "{text}: {}", refused(text));
    }
}
