//! A run once more: the same to the bit on what its journal holds, and where a changed one departs.

#![expect(clippy::unwrap_used, clippy::panic, reason = "a test whose scripts cannot be read has failed")]

use crate::sink::Sink;
use albacore_session::journal::{Ending, Reader};
use albacore_session::{Changes, DeedDifference, PastRun, Plan, Run, RunDifference, depart, explain, load, repeat};
use std::path::{Path, PathBuf};

fn missions() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../missions")
}

fn path_of(mission: &str) -> PathBuf {
    missions().join(mission).with_extension("alb")
}

/// The journal of a run with a seed, to its end or for so many ticks.
fn journal(path: &Path, mission: Option<&str>, seed: u64, ticks: u64, set: &[String]) -> Vec<u8> {
    let script = load(path, mission, set).unwrap();
    let plan = Plan::new(&script, &path.display().to_string(), mission, None).unwrap();
    let sink = Sink::default();
    let mut run = Run::new(&plan, seed).unwrap();
    run.with_journal(Box::new(sink.clone()), set);
    while run.outcome().is_none() && run.tick() < ticks {
        run.step();
    }
    run.interrupt();
    sink.bytes()
}

/// The plan that a journal tells, with changes.
fn plan_of(journal: &[u8], path: &Path, set: &[String]) -> Plan {
    let header = Reader::new(journal).unwrap().header().clone();
    let changes = Changes { beside: Some(path), set, ..Changes::default() };
    let planned = Plan::of_journal(&header, &changes);
    planned.unwrap_or_else(|error| panic!("{error:?}")).1
}

#[test]
fn every_shipped_mission_is_replayed_to_the_bit_from_its_journal_alone() {
    // Those of the rules of time run in worlds of a module.
    let rules = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/rules");
    let folders = [missions(), missions().join("gallery"), missions().join("benchmark"), rules];
    let scripts = folders.iter().flat_map(|folder| {
        let entries = std::fs::read_dir(folder).unwrap();
        entries.map(|entry| entry.unwrap().path()).filter(|path| path.extension().is_some_and(|e| e == "alb"))
    });
    let (mut replayed, mut scripts): (usize, Vec<PathBuf>) = (0, scripts.collect());
    scripts.sort();
    for path in scripts {
        let script = load(&path, None, &[]).unwrap();
        if !script.is_sound() {
            continue;
        }
        let names: Vec<String> = script.missions().filter(|m| m.scenario.is_some()).map(|m| m.name.clone()).collect();
        for mission in names {
            let journal = journal(&path, Some(&mission), 1, TICKS, &[]);
            let plan = plan_of(&journal, &path, &[]);
            let repeated = repeat(Reader::new(&journal).unwrap(), &plan).unwrap();
            assert!(repeated.is_same() && repeated.ticks > 0, "{}: {mission}: {repeated:?}", path.display());
            assert!(matches!(repeated.ending, Ending::Complete(_)), "{mission}");
            replayed += 1;
        }
    }
    assert!(replayed > 150, "{replayed}");
}

/// So many ticks of each mission are run: 20 minutes.
const TICKS: u64 = 12_000;

#[test]
fn a_changed_parameter_departs_at_a_tick_by_a_rule() {
    let path = path_of("duck_single");
    let journal = journal(&path, None, 1, 4000, &[]);
    let original = plan_of(&journal, &path, &[]);
    let same = depart(&journal, &original, &original).unwrap();
    assert!(same.commanded.is_none() && same.decided.is_none() && same.deeds.is_empty(), "{same:?}");

    let changed = plan_of(&journal, &path, &["lambda=4s".into()]);
    let departure = depart(&journal, &original, &changed).unwrap();
    let parting = departure.decided.unwrap();
    assert!(parting.lines[0].is_empty() && parting.lines[1][0].contains("track_in -> track_out"), "{parting:?}");
    let [run, replay] = parting.conditions;
    assert_eq!((run[0].holds, replay[0].holds), (false, true));
    assert!(run[0].values.contains("lambda = 5 s") && replay[0].values.contains("lambda = 4 s"), "{run:?}");
    // A second earlier, as the vehicle sensed the same.
    let DeedDifference::Shift { ticks: [of_run, of_replay], deed } = &departure.deeds[0] else {
        panic!("{:?}", departure.deeds)
    };
    assert_eq!((of_run - of_replay, *of_replay, deed.as_str()), (10, parting.tick, "track_in -> track_out"));
}

/// What is set takes the place of what was set for the run, by its own name or with the mission's.
#[test]
fn a_parameter_of_the_run_is_changed_once_more() {
    let path = path_of("duck_single");
    let journal = journal(&path, None, 1, 50, &["lambda=6s".into()]);
    for set in ["lambda=6s", "lambda = 7 s", "duck_single.lambda=6s"] {
        let plan = plan_of(&journal, &path, &[set.into()]);
        let is_same = plan.program == plan_of(&journal, &path, &[]).program;
        assert_eq!(is_same, set != "lambda = 7 s", "{set}");
    }
}

#[test]
fn a_switch_is_explained_by_its_rule_and_by_what_did_not_hold() {
    let path = path_of("duck_single");
    let journal = journal(&path, None, 1, 4000, &[]);
    let plan = plan_of(&journal, &path, &[]);
    let all = explain(Reader::new(&journal).unwrap(), &plan, None).unwrap();
    let switches = all.decisions.iter().filter(|decision| decision.lines.iter().any(|line| line.contains("switch ")));
    let mut count = 0;
    for decision in switches {
        let held: Vec<_> = decision.conditions.iter().filter(|condition| condition.holds).collect();
        assert_eq!(held.len(), 1, "{decision:?}");
        let lines = decision.lines.join("\n");
        assert!(lines.contains(&held[0].decides) && lines.contains(&held[0].place), "{decision:?}");
        // What a conjunction is made of holds, where it does: by its terms of the first depth.
        let terms = held[0].terms.iter().filter(|term| term.depth == 0);
        let is_or = held[0].condition.contains(" or ");
        assert!(is_or || terms.clone().all(|term| term.holds == Some(true)), "{decision:?}");
        count += 1;
    }
    assert!(count > 10, "{count}");

    let first = all.decisions.iter().find(|decision| decision.lines[0].contains("find -> track_in")).unwrap();
    let before = explain(Reader::new(&journal).unwrap(), &plan, Some(first.tick - 5..=first.tick - 5)).unwrap();
    assert!(before.decisions.is_empty() && before.after.as_ref() == first.lines.first(), "{:?}", before.after);
    let moment = before.moment.unwrap();
    let rule = moment.conditions.iter().find(|condition| condition.decides == "find -> track_in").unwrap();
    assert!(!rule.holds && rule.terms.iter().any(|term| term.holds == Some(false)), "{rule:?}");
    let known = |name: &str| moment.inputs.iter().find(|input| input.name == name).unwrap();
    assert!(known("chemical").age_s.unwrap() < 0.2 && known("temperature").value.is_none(), "{:?}", moment.inputs);
}

#[test]
fn two_runs_differ_in_a_missions_own_terms() {
    let path = path_of("box");
    let journals = [journal(&path, None, 1, u64::MAX, &[]), journal(&path, None, 2, u64::MAX, &[])];
    let difference = |journals: [&[u8]; 2]| {
        let runs = journals.map(|journal| PastRun::read(&plan_of(journal, &path, &[]), journal).unwrap());
        RunDifference::of([&runs[0], &runs[1]], journals.map(|journal| Reader::new(journal).unwrap()))
    };
    let same = difference([&journals[0], &journals[0]]);
    assert!(same.is_same() && same.run.is_empty() && same.behaviors.is_empty() && same.reports.is_empty(), "{same:?}");
    let other = difference([&journals[0], &journals[1]]);
    assert!(!other.is_same() && other.run == ["seed 1, and 2"] && other.sensed_at.is_some(), "{other:?}");
}

/// Whatever happens to a journal: as much of it as is whole is told, and then where it ends, or that it cannot be read.
#[test]
fn a_damaged_journal_is_replayed_up_to_where_it_is_whole() {
    let path = path_of("box");
    let whole = journal(&path, None, 1, 40, &[]);
    let plan = plan_of(&whole, &path, &[]);
    let count: u64 = std::env::var("DAMAGED_COUNT").ok().and_then(|count| count.parse().ok()).unwrap_or(500);
    // What is changed is drawn by a generator of the test's own, from one number.
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut draw = |below: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    let (mut unreadable, mut short) = (0, 0);
    for _ in 0..count {
        let mut damaged = whole.clone();
        match draw(4) {
            0 => damaged.truncate(draw(whole.len())),
            1 => damaged[draw(whole.len())] ^= 1 << draw(8),
            2 => _ = damaged.drain(draw(whole.len() / 2)..whole.len() / 2 + draw(whole.len() / 2)),
            _ => damaged.extend_from_slice(&whole[draw(whole.len())..]),
        }
        if damaged == whole {
            continue;
        }
        let Ok(reader) = Reader::new(&damaged) else {
            unreadable += 1;
            continue;
        };
        // A header that is whole is that of the run.
        let repeated = repeat(reader, &plan).unwrap();
        assert!(repeated.differs_at.is_none(), "{repeated:?}");
        match &repeated.ending {
            Ending::CutShort(flaw) | Ending::Damaged(flaw) => assert!(flaw.at <= damaged.len() && repeated.ticks <= 40),
            Ending::Complete(_) => panic!("what was changed goes unnoticed"),
        }
        let told = explain(Reader::new(&damaged).unwrap(), &plan, None).unwrap();
        assert!(told.ticks <= 41, "{}", told.ticks);
        assert!(PastRun::read(&plan, &damaged).is_ok());
        short += 1;
    }
    assert!(unreadable > 0 && short > 0, "{unreadable} {short}");
}
