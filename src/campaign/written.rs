//! A table that was written, with what it was made from: read whole, and held against its checksums.

use super::provenance::{self, Provenance, Unread};
use super::sums;
use crate::made::is_as_summed;
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
    /// Its rows, each with its seed: one for each seed from the first on.
    pub rows: Vec<(u64, Vec<u8>)>,
}

/// Why a table cannot be used: what is wrong, and a fix.
pub type Unusable = (String, String);

/// Finds the seed in a row of a table with this first line.
fn seeds(head: &[u8]) -> impl Fn(&[u8]) -> Option<u64> + use<> {
    let cells =
        |line: &[u8]| csv::ReaderBuilder::new().has_headers(false).from_reader(line).into_records().next()?.ok();
    let column = cells(head).and_then(|names| names.iter().position(|name| name == "seed"));
    move |line| cells(line)?.get(column?)?.parse().ok()
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
        let rows: Vec<(u64, Vec<u8>)> = (origin.first_seed()..).zip(lines.map(<[u8]>::to_vec)).collect();
        // Whoever takes a row out and its checksum too leaves a table that is whole by its sums.
        let seed_of = seeds(&head);
        if let Some((due, found)) =
            rows.iter().map(|(due, line)| (*due, seed_of(line))).find(|(due, found)| *found != Some(*due))
        {
            let found = found.map_or("none".to_string(), |found| format!("seed {found}"));
            let message = format!("`{shown}` has {found} where seed {due} is due: rows were taken out of it");
            return Err((message, again.to_string()));
        }
        if rows.is_empty() {
            return Err((format!("`{shown}` has no rows"), again.to_string()));
        }
        Ok(WrittenTable { path: path.to_path_buf(), origin, head, rows })
    }

    /// The seed of its first row.
    pub fn first(&self) -> u64 {
        self.origin.first_seed()
    }

    /// The seed of its last row.
    pub fn last(&self) -> u64 {
        self.first() + self.rows.len() as u64 - 1
    }
}
