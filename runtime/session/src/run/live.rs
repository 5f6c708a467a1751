//! A run in real time: the driver on a thread of its own, which waits for the vehicle and for nothing else.
//!
//! Records go to two writers, and to a page if one is looked at, through queues that have bounds. The thread that calls folds those that are kept in memory;
//! another writes the journal, and may be held by its disk as long as that likes. What a queue does not take is left out and
//! counted: in the journal a gap is a record of its own, with a checkpoint.

use super::page::{Counted, Kept, is_empty_wait};
use super::queue::{Feed, Intake, queue};
use super::{Driver, Run, Running};
use crate::recorders::journal::{Journal, Sink};
use crate::recorders::status::Status;
use crate::recorders::{InMemory, Recorder};
use crate::threads::thread;
use albacore_machine::Outcome;
use albacore_trace::journal::{Gap, JournalHeader};
use albacore_trace::{Step, TickRecord};
use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::Duration;

/// The most that waits for a writer: some two hours of ticks.
pub const WAITING_BYTES: usize = 64 << 20;
/// How long one look for a record or for a writer's progress takes.
const LOOK: Duration = Duration::from_millis(50);
/// After so many looks in which it has got nothing done, a writer is left: 3 s.
const PATIENCE_LOOKS: u32 = 60;
/// Ticks between two looks of the person at the progress.
const PROGRESS_TICKS: u64 = 10;

/// What a run in real time is done with.
pub struct LiveOptions<'a> {
    /// Where the journal goes, and the texts of the parameters changed for this run.
    pub journal: Option<(Sink, Vec<String>)>,
    /// Raised when the run is to end.
    pub interrupted: Arc<AtomicBool>,
    /// Hears what a person should; it must not wait.
    pub report: &'a mut dyn FnMut(LiveUpdate<'_>),
    /// The most bytes of records that wait for a writer: mostly [`WAITING_BYTES`].
    pub waiting_bytes: usize,
}

/// What a person should hear of a run in real time.
pub enum LiveUpdate<'a> {
    /// Of the vehicle, or its link.
    Notice(&'a str),
    /// How the run stands, the active activities from outside in, and the statement that is under way.
    Progress(&'a Status, &'a [String]),
    /// The journal is given up.
    JournalFailed(io::Error),
    /// Now and then: there is nothing new.
    Nothing,
}

/// A run in real time that is over.
pub struct LiveRun {
    /// The run.
    pub run: Run,
    /// How it ended.
    pub outcome: Outcome,
    /// Whether the journal's end is not written: for 3 s its disk had got nothing done.
    pub journal_stalled: bool,
}

impl Run {
    /// Runs to the end in the vehicle's time, on threads of its own. An error tells of a thread that could not be begun:
    /// then nothing was sent.
    pub fn live(mut self, means: LiveOptions<'_>) -> io::Result<LiveRun> {
        let LiveOptions { journal, interrupted, report, waiting_bytes } = means;
        let (feed, records) = queue(waiting_bytes);
        let mut lines = Lines { memory: Kept::new(feed), page: self.page.take(), journal: None, gap: None };
        let mut journalist = None;
        if let Some((sink, set)) = journal {
            let (feed, waits) = queue(waiting_bytes);
            lines.journal = Some(feed);
            journalist = Some(Journalist::begin(waits, self.header(&set), sink)?);
        }
        let Run { driver, mut memory, journal, page, record } = self;
        let driving = thread("driver").spawn(move || drive(driver, &interrupted, lines))?;
        fold(&mut memory, &records, journalist.as_ref(), report);
        let driver = driving.join().map_err(|_| io::Error::other("the driver has panicked: report this"))?;
        let journal_stalled = journalist.is_some_and(|journalist| !journalist.ends(report));
        let outcome = memory.results.outcome().unwrap_or(Outcome::Failed);
        Ok(LiveRun { run: Run { driver, memory, journal, page, record }, outcome, journal_stalled })
    }
}

/// Steps to the end. A panic is a fault of the interpreter, and still no reason to leave a vehicle without its release.
fn drive(mut driver: Driver, interrupted: &AtomicBool, mut lines: Lines) -> Driver {
    loop {
        if interrupted.load(Ordering::Relaxed) {
            driver.interrupt("interrupted");
        }
        let ending = driver.is_ending();
        let mut record = TickRecord::default();
        match catch_unwind(AssertUnwindSafe(|| driver.step(&mut record))) {
            Ok(running) => {
                lines.hand_on(record, &driver);
                if running != Running::On {
                    return driver;
                }
            }
            Err(_) if ending => return driver,
            Err(_) => driver.fail("the interpreter has panicked: report this"),
        }
    }
}

/// The ways from the driver to the writers.
struct Lines {
    memory: Kept,
    page: Option<Kept>,
    journal: Option<Feed<Line>>,
    /// The first tick that is not in the journal, while there is no room.
    gap: Option<u64>,
}

/// What goes to the journal.
enum Line {
    Step(Arc<TickRecord>),
    Gap(Gap),
}

impl Lines {
    fn hand_on(&mut self, record: TickRecord, driver: &Driver) {
        if is_empty_wait(&record) {
            return;
        }
        let is_wait = matches!(record.step, Step::Wait);
        let (bytes, is_end, record) = (record.bytes(), record.ending().is_some(), Arc::new(record));
        self.memory.hand(bytes, &record);
        if let Some(page) = &mut self.page {
            page.hand(bytes, &record);
        }
        // What was noticed in a gap is a part of it.
        if !is_wait || self.gap.is_none() {
            self.write(bytes, is_end, record, driver);
        }
    }

    fn write(&mut self, bytes: usize, is_end: bool, record: Arc<TickRecord>, driver: &Driver) {
        let Some(journal) = &mut self.journal else { return };
        if !(journal.has_room(bytes) || is_end) {
            self.gap.get_or_insert(record.tick);
            return;
        }
        if let Some(first) = self.gap.take() {
            let state = Box::new(driver.machine().state().clone());
            let checkpoint = size_of_val(&*state) + size_of_val(state.words.as_slice());
            journal.put(checkpoint, Line::Gap(Gap { first, last: state.tick.saturating_sub(1), state }));
            // A tick that finds room again is the last of the gap: the checkpoint is of the state after it.
            if !is_end {
                return;
            }
        }
        journal.put(bytes, Line::Step(record));
    }
}

/// Takes in what is kept in memory, and tells what a person should hear.
fn fold(
    memory: &mut InMemory,
    records: &Intake<Counted>,
    journalist: Option<&Journalist>,
    report: &mut dyn FnMut(LiveUpdate<'_>),
) {
    loop {
        match records.take(LOOK) {
            Ok((unseen, record)) => {
                if unseen > 0 {
                    memory.miss(unseen, record.tick);
                }
                memory.take(&record);
                for notice in memory.notices.take_all() {
                    report(LiveUpdate::Notice(&notice));
                }
                if matches!(record.step, Step::Tick) && record.tick.is_multiple_of(PROGRESS_TICKS) {
                    report(LiveUpdate::Progress(&memory.status, &memory.trace.lines().under_way()));
                }
            }
            Err(RecvTimeoutError::Timeout) => report(LiveUpdate::Nothing),
            Err(RecvTimeoutError::Disconnected) => return,
        }
        if let Some(error) = journalist.and_then(|journalist| journalist.failures.try_recv().ok()) {
            report(LiveUpdate::JournalFailed(error));
        }
    }
}

/// The thread that writes the journal, as seen from another.
struct Journalist {
    /// How many bytes wait for it.
    level: Arc<AtomicUsize>,
    /// Closed at its end.
    failures: Receiver<io::Error>,
}

impl Journalist {
    fn begin(waits: Intake<Line>, header: JournalHeader, sink: Sink) -> io::Result<Self> {
        let (told, failures) = channel();
        let level = waits.level();
        thread("journal").spawn(move || write_all(&waits, &header, sink, &told))?;
        Ok(Journalist { level, failures })
    }

    /// Waits for its end, as long as it gets anything done; whether it came.
    fn ends(&self, report: &mut dyn FnMut(LiveUpdate<'_>)) -> bool {
        let (mut level, mut looks) = (usize::MAX, 0);
        while looks < PATIENCE_LOOKS {
            match self.failures.recv_timeout(LOOK) {
                Ok(error) => report(LiveUpdate::JournalFailed(error)),
                Err(RecvTimeoutError::Disconnected) => return true,
                Err(RecvTimeoutError::Timeout) => {
                    let now = self.level.load(Ordering::Relaxed);
                    looks = if now == level { looks + 1 } else { 0 };
                    level = now;
                }
            }
        }
        false
    }
}

/// Writes a journal to its end, or until it is given up.
fn write_all(waits: &Intake<Line>, header: &JournalHeader, sink: Sink, told: &Sender<io::Error>) {
    let mut journal = Journal::default();
    journal.begin(sink, header);
    loop {
        if let Some(error) = journal.failure() {
            // Nobody listens any more when the run is over.
            let _ = told.send(error);
        }
        match waits.take(LOOK) {
            Ok(Line::Step(record)) => journal.take(&record),
            Ok(Line::Gap(gap)) => journal.gap(&gap),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return,
        }
    }
}
