//! Checksums of a table's lines, in a file beside it: what was changed on the disk since it was written is noticed, and where.
//!
//! Each line of the table, the first too, has a record of 17 bytes: the digest of its bytes, as 16 hexadecimal digits, and
//! a line end. It is written after the line, so that a line without one was not finished.

use super::growing::Growing;
use super::origin::{Unread, beside, read_beside};
use super::seeds::RUNS_MAX;
use super::table::Trouble;
use crate::disk;
use albacore_trace::Digest;
use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::{Path, PathBuf};

/// Bytes of a record.
const RECORD: usize = 17;
/// A record for each run that a campaign can have, and for the first line.
const BYTES_MAX: u64 = RECORD as u64 * (RUNS_MAX + 2);

/// Where a table's checksums go.
pub struct Sums(Growing);

impl Sums {
    /// Begins with these lines.
    pub fn begin<'a>(table: &Path, lines: impl Iterator<Item = &'a [u8]>) -> io::Result<Self> {
        let text: String = lines.map(record).collect();
        let path = path(table);
        let file = disk::replace(&path, text.as_bytes())?;
        Ok(Sums(Growing::new(file, path, text.as_bytes())))
    }

    /// Adds a line.
    pub fn add(&mut self, line: &[u8]) -> Result<(), Trouble> {
        self.0.add(record(line).as_bytes())
    }

    /// An error if they are not as they were written.
    pub fn is_whole(&mut self) -> Result<(), Trouble> {
        self.0.text().map(drop)
    }
}

/// What the disk kept of a table.
#[derive(Debug, PartialEq, Eq)]
pub struct Kept<'a> {
    /// Its lines as they were written, the first too; `None` where one is otherwise now. The last is never `None`.
    pub lines: Vec<Option<&'a [u8]>>,
    /// The numbers, from 1, of lines that were written and are otherwise now, and of those that nobody wrote.
    pub changed: Vec<usize>,
    /// What stands behind as many lines as have records: the beginning of a line whose record was not written yet, or another's.
    pub tail: &'a [u8],
    /// The number of the line that it begins.
    pub tail_line: usize,
}

/// Whether the file beside a table holds checksums, whatever they are of, or nothing: one that holds else is somebody's own.
pub fn are_sums(table: &Path) -> bool {
    let is_sum = |record: &[u8]| {
        let (sum, end) = record.split_at(record.len().min(RECORD - 1));
        sum.iter().all(u8::is_ascii_hexdigit) && matches!(end, b"" | b"\n")
    };
    match read_beside(table, ".sums", BYTES_MAX) {
        Ok(sums) => sums.chunks(RECORD).all(is_sum),
        Err(Unread::Missing) => true,
        Err(Unread::Wrong(_)) => false,
    }
}

/// Reads the checksums of a table, and holds its text against them.
pub fn kept<'a>(table: &Path, text: &'a [u8]) -> Result<Kept<'a>, Unread> {
    let sums = read_beside(table, ".sums", BYTES_MAX)?;
    Ok(held_against(text, &sums))
}

/// A line is found by its digest wherever it stands: a line end that was changed, or a line that was moved, takes no others
/// with it.
fn held_against<'a>(text: &'a [u8], sums: &[u8]) -> Kept<'a> {
    let pieces = text.split_inclusive(|b| *b == b'\n');
    let whole = pieces.clone().filter(|line| line.ends_with(b"\n"));
    let by_sum: BTreeMap<String, &[u8]> = whole.clone().map(|line| (record(line), line)).collect();
    let found = |sum: &[u8]| std::str::from_utf8(sum).ok().and_then(|sum| by_sum.get(sum).copied());
    let records = sums.chunks_exact(RECORD);
    let mut lines: Vec<Option<&[u8]>> = records.map(found).collect();
    // The first line is known without a record.
    let tail_line = lines.len().max(1) + 1;
    let written: BTreeSet<&[u8]> = sums.chunks_exact(RECORD).collect();
    let last_line = whole.clone().count();
    // Of one line more at the end its record may not have been written.
    let may_lack_it = |number: usize| number == tail_line && number == last_line;
    let is_foreign = |number, line: &[u8]| !written.contains(record(line).as_bytes()) && !may_lack_it(number);
    let gone = (1..).zip(&lines).filter(|(_, line)| line.is_none()).map(|(number, _)| number);
    let foreign = (1..).zip(whole).filter(|(number, line)| is_foreign(*number, line)).map(|(number, _)| number);
    let changed: BTreeSet<usize> = gone.chain(foreign).collect();
    let before: usize = pieces.take(tail_line - 1).map(<[u8]>::len).sum();
    while lines.last().is_some_and(Option::is_none) {
        lines.pop();
    }
    Kept { lines, changed: changed.into_iter().collect(), tail: &text[before..], tail_line }
}

fn record(line: &[u8]) -> String {
    let mut digest = Digest::new();
    digest.bytes(line);
    format!("{digest}\n")
}

fn path(table: &Path) -> PathBuf {
    beside(table, ".sums")
}

#[cfg(test)]
mod tests {
    use super::{held_against, record};

    const TABLE: &str = "seed,outcome\n1,completed\n2,aborted\n3,completed\n";

    fn sums() -> String {
        TABLE.split_inclusive('\n').map(|line| record(line.as_bytes())).collect()
    }

    /// What is left of a table of which something was changed is a part of what was written, and the change is told.
    #[track_caller]
    fn is_noticed(text: &[u8], sums: &[u8], what: &str) {
        let kept = held_against(text, sums);
        assert!(!kept.changed.is_empty(), "{what}: not noticed");
        for (line, written) in kept.lines.iter().zip(TABLE.split_inclusive('\n')) {
            assert!(line.is_none_or(|line| line == written.as_bytes()), "{what}: taken for what was written");
        }
    }

    #[test]
    fn a_record_has_its_length() {
        assert_eq!(sums().len(), 4 * super::RECORD);
    }

    #[test]
    fn what_is_as_it_was_is_kept() {
        let kept = held_against(TABLE.as_bytes(), sums().as_bytes());
        assert_eq!((kept.lines.len(), kept.changed.len()), (4, 0));
        // Killed between a line and its record.
        let kept = held_against(TABLE.as_bytes(), &sums().as_bytes()[..3 * super::RECORD + 5]);
        assert_eq!((kept.lines.len(), kept.changed.len()), (3, 0));
    }

    #[test]
    fn every_changed_bit_of_table_and_sums_is_noticed() {
        for bit in 0..8 * TABLE.len() {
            let mut text = TABLE.as_bytes().to_vec();
            text[bit / 8] ^= 1 << (bit % 8);
            is_noticed(&text, sums().as_bytes(), &format!("bit {bit} of the table"));
        }
        for bit in 0..8 * sums().len() {
            let mut changed = sums().into_bytes();
            changed[bit / 8] ^= 1 << (bit % 8);
            is_noticed(TABLE.as_bytes(), &changed, &format!("bit {bit} of the sums"));
        }
    }

    #[test]
    fn what_is_cut_off_added_or_taken_out_is_noticed() {
        for at in 0..TABLE.len() {
            is_noticed(&TABLE.as_bytes()[..at], sums().as_bytes(), &format!("cut at {at}"));
            is_noticed(TABLE.replacen(&TABLE[at..=at], "", 1).as_bytes(), sums().as_bytes(), &format!("without {at}"));
        }
        is_noticed(TABLE.as_bytes(), b"", "no sums");
    }
}
