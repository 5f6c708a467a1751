//! The table on the disk: whole rows in the order of the seeds, whenever and however the program ends.
//!
//! A row is written in one piece as soon as it is known, and then its checksum. Whoever takes the campaign up again keeps the
//! rows that are as they were written, runs the seeds of the others again, and goes on: the bytes are the same as without
//! the interruption, and whatever the disk did.

use super::growing::Growing;
use super::origin::{Origin, Unread, beside};
use super::seeds::Seeds;
use super::sums::{self, Sums};
use crate::disk;
use albacore_session::campaign::{Columns, Row, Tally, plain};
use std::fs::{File, TryLockError};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// A table that rows can be added to.
pub struct Table {
    path: PathBuf,
    state: State,
    rows: u64,
    /// The last row of an earlier campaign, until it has come out the same again.
    known: Option<Vec<u8>>,
    /// Lines that were changed on the disk, by their numbers.
    changed: Vec<usize>,
    /// Where the table is kept as it was found, if any were.
    found: Option<PathBuf>,
    /// What stood behind its last line, if that may be a row that was being written.
    tail: Option<Tail>,
}

/// The end of a table, which is known for a row or for another's when that row is run again.
struct Tail {
    row: u64,
    /// The table as it was found, and where in it this begins.
    found: Vec<u8>,
    at: usize,
}

enum State {
    /// Rows are added at the end.
    Adding(Growing, Sums),
    /// Rows in the middle are run again first. The file is left as it is until all of them are known, and locked.
    Mending(Growing, Lines),
}

/// What is known of a table's lines, the first too.
type Lines = Vec<Option<Vec<u8>>>;

/// Why there is no table, or no further row.
#[derive(Debug)]
pub enum Trouble {
    /// What was asked for cannot be: what is wrong, and a fix.
    Asked(String, String),
    /// The disk will not have it.
    Disk(io::Error),
    /// A file was removed or replaced while it was written.
    Gone(PathBuf),
    /// Somebody else wrote into it.
    Changed(PathBuf),
}

impl From<io::Error> for Trouble {
    fn from(error: io::Error) -> Self {
        Trouble::Disk(error)
    }
}

impl Table {
    /// Begins a table, where there is none yet.
    pub fn begin(path: &Path, columns: &Columns, origin: &Origin) -> Result<Self, Trouble> {
        // What lies beside a table that is gone is of that one, and may be all that is left of it.
        match neighbours(path).iter().find(|left| !path.exists() && is_there(left)) {
            Some(left) => Err(another(left)),
            None => Table::create(path, columns, origin),
        }
    }

    fn create(path: &Path, columns: &Columns, origin: &Origin) -> Result<Self, Trouble> {
        if path.is_symlink() && !path.exists() {
            let message = format!("`{}` is there already: a link that leads nowhere", path.display());
            return Err(Trouble::Asked(message, "remove it, or choose another file with `--out`".to_string()));
        }
        let created = disk::new_file(path);
        if created.as_ref().is_err_and(|error| error.kind() == io::ErrorKind::AlreadyExists) {
            let help = match neighbours(path).iter().any(|beside| is_there(beside)) {
                true => "go on with it by `--resume`, or choose another file with `--out`",
                false => "choose another file with `--out`",
            };
            return Err(Trouble::Asked(format!("`{}` is there already", path.display()), help.to_string()));
        }
        let file = created?;
        lock(&file, path)?;
        let made: Vec<PathBuf> = neighbours(path).into_iter().filter(|left| !is_there(left)).collect();
        let table = Table::headed(path, file, columns, origin);
        if table.is_err() {
            // Of what was not there before nothing is worth keeping.
            made.iter().map(PathBuf::as_path).chain([path]).for_each(|left| drop(disk::remove(left)));
        }
        table
    }

    /// Writes where it comes from, and then the first line: a table with a line always has its origin beside it.
    fn headed(path: &Path, file: File, columns: &Columns, origin: &Origin) -> Result<Self, Trouble> {
        let head = line(columns.names());
        origin.write(path)?;
        let mut sums = Sums::begin(path, std::iter::empty())?;
        let mut file = Growing::new(file, path.to_path_buf(), &[]);
        file.add(&head)?;
        sums.add(&head)?;
        let state = State::Adding(file, sums);
        Ok(Table {
            path: path.to_path_buf(),
            state,
            rows: 0,
            known: None,
            changed: Vec::new(),
            found: None,
            tail: None,
        })
    }

    /// Goes on with a table, or begins it if there is none.
    pub fn resume(path: &Path, columns: &Columns, origin: &Origin, seeds: Seeds) -> Result<Self, Trouble> {
        match std::fs::metadata(path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                // A table that is gone is made again, and no other in its place.
                left_by(path, origin)?;
                return Table::create(path, columns, origin);
            }
            Err(error) => return Err(error.into()),
            // A device or a pipe would answer with something else, or never.
            Ok(found) if !found.is_file() => {
                let message = format!("`{}` is no ordinary file", path.display());
                return Err(Trouble::Asked(message, "choose another file with `--out`".to_string()));
            }
            Ok(_) => {}
        }
        // What a link leads to is gone on with, and the link stays.
        let path = &path.canonicalize()?;
        let mut file = disk::old_file(path)?;
        lock(&file, path)?;
        let mut text = Vec::new();
        file.read_to_end(&mut text)?;
        let head = line(columns.names());
        if text.is_empty() {
            left_by(path, origin)?;
        } else {
            belongs(path, origin)?;
        }
        if !text.contains(&b'\n') {
            // Not even its first line was written.
            if !head.starts_with(&text) || !sums::are_sums(path) {
                return Err(damaged(path));
            }
            file.set_len(0)?;
            return Table::headed(path, file, columns, origin);
        }
        let kept = sums::kept(path, &text)
            .map_err(|unread| silent(path, ".sums", "which tells whether its rows are whole", unread))?;
        let mut lines: Vec<Option<Vec<u8>>> = kept.lines.iter().map(|line| line.map(<[u8]>::to_vec)).collect();
        match lines.first_mut() {
            // What it was is known without it.
            Some(first @ None) => *first = Some(head),
            Some(Some(first)) if *first == head => {}
            None if text.starts_with(&head) && sums::are_sums(path) => lines.push(Some(head)),
            // Whatever its columns are, the first line that was written is not here, or its sum is not.
            first if first.is_none() || text.starts_with(&head) => return Err(damaged(path)),
            _ => {
                let help = "give the `--reports` that it was begun with, or choose another file with `--out`";
                let message = format!("`{}` has other columns than this campaign", path.display());
                return Err(Trouble::Asked(message, help.to_string()));
            }
        }
        matching(path, &lines[1..], columns, seeds)?;
        let rows = lines.len() as u64 - 1;
        let known = if rows > 0 { lines.last().cloned().flatten() } else { None };
        let state = State::Mending(Growing::new(file, path.clone(), &text), lines);
        let mut table =
            Table { path: path.clone(), state, rows, known, changed: kept.changed, found: None, tail: None };
        let row = kept.tail_line as u64 - 2;
        match kept.tail {
            b"" => {}
            // Whether it is the row that was being written is known when that is run again.
            tail if row < seeds.count() && may_be_row(tail, seeds.first + row, columns) => {
                table.tail = Some(Tail { row, at: text.len() - tail.len(), found: text.clone() });
            }
            _ if table.changed.is_empty() => table.changes(row),
            // Lines that were moved there, or are told already.
            _ => {}
        }
        if !table.changed.is_empty() {
            table.found = Some(keep(path, &text)?);
        }
        table.mended()?;
        Ok(table)
    }

    /// Goes on adding rows if all lines are known.
    fn mended(&mut self) -> Result<(), Trouble> {
        let State::Mending(file, lines) = &mut self.state else { return Ok(()) };
        let Some(known) = lines.iter().map(Option::as_deref).collect::<Option<Vec<&[u8]>>>() else { return Ok(()) };
        let written = known.concat();
        let file = if file.text()?.starts_with(&written) {
            file.file().set_len(written.len() as u64)?;
            file.file().try_clone()?
        } else {
            disk::replace(&self.path, &written)?
        };
        let sums = Sums::begin(&self.path, known.into_iter())?;
        self.state = State::Adding(Growing::new(file, self.path.clone(), &written), sums);
        Ok(())
    }

    /// The line of a row is not as it was written.
    fn changes(&mut self, row: u64) {
        self.changed.push(row as usize + 2);
        self.changed.sort_unstable();
        self.changed.dedup();
    }

    /// The seeds that are still to be run. The last one of the table is run again: if its row comes out otherwise, this
    /// is another interpreter, whatever its version says. Then come those whose rows were changed.
    pub fn missing(&self, seeds: Seeds) -> impl Iterator<Item = u64> + Clone + use<> {
        let known = self.known.as_ref().map(|_| self.rows - 1);
        let changed: Vec<u64> = match &self.state {
            State::Adding(..) => Vec::new(),
            State::Mending(_, lines) => {
                (0..).zip(&lines[1..]).filter(|(_, line)| line.is_none()).map(|(row, _)| row).collect()
            }
        };
        let again = known.into_iter().chain(changed).map(move |row| seeds.first + row);
        again.chain(seeds.after(self.rows))
    }

    /// How many rows it has.
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// The numbers of lines that were changed on the disk since they were written: their seeds are run again.
    pub fn changed(&self) -> &[usize] {
        &self.changed
    }

    /// Where the table is kept as it was before they were run again.
    pub fn found(&self) -> Option<&Path> {
        self.found.as_deref()
    }

    /// Adds a row.
    pub fn add(&mut self, seeds: Seeds, row: &Row) -> Result<(), Trouble> {
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
        if let Some(tail) = self.tail.take_if(|tail| seeds.first + tail.row == row.seed)
            && !line.starts_with(&tail.found[tail.at..])
        {
            self.changes(tail.row);
            if self.found.is_none() {
                self.found = Some(keep(&self.path, &tail.found)?);
            }
        }
        match &mut self.state {
            State::Adding(file, sums) => {
                file.add(&line)?;
                sums.add(&line)?;
                self.rows += 1;
            }
            State::Mending(_, lines) => {
                let at = (row.seed - seeds.first) as usize + 1;
                if let Some(missing) = lines.get_mut(at) {
                    *missing = Some(line);
                }
                self.mended()?;
            }
        }
        Ok(())
    }

    /// What the rows come to, when all are written.
    pub fn tally(&mut self, columns: &Columns, origin: &Origin) -> Result<Tally, Trouble> {
        match Origin::read(&self.path) {
            // Nobody else could put it back.
            Err(Unread::Missing) => origin.write(&self.path)?,
            _ => belongs(&self.path, origin)?,
        }
        let text = match &mut self.state {
            State::Adding(file, sums) => {
                sums.is_whole()?;
                file.text()?
            }
            State::Mending(file, _) => file.text()?,
        };
        let mut reader = csv::Reader::from_reader(&text[..]);
        let mut tally = Tally::default();
        for row in reader.records() {
            let row = row.map_err(io::Error::from)?;
            tally.add(columns, &row.iter().collect::<Vec<_>>());
        }
        Ok(tally)
    }
}

/// The files that lie beside a table.
fn neighbours(table: &Path) -> [PathBuf; 2] {
    [".origin", ".sums"].map(|suffix| beside(table, suffix))
}

fn is_there(path: &Path) -> bool {
    path.symlink_metadata().is_ok()
}

fn another(left: &Path) -> Trouble {
    let message = format!("`{}` is there already, and belongs to another table", left.display());
    Trouble::Asked(message, "move it away, or choose another file with `--out`".to_string())
}

fn damaged(path: &Path) -> Trouble {
    let message = format!("`{}` or its `.sums` is damaged: the first line is not as it was written", path.display());
    Trouble::Asked(message, "put both back as they were, or begin anew with another `--out`".to_string())
}

/// A table that is gone, or empty, is made again where what lies beside it is its own, and no other in its place.
fn left_by(path: &Path, origin: &Origin) -> Result<(), Trouble> {
    let [of, sums] = neighbours(path);
    if is_there(&of) {
        belongs(path, origin)?;
    }
    if is_there(&sums) && !(is_there(&of) && sums::are_sums(path)) { Err(another(&sums)) } else { Ok(()) }
}

/// Two campaigns must not write one file. Where a disk knows no locks, nothing is said.
fn lock(file: &File, path: &Path) -> Result<(), Trouble> {
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => {
            let message = format!("another campaign is writing `{}`", path.display());
            Err(Trouble::Asked(message, "wait for its end, or choose another file with `--out`".to_string()))
        }
        _ => Ok(()),
    }
}

/// Says that a file beside a table does not tell what it should.
fn silent(table: &Path, suffix: &str, what: &str, unread: Unread) -> Trouble {
    let message = match unread {
        Unread::Missing => format!("`{}` has no `{suffix}` beside it, {what}", table.display()),
        Unread::Wrong(error) => format!("`{}{suffix}`, {what}, cannot be read: {error}", table.display()),
    };
    Trouble::Asked(message, "put that back as it was, or begin anew with another `--out`".to_string())
}

/// Whether this campaign is the one that the table was begun by.
fn belongs(path: &Path, origin: &Origin) -> Result<(), Trouble> {
    let problem = match Origin::read(path) {
        Err(unread) => return Err(silent(path, ".origin", "which tells what it was made from", unread)),
        Ok(then) => then.difference(origin),
    };
    let Some(problem) = problem else { return Ok(()) };
    let help = "a table holds one campaign: give what it was begun with, or choose another file with `--out`";
    Err(Trouble::Asked(format!("`{}` {problem}", path.display()), help.to_string()))
}

/// The rows that are known must be those of the first seeds.
fn matching(path: &Path, rows: &[Option<Vec<u8>>], columns: &Columns, seeds: Seeds) -> Result<(), Trouble> {
    let mut expected = seeds.after(0);
    for (i, line) in rows.iter().enumerate() {
        let wanted = expected.next();
        let Some(line) = line else { continue };
        let seed = seed_of(line, columns);
        if seed.is_none() || seed != wanted.map(|seed| seed.to_string()) {
            let found = seed.map_or("is no row".to_string(), |seed| format!("has seed {seed}"));
            let message = format!("`{}`, line {}: this {found}", path.display(), i + 2);
            let help = wanted.map_or_else(
                || format!("`--seeds {seeds}` ends before it: ask for more seeds"),
                |seed| format!("`--seeds {seeds}` has seed {seed} here: give the first seed it was begun with"),
            );
            return Err(Trouble::Asked(message, format!("{help}, or choose another file with `--out`")));
        }
    }
    Ok(())
}

/// Whether the end of a table may be the row of a seed, or the beginning of that.
fn may_be_row(tail: &[u8], seed: u64, columns: &Columns) -> bool {
    !tail.contains(&b'\n') || seed_of(tail, columns) == Some(seed.to_string())
}

/// Keeps a table as it was found, beside it: who wrote into it may want that back.
fn keep(table: &Path, text: &[u8]) -> io::Result<PathBuf> {
    let mut number = 1;
    loop {
        let suffix = if number == 1 { ".found".to_string() } else { format!(".found-{number}") };
        let copy = beside(table, &suffix);
        match disk::keep(&copy, text) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => number += 1,
            kept => return kept.map(|()| copy),
        }
    }
}

/// The seed of a row that has all columns.
fn seed_of(line: &[u8], columns: &Columns) -> Option<String> {
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(line);
    let row = reader.records().next()?.ok().filter(|row| row.len() == columns.names().len())?;
    let column = columns.names().iter().position(|name| name == "seed")?;
    row.get(column).map(str::to_string)
}

/// A row as it stands in the file. Names and reasons may have line ends in them; a row is one line.
fn line(cells: &[String]) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    // Memory takes everything.
    let _ = writer.write_record(cells.iter().map(|cell| plain(cell)));
    writer.into_inner().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::line;

    #[test]
    fn a_spreadsheet_computes_nothing_of_a_text() {
        let cells = ["=1+1", "+1", "-12.5", "-1e-3", "@SUM(1)", "\t=cmd()", "\r-2+3", "-", "a=b", "\u{1b}[2J", "+inf"];
        let cells: Vec<String> = cells.iter().map(|cell| cell.to_string()).collect();
        let expected = "'=1+1,+1,-12.5,-1e-3,'@SUM(1),' =cmd(),' -2+3,'-,a=b,\\u{1b}[2J,'+inf\n";
        assert_eq!(String::from_utf8(line(&cells)).unwrap(), expected);
        let parted = ["a;=1+1".to_string(), "=1; \"@SUM(1)".to_string(), "1;-2".to_string()];
        assert_eq!(line(&parted), b"a;'=1+1,\"'=1;' \"\"@SUM(1)\",1;-2\n");
    }

    #[test]
    fn a_row_is_one_line() {
        let cells = ["box".to_string(), "he said \"no,\nnever\"".to_string(), String::new()];
        assert_eq!(line(&cells), b"box,\"he said \"\"no, never\"\"\",\n");
    }
}
