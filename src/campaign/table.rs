//! The table on the disk: whole rows in the order of the seeds, whenever and however the program ends.
//!
//! A row is written in one piece as soon as it is known. Only what stops in the middle of that, a full disk or a dying
//! machine, leaves a torn last line, which has no line end: who takes the campaign up again drops it, and goes on with the
//! same bytes.

use super::origin::Origin;
use super::seeds::Seeds;
use crate::disk;
use albacore_session::campaign::{Columns, Row, Tally};
use std::fs::{File, TryLockError};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

/// A table that rows can be added to.
pub struct Table {
    path: PathBuf,
    file: File,
    rows: u64,
    /// The last row of an earlier campaign, until it has come out the same again.
    known: Option<Vec<u8>>,
}

/// Why there is no table, or no further row.
#[derive(Debug)]
pub enum Trouble {
    /// What was asked for cannot be: what is wrong, and a fix.
    Asked(String, String),
    /// The disk will not have it.
    Disk(io::Error),
}

impl From<io::Error> for Trouble {
    fn from(error: io::Error) -> Self {
        Trouble::Disk(error)
    }
}

impl Table {
    /// Begins a table, where there is none yet.
    pub fn begin(path: &Path, columns: &Columns, origin: &Origin) -> Result<Self, Trouble> {
        let created = disk::new_file(path);
        if created.as_ref().is_err_and(|error| error.kind() == io::ErrorKind::AlreadyExists) {
            let help = "go on with it by `--resume`, or choose another file with `--out`";
            return Err(Trouble::Asked(format!("`{}` is there already", path.display()), help.to_string()));
        }
        let mut table = Table { path: path.to_path_buf(), file: created?, rows: 0, known: None };
        table.lock()?;
        table.head(columns, origin)?;
        Ok(table)
    }

    /// Goes on with a table, or begins it if there is none.
    pub fn resume(path: &Path, columns: &Columns, origin: &Origin, seeds: Seeds) -> Result<Self, Trouble> {
        match std::fs::metadata(path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Table::begin(path, columns, origin),
            Err(error) => return Err(error.into()),
            // A device or a pipe would answer with something else, or never.
            Ok(found) if !found.is_file() => {
                let message = format!("`{}` is no ordinary file", path.display());
                return Err(Trouble::Asked(message, "choose another file with `--out`".to_string()));
            }
            Ok(_) => {}
        }
        let file = disk::old_file(path)?;
        let mut table = Table { path: path.to_path_buf(), file, rows: 0, known: None };
        table.lock()?;
        let mut text = Vec::new();
        table.file.read_to_end(&mut text)?;
        let Some((head, rows, torn)) = parts(&text) else {
            // Not even its first line was written.
            table.belongs(origin, text.is_empty())?;
            table.file.set_len(0)?;
            table.head(columns, origin)?;
            return Ok(table);
        };
        table.belongs(origin, false)?;
        if head != line(columns.names()) {
            let help = "give the `--reports` that it was begun with, or choose another file with `--out`";
            let message = format!("`{}` has other columns than this campaign", path.display());
            return Err(Trouble::Asked(message, help.to_string()));
        }
        table.rows = table.matching(rows, columns, seeds)?;
        table.known = rows.split_inclusive(|b| *b == b'\n').next_back().map(<[u8]>::to_vec);
        table.file.set_len((text.len() - torn) as u64)?;
        Ok(table)
    }

    /// The seeds that are still to be run. The last one of the table is run again: if its row comes out otherwise, this
    /// is another interpreter, whatever its version says.
    pub fn missing(&self, seeds: Seeds) -> std::ops::RangeInclusive<u64> {
        seeds.after(self.rows - u64::from(self.known.is_some()))
    }

    /// How many rows it has.
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// Adds a row.
    pub fn add(&mut self, row: &Row) -> Result<(), Trouble> {
        let line = line(&row.cells);
        if let Some(known) = self.known.take() {
            if known == line {
                return Ok(());
            }
            let message = format!("seed {} gives another row today than in `{}`", row.seed, self.path.display());
            let help =
                "the interpreter is another one, or the row was changed by hand: begin anew with another `--out`";
            return Err(Trouble::Asked(message, help.to_string()));
        }
        self.file.write_all(&line)?;
        self.rows += 1;
        Ok(())
    }

    /// What the rows come to.
    pub fn tally(&self, columns: &Columns) -> Result<Tally, Trouble> {
        let mut reader = csv::Reader::from_path(&self.path).map_err(io::Error::from)?;
        let mut tally = Tally::default();
        for row in reader.records() {
            let row = row.map_err(io::Error::from)?;
            tally.add(columns, &row.iter().collect::<Vec<_>>());
        }
        Ok(tally)
    }

    /// Two campaigns must not write one file. Where a disk knows no locks, nothing is said.
    fn lock(&self) -> Result<(), Trouble> {
        match self.file.try_lock() {
            Err(TryLockError::WouldBlock) => {
                let message = format!("another campaign is writing `{}`", self.path.display());
                Err(Trouble::Asked(message, "wait for its end, or choose another file with `--out`".to_string()))
            }
            _ => Ok(()),
        }
    }

    /// Writes where it comes from, and then the first line: a table with a line always has its origin beside it.
    fn head(&mut self, columns: &Columns, origin: &Origin) -> io::Result<()> {
        origin.write(&self.path)?;
        self.file.write_all(&line(columns.names()))
    }

    /// Whether this campaign is the one that the table was begun by. An empty file belongs to every campaign.
    fn belongs(&self, origin: &Origin, is_empty: bool) -> Result<(), Trouble> {
        let problem = match Origin::read(&self.path) {
            _ if is_empty => None,
            None => Some("has no readable `.origin` beside it, which tells what it was made from".to_string()),
            Some(then) => then.difference(origin),
        };
        let Some(problem) = problem else { return Ok(()) };
        let help = "a table holds one campaign: give what it was begun with, or choose another file with `--out`";
        Err(Trouble::Asked(format!("`{}` {problem}", self.path.display()), help.to_string()))
    }

    /// Counts the rows, which must be those of the first seeds.
    fn matching(&self, rows: &[u8], columns: &Columns, seeds: Seeds) -> Result<u64, Trouble> {
        let mut count = 0;
        let mut expected = seeds.after(0);
        let seed_column = columns.names().iter().position(|name| name == "seed").unwrap_or_default();
        let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(rows);
        for row in reader.records() {
            let wanted = expected.next();
            let row = row.ok().filter(|row| row.len() == columns.names().len());
            let seed = row.as_ref().and_then(|row| row.get(seed_column));
            if seed.is_none() || seed != wanted.map(|seed| seed.to_string()).as_deref() {
                let found = seed.map_or("is no row".to_string(), |seed| format!("has seed {seed}"));
                let message = format!("`{}`, line {}: this {found}", self.path.display(), count + 2);
                let help = wanted.map_or_else(
                    || format!("`--seeds {seeds}` ends before it: ask for more seeds"),
                    |seed| format!("`--seeds {seeds}` has seed {seed} here: give the first seed it was begun with"),
                );
                return Err(Trouble::Asked(message, format!("{help}, or choose another file with `--out`")));
            }
            count += 1;
        }
        Ok(count)
    }
}

/// The first line of a text, the whole lines after it, and the bytes of a torn last one.
fn parts(text: &[u8]) -> Option<(&[u8], &[u8], usize)> {
    let head = text.iter().position(|b| *b == b'\n')? + 1;
    let end = text.iter().rposition(|b| *b == b'\n')? + 1;
    Some((&text[..head], &text[head..end], text.len() - end))
}

/// A row as it stands in the file. Names and reasons may have line ends in them; a row is one line.
fn line(cells: &[String]) -> Vec<u8> {
    let plain = |cell: &String| cell.chars().map(|c| if c.is_control() { ' ' } else { c }).collect::<String>();
    let mut writer = csv::Writer::from_writer(Vec::new());
    // Memory takes everything.
    let _ = writer.write_record(cells.iter().map(plain));
    writer.into_inner().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::{line, parts};

    #[test]
    fn a_row_is_one_line() {
        let cells = ["box".to_string(), "he said \"no,\nnever\"".to_string(), String::new()];
        assert_eq!(line(&cells), b"box,\"he said \"\"no, never\"\"\",\n");
    }

    #[test]
    fn a_torn_line_is_told_from_whole_ones() {
        assert_eq!(parts(b""), None);
        assert_eq!(parts(b"a,b"), None);
        assert_eq!(parts(b"a,b\n"), Some((&b"a,b\n"[..], &b""[..], 0)));
        assert_eq!(parts(b"a,b\n1,2\n3"), Some((&b"a,b\n"[..], &b"1,2\n"[..], 1)));
    }
}
