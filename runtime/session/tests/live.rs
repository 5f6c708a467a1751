//! A run in real time: no writer holds the driver, what is left out is told, and nothing else differs from a run that is stepped.

#![expect(clippy::unwrap_used, reason = "a test that cannot set up its own run has failed")]

use albacore_machine::Machine;
use albacore_session::{
    LiveOptions, LiveRun, LiveUpdate, Outcome, PICTURE, Plan, RECORDED, Run, Sink, Source, WAITING_BYTES, load_text,
};
use albacore_sim::Simulator;
use albacore_trace::journal::{Ending, Journal};
use albacore_vehicle::{Command, Measurement, Snapshot, Vehicle, VehicleError};
use std::io;
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex};

fn plan() -> Plan {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../missions/box.alb");
    let text = std::fs::read_to_string(path).unwrap().replacen(
        "    limits {",
        "    record depth, heading at 2 Hz\n    limits {",
        1,
    );
    let script = load_text(Source { name: "box.alb".into(), text: text.into() });
    Plan::new(&script, "box.alb", None, None).unwrap()
}

/// What the test and the vehicle both hold.
#[derive(Default)]
struct Dock {
    /// Ticks that may go by.
    allowed: AtomicU64,
    commands: AtomicU64,
    released: AtomicBool,
    /// The command in which the vehicle's driver panics; none at 0.
    panics_at: u64,
    /// It says as it is released that it lies on the bottom.
    grounds: bool,
}

/// A simulated vehicle whose time is the test's.
struct Paced {
    vehicle: Simulator,
    dock: Arc<Dock>,
    ticks: u64,
}

impl Vehicle for Paced {
    fn measurements(&self) -> &[Measurement] {
        self.vehicle.measurements()
    }

    fn ready(&mut self) -> Result<bool, VehicleError> {
        if self.ticks < self.dock.allowed.load(Ordering::SeqCst) {
            return Ok(true);
        }
        std::thread::yield_now();
        Ok(false)
    }

    fn sense(&mut self, snapshot: &mut Snapshot) -> Result<(), VehicleError> {
        self.ticks += 1;
        self.vehicle.sense(snapshot)
    }

    fn take_over(&mut self) -> Result<(), VehicleError> {
        self.vehicle.take_over()
    }

    fn command(&mut self, command: &Command) -> Result<(), VehicleError> {
        let count = self.dock.commands.fetch_add(1, Ordering::SeqCst) + 1;
        assert_ne!(count, self.dock.panics_at, "out of water");
        self.vehicle.command(command)
    }

    fn give_back(&mut self) -> Result<(), VehicleError> {
        self.vehicle.give_back()
    }

    fn release(&mut self) -> Result<(), VehicleError> {
        self.dock.released.store(true, Ordering::SeqCst);
        self.vehicle.release()
    }

    fn is_aground(&self) -> bool {
        self.dock.grounds && self.dock.released.load(Ordering::SeqCst)
    }

    fn notices(&mut self) -> Vec<String> {
        self.vehicle.notices()
    }
}

fn run(plan: &Plan, dock: &Arc<Dock>) -> Run {
    let vehicle = Simulator::new(&plan.scenario, 1).unwrap();
    Run::on_link(plan, 1, Box::new(Paced { vehicle, dock: Arc::clone(dock), ticks: 0 })).unwrap()
}

/// A disk that takes nothing while it is stalled.
#[derive(Clone, Default)]
struct Disk(Arc<Platter>);

#[derive(Default)]
struct Platter {
    bytes: Mutex<Vec<u8>>,
    stalled: Mutex<bool>,
    turns: Condvar,
}

impl Disk {
    fn stall(&self, stalled: bool) {
        *self.0.stalled.lock().unwrap() = stalled;
        self.0.turns.notify_all();
    }

    fn bytes(&self) -> Vec<u8> {
        self.0.bytes.lock().unwrap().clone()
    }
}

impl io::Write for Disk {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let stalled = self.0.stalled.lock().unwrap();
        let _turning = self.0.turns.wait_while(stalled, |stalled| *stalled).unwrap();
        self.0.bytes.lock().unwrap().extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

fn live(run: Run, disk: &Disk, waiting_bytes: usize, report: &mut dyn FnMut(LiveUpdate<'_>, &AtomicBool)) -> LiveRun {
    let interrupted = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&interrupted);
    let journal: Sink = Box::new(disk.clone());
    let mut report = |told: LiveUpdate<'_>| report(told, &flag);
    run.live(LiveOptions { journal: Some((journal, Vec::new())), interrupted, report: &mut report, waiting_bytes })
        .unwrap()
}

const FREE: u64 = u64::MAX;

/// A link is slow: that the vehicle lay on the bottom is heard when the mission has ended.
#[test]
fn what_is_heard_of_the_bottom_on_the_way_out_counts() {
    let plan = plan();
    let ended = |grounds| {
        let dock = Dock { allowed: AtomicU64::new(FREE), grounds, ..Dock::default() };
        let mut run = run(&plan, &Arc::new(dock));
        let outcome = run.to_end();
        (outcome, run.outcome())
    };
    assert_eq!(ended(false), (Outcome::Completed, Some(Outcome::Completed)));
    assert_eq!(ended(true), (Outcome::Aground, Some(Outcome::Aground)));
}

#[test]
fn a_live_run_leaves_the_same_bytes_as_one_that_is_stepped() {
    let plan = plan();
    let dock = || Arc::new(Dock { allowed: AtomicU64::new(FREE), ..Dock::default() });
    let stepped = Disk::default();
    let mut by_step = run(&plan, &dock());
    by_step.with_journal(Box::new(stepped.clone()), &[]);
    let outcome = by_step.to_end();
    let disk = Disk::default();
    let lived = live(run(&plan, &dock()), &disk, WAITING_BYTES, &mut |_, _| {});
    assert_eq!((lived.outcome, lived.journal_stalled), (outcome, false));
    assert!(disk.bytes() == stepped.bytes(), "the journals differ");
    assert_eq!(lived.run.trace().to_string(), by_step.trace().to_string());
    assert_eq!(lived.run.summary(0.0), by_step.summary(0.0));
    assert_eq!(lived.run.file(&PICTURE), by_step.file(&PICTURE));
    assert_eq!(lived.run.file(&RECORDED), by_step.file(&RECORDED));
    assert!(lived.run.summary(0.0).recorded_rows.is_some_and(|rows| rows > 100));
}

#[test]
fn a_stalled_disk_holds_no_command_and_leaves_a_gap_with_a_checkpoint() {
    const STALLED: u64 = 1000;
    const ENDS: u64 = 1200;
    const AT_ONCE: u64 = 20;
    let plan = plan();
    let dock = Arc::new(Dock { allowed: AtomicU64::new(STALLED), ..Dock::default() });
    let disk = Disk::default();
    disk.stall(true);
    let (mut stalled, mut waited) = (true, 0);
    let lived = live(run(&plan, &dock), &disk, 50_000, &mut |told, interrupted| match told {
        // All that could be commanded was, with nothing written.
        LiveUpdate::Nothing if stalled && dock.commands.load(Ordering::SeqCst) + 50 >= STALLED => {
            assert!(disk.bytes().is_empty());
            stalled = false;
            disk.stall(false);
        }
        // Some ticks more whenever the last are written; those of the gap never are.
        LiveUpdate::Nothing if !stalled => {
            let journal = Journal::read(&disk.bytes());
            let written = journal.map_or(0, |journal| journal.ticks.last().map_or(0, |record| record.tick + 1));
            let allowed = dock.allowed.load(Ordering::SeqCst);
            waited = if written == allowed { 0 } else { waited + 1 };
            interrupted.store(written >= ENDS, Ordering::SeqCst);
            if written == allowed || waited >= 20 {
                waited = 0;
                dock.allowed.store(allowed + AT_ONCE, Ordering::SeqCst);
            }
        }
        LiveUpdate::JournalFailed(error) => panic!("{error}"),
        LiveUpdate::Notice(_) | LiveUpdate::Progress(..) | LiveUpdate::Nothing => {}
    });
    assert_eq!((lived.outcome, lived.journal_stalled), (Outcome::Interrupted, false));
    assert!(dock.released.load(Ordering::SeqCst));
    let journal = Journal::read(&disk.bytes()).unwrap();
    let Ending::Complete(end) = &journal.ending else { panic!("{:?}", journal.ending) };
    assert_eq!(format!("{:016x}", end.ending().unwrap().digest), lived.run.summary(0.0).digest, "of all ticks");
    let [gap, ..] = journal.gaps.as_slice() else { panic!("there is no gap") };
    assert!(gap.first > 10 && gap.last >= STALLED, "{} to {}", gap.first, gap.last);
    let missing: u64 = journal.gaps.iter().map(|gap| gap.last - gap.first + 1).sum();
    assert_eq!(journal.ticks.len() as u64 + missing, end.tick);

    // A replay goes on from the checkpoint.
    let mut machine = Machine::new(Arc::clone(&plan.program), &journal.header.measurements).unwrap();
    machine.restore((*gap.state).clone());
    let until = journal.gaps.get(1).map_or(u64::MAX, |next| next.first);
    let after: Vec<_> = journal.ticks.iter().filter(|r| r.tick > gap.last && r.tick < until).collect();
    assert!(!after.is_empty());
    for record in after {
        assert_eq!(machine.step(&record.snapshot), record.command, "tick {}", record.tick);
        assert_eq!(machine.events(), record.events, "tick {}", record.tick);
    }
}

#[test]
fn a_disk_that_stays_stalled_does_not_hold_the_end() {
    let dock = Arc::new(Dock { allowed: AtomicU64::new(FREE), ..Dock::default() });
    let disk = Disk::default();
    disk.stall(true);
    let lived = live(run(&plan(), &dock), &disk, WAITING_BYTES, &mut |_, _| {});
    assert_eq!((lived.outcome, lived.journal_stalled), (Outcome::Completed, true));
    assert!(dock.released.load(Ordering::SeqCst));
    disk.stall(false);
}

#[test]
fn a_panic_gives_the_vehicle_back() {
    let dock = Arc::new(Dock { allowed: AtomicU64::new(FREE), panics_at: 100, ..Dock::default() });
    let disk = Disk::default();
    let lived = live(run(&plan(), &dock), &disk, WAITING_BYTES, &mut |_, _| {});
    assert_eq!(lived.outcome, Outcome::Failed);
    assert!(dock.released.load(Ordering::SeqCst));
    assert!(lived.run.summary(0.0).reason.contains("panicked"));
    let journal = Journal::read(&disk.bytes()).unwrap();
    assert!(matches!(journal.ending, Ending::Complete(_)), "{:?}", journal.ending);
}
