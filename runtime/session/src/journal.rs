//! The journal of a run under way: kept as long as it can be written, and given up without harm to the run.

use albacore_machine::Event;
use albacore_trace::journal::{Closing, JournalHeader, Writer};
use albacore_vehicle::{Command, Snapshot};
use std::io;

/// Where a journal's bytes go.
pub(crate) type Sink = Box<dyn io::Write + Send>;

/// A journal, or what became of it.
#[derive(Default)]
pub(crate) struct Keeper {
    writer: Option<Writer<Sink>>,
    failure: Option<io::Error>,
}

impl Keeper {
    pub(crate) fn begin(&mut self, sink: Sink, header: &JournalHeader) {
        match Writer::new(sink, header) {
            Ok(writer) => self.writer = Some(writer),
            Err(error) => self.failure = Some(error),
        }
    }

    pub(crate) fn tick(&mut self, tick: u64, snapshot: &Snapshot, command: Option<&Command>, events: &[Event]) {
        self.write(|writer| writer.tick(tick, snapshot, command, events));
    }

    pub(crate) fn close(&mut self, closing: impl FnOnce() -> Closing) {
        self.write(|writer| writer.close(&closing()));
        // Nothing follows the end.
        self.writer = None;
    }

    /// What went wrong, told once.
    pub(crate) fn failure(&mut self) -> Option<io::Error> {
        self.failure.take()
    }

    fn write(&mut self, record: impl FnOnce(&mut Writer<Sink>) -> io::Result<()>) {
        if let Some(writer) = &mut self.writer
            && let Err(error) = record(writer)
        {
            // What was written last may be half a record: nothing that follows it could be read.
            self.writer = None;
            self.failure = Some(error);
        }
    }
}
