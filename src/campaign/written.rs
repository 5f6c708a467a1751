//! A table that was written, with what it was made from: read whole, and held against its checksums.

use super::line_reader::LineReader;
use super::provenance::{self, Provenance, Unread};
use super::sums;
use crate::made::is_as_summed;
use albacore_session::campaign::RowOrder;
use albacore_session::read_file;
use std::path::{Path, PathBuf};

/// No table is larger, in bytes.
const BYTES_MAX: u64 = 1 << 32;

/// A table whose rows are all as they were written.
pub struct WrittenTable {
    /// Where it lies.
    pub path: PathBuf,
    /// What it was made from.
    pub origin: Provenance,
    /// Its first line.
    pub head: Vec<u8>,
    /// Its rows, in their order: of each seed from the first on one of each case, but perhaps of the last.
    pub rows: Vec<WrittenRow>,
}

/// A row, and which run it is of.
pub struct WrittenRow {
    /// The seed.
    pub seed: u64,
    /// The case, from 0.
    pub case: usize,
    /// The line.
    pub line: Vec<u8>,
}

/// Why a table cannot be used: what is wrong, and a fix.
pub type Unusable = (String, String);

/// Finds the seed and the case in a row of a table with this first line: one that has no column for the case is of one.
fn runs(head: &[u8], cases: usize) -> impl FnMut(&[u8]) -> Option<(u64, usize)> + use<> {
    let mut reader = LineReader::default();
    let names = reader.cells(head).cloned();
    let column = move |name: &str| names.as_ref()?.iter().position(|other| other == name);
    let (seed, case) = (column("seed"), column("case"));
    move |line| {
        let cells = reader.cells(line)?;
        let case = if cases == 1 { 1 } else { cells.get(case?)?.parse::<usize>().ok()? };
        Some((cells.get(seed?)?.parse().ok()?, case.checked_sub(1)?))
    }
}

impl WrittenTable {
    /// Reads a table and the two files beside it.
    pub fn read(path: &Path) -> Result<Self, Unusable> {
        let shown = path.display();
        let unread = |suffix: &str, unread: Unread| {
            let message = match unread {
                Unread::Missing => format!("there is no `{shown}{suffix}`"),
                Unread::Wrong(why) => format!("`{shown}{suffix}` cannot be read: {why}"),
            };
            let help =
                "a table of `albacore campaign` has its `.origin` and its `.sums` beside it: copy the three together";
            (message, help.to_string())
        };
        let text = read_file(path, BYTES_MAX).map_err(|error| {
            (format!("`{shown}` cannot be read: {error}"), "name a table of `albacore campaign`".to_string())
        })?;
        let bytes = provenance::read(path).map_err(|error| unread(".origin", error))?;
        let origin = Provenance::of(&bytes).map_err(|error| unread(".origin", error))?;
        let again = "the campaign that wrote it mends it: the same command with `--resume`";
        if !is_as_summed(&bytes) {
            return Err((format!("`{shown}.origin` was changed since it was written"), again.to_string()));
        }
        let sums = sums::read(path).map_err(|error| unread(".sums", error))?;
        let kept = sums::held_against(&text, &sums, &origin.key());
        if !kept.changed.is_empty() {
            let message =
                format!("`{shown}` or its `.sums` was changed since it was written: {}", super::listed(&kept.changed));
            return Err((message, again.to_string()));
        }
        if !kept.tail.is_empty() {
            return Err((format!("`{shown}` ends in the middle of a row"), again.to_string()));
        }
        let mut lines = kept.lines.into_iter().map(|(_, line)| line);
        let head = lines.next().unwrap_or_default().to_vec();
        let cases = origin.cases().len();
        if cases == 0 {
            return Err((format!("`{shown}.origin` tells of no case"), again.to_string()));
        }
        let order = RowOrder { first_seed: origin.first_seed(), cases: cases as u64 };
        let mut run_of = runs(&head, cases);
        let mut rows = Vec::new();
        for (number, line) in (0..).zip(lines) {
            let (seed, case) = order.run(number);
            // Whoever takes a row out and its checksum too leaves a table that is whole by its sums.
            let found = run_of(line);
            if found != Some((seed, case)) {
                let named = |(seed, case): (u64, usize)| match cases {
                    1 => format!("seed {seed}"),
                    _ => format!("seed {seed} of case {}", case + 1),
                };
                let (found, due) = (found.map_or("none".to_string(), named), named((seed, case)));
                let message = format!("`{shown}` has {found} where {due} is due: rows were taken out of it");
                return Err((message, again.to_string()));
            }
            rows.push(WrittenRow { seed, case, line: line.to_vec() });
        }
        if rows.is_empty() {
            return Err((format!("`{shown}` has no rows"), again.to_string()));
        }
        Ok(WrittenTable { path: path.to_path_buf(), origin, head, rows })
    }

    /// Hands on some cells of each row, by the names of their columns; none of a column that it has not.
    pub fn each_row<const N: usize>(
        &self,
        columns: [&str; N],
        mut take: impl FnMut(&WrittenRow, [Option<&str>; N]),
    ) -> Result<(), Unusable> {
        let unread = |error: csv::Error| {
            let help = "name a table of `albacore campaign`".to_string();
            (format!("`{}` cannot be read: {error}", self.path.display()), help)
        };
        let lines = std::iter::once(&self.head).chain(self.rows.iter().map(|row| &row.line));
        let text: Vec<u8> = lines.flatten().copied().collect();
        let mut reader = csv::Reader::from_reader(text.as_slice());
        let names = reader.headers().map_err(unread)?.clone();
        let columns = columns.map(|name| names.iter().position(|other| other == name));
        for (written, row) in self.rows.iter().zip(reader.records()) {
            let row = row.map_err(unread)?;
            take(written, columns.map(|column| row.get(column?)));
        }
        Ok(())
    }

    /// The seed of its first row.
    pub fn first(&self) -> u64 {
        self.origin.first_seed()
    }

    /// The seed of its last row.
    pub fn last(&self) -> u64 {
        self.rows.last().map_or(self.first(), |row| row.seed)
    }

    /// Whether its last seed has a row of each case.
    pub fn is_even(&self) -> bool {
        self.rows.len().is_multiple_of(self.origin.cases().len())
    }
}
