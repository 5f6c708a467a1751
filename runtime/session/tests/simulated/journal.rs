//! The journal of a run: it holds all that a replay needs, and no failing disk stops a mission.

#![expect(clippy::unwrap_used, clippy::panic, reason = "a test whose scripts cannot be read has failed")]

use crate::sink::Sink;
use albacore_machine::{Machine, Outcome};
use albacore_session::{Faults, PICTURE, PastRun, Plan, Run, Running, load, load_faults};
use albacore_trace::TickRecord;
use albacore_trace::journal::{Ending, Journal};
use albacore_vehicle::Sample;
use std::path::Path;
use std::sync::Arc;

/// Bytes a tick, so that a day at ten ticks a second stays below 500 MB.
const BYTES_A_TICK: usize = 578;

fn plan(mission: &str) -> Plan {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../missions").join(mission).with_extension("alb");
    let script = load(&path, None, &[]).unwrap();
    Plan::new(&script, &path.display().to_string(), None, None).unwrap()
}

fn read(sink: &Sink) -> Journal {
    Journal::read(&sink.bytes()).unwrap()
}

#[track_caller]
fn end(journal: &Journal) -> TickRecord {
    match &journal.ending {
        Ending::Complete(end) => *end.clone(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_machine_fed_with_the_journal_does_the_same_again() {
    let plan = plan("duck_single");
    let sink = Sink::default();
    let mut run = Run::new(&plan, 1).unwrap();
    run.with_journal(Box::new(sink.clone()), &["lambda=5s".into()]);
    assert_eq!(run.to_end(), Outcome::Completed);
    assert!(run.journal_failure().is_none());
    let (journal, summary) = (read(&sink), run.summary(0.0));
    assert_eq!((journal.header.mission.as_str(), &journal.header.set), ("duck_single", &vec!["lambda=5s".into()]));
    assert!(journal.header.sources[0].name.ends_with("duck_single.alb"));
    let end = end(&journal);
    let ending = end.ending().unwrap();
    assert_eq!((ending.outcome, end.tick), (Outcome::Completed, journal.ticks.len() as u64));
    assert_eq!(format!("{:016x}", ending.digest), summary.digest);

    let mut machine = Machine::new(Arc::clone(&plan.program), &journal.header.measurements).unwrap();
    for record in &journal.ticks {
        assert_eq!(machine.step(&record.snapshot), record.command, "tick {}", record.tick);
        assert_eq!(machine.events(), record.events, "tick {}", record.tick);
    }
    assert_eq!(machine.outcome(), Some(Outcome::Completed));

    let per_tick = sink.bytes().len() / journal.ticks.len();
    println!("{per_tick} bytes a tick");
    assert!(per_tick < BYTES_A_TICK, "{per_tick} bytes a tick");
}

/// A beacon is in the journal as each other input is, with a digest of its own for each seed.
#[test]
fn what_was_heard_of_a_beacon_is_in_the_journal() {
    let plan = plan("gallery/docking");
    let heard = |seed: u64| {
        let sink = Sink::default();
        let mut run = Run::new(&plan, seed).unwrap();
        run.with_journal(Box::new(sink.clone()), &[]);
        assert_eq!(run.to_end(), Outcome::Completed);
        (read(&sink), run.summary(0.0).digest)
    };
    let (journal, digest) = heard(1);
    let number = journal.header.measurements.iter().position(|m| m.name == "beacon").unwrap();
    let is_beacon = |sample: &&Sample| usize::from(sample.input_measurement()) == number;
    let samples = journal.ticks.iter().flat_map(|record| &record.snapshot.samples).filter(is_beacon).count();
    // One a second, of which one in ten is lost.
    let (least, most) = (journal.ticks.len() * 8 / 100, journal.ticks.len() * 98 / 1000);
    assert!((least..most).contains(&samples), "{samples} in {} ticks", journal.ticks.len());
    let mut machine = Machine::new(Arc::clone(&plan.program), &journal.header.measurements).unwrap();
    for record in &journal.ticks {
        assert_eq!(machine.step(&record.snapshot), record.command, "tick {}", record.tick);
        assert_eq!(machine.events(), record.events, "tick {}", record.tick);
    }
    assert_eq!(heard(1).1, digest);
    assert_ne!(heard(2).1, digest);
}

/// What was not believed is in the journal, and marked.
#[test]
fn a_machine_fed_with_a_wrong_sample_withholds_it_again() {
    let faults = load_faults(&["position, jump(by: 5 km, toward: north), from: 60 s, to: 60.1 s".into()]);
    let plan = plan("box").with_faults(&Faults::of(&faults).unwrap()).unwrap();
    let sink = Sink::default();
    let mut run = Run::new(&plan, 1).unwrap();
    run.with_journal(Box::new(sink.clone()), &[]);
    assert_eq!(run.to_end(), Outcome::Completed);
    let journal = read(&sink);
    let withheld = |record: &TickRecord| record.snapshot.samples.iter().any(Sample::is_withheld);
    let ticks: Vec<u64> = journal.ticks.iter().filter(|r| withheld(r)).map(|r| r.tick).collect();
    assert_eq!(ticks, [600]);
    let mut machine = Machine::new(Arc::clone(&plan.program), &journal.header.measurements).unwrap();
    for record in &journal.ticks {
        assert_eq!(machine.step(&record.snapshot), record.command, "tick {}", record.tick);
        assert_eq!(machine.events(), record.events, "tick {}", record.tick);
    }
}

/// What a run left in memory is the same when its journal is read back: after its end, after an interruption, and of half a journal up
/// to where that ends.
#[test]
fn a_journal_that_is_read_back_feeds_the_same_recorders() {
    for (mission, ticks) in [("duck_single", None), ("thermocline", None), ("woods_hole", None), ("box", Some(700))] {
        let plan = plan(mission);
        let sink = Sink::default();
        let mut run = Run::new(&plan, 4).unwrap();
        run.with_journal(Box::new(sink.clone()), &[]);
        match ticks {
            Some(ticks) => (0..ticks).for_each(|_| assert_eq!(run.step(), Running::On)),
            None => _ = run.to_end(),
        }
        run.interrupt();
        let bytes = sink.bytes();
        let past = PastRun::read(&plan, &bytes).unwrap();
        assert!(matches!(past.ending(), Ending::Complete(_)), "{mission}: {:?}", past.ending());
        assert_eq!(past.summary(), run.summary(0.0), "{mission}");
        assert_eq!(past.trace().to_string(), run.trace().to_string(), "{mission}");
        // The plume is not in the journal.
        assert!(
            plan.scenario.has_plume() || past.file(&PICTURE) == run.file(&PICTURE),
            "{mission}: the pictures differ"
        );
        let half = PastRun::read(&plan, &bytes[..bytes.len() / 2]).unwrap();
        let (trace, whole) = (half.trace().to_string(), run.trace().to_string());
        assert!(matches!(half.ending(), Ending::CutShort(_)) && trace.lines().count() > 3, "{mission}: {trace}");
        assert!(whole.starts_with(&trace), "{mission}");
    }
}

/// A journal outlives its script: what that has no names for is told as far as it can be.
#[test]
fn a_journal_of_another_script_can_be_read() {
    let missions = ["duck_single", "thermocline", "woods_hole", "box", "deepest_point"];
    let journals = missions.map(|mission| {
        let sink = Sink::default();
        let mut run = Run::new(&plan(mission), 1).unwrap();
        run.with_journal(Box::new(sink.clone()), &[]);
        (0..6000).for_each(|_| _ = run.step());
        run.interrupt();
        sink.bytes()
    });
    for mission in missions {
        let plan = plan(mission);
        for journal in &journals {
            let past = PastRun::read(&plan, journal).unwrap();
            assert!(matches!(past.ending(), Ending::Complete(_)), "{mission}: {:?}", past.ending());
            assert!(!past.trace().to_string().is_empty() && past.file(&PICTURE).starts_with("<svg"), "{mission}");
        }
    }
}

#[test]
fn an_interrupted_run_closes_its_journal() {
    let plan = plan("box");
    let sink = Sink::default();
    let mut run = Run::new(&plan, 1).unwrap();
    run.with_journal(Box::new(sink.clone()), &[]);
    (0..100).for_each(|_| assert_eq!(run.step(), Running::On));
    run.interrupt();
    let journal = read(&sink);
    let end = end(&journal);
    let ending = end.ending().unwrap();
    assert_eq!((ending.outcome, ending.reason.as_str(), end.tick), (Outcome::Interrupted, "interrupted", 100));
    assert_eq!(journal.ticks.len(), 100);
    assert!(!end.events.is_empty());
}

#[test]
fn the_same_run_leaves_the_same_journal() {
    let plan = plan("box");
    let bytes = || {
        let sink = Sink::default();
        let mut run = Run::new(&plan, 3).unwrap();
        run.with_journal(Box::new(sink.clone()), &[]);
        run.to_end();
        sink.bytes()
    };
    assert_eq!(bytes(), bytes());
}

#[test]
fn a_disk_that_fills_at_any_write_leaves_the_run_alone() {
    const TICKS: u64 = 205;
    let plan = plan("box");
    let digest = |writes_left: Option<usize>| {
        let sink = Sink::with_writes(writes_left);
        let mut run = Run::new(&plan, 1).unwrap();
        run.with_journal(Box::new(sink.clone()), &[]);
        let mut failures = usize::from(run.journal_failure().is_some());
        for _ in 0..TICKS {
            assert_eq!(run.step(), Running::On);
            failures += usize::from(run.journal_failure().is_some());
        }
        (run.summary(0.0).digest, failures, sink)
    };
    let (good, failures, _) = digest(None);
    assert_eq!(failures, 0);
    for k in 1..=200 {
        let (digest, failures, sink) = digest(Some(k));
        assert_eq!((digest, failures), (good.clone(), 1), "disk full at write {k}");
        match Journal::read(&sink.bytes()) {
            Err(_) => assert_eq!(k, 1),
            Ok(journal) => {
                assert_eq!(journal.ticks.len(), k - 2, "disk full at write {k}");
                assert!(matches!(journal.ending, Ending::CutShort(_)), "disk full at write {k}");
            }
        }
    }
}
