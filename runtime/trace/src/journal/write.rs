//! Writing a journal: one write call a record.

use super::{Gap, JOURNAL_VERSION, JournalHeader, MAGIC, PAYLOAD_MAX, WORD, Written, sealed};
use crate::record::TickRecord;
use std::io;

/// Appends records to a sink, which should not hold bytes back where nobody can have the run again: what it has taken is to survive the program's end.
pub struct Writer<W> {
    sink: W,
    /// The bytes of the record being made, kept so that a tick allocates nothing.
    bytes: Vec<u8>,
}

impl<W: io::Write> Writer<W> {
    /// Begins a journal.
    pub fn new(sink: W, header: &JournalHeader) -> io::Result<Self> {
        let mut writer = Writer { sink, bytes: Vec::new() };
        writer.bytes.extend(MAGIC);
        writer.bytes.extend(JOURNAL_VERSION.to_le_bytes());
        writer.append(&Written::Header(header))?;
        Ok(writer)
    }

    /// Takes down a step. With the last one the sink hands on all that it has.
    pub fn step(&mut self, record: &TickRecord) -> io::Result<()> {
        self.append(&Written::Step(record))?;
        if record.ending().is_some() { self.sink.flush() } else { Ok(()) }
    }

    /// Takes down what is missing.
    pub fn gap(&mut self, gap: &Gap) -> io::Result<()> {
        self.append(&Written::Gap(gap))
    }

    /// Writes a record behind the bytes that already wait for it.
    fn append(&mut self, entry: &Written<'_>) -> io::Result<()> {
        let start = self.bytes.len();
        self.bytes.extend([0; WORD]);
        self.bytes = postcard::to_extend(entry, std::mem::take(&mut self.bytes)).map_err(io::Error::other)?;
        let length = self.bytes.len() - start - WORD;
        if length > PAYLOAD_MAX {
            return Err(io::Error::other("the record of one tick is larger than 16 MiB"));
        }
        self.bytes[start..start + WORD].copy_from_slice(&sealed(length));
        let check = crc32fast::hash(&self.bytes[start..]);
        self.bytes.extend(check.to_le_bytes());
        let written = self.sink.write_all(&self.bytes);
        self.bytes.clear();
        written
    }
}
