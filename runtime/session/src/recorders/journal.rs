//! The journal of a run under way: kept as long as it can be written, and given up without harm to the run.

use super::Recorder;
use albacore_trace::journal::{self, Gap, JournalHeader, Reader, Unreadable, Writer, is_beginning};
use albacore_trace::{Step, TickRecord};
use std::io::{self, Read};

/// Where a journal's bytes go.
pub type Sink = Box<dyn io::Write + Send>;

/// Whether a file is a journal: one that has just been created is empty.
pub fn is_journal(file: impl Read) -> io::Result<bool> {
    let mut bytes = Vec::new();
    file.take(16).read_to_end(&mut bytes)?;
    Ok(is_beginning(&bytes))
}

/// Whether bytes are one as a run leaves it, whole or cut short: nobody else has written into it. One of another version is taken for that.
pub fn is_journal_as_left(bytes: &[u8]) -> bool {
    bytes.is_empty()
        || match Reader::new(bytes) {
            Ok(reader) => !matches!(reader.into_ending(), journal::Ending::Damaged(_)),
            Err(unreadable) => !matches!(unreadable, Unreadable::Damaged(_)),
        }
}

/// A journal, or what became of it.
#[derive(Default)]
pub(crate) struct Journal {
    writer: Option<Writer<Sink>>,
    failure: Option<io::Error>,
}

impl Journal {
    pub(crate) fn begin(&mut self, sink: Sink, header: &JournalHeader) {
        match Writer::new(sink, header) {
            Ok(writer) => self.writer = Some(writer),
            Err(error) => self.failure = Some(error),
        }
    }

    /// Takes down what is missing.
    pub(crate) fn gap(&mut self, gap: &Gap) {
        self.write(|writer| writer.gap(gap));
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

impl Recorder for Journal {
    fn take(&mut self, record: &TickRecord) {
        if matches!(record.step, Step::Wait) && record.notices.is_empty() {
            return;
        }
        self.write(|writer| writer.step(record));
        if record.ending().is_some() {
            // Nothing follows the end.
            self.writer = None;
        }
    }
}
