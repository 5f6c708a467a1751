//! The way from a driver to what keeps records in memory: a queue that has a bound, and what finds no room in it is counted. And the
//! thread that keeps the report of a run that goes on.

use super::live::WAITING_BYTES;
use super::queue::{Feed, Intake, queue};
use crate::report::live::LiveReport;
use crate::threads::thread;
use albacore_trace::{Step, TickRecord};
use std::io;
use std::sync::Arc;
use std::sync::mpsc::RecvTimeoutError;
use std::time::Duration;

/// How long one look for a record takes.
const LOOK: Duration = Duration::from_millis(200);

/// A record, and how many ticks before it found no room.
pub(super) type Counted = (u64, Arc<TickRecord>);

/// The end of the way at which records are handed on.
pub(super) struct Kept {
    feed: Feed<Counted>,
    /// Ticks since the last that found room.
    unseen: u64,
}

impl Kept {
    pub fn new(feed: Feed<Counted>) -> Self {
        Kept { feed, unseen: 0 }
    }

    /// Hands a record on, if there is room; the end finds room always.
    pub fn hand(&mut self, bytes: usize, record: &Arc<TickRecord>) {
        if record.ending().is_some() || self.feed.has_room(bytes) {
            self.feed.put(bytes, (std::mem::take(&mut self.unseen), Arc::clone(record)));
        } else {
            self.unseen += 1;
        }
    }

    /// The same with a record that its owner keeps.
    pub fn hand_copy(&mut self, record: &TickRecord) {
        if is_empty_wait(record) {
            return;
        }
        let bytes = record.bytes();
        if record.ending().is_some() || self.feed.has_room(bytes) {
            self.hand(bytes, &Arc::new(record.clone()));
        } else {
            self.unseen += 1;
        }
    }
}

/// Whether nothing happened in a step.
pub(super) fn is_empty_wait(record: &TickRecord) -> bool {
    matches!(record.step, Step::Wait) && record.notices.is_empty()
}

/// Begins the thread that keeps a report. It ends when nobody can hand on anything any more.
pub(super) fn begin(report: Arc<LiveReport>) -> io::Result<Kept> {
    let (feed, records) = queue(WAITING_BYTES);
    thread("report").spawn(move || keep(&report, &records))?;
    Ok(Kept::new(feed))
}

fn keep(report: &LiveReport, records: &Intake<Counted>) {
    loop {
        match records.take(LOOK) {
            Ok((unseen, record)) => report.take(unseen, &record),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return,
        }
    }
}
