//! Reading a journal, as far as it is whole.

use super::{Ending, Entry, Flaw, Gap, JOURNAL_VERSION, JournalHeader, MAGIC, Payload, Unreadable, WORD, sealed};
use crate::record::Step;

/// Gives the steps of a journal and what is missing between them one by one, and then how it ends.
pub struct Reader<'a> {
    bytes: &'a [u8],
    header: JournalHeader,
    /// The first byte that belongs to no record read so far.
    at: usize,
    /// The tick that comes next.
    tick: u64,
    /// How the journal ends, once that is known.
    ending: Option<Ending>,
}

/// Whether bytes begin as a journal does, as far as they go.
pub fn is_beginning(bytes: &[u8]) -> bool {
    bytes.iter().zip(MAGIC).all(|(byte, known)| *byte == known)
}

/// What stands at a place instead of a record.
enum Fault {
    Short(String),
    Wrong(String),
}

impl<'a> Reader<'a> {
    /// Reads how a journal begins.
    pub fn new(bytes: &'a [u8]) -> Result<Self, Unreadable> {
        let flaw = |at: usize, expected: &str| Flaw { at, expected: expected.to_string() };
        if !is_beginning(bytes) {
            return Err(Unreadable::Damaged(flaw(0, "the beginning of a journal")));
        }
        let Some(version) = word(bytes, MAGIC.len()) else {
            return Err(Unreadable::CutShort(flaw(0, "the beginning of a journal")));
        };
        if version != JOURNAL_VERSION {
            return Err(Unreadable::Version(version));
        }
        let start = MAGIC.len() + WORD;
        match record(bytes, start) {
            Ok((Payload::Header(header), at)) => Ok(Reader { bytes, header: *header, at, tick: 0, ending: None }),
            Ok(_) => Err(Unreadable::Damaged(flaw(start, "what is run"))),
            Err(Fault::Short(expected)) => Err(Unreadable::CutShort(flaw(start, &expected))),
            Err(Fault::Wrong(expected)) => Err(Unreadable::Damaged(flaw(start, &expected))),
        }
    }

    /// What was run.
    pub fn header(&self) -> &JournalHeader {
        &self.header
    }

    /// How the journal ends; reads on to there.
    pub fn into_ending(mut self) -> Ending {
        loop {
            if let Some(ending) = self.ending {
                return ending;
            }
            self.next();
        }
    }

    /// Reads the record that comes next, unless there is none: then the journal ends, one way or the other.
    fn advance(&mut self) -> Result<Entry, Ending> {
        let flaw = |expected: String| Flaw { at: self.at, expected };
        let next = format!("the record of tick {}", self.tick);
        match record(self.bytes, self.at) {
            Ok((Payload::Step(record), at)) if record.ending().is_some() => {
                // A copy of the file's end behind itself, or of another file's, is made of records that are each whole.
                if at < self.bytes.len() {
                    let expected = "nothing more, behind the end of the run".into();
                    return Err(Ending::Damaged(Flaw { at, expected }));
                }
                self.at = at;
                self.ending = Some(Ending::Complete(record.clone()));
                Ok(Entry::Step(record))
            }
            Ok((Payload::Step(record), at)) if record.tick == self.tick => {
                self.at = at;
                self.tick = self.tick.saturating_add(u64::from(matches!(record.step, Step::Tick)));
                Ok(Entry::Step(record))
            }
            Ok((Payload::Gap(gap), at)) if gap.first == self.tick && gap.last >= gap.first && follows(&gap) => {
                self.at = at;
                self.tick = gap.state.tick;
                Ok(Entry::Gap(gap))
            }
            Ok(_) => Err(Ending::Damaged(flaw(next))),
            Err(Fault::Short(expected)) => Err(Ending::CutShort(flaw(format!("{next}, {expected}")))),
            Err(Fault::Wrong(expected)) => Err(Ending::Damaged(flaw(format!("{next}, {expected}")))),
        }
    }
}

impl Iterator for Reader<'_> {
    type Item = Entry;

    fn next(&mut self) -> Option<Entry> {
        if self.ending.is_some() {
            return None;
        }
        match self.advance() {
            Ok(entry) => Some(entry),
            Err(ending) => {
                self.ending = Some(ending);
                None
            }
        }
    }
}

/// Whether a gap's checkpoint is of the tick after it.
fn follows(gap: &Gap) -> bool {
    gap.last.checked_add(1) == Some(gap.state.tick)
}

/// The record at a place, and the place behind it.
fn record(bytes: &[u8], at: usize) -> Result<(Payload, usize), Fault> {
    let rest = bytes.get(at..).unwrap_or_default();
    let Some(head) = rest.get(..WORD) else {
        return Err(Fault::Short("its length".into()));
    };
    let length = usize::from(head[0]) | usize::from(head[1]) << 8 | usize::from(head[2]) << 16;
    if head != sealed(length) {
        return Err(Fault::Wrong("a length that agrees with its check".into()));
    }
    let covered = WORD + length;
    let Some(check) = word(rest, covered) else {
        let missing = covered + WORD - rest.len();
        return Err(Fault::Short(format!("{missing} bytes longer")));
    };
    if crc32fast::hash(&rest[..covered]) != check {
        return Err(Fault::Wrong("bytes that agree with their check".into()));
    }
    match postcard::take_from_bytes(&rest[WORD..covered]) {
        Ok((entry, [])) => Ok((entry, at + covered + WORD)),
        _ => Err(Fault::Wrong("something that this version knows".into())),
    }
}

/// Four bytes, least first.
fn word(bytes: &[u8], at: usize) -> Option<u32> {
    let four = bytes.get(at..at.checked_add(WORD)?)?;
    Some(u32::from_le_bytes(four.try_into().ok()?))
}
