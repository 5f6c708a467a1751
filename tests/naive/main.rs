//! A second opinion on the rules of time: a naive evaluator of the checked program, held against the machine.

#![allow(
    clippy::expect_used,
    clippy::panic,
    clippy::print_stdout,
    clippy::unwrap_used,
    missing_docs,
    reason = "a test whose scripts cannot be run has failed"
)]

mod compare;
mod evaluator;
mod events;
mod generate;
mod heavy;
mod host;
mod random;
mod vehicle;

use albacore_lang::{FileFault, Library, Prelude};
use albacore_session::{Plan, Severity, Source, load};
use albacore_sim::Simulator;
use heavy::Heavy;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use vehicle::Chance;

/// No rule needs more ticks than this to be shown.
const TICKS_MAX: u64 = 1_000;

/// Ticks that a generated mission may take: its own limits are below that.
const GENERATED_TICKS_MAX: u64 = 400;
/// Generated scripts of an ordinary `cargo test`; more, and others, with `NAIVE_SEED=1 NAIVE_COUNT=10000`.
const FEW: u64 = 100;

/// What every script knows of a vehicle; a generated one imports nothing.
struct Inputs;

impl Library for Inputs {
    fn prelude(&self) -> &Prelude {
        static INPUTS: LazyLock<Prelude> = LazyLock::new(|| {
            let text = include_str!("../../stdlib/inputs.alb");
            Prelude::read(vec![Source { name: "stdlib/inputs.alb".into(), text: text.into() }])
        });
        &INPUTS
    }

    fn module(&self, _: &Source, _: &[String]) -> Result<Source, String> {
        Err("a generated script imports nothing".to_string())
    }

    fn data_file(&self, path: &str, _: u64) -> Result<Vec<u8>, FileFault> {
        Err(FileFault { message: format!("a generated script reads no `{path}`"), help: None })
    }
}

/// Generates a script, runs it on both sides, and counts what it had in it.
fn trial(seed: u64, had: &mut BTreeMap<String, usize>) -> Result<(), String> {
    let (text, features) = generate::script(seed);
    let script =
        albacore_lang::load(Source { name: "trial.alb".into(), text: text.as_str().into() }, &Inputs, None, &[]);
    if !script.is_sound() {
        let errors = script.findings.iter().filter(|finding| finding.severity == Severity::Error);
        let errors: Vec<String> =
            errors.map(|e| format!("{} {:?} {}", e.code, script.sources.line_column(e.span()), e.message)).collect();
        return Err(format!("seed {seed} is not sound:\n{}\n{text}", errors.join("\n")));
    }
    let mut vehicle = match seed {
        _ if features.contains_key("guest") => Chance::host(seed),
        _ if seed.is_multiple_of(7) => Chance::absurd(seed),
        _ => Chance::new(seed),
    };
    let run = compare::compare(&script, "trial", &mut vehicle, GENERATED_TICKS_MAX);
    for (feature, count) in features {
        *had.entry(feature.to_string()).or_default() += count;
    }
    for event in &run.events {
        let words: Vec<&str> = event.split(' ').collect();
        let kind = match words[0] {
            kind @ ("leave" | "end" | "control") => format!("event: {kind} {}", words[words.len() - 1]),
            kind => format!("event: {kind}"),
        };
        *had.entry(kind).or_default() += 1;
    }
    *had.entry("ticks".to_string()).or_default() += run.ticks as usize;
    run.difference.map_or(Ok(()), |difference| Err(format!("seed {seed}: {difference}\n\n{text}")))
}

/// Generated scripts from a seed on: whether any of them differs, and what all of them had.
fn trials(first: u64, count: u64) -> BTreeMap<String, usize> {
    let mut had = BTreeMap::new();
    let mut failures: Vec<String> = (first..first + count).filter_map(|seed| trial(seed, &mut had).err()).collect();
    failures.sort_by_key(String::len);
    assert!(failures.is_empty(), "{} of {count} differ; the shortest:\n{}", failures.len(), failures[0]);
    had
}

/// What the scripts of an ordinary test must have had between them: each statement, form of rule and condition over time, and
/// each cause of leaving.
#[test]
fn generated() {
    let (seed, count) = (from_environment("NAIVE_SEED", 1), from_environment("NAIVE_COUNT", FEW));
    let had = trials(seed, count);
    println!("{count} programs: {had:#?}");
    // A few may well lack something.
    if count < FEW {
        return;
    }
    let wanted = [
        "steer, steer heading, goto, follow, dubins, loiter, keep, hold, wait, call, call for, call until, call within",
        "call with a result, for T, until, within, at, with, overlay on course, overlay on vertical",
        "overlay on vertical in a block, let, assignment, var, insert, remove, clear, list, ordered list, memory, signal",
        "if, if let, if value, narrowing, match, match value, for range, for list, for written list, for edges, for rows",
        "map, cell, cell set, for map, while, while let, loop, finish, abort, report, log, default, limits, requires, recovery, abort on",
        "reaction of a mission, reaction of a strategy, reaction of a behavior, reaction of a table's behavior",
        "reaction of an overlay, optional as a condition, body that takes no time, sequence, table, rule, several sources",
        "any ->, then back, do, done, done and, done or, after T, -> finish, -> abort, becomes, for, not, no for, after",
        "becomes after, every, false and, or over time, becomes of for",
        "utc, date, elapsed, polygon, polygon of a list, named area, map of shares, map of records, share set, record, ask, replace",
        "call of a given behavior, given behavior handed on, call with given behaviors",
        "result of a given behavior unread, derived strategy, behavior in the place of the base's",
        "table in the place of the base's, memory in the place of the base's, signal in the place of the base's",
        "event: begin, event: suspend, event: resume, event: stale, event: fresh, event: wait, event: amend, event: limit",
        "event: leave Done, event: leave Rule, event: leave Until, event: leave TimedOut, event: leave Preempted",
        "event: finish, event: leave Aborted, event: end completed, event: end aborted, event: end timed_out",
        "guest sequence, guest table, call of a guest, watch, watch for, watch until, reaction to control, abort on control",
        "override, let end = override, override within, override when offered, override for, override until, override cut",
        "event: control Requesting, event: control InControl, event: control Offered, event: control Suspended",
        "event: control Refused, event: control Released, event: leave Refused, event: leave NoAnswer",
        "event: leave TakenBack, event: end refused, event: end link_lost, event: end released_by_vehicle",
    ];
    let missing: Vec<&str> =
        wanted.iter().flat_map(|line| line.split(", ")).filter(|x| !had.contains_key(*x)).collect();
    assert!(missing.is_empty(), "no generated script had: {missing:?}");
}

fn from_environment(name: &str, otherwise: u64) -> u64 {
    std::env::var(name).ok().and_then(|value| value.parse().ok()).unwrap_or(otherwise)
}

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

/// Whatever sensors tell, what is computed of it lies where the checker has it, in the fields of inputs too: the evaluator looks.
#[test]
fn absurd_samples() {
    let text = "enum Mode { still, rough, wild }
        input told: Ratio { count: Int, on: Bool, mode: Mode }
        mission absurd within 2 min {
            area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 400 m, width: 400 m)
            requires { position, course, heading, speed, flow, told fresh 1 min, else abort }
            with depth 3 m, speed 1 m/s
            memory seen: Int = 0
            on told.count >= 1 { seen = seen + told.count }
            on true {
                let named = match told.mode { still { 1 }; rough { 2 }; wild { 3 } }
                let far = (position - op.center).length
                log \"{told} {told.count + 1} {told.count * told.count} {told.on} {named} {seen}\"
                log \"{told * told} {told.peak} {1 / told else 0} {sqrt(abs(told))} {far} {position.sigma * far}\"
                log \"{abs(told.count)} {1 / (1 + told.count * told.count) else 0} {heading + 1 deg} {flow.length}\"
            }
            loop { goto op.center + 1 m toward north within 1 s; steer heading for 1 s at speed min(speed, 2 m/s) }
        }";
    let script = albacore_lang::load(Source { name: "absurd.alb".into(), text: text.into() }, &Inputs, None, &[]);
    let said: Vec<String> = script.findings.iter().map(|finding| finding.message.clone()).collect();
    assert!(script.is_sound(), "{said:#?}");
    for seed in 0..20 {
        let run = compare::compare(&script, "absurd", &mut Chance::absurd(seed), 200);
        assert!(run.difference.is_none(), "seed {seed}: {}", run.difference.unwrap_or_default());
    }
}

/// Vehicles that sink make way by both sides alike: under each kind of limit some are lifted and rise, and some make it in vain.
#[test]
fn lifts() {
    let kinds = [
        "altitude >= 2 m, depth <= 11.5 m, speed <= 1.8 m/s",
        "altitude >= 5 m",
        "altitude >= 4 m, depth >= 1 m, speed <= 1 m/s",
        "depth <= 8 m",
        "speed <= 2 m/s",
    ];
    let (first, count) = (from_environment("NAIVE_SEED", 1), from_environment("NAIVE_COUNT", FEW));
    let (mut differences, mut in_vain) = (Vec::new(), 0);
    for (kind, limits) in (0..).zip(kinds) {
        let text = format!(
            "mission sinks within 95 s {{
                area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 400 m, width: 400 m)
                limits {{ {limits} }}
                requires {{ heading fresh 5 s, else abort; depth fresh 5 s, else hold for 30 s then abort }}
                recovery within 10 s {{ steer north at speed 1 m/s, depth 2 m }}
                loop {{
                    wait for 20 s
                    steer north for 4 s at speed 0.3 m/s, depth 7 m
                    wait for 6 s
                    steer west for 5 s at speed 0.3 m/s, altitude 6 m
                    steer south for 3 s at speed 1 m/s, depth depth + 5 m
                }}
            }}"
        );
        let script = albacore_lang::load(Source { name: "sinks.alb".into(), text: text.into() }, &Inputs, None, &[]);
        let said: Vec<String> = script.findings.iter().map(|finding| finding.message.clone()).collect();
        assert!(script.is_sound(), "{said:#?}");
        let mut had = BTreeMap::new();
        // The last once differed: a vehicle that was too deep in its first tick counted as sinking from the surface.
        for seed in (first + kind..first + count).step_by(kinds.len()).chain([497]) {
            let run = compare::compare(&script, "sinks", &mut Heavy::new(seed), TICKS_MAX);
            differences.extend(run.difference.map(|difference| format!("{limits}, seed {seed}: {difference}")));
            for event in run.events {
                *had.entry(event.split(' ').next().unwrap_or_default().to_string()).or_insert(0) += 1;
            }
        }
        assert!(count < FEW || ["lifted", "risen"].iter().all(|event| had.contains_key(*event)), "{limits}: {had:?}");
        in_vain += had.get("lifted_in_vain").copied().unwrap_or(0);
    }
    assert!(count < FEW || in_vain > 0, "no way was made in vain");
    differences.sort_by_key(String::len);
    assert!(differences.is_empty(), "{} differ; the shortest:\n{}", differences.len(), differences[0]);
}

/// What is written too fast is left out by both sides alike, and counted.
#[test]
fn floods() {
    let text = "mission flood in calm within 2 min {
            area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 400 m, width: 400 m)
            with depth 3 m, speed 1 m/s
            memory places: [Point; 40]
            on true { for n in 1..20 { log \"{n} {places}\" } }
            on true { for n in 1..20 { report \"all\": places, number: n }; places.insert(position) }
            steer north for 1 min
            report \"last\": position
        }";
    let script = albacore_session::load_text(Source { name: "flood.alb".into(), text: text.into() });
    let plan = Plan::new(&script, "flood.alb", None, None).unwrap();
    let run = compare::compare(&script, "flood", &mut Simulator::new(&plan.scenario, 1).unwrap(), TICKS_MAX);
    assert_eq!(run.difference, None);
    assert!(run.events.iter().any(|event| event.starts_with("unwritten")), "nothing was left out");
}
