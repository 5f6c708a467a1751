//! The journal: every step's inputs, command, events, notices and truth, in a file that stays readable wherever the writing of it stops.
//!
//! A journal is eight bytes (`ALBJ` and the version of this form), then records one after the other: the first tells what
//! is run, one follows for each step ([`TickRecord`]), the last of which tells how it ended. A run in real time does not wait for a disk: where ticks were
//! not written, a record tells which, with the state of the machine after them, from which a replay can go on. A record is
//!
//! ```text
//! length of the payload   3 bytes, least first, and a fourth that is wrong whenever one of the three is
//! payload                 the record in postcard's form
//! CRC-32                  4 bytes, least first, of length and payload
//! ```
//!
//! The length has a check of its own, because a wrong one would pass for a journal that was cut short.

mod read;
pub(crate) mod snapshot;
mod write;

pub use read::{Reader, is_beginning};
pub use write::Writer;

use crate::record::{Step, TickRecord};
use albacore_geometry::Point;
use albacore_machine::State;
use albacore_vehicle::Measurement;
use serde::{Deserialize, Serialize};

/// The version of this form: one more whenever a record, or what a record holds (such as a snapshot, an event or [`State`]),
/// is laid out otherwise. Postcard's form names no fields, and would read the older as something else.
pub const JOURNAL_VERSION: u32 = 7;

/// How every journal begins.
const MAGIC: [u8; 4] = *b"ALBJ";
/// Bytes of a length, and of a check.
const WORD: usize = 4;
/// The longest payload, in bytes: what three bytes can count.
const PAYLOAD_MAX: usize = 0xff_ffff;
/// The check of a length of zero, so that a file of zeros, which some disks leave behind, is no row of empty records.
const LENGTH_SEAL: u8 = 0xa5;

/// What is run: all that a replay needs beside the scripts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JournalHeader {
    /// The version of the lowered program's form.
    pub program_version: u32,
    /// The mission.
    pub mission: String,
    /// The world's name.
    pub scenario: String,
    /// The seed of all that is random.
    pub seed: u64,
    /// One tick, in seconds.
    pub tick_s: f64,
    /// Every source that was read, the script's own file first.
    pub sources: Vec<SourceDigest>,
    /// The parameters changed for this run, as `NAME=VALUE`.
    pub set: Vec<String>,
    /// What the vehicle measures: a sample's measurement is an index into it.
    pub measurements: Vec<Measurement>,
    /// Where the vehicle starts, where that is known.
    pub start: Option<Point>,
    /// The texts of the scripts, so that what was run is known when the files have changed: the mission's and its project's, of which
    /// the first is the script itself. The standard library is in every albacore, and files of data are where they were.
    pub scripts: Vec<KeptScript>,
    /// What it ran in.
    pub world: World,
}

/// A script as it was.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct KeptScript {
    /// What it is called in messages.
    pub name: String,
    /// Its path from the project's folder without its ending, as `use` gives it: `worlds/bay`.
    pub module: String,
    /// Its text.
    pub text: String,
}

/// What a mission ran in.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum World {
    /// A scenario.
    Scenario {
        /// What the script calls it in which it stands: `sparse`, or `worlds.sparse` of a module.
        called: String,
        /// That script and what it imports, where it is another than the mission's.
        scripts: Vec<KeptScript>,
    },
    /// A vehicle at the end of a link.
    Link,
}

/// A source file by its name and the digest of its text, so that a replay can say which of them has changed since.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SourceDigest {
    /// What it is called in messages.
    pub name: String,
    /// The digest of its text.
    pub digest: u64,
}

/// Ticks that were not written: the disk did not take them in time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Gap {
    /// The first tick that is missing.
    pub first: u64,
    /// The last one.
    pub last: u64,
    /// The machine's state after it: a checkpoint.
    pub state: Box<State>,
}

/// What a journal is made of behind its beginning.
#[derive(Clone, Debug, PartialEq)]
pub enum Entry {
    /// A step of the run; the last is its end.
    Step(Box<TickRecord>),
    /// Ticks that were not written.
    Gap(Gap),
}

/// A journal that has been read: as much of it as is whole.
#[derive(Clone, Debug, PartialEq)]
pub struct Journal {
    /// What was run.
    pub header: JournalHeader,
    /// Its ticks, in order.
    pub ticks: Vec<TickRecord>,
    /// What is missing between them, in order: mostly nothing.
    pub gaps: Vec<Gap>,
    /// How the journal ends.
    pub ending: Ending,
}

/// How a journal ends.
#[derive(Clone, Debug, PartialEq)]
pub enum Ending {
    /// With the end of the run.
    Complete(Box<TickRecord>),
    /// In the middle: the writing stopped.
    CutShort(Flaw),
    /// With something that was never written so.
    Damaged(Flaw),
}

/// Where a journal is not as it should be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Flaw {
    /// The first byte that belongs to no whole record: all before it is good.
    pub at: usize,
    /// What should stand there.
    pub expected: String,
}

/// What begins too badly to be read as a journal at all.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unreadable {
    /// It ends before it has told what is run.
    CutShort(Flaw),
    /// Its beginning is damaged, or it never was a journal.
    Damaged(Flaw),
    /// It has the form of another version.
    Version(u32),
}

impl Journal {
    /// Reads a whole journal, but for what was only noticed between ticks. One that fits memory badly is better read step by step, with
    /// [`Reader`].
    pub fn read(bytes: &[u8]) -> Result<Self, Unreadable> {
        let mut reader = Reader::new(bytes)?;
        let (mut ticks, mut gaps) = (Vec::new(), Vec::new());
        for entry in reader.by_ref() {
            match entry {
                Entry::Step(record) if matches!(record.step, Step::Tick) => ticks.push(*record),
                Entry::Step(_) => {}
                Entry::Gap(gap) => gaps.push(gap),
            }
        }
        let header = reader.header().clone();
        Ok(Journal { header, ticks, gaps, ending: reader.into_ending() })
    }
}

impl std::fmt::Display for Flaw {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "at byte {}: expected {}", self.at, self.expected)
    }
}

impl std::fmt::Display for Unreadable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Unreadable::CutShort(flaw) => write!(f, "the journal is cut short {flaw}"),
            Unreadable::Damaged(flaw) => write!(f, "this is no journal, or a damaged one: {flaw}"),
            Unreadable::Version(version) => {
                write!(
                    f,
                    "the journal has the form of version {version}, and this albacore reads version {JOURNAL_VERSION} alone: \
                     read it with the albacore that wrote it"
                )
            }
        }
    }
}

impl std::error::Error for Unreadable {}

/// A payload as it is read.
#[derive(Deserialize)]
enum Payload {
    Header(Box<JournalHeader>),
    Step(Box<TickRecord>),
    Gap(Gap),
}

/// A payload as it is written: the same form, from borrowed parts.
#[derive(Serialize)]
enum Written<'a> {
    Header(&'a JournalHeader),
    Step(&'a TickRecord),
    Gap(&'a Gap),
}

/// The four bytes of a length.
fn sealed(length: usize) -> [u8; WORD] {
    let [a, b, c, ..] = (length as u32).to_le_bytes();
    [a, b, c, a ^ b ^ c ^ LENGTH_SEAL]
}
