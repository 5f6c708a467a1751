//! The journal of a run: it holds all that a replay needs, and no failing disk stops a mission.

#![expect(clippy::unwrap_used, clippy::panic, reason = "a test whose scripts cannot be read has failed")]

use albacore_machine::{Machine, Outcome};
use albacore_session::{Faults, Plan, Run, Running, load, load_faults};
use albacore_trace::journal::{Closing, Ending, Journal, Record};
use albacore_vehicle::Sample;
use std::io;
use std::path::Path;
use std::sync::{Arc, Mutex};

/// Bytes a tick, so that a day at ten ticks a second stays below 500 MB.
const BYTES_A_TICK: usize = 578;

fn plan(mission: &str) -> Plan {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../missions").join(mission).with_extension("alb");
    let script = load(&path, None, &[]).unwrap();
    Plan::new(&script, &path.display().to_string(), None, None).unwrap()
}

/// A sink whose bytes can be looked at, and which fails from one of its writes on.
#[derive(Clone, Default)]
struct Sink {
    bytes: Arc<Mutex<Vec<u8>>>,
    writes_left: Option<usize>,
}

impl io::Write for Sink {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let mut taken = self.bytes.lock().unwrap();
        let fits = match &mut self.writes_left {
            Some(0) => return Err(io::ErrorKind::StorageFull.into()),
            // A disk that gets full takes a part of the last write, and then nothing.
            Some(left) => {
                *left -= 1;
                if *left == 0 { bytes.len() / 2 } else { bytes.len() }
            }
            None => bytes.len(),
        };
        taken.extend(&bytes[..fits]);
        Ok(fits)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

fn read(sink: &Sink) -> Journal {
    Journal::read(&sink.bytes.lock().unwrap()).unwrap()
}

#[track_caller]
fn closing(journal: &Journal) -> Closing {
    match &journal.ending {
        Ending::Complete(closing) => closing.clone(),
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
    let closing = closing(&journal);
    assert_eq!((closing.outcome, closing.ticks), (Outcome::Completed, journal.records.len() as u64));
    assert_eq!(format!("{:016x}", closing.digest), summary.digest);

    let mut machine = Machine::new(Arc::clone(&plan.program), &journal.header.channels).unwrap();
    for record in &journal.records {
        assert_eq!(machine.step(&record.snapshot), record.command, "tick {}", record.tick);
        assert_eq!(machine.events(), record.events, "tick {}", record.tick);
    }
    assert_eq!(machine.outcome(), Some(Outcome::Completed));

    let per_tick = sink.bytes.lock().unwrap().len() / journal.records.len();
    println!("{per_tick} bytes a tick");
    assert!(per_tick < BYTES_A_TICK, "{per_tick} bytes a tick");
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
    let withheld = |record: &Record| record.snapshot.samples.iter().any(Sample::is_withheld);
    let ticks: Vec<u64> = journal.records.iter().filter(|r| withheld(r)).map(|r| r.tick).collect();
    assert_eq!(ticks, [600]);
    let mut machine = Machine::new(Arc::clone(&plan.program), &journal.header.channels).unwrap();
    for record in &journal.records {
        assert_eq!(machine.step(&record.snapshot), record.command, "tick {}", record.tick);
        assert_eq!(machine.events(), record.events, "tick {}", record.tick);
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
    let closing = closing(&journal);
    assert_eq!((closing.outcome, closing.reason.as_str(), closing.ticks), (Outcome::Interrupted, "interrupted", 100));
    assert_eq!(journal.records.len(), 100);
    assert!(!closing.events.is_empty());
}

#[test]
fn the_same_run_leaves_the_same_journal() {
    let plan = plan("box");
    let bytes = || {
        let sink = Sink::default();
        let mut run = Run::new(&plan, 3).unwrap();
        run.with_journal(Box::new(sink.clone()), &[]);
        run.to_end();
        sink.bytes.lock().unwrap().clone()
    };
    assert_eq!(bytes(), bytes());
}

#[test]
fn a_disk_that_fills_at_any_write_leaves_the_run_alone() {
    const TICKS: u64 = 205;
    let plan = plan("box");
    let digest = |writes_left: Option<usize>| {
        let sink = Sink { writes_left, ..Sink::default() };
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
        match Journal::read(&sink.bytes.lock().unwrap()) {
            Err(_) => assert_eq!(k, 1),
            Ok(journal) => {
                assert_eq!(journal.records.len(), k - 2, "disk full at write {k}");
                assert!(matches!(journal.ending, Ending::CutShort(_)), "disk full at write {k}");
            }
        }
    }
}
