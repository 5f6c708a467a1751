//! Limits never fail open: no fault of the depth or of the altitude lets a mission with `altitude >= A` touch the bottom.

#![expect(clippy::unwrap_used, reason = "a test whose scripts cannot be read has failed")]

use albacore_lang::source::Source;
use albacore_session::{Faults, Outcome, Plan, Run, Script, load, load_faults, load_text, run_test};
use std::path::Path;

const LIMITS: &str = "tests/aground/limits.alb";
/// What can be wrong with an altitude, but for an error that could be true of it.
const ALTITUDES: [&str; 8] = [
    "off",
    "stuck",
    "garbage",
    "slow(every: 4 s)",
    "delayed(by: 3 s)",
    "intermittent(heard: 1 s, silent: 4 s)",
    "not_a_number",
    "wrong(size: -1)",
];
/// A depth that is told wrong, while the vehicle holds the true one that it is told: the altitude alone can lead up.
const DEPTHS: [&str; 5] = ["stuck", "garbage", "wrong", "wrong(size: 3)", "wrong(size: 20)"];
const MISSIONS: [&str; 2] = ["deep", "by_altitude"];
const FROM: [&str; 4] = ["0 s", "12 s", "25 s", "60 s"];

fn limits() -> Script {
    let script = load(Path::new(LIMITS), None, &[]).unwrap();
    assert!(script.is_sound() && script.findings.is_empty(), "{:?}", script.findings);
    script
}

/// A mission in a scenario of the script.
fn plan(script: &Script, mission: &str, scenario: &str) -> Plan {
    Plan::new(script, LIMITS, Some(mission), Some(scenario)).unwrap()
}

fn run(plan: &Plan, faults: &[String]) -> (Outcome, String) {
    let faults = load_faults(faults);
    assert!(faults.is_sound(), "{:?}", faults.findings);
    let mut run = Run::new(&plan.clone().with_faults(&Faults::of(&faults).unwrap()).unwrap(), 1).unwrap();
    let outcome = run.to_end();
    (outcome, run.trace().to_string())
}

/// Runs each mission over each bottom with each fault of a sensor, and gives what touched the bottom.
fn aground(missions: [&str; 2], sensor: &str, disorders: &[&str]) -> Vec<String> {
    let (mut aground, script) = (Vec::new(), limits());
    for mission in missions {
        for scenario in ["level", "shallow", "rising"] {
            let plan = plan(&script, mission, scenario);
            for disorder in disorders {
                for from in FROM {
                    let fault = format!("{sensor}, {disorder}, from: {from}");
                    let (outcome, trace) = run(&plan, std::slice::from_ref(&fault));
                    if trace.contains("grounded at") || outcome == Outcome::Aground {
                        aground.push(format!("{mission} in {scenario}, {fault}: {outcome:?}"));
                    }
                }
            }
        }
    }
    aground
}

#[test]
fn no_altitude_leads_aground() {
    let aground = aground(MISSIONS, "altitude", &ALTITUDES);
    assert!(aground.is_empty(), "{} runs:\n{}", aground.len(), aground.join("\n"));
}

#[test]
fn no_depth_leads_aground_while_the_altitude_is_true() {
    let aground = aground(MISSIONS, "depth", &DEPTHS);
    assert!(aground.is_empty(), "{} runs:\n{}", aground.len(), aground.join("\n"));
}

/// An attack: with `depth >= D` a low altitude led down to D, through the bottom where the water had less.
#[test]
fn no_least_depth_leads_aground() {
    let missions = ["deep_at_least", "by_altitude_at_least"];
    let aground = [aground(missions, "depth", &DEPTHS), aground(missions, "altitude", &["wrong(size: 60 %)"])].concat();
    assert!(aground.is_empty(), "{} runs:\n{}", aground.len(), aground.join("\n"));
    for mission in missions {
        for scenario in ["level", "shallow", "rising"] {
            let (_, trace) = run(&plan(&limits(), mission, scenario), &[]);
            assert!(!trace.contains("grounded at"), "{mission} in {scenario}:\n{trace}");
        }
    }
}

/// An attack: an altitude was held within `depth <= D` by the altitude that was told alone, and a vehicle that measured another went to
/// 55 m where 15 m were allowed.
#[test]
fn no_altitude_that_is_asked_for_leads_deeper_than_the_depth_may_be() {
    let text = std::fs::read_to_string("tests/aground/deep.alb").unwrap();
    for hull in ["kinematic", "fossen", "prestero"] {
        let text = text.replace("vehicle(kinematic", &format!("vehicle({hull}"));
        let script = load_text(Source { name: "deep.alb".into(), text: text.into() });
        assert!(script.is_sound() && script.findings.is_empty(), "{:?}", script.findings);
        for scenario in
            ["told_less", "share", "biased", "silent", "falling", "falling_biased", "stuck", "late", "stuck_early"]
        {
            let plan = Plan::new(&script, "deep.alb", None, Some(scenario)).unwrap();
            let mut run = Run::new(&plan, 1).unwrap();
            run.to_end();
            let trace = run.trace().to_string();
            // Each minute's line tells the true depth.
            let deepest =
                trace.lines().filter_map(|line| line.split_once(" depth ")?.1.split_whitespace().next()?.parse().ok());
            let deepest = deepest.fold(0.0, f64::max);
            assert!(!trace.contains("below 16 m") && deepest > 0.5 && deepest < 16.0, "{hull} in {scenario}:\n{trace}");
            assert!(!trace.contains("grounded at"), "{hull} in {scenario}:\n{trace}");
        }
    }
}

/// What of dives to a depth that is told too deep touches the bottom, with these faults besides.
fn told_deep_aground(sizes: &[f64], rates: &[&str], besides: &[&str]) -> Vec<String> {
    let mut aground = Vec::new();
    for hull in ["kinematic", "fossen", "prestero"] {
        for rate in rates {
            let scenario = format!("{hull}_level");
            let text = std::fs::read_to_string("tests/aground/told_deep.alb").unwrap();
            let text = text.replace("rate: 1 Hz", &format!("rate: {rate}"));
            let script = load_text(Source { name: "told_deep.alb".into(), text: text.into() });
            assert!(script.is_sound() && script.findings.is_empty(), "{:?}", script.findings);
            let plan = Plan::new(&script, "told_deep.alb", None, Some(&scenario)).unwrap();
            for (size, besides) in sizes.iter().flat_map(|size| besides.iter().map(move |besides| (size, besides))) {
                let mut faults = vec![format!("depth, wrong(size: {size})")];
                faults.extend((!besides.is_empty()).then(|| (*besides).to_string()));
                let faults = load_faults(&faults);
                assert!(faults.is_sound(), "{:?}", faults.findings);
                let plan = plan.clone().with_faults(&Faults::of(&faults).unwrap()).unwrap();
                for seed in 1..=2 {
                    let mut run = Run::new(&plan, seed).unwrap();
                    run.to_end();
                    if run.trace().to_string().contains("grounded at") {
                        aground.push(format!("{hull} at {rate}, {size} times, {besides}, seed {seed}"));
                    }
                }
            }
        }
    }
    aground
}

/// An attack: by the time that a sounder of 1 Hz told that the altitude was low, a hull that turns slowly could not be led up any more.
#[test]
fn no_depth_that_is_told_too_deep_leads_aground() {
    let aground = told_deep_aground(&[1.0, 3.0, 5.0], &["1 Hz", "2 Hz"], &[""]);
    assert!(aground.is_empty(), "{} runs:\n{}", aground.len(), aground.join("\n"));
}

/// An attack: nor does an altitude that is lost in the middle of it. A vehicle that is deeper than it is told to be is led up.
#[test]
fn no_dive_that_is_told_too_deep_goes_on_without_an_altitude() {
    let lost = ["45.1 s", "49 s", "62 s", "66 s"];
    let lost: Vec<String> =
        lost.iter().flat_map(|from| ["stuck", "off"].map(|how| format!("altitude, {how}, from: {from}"))).collect();
    let lost: Vec<&str> = lost.iter().map(String::as_str).collect();
    let aground = told_deep_aground(&[2.0, 3.0, 5.0], &["10 Hz"], &lost);
    assert!(aground.is_empty(), "{} runs:\n{}", aground.len(), aground.join("\n"));
}

#[test]
fn a_mission_that_waits_stays_where_it_began_to() {
    let (outcome, trace) = run(&plan(&limits(), "waiting", "biased"), &[]);
    assert_eq!(outcome, Outcome::Aborted, "{trace}");
    assert!(trace.contains("`flow` has never come") && !trace.contains("grounded at"), "{trace}");
}

/// Below its steerage way a light hull swam down nose first, whatever depth was commanded, and no limit could lead it up.
#[test]
fn no_slow_way_leads_a_light_hull_aground() {
    let mut ways = Vec::new();
    for speed in ["0.3 m/s", "0.6 m/s", "0.8 m/s", "1 m/s"] {
        for (fast_for, slow_for) in [("10 s", "10 s"), ("10 s", "30 s"), ("30 s", "60 s")] {
            let set = [("slow_at", speed), ("fast_for", fast_for), ("slow_for", slow_for)];
            let set = set.map(|(name, value)| format!("{name}={value}"));
            let script = load(Path::new("tests/aground/slow.alb"), None, &set).unwrap();
            assert!(script.is_sound() && script.findings.is_empty(), "{:?}", script.findings);
            let mut run = Run::new(&Plan::new(&script, "slow.alb", Some("slow"), None).unwrap(), 1).unwrap();
            let outcome = run.to_end();
            if outcome != Outcome::TimedOut || run.trace().to_string().contains("grounded at") {
                ways.push(format!("{set:?}: {outcome:?}"));
            }
        }
    }
    assert!(ways.is_empty(), "{}", ways.join("\n"));
}

/// A limit is held where the bottom rises ahead, too: by what it rose on the way behind, and by an autopilot whose trim a long dive does not
/// wind up.
#[test]
fn no_slope_leads_aground() {
    let mut aground = Vec::new();
    for (scenario, slowest) in [("gentle", 0), ("steep", 0), ("very_steep", 1)] {
        for up in [0, 180] {
            for slow_at in &["0 m/s", "0.1 m/s", "0.6 m/s", "1 m/s"][slowest..] {
                for legs in [20, 60] {
                    for by_altitude in [0, 1] {
                        let set = [
                            format!("up={up}deg"),
                            format!("slow_at={slow_at}"),
                            format!("legs={legs}s"),
                            format!("by_altitude={by_altitude}"),
                        ];
                        let script = load(Path::new("tests/aground/slow.alb"), Some("slopes"), &set).unwrap();
                        assert!(script.is_sound() && script.findings.is_empty(), "{:?}", script.findings);
                        let plan = Plan::new(&script, "slow.alb", Some("slopes"), Some(scenario)).unwrap();
                        let mut run = Run::new(&plan, 1).unwrap();
                        let outcome = run.to_end();
                        if outcome != Outcome::TimedOut || run.trace().to_string().contains("grounded at") {
                            aground.push(format!("{scenario}, {set:?}: {outcome:?}"));
                        }
                    }
                }
            }
        }
    }
    assert!(aground.is_empty(), "{} runs:\n{}", aground.len(), aground.join("\n"));
}

/// Where the altitude is lost, or the depth comes seldom, a current carries the vehicle up the slope, and a slow hull has to be lifted.
#[test]
fn no_current_leads_aground() {
    let faults = [
        "altitude, off",
        "altitude, not_a_number",
        "altitude, garbage",
        "altitude, slow(every: 8 s)",
        "altitude, slow(every: 40 s)",
        "altitude, intermittent(heard: 2 s, silent: 6 s)",
        "depth, slow",
        "depth, stuck",
        "depth, off",
    ];
    let mut aground = Vec::new();
    for scenario in ["upward", "upward_fossen", "upward_prestero"] {
        for (mission, current, cruise) in [
            ("upslope", "0 m/s", "0.5 m/s"),
            ("upslope", "0 m/s", "1.2 m/s"),
            ("upslope", "0.3 m/s", "0.8 m/s"),
            ("drifts", "0.2 m/s", "0 m/s"),
            ("drifts", "0.5 m/s", "0.1 m/s"),
        ] {
            for fault in faults {
                let set = [format!("current={current}"), format!("cruise={cruise}")];
                let set: Vec<&str> = set.iter().map(String::as_str).collect();
                let trace = slow(mission, scenario, &set, &[&format!("{fault}, from: 185 s")]);
                if trace.contains("grounded at") {
                    aground.push(format!("{mission} in {scenario}, {set:?}, {fault}"));
                }
            }
        }
    }
    assert!(aground.is_empty(), "{} runs:\n{}", aground.len(), aground.join("\n"));
}

/// Runs that once touched the bottom, as they were found.
#[test]
fn what_once_led_aground_does_not() {
    let mut runs = 0;
    insta::glob!("aground/found/*.alb", |path| {
        let script = load(path, None, &[]).unwrap();
        assert!(script.is_sound(), "{:?}", script.findings);
        let plan = Plan::new(&script, &path.to_string_lossy(), None, None).unwrap();
        for seed in 1..=3 {
            let mut run = Run::new(&plan, seed).unwrap();
            run.to_end();
            let trace = run.trace().to_string();
            assert!(!trace.contains("grounded at"), "{}, seed {seed}: {trace}", path.display());
            runs += 1;
        }
    });
    assert!(runs >= 102);
}

/// A vehicle without way obeys no depth: one that has sunk below where its limits let it is given way, as much as they allow.
#[test]
fn a_vehicle_that_waits_does_not_sink_to_the_bottom() {
    for (most, way) in [("2 m/s", "makes way, 1.50 m/s"), ("1 m/s", "makes way, 1.00 m/s")] {
        let set = [format!("most={most}")];
        let script = load(Path::new("tests/aground/slow.alb"), Some("waits"), &set).unwrap();
        assert!(script.is_sound() && script.findings.is_empty(), "{:?}", script.findings);
        let mut lifted = 0;
        for seed in 1..=8 {
            let mut run = Run::new(&Plan::new(&script, "slow.alb", Some("waits"), None).unwrap(), seed).unwrap();
            assert_eq!(run.to_end(), Outcome::TimedOut, "{}", run.trace());
            let trace = run.trace().to_string();
            assert!(!trace.contains("grounded at"), "{trace}");
            // By other waves it rises.
            lifted += u32::from(trace.contains(way) && trace.contains("no longer too deep"));
        }
        assert!(lifted >= 3, "{most}: {lifted}");
    }
}

fn slow(mission: &str, scenario: &str, set: &[&str], faults: &[&str]) -> String {
    let set: Vec<String> = set.iter().map(ToString::to_string).collect();
    let script = load(Path::new("tests/aground/slow.alb"), Some(mission), &set).unwrap();
    assert!(script.is_sound() && script.findings.is_empty(), "{:?}", script.findings);
    let faults: Vec<String> = faults.iter().map(ToString::to_string).collect();
    let plan = Plan::new(&script, "slow.alb", Some(mission), Some(scenario)).unwrap();
    let mut run = Run::new(&plan.with_faults(&Faults::of(&load_faults(&faults)).unwrap()).unwrap(), 1).unwrap();
    run.to_end();
    run.trace().to_string()
}

/// Nobody who waits is driven about because a gauge is wrong, the bottom is lost, or no speed that is allowed lifts the vehicle.
#[test]
fn way_that_cannot_help_is_not_made() {
    for fault in ["depth, wrong, from: 60 s", "depth, wrong(size: 5), from: 60 s", "altitude, off, from: 60 s"] {
        let trace = slow("waits", "shelf", &[], &[fault]);
        let waiting: Vec<&str> = trace.lines().take_while(|line| !line.trim_start().starts_with("300.0 s")).collect();
        let is_noticed = trace.contains("altitude unknown") || trace.contains("depth jumps");
        assert!(is_noticed && waiting.len() < trace.lines().count(), "{fault}: {trace}");
        assert!(!waiting.join("\n").contains("makes way"), "{fault}: {trace}");
    }
    let trace = slow("hangs", "still", &[], &[]);
    assert!(!trace.contains("stuck") && !trace.contains("makes way"), "{trace}");
    let trace = slow("waits", "surf", &["most=1cm/s"], &[]);
    // It is no way to speak of, and goes on for as long as the vehicle sinks.
    assert!(trace.contains("makes way, 0.01 m/s") && !trace.contains("no longer too deep"), "{trace}");
}

/// Way is made for who sinks: not out of a dive that was asked for, and not for ever where a gauge goes up and down.
#[test]
fn way_is_made_for_who_sinks() {
    let trace = |file: &str| {
        let path = Path::new("tests/aground").join(file);
        let script = load(&path, None, &[]).unwrap();
        assert!(script.is_sound(), "{:?}", script.findings);
        let mut run = Run::new(&Plan::new(&script, file, None, None).unwrap(), 1).unwrap();
        run.to_end();
        run.trace().to_string()
    };
    let dives = trace("yoyo.alb");
    assert!(!dives.contains("makes way"), "{dives}");
    let noisy = trace("noisy_gauge.alb");
    assert!(noisy.contains("makes way") && noisy.contains("makes no more"), "{noisy}");
}

/// What is wrong for a moment aborts nothing: a first sample too has others to follow it.
#[test]
fn one_wrong_sample_aborts_nothing() {
    for fault in [
        "position, jump(5 km), from: 0 s, to: 0.1 s",
        "position, jump(5 km), from: 20 s, to: 20.1 s",
        "position, garbage, from: 20 s, to: 20.1 s",
        "position, garbage, from: 0 s, to: 0.1 s",
        "depth, wrong(size: 100), from: 0 s, to: 0.1 s",
        "depth, garbage, from: 20 s, to: 20.1 s",
        "heading, garbage, from: 20 s, to: 20.1 s",
        "speed, garbage, from: 20 s, to: 20.1 s",
    ] {
        for seed in 1..=8 {
            let script = load(Path::new("tests/aground/one_wrong.alb"), None, &[]).unwrap();
            assert!(script.is_sound() && script.findings.is_empty(), "{:?}", script.findings);
            let plan = Plan::new(&script, "one_wrong.alb", None, None).unwrap();
            let faults = Faults::of(&load_faults(&[fault.to_string()])).unwrap();
            let mut run = Run::new(&plan.with_faults(&faults).unwrap(), seed).unwrap();
            assert_eq!(run.to_end(), Outcome::Completed, "{fault}, seed {seed}:\n{}", run.trace());
        }
    }
}

/// Depths all over the place for longer than the vehicle can do without: the mission ends for want of one, not by what it heard.
#[test]
fn garbage_is_never_taken_for_a_depth() {
    for seed in 1..=8 {
        let script = load(Path::new("tests/aground/one_wrong.alb"), None, &[]).unwrap();
        let plan = Plan::new(&script, "one_wrong.alb", None, None).unwrap();
        let faults = Faults::of(&load_faults(&["depth, garbage, from: 10 s, to: 30 s".into()])).unwrap();
        let mut run = Run::new(&plan.with_faults(&faults).unwrap(), seed).unwrap();
        assert_eq!(run.to_end(), Outcome::Completed, "seed {seed}:\n{}", run.trace());
    }
}

/// What the tests of a script expect.
#[track_caller]
fn holds(path: &str) {
    let script = load(Path::new(path), None, &[]).unwrap();
    for test in script.tests() {
        let result = run_test(&script, &test.unwrap(), &Faults::default()).unwrap();
        assert!(result.failures.is_empty(), "{:#?}", result.failures);
    }
}

/// An attack: a guest was aborted in its first tick for the time that its vehicle had lain on the bottom by a plan of its own.
#[test]
fn a_guest_is_not_charged_with_its_vehicles_own_grounding() {
    holds("tests/aground/guest.alb");
}

/// An attack: it passed its depth by more than was said.
#[test]
fn a_vehicle_that_is_suspended_under_way_passes_its_depth_by_some_metres() {
    holds("tests/aground/suspended.alb");
}
