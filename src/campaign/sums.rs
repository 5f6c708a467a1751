//! Checksums of a table's lines, in a file beside it: what was changed on the disk since it was written is noticed, and where.
//!
//! Each line of the table, the first too, has a record of 17 bytes: the digest of what the table was made from and of its bytes, as 16
//! hexadecimal digits, and a line end. It is written after the line, so that a line without one was not finished.

use super::digested_file::DigestedFile;
use super::provenance::{OriginKey, Unread, beside, read_beside};
use super::seeds::RUNS_MAX;
use super::table::TableError;
use crate::disk;
use albacore_trace::Digest;
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Bytes of a record.
const RECORD: usize = 17;
/// A record for each run that a campaign can have, and for the first line.
const BYTES_MAX: u64 = RECORD as u64 * (RUNS_MAX + 2);

/// Where a table's checksums go.
pub struct Sums {
    file: DigestedFile,
    key: OriginKey,
}

impl Sums {
    /// Those of a table that is begun.
    pub fn begin(table: &Path, key: OriginKey) -> Result<Self, TableError> {
        Sums::written(path(table), key, b"")
    }

    /// Goes on with what was found: where that is not of these lines it is written anew.
    pub fn go_on<'a>(
        table: &Path,
        key: OriginKey,
        found: &[u8],
        lines: impl Iterator<Item = &'a [u8]>,
    ) -> Result<Self, TableError> {
        let text: String = lines.map(|line| record(&key, line)).collect();
        let path = path(table);
        if text.as_bytes() != found {
            return Sums::written(path, key, text.as_bytes());
        }
        match disk::known_file(&path) {
            Ok((file, forbidden)) => Ok(Sums { file: DigestedFile::known(file, forbidden, path, found), key }),
            Err(error) => Err(TableError::Disk(path, error)),
        }
    }

    fn written(path: PathBuf, key: OriginKey, text: &[u8]) -> Result<Self, TableError> {
        match disk::replace(&path, text) {
            Ok(file) => Ok(Sums { file: DigestedFile::new(file, path, text), key }),
            Err(error) => Err(TableError::Disk(path, error)),
        }
    }

    /// An error if they can only be read.
    pub fn may_grow(&mut self) -> Result<(), TableError> {
        self.file.may_grow()
    }

    /// Adds a line.
    pub fn add(&mut self, line: &[u8]) -> Result<(), TableError> {
        self.file.add(record(&self.key, line).as_bytes())
    }

    /// Sees to it that the disk has all of them.
    pub fn settle(&mut self) -> Result<(), TableError> {
        self.file.settle()
    }

    /// The same for what was added more than a second ago.
    pub fn settle_when_due(&mut self) -> Result<(), TableError> {
        self.file.settle_when_due()
    }

    /// An error if they are not as they were written.
    pub fn is_whole(&mut self) -> Result<(), TableError> {
        self.file.is_whole()
    }
}

/// What is known of a table by its checksums.
#[derive(Debug, PartialEq, Eq)]
pub struct IntactLines<'a> {
    /// The lines that are as they were written, each once, by their numbers from 1.
    pub lines: Vec<(usize, &'a [u8])>,
    /// The numbers of the lines, of the table and of its sums, that are not as they were written.
    pub changed: BTreeSet<usize>,
    /// What stands behind as many lines as have records, where nothing was changed before it: the beginning of a line whose record was
    /// not written yet, or another's.
    pub tail: &'a [u8],
}

/// Whether the file beside a table holds checksums, whatever they are of, or nothing: one that holds else is somebody's own.
pub fn are_sums(table: &Path) -> bool {
    let is_sum = |record: &[u8]| {
        let (sum, end) = record.split_at(record.len().min(RECORD - 1));
        sum.iter().all(u8::is_ascii_hexdigit) && matches!(end, b"" | b"\n")
    };
    match read(table) {
        Ok(sums) => sums.chunks(RECORD).all(is_sum),
        Err(Unread::Missing) => true,
        Err(Unread::Wrong(_)) => false,
    }
}

/// The checksums of a table, as they stand in the file.
pub fn read(table: &Path) -> Result<Vec<u8>, Unread> {
    read_beside(table, ".sums", BYTES_MAX)
}

/// Holds a table against its checksums. What a campaign that was killed leaves has a record for every line but the last.
pub fn held_against<'a>(text: &'a [u8], sums: &[u8], key: &OriginKey) -> IntactLines<'a> {
    let record = |line: &[u8]| record(key, line);
    let lines: Vec<&[u8]> = pieces(text).collect();
    let records: Vec<&[u8]> = pieces(sums).collect();
    let written =
        records.iter().zip(&lines).take_while(|(sum, line)| is_whole(line) && **sum == record(line).as_bytes()).count();
    let (tail, rest) = (&lines[written..], &records[written..]);
    let is_begun = |sum: &[u8]| {
        !is_whole(sum) && tail.iter().all(|line| is_whole(line) && record(line).as_bytes().starts_with(sum))
    };
    if tail.len() <= 1 && (rest.is_empty() || tail.len() == 1 && rest.len() == 1 && is_begun(rest[0])) {
        let lines = (1..).zip(lines[..written].iter().copied()).collect();
        return IntactLines { lines, changed: BTreeSet::new(), tail: tail.first().copied().unwrap_or_default() };
    }
    // A line is found by its digest wherever it stands: one that was moved, or put between others, takes none with it.
    let (mut known, mut changed, mut open) = (Vec::new(), BTreeSet::new(), BTreeMap::new());
    for (number, sum) in (1..).zip(&records) {
        match open.entry(*sum) {
            Entry::Vacant(first) => drop(first.insert(number)),
            Entry::Occupied(_) => drop(changed.insert(number)),
        }
    }
    for (number, line) in (1..).zip(lines.iter().copied()) {
        match open.remove(record(line).as_bytes()) {
            Some(_) => known.push((number, line)),
            None => drop(changed.insert(number)),
        }
    }
    changed.extend(open.into_values());
    if changed.is_empty() {
        // All are there, in another order.
        let moved = (1..).zip(lines.iter().zip(&records)).filter(|(_, (line, sum))| record(line).as_bytes() != **sum);
        changed.extend(moved.map(|(number, _)| number));
    }
    IntactLines { lines: known, changed, tail: &[] }
}

fn pieces(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    text.split_inclusive(|b| *b == b'\n')
}

fn is_whole(line: &[u8]) -> bool {
    line.ends_with(b"\n")
}

fn record(key: &OriginKey, line: &[u8]) -> String {
    let mut digest = Digest::new();
    digest.bytes(key.bytes());
    digest.bytes(line);
    format!("{digest}\n")
}

fn path(table: &Path) -> PathBuf {
    beside(table, ".sums")
}

#[cfg(test)]
mod tests {
    use super::{IntactLines, OriginKey};

    const TABLE: &str = "seed,outcome\n1,completed\n2,aborted\n3,completed\n";

    fn key() -> OriginKey {
        OriginKey::of("this campaign")
    }

    fn held_against<'a>(text: &'a [u8], sums: &[u8]) -> IntactLines<'a> {
        super::held_against(text, sums, &key())
    }

    fn sums() -> String {
        TABLE.split_inclusive('\n').map(|line| super::record(&key(), line.as_bytes())).collect()
    }

    /// What is left of a table of which something was changed is a part of what was written, and the change is told.
    #[track_caller]
    fn is_noticed(text: &[u8], sums: &[u8], what: &str) {
        let kept = held_against(text, sums);
        assert!(!kept.changed.is_empty(), "{what}: not noticed");
        for (_, line) in kept.lines {
            let is_written = TABLE.split_inclusive('\n').any(|written| written.as_bytes() == line);
            assert!(is_written, "{what}: taken for what was written");
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
        assert_eq!((kept.lines.len(), kept.changed.len(), kept.tail), (3, 0, &b"3,completed\n"[..]));
        let kept = held_against(&TABLE.as_bytes()[..TABLE.len() - 4], &sums().as_bytes()[..3 * super::RECORD]);
        assert_eq!((kept.lines.len(), kept.changed.len(), kept.tail), (3, 0, &b"3,comple"[..]));
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
        for at in 0..3 * super::RECORD {
            is_noticed(TABLE.as_bytes(), &sums().as_bytes()[..at], &format!("sums cut at {at}"));
        }
        for at in 0..=sums().len() {
            for added in ["\n", "7", "# mine\n", &sums()[super::RECORD..2 * super::RECORD]] {
                let mut sums = sums();
                sums.insert_str(at, added);
                is_noticed(TABLE.as_bytes(), sums.as_bytes(), &format!("{added:?} at {at} of the sums"));
            }
        }
    }

    #[test]
    fn no_line_of_another_campaign_is_known() {
        let kept = super::held_against(TABLE.as_bytes(), sums().as_bytes(), &OriginKey::of("another"));
        assert!(kept.lines.is_empty() && kept.changed == [1, 2, 3, 4].into(), "{kept:?}");
    }

    #[test]
    fn what_was_moved_is_noticed() {
        let mut lines: Vec<&str> = TABLE.split_inclusive('\n').collect();
        lines.swap(1, 2);
        assert_eq!(held_against(lines.concat().as_bytes(), sums().as_bytes()).changed, [2, 3].into());
    }
}
