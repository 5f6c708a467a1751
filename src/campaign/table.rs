//! The table on the disk: whole rows in the order of the seeds, whenever and however the program ends.
//!
//! A row is written in one piece as soon as it is known, and then its checksum. Whoever takes the campaign up again keeps the
//! rows that are as they were written, runs the seeds of the others again, and goes on: the bytes are the same as without
//! the interruption, and whatever the disk did.

use super::digested_file::DigestedFile;
use super::line_reader::LineReader;
use super::neighbours::{
    MADE_FROM, alone, alone_of_name, belongs, is_there, left_by, lock, neighbours, no_stray_link, same, silent, write,
};
use super::provenance::{self, OriginKey, Provenance, Unread, beside};
use super::seeds::Rows;
use super::sums::{self, Sums};
use crate::disk;
use crate::made::is_as_summed;
use albacore_session::campaign::{Columns, Row, Tallies, plain};
use albacore_session::read_file;
use csv::StringRecord;
use std::collections::BTreeSet;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// A table that rows can be added to.
pub struct Table {
    path: PathBuf,
    state: State,
    /// The last row of an earlier campaign and its number, until it has come out the same again.
    known: Option<(u64, Vec<u8>)>,
    /// What stood behind its last line, if that may be a row that was being written.
    tail: Option<Tail>,
    /// What others did to it, as long as nobody was told.
    foreign: Vec<Foreign>,
}

/// What others did to a table or to what lies beside it, and where that is kept as it was found.
pub enum Foreign {
    /// Lines of the table or of its sums, by their numbers.
    Lines(BTreeSet<usize>, Vec<PathBuf>),
    /// The origin, which says the same yet.
    Provenance(Vec<PathBuf>),
}

/// The end of a table, which is known for a row or for another's when that row is run again.
struct Tail {
    row: u64,
    /// Where in the table it begins.
    at: usize,
}

/// A table and its sums, as they were found.
struct Found {
    text: Vec<u8>,
    sums: Vec<u8>,
}

enum State {
    /// Rows are added at the end.
    Adding { file: DigestedFile, sums: Sums, rows: u64 },
    /// Rows of those that were written are run again first. The files are left as they are until all of them are known, and locked.
    Mending { file: DigestedFile, found: Found, lines: Lines, key: OriginKey },
}

/// What is known of a table's lines, the first too.
type Lines = Vec<Option<Vec<u8>>>;

/// Why there is no table, or no further row.
#[derive(Debug)]
pub enum TableError {
    /// What was asked for cannot be: what is wrong, and a fix.
    Asked(String, String),
    /// The disk will not have a file.
    Disk(PathBuf, io::Error),
    /// A file was removed or replaced while it was written.
    Gone(PathBuf),
    /// Somebody else wrote into it.
    Changed(PathBuf),
}

/// What is known of a table that cannot be gone on with, by nothing but a look at it.
pub enum Standing {
    /// So many rows are as they were written.
    Whole(usize),
    /// These lines of the table or of its sums are not.
    Changed(BTreeSet<usize>),
    /// It or its sums cannot be read.
    Unknown,
}

/// Holds a table against its checksums, and touches nothing.
pub fn standing(path: &Path) -> Standing {
    let read = |path: &Path| std::fs::read(path).ok().zip(sums::read(path).ok());
    let Some((text, sums)) = path.canonicalize().ok().filter(|path| path.is_file()).and_then(|path| read(&path)) else {
        return Standing::Unknown;
    };
    let origin = path.canonicalize().ok().and_then(|path| provenance::read(&path).ok());
    let Some(origin) = origin.and_then(|bytes| Provenance::of(&bytes).ok()) else { return Standing::Unknown };
    let kept = sums::held_against(&text, &sums, &origin.key());
    if kept.changed.is_empty() {
        Standing::Whole(kept.lines.len().saturating_sub(1))
    } else {
        Standing::Changed(kept.changed)
    }
}

/// What the disk says of a file.
fn disk_of(path: &Path) -> impl FnOnce(io::Error) -> TableError {
    |error| TableError::Disk(path.to_path_buf(), error)
}

impl Table {
    /// Begins a table, where there is none yet.
    pub fn begin(path: &Path, columns: &Columns, origin: &Provenance) -> Result<Self, TableError> {
        // What lies beside a table that is gone is of that one, and may be all that is left of it.
        match neighbours(path).iter().any(|left| !path.exists() && is_there(left)) {
            true => Err(alone(path)),
            false => Table::create(path, columns, origin),
        }
    }

    fn create(path: &Path, columns: &Columns, origin: &Provenance) -> Result<Self, TableError> {
        no_stray_link(path)?;
        let created = disk::new_file(path);
        if created.as_ref().is_err_and(|error| error.kind() == io::ErrorKind::AlreadyExists) {
            let help = match neighbours(path).iter().any(|beside| is_there(beside)) {
                true => "go on with it by `--resume`, or choose another file with `--out`",
                false => "choose another file with `--out`",
            };
            return Err(TableError::Asked(format!("`{}` is there already", path.display()), help.to_string()));
        }
        let file = created.map_err(disk_of(path))?;
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
    fn headed(path: &Path, file: File, columns: &Columns, origin: &Provenance) -> Result<Self, TableError> {
        let head = line(columns.names());
        write(origin, path)?;
        let mut sums = Sums::begin(path, origin.key())?;
        let mut file = DigestedFile::new(file, path.to_path_buf(), &[]);
        file.add(&head)?;
        sums.add(&head)?;
        let state = State::Adding { file, sums, rows: 0 };
        Ok(Table { path: path.to_path_buf(), state, known: None, tail: None, foreign: Vec::new() })
    }

    /// Goes on with a table, or begins it if there is none.
    pub fn resume(path: &Path, columns: &Columns, origin: &Provenance, rows: Rows) -> Result<Self, TableError> {
        match std::fs::metadata(path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                if !neighbours(path).iter().any(|left| is_there(left)) {
                    return Table::create(path, columns, origin);
                }
                // A table that is gone is made again, and no other in its place.
                left_by(path, origin)?;
                no_stray_link(path)?;
                drop(disk::new_file(path).map_err(disk_of(path))?);
            }
            Err(error) => return Err(TableError::Disk(path.to_path_buf(), error)),
            // A device or a pipe would answer with something else, or never.
            Ok(found) if !found.is_file() => {
                let message = format!("`{}` is no ordinary file", path.display());
                return Err(TableError::Asked(message, "choose another file with `--out`".to_string()));
            }
            Ok(_) => {}
        }
        // What a link leads to is gone on with, and the link stays.
        let path = &path.canonicalize().map_err(disk_of(path))?;
        let (mut file, forbidden) = disk::known_file(path).map_err(disk_of(path))?;
        lock(&file, path)?;
        let mut text = Vec::new();
        file.read_to_end(&mut text).map_err(disk_of(path))?;
        let file = DigestedFile::known(file, forbidden, path.clone(), &text);
        let changed_origin = if text.is_empty() { left_by(path, origin)? } else { belongs(path, origin)? };
        let sums = match sums::read(path) {
            Err(Unread::Missing) if text.is_empty() => Vec::new(),
            sums => sums.map_err(|unread| silent(path, ".sums", "which tells whether its rows are whole", unread))?,
        };
        let mut table = Table::held(path, file, Found { text, sums }, columns, origin, rows)?;
        if let Some(theirs) = changed_origin {
            table.origin_changed(&theirs, origin)?;
        }
        Ok(table)
    }

    /// Goes on with what is left of a table.
    fn held(
        path: &Path,
        mut file: DigestedFile,
        found: Found,
        columns: &Columns,
        origin: &Provenance,
        rows: Rows,
    ) -> Result<Self, TableError> {
        let head = line(columns.names());
        let kept = sums::held_against(&found.text, &found.sums, &origin.key());
        let mut changed = kept.changed;
        let (are_written, is_headed) = (changed.is_empty(), !kept.lines.is_empty());
        // What the first line was is known without it.
        let (mut lines, mut reader) = (vec![Some(head.clone())], LineReader::default());
        for (number, line) in kept.lines {
            let at = if line == head { 0 } else { place(path, number, reader.cells(line), columns, rows)? };
            lines.resize(lines.len().max(at + 1), None);
            lines[at] = Some(line.to_vec());
            if are_written && number != at + 1 {
                changed.insert(number);
            }
        }
        let row = lines.len() as u64 - 1;
        let mut tail = None;
        match kept.tail {
            b"" => {}
            // Not even the first line was finished.
            of_head if !is_headed && head.starts_with(of_head) => {}
            _ if !is_headed => drop(changed.insert(1)),
            // Whether it is the row that was being written is known when that is run again.
            of_row if row < rows.count() && may_be_row(of_row, row, columns, rows) => {
                lines.push(None);
                tail = Some(Tail { row, at: found.text.len() - of_row.len() });
            }
            _ => drop(changed.insert(lines.len() + 1)),
        }
        // Into one that is complete nothing has to be written, and nothing is.
        let is_complete = lines.len() as u64 > rows.count() && lines.iter().all(Option::is_some) && changed.is_empty();
        if !is_complete {
            alone_of_name(path)?;
            file.may_grow()?;
        }
        let mut foreign = Vec::new();
        if !changed.is_empty() {
            let copies = keep(path, &[("", &found.text), (".sums", &found.sums)])?;
            foreign.push(Foreign::Lines(changed, copies));
        }
        // A table with a line has both beside it, whenever the campaign is killed.
        let [of, sums] = neighbours(path);
        if found.text.is_empty() && !is_there(&of) {
            write(origin, path)?;
        }
        if found.text.is_empty() && !is_there(&sums) {
            Sums::begin(path, origin.key())?;
        }
        let known = (0..).zip(&lines[1..]).filter_map(|(row, line)| Some((row, line.clone()?))).last();
        let state = State::Mending { file, found, lines, key: origin.key() };
        let mut table = Table { path: path.to_path_buf(), state, known, tail, foreign };
        table.mended()?;
        match &mut table.state {
            State::Adding { sums, .. } if !is_complete => sums.may_grow()?,
            _ => {}
        }
        Ok(table)
    }

    /// Goes on adding rows if all lines are known.
    fn mended(&mut self) -> Result<(), TableError> {
        let State::Mending { file, found, lines, key } = &mut self.state else { return Ok(()) };
        let Some(known) = lines.iter().map(Option::as_deref).collect::<Option<Vec<&[u8]>>>() else { return Ok(()) };
        let written = known.concat();
        // Others may have written while rows were run.
        file.is_whole()?;
        let path = beside(&self.path, ".sums");
        match sums::read(&self.path) {
            Ok(sums) if sums == found.sums => {}
            Err(Unread::Wrong(why)) => return Err(TableError::Disk(path, io::Error::other(why))),
            _ => return Err(TableError::Changed(path)),
        }
        // Whoever kills the campaign in between finds a table that is as it was, or whole, and never one that is shorter than its sums.
        let file = if found.text.starts_with(&written) {
            if found.text.len() > written.len() {
                file.file().set_len(written.len() as u64).map_err(disk_of(&self.path))?;
            }
            file.file().try_clone()
        } else {
            disk::replace(&self.path, &written)
        };
        let file = DigestedFile::new(file.map_err(disk_of(&self.path))?, self.path.clone(), &written);
        let rows = known.len() as u64 - 1;
        let sums = Sums::go_on(&self.path, key.clone(), &found.sums, known.into_iter())?;
        self.state = State::Adding { file, sums, rows };
        Ok(())
    }

    /// The origin is not as it was written, and what this campaign is of is known: it is written again.
    fn origin_changed(&mut self, theirs: &[u8], origin: &Provenance) -> Result<(), TableError> {
        let copies = keep(&self.path, &[(".origin", theirs)])?;
        write(origin, &self.path)?;
        self.foreign.push(Foreign::Provenance(copies));
        Ok(())
    }

    /// The numbers of the rows that are still to be run. The last one of the table is run again: if it comes out otherwise, this
    /// is another interpreter, whatever its version says. Then come those that were changed.
    pub fn missing(&self, rows: Rows) -> impl Iterator<Item = u64> + Clone + use<> {
        let known = self.known.as_ref().map(|(row, _)| *row);
        let (written, changed): (u64, Vec<u64>) = match &self.state {
            State::Adding { rows, .. } => (*rows, Vec::new()),
            State::Mending { lines, .. } => {
                let changed = (0..).zip(&lines[1..]).filter(|(_, line)| line.is_none()).map(|(row, _)| row);
                (lines.len() as u64 - 1, changed.collect())
            }
        };
        known.into_iter().chain(changed).chain(written..rows.count())
    }

    /// How many rows it has.
    pub fn rows(&self) -> u64 {
        match &self.state {
            State::Adding { rows, .. } => *rows,
            State::Mending { lines, .. } => lines[1..].iter().flatten().count() as u64,
        }
    }

    /// What others did to it, each once.
    pub fn take_foreign(&mut self) -> Vec<Foreign> {
        std::mem::take(&mut self.foreign)
    }

    /// Adds a row.
    pub fn add(&mut self, row: &Row) -> Result<(), TableError> {
        let line = line(&row.cells);
        if let Some((_, known)) = self.known.take() {
            if known == line {
                return Ok(());
            }
            let message = format!("seed {} gives another row today than in `{}`", row.seed, self.path.display());
            let help =
                "the interpreter is another one, or the row was changed by hand: begin anew with another `--out`";
            return Err(TableError::Asked(message, help.to_string()));
        }
        match &mut self.state {
            State::Adding { file, sums, rows } => {
                file.add(&line)?;
                sums.add(&line)?;
                *rows += 1;
            }
            State::Mending { found, lines, .. } => {
                let at = row.number;
                if let Some(tail) = self.tail.take_if(|tail| tail.row == at)
                    && !line.starts_with(&found.text[tail.at..])
                {
                    let copies = keep(&self.path, &[("", &found.text), (".sums", &found.sums)])?;
                    self.foreign.push(Foreign::Lines([at as usize + 2].into(), copies));
                }
                if let Some(missing) = lines.get_mut(at as usize + 1) {
                    *missing = Some(line);
                }
                self.mended()?;
            }
        }
        Ok(())
    }

    /// Sees to it that the disk has all that was added: an error of the last second would be told to nobody else.
    pub fn settle(&mut self) -> Result<(), TableError> {
        match &mut self.state {
            State::Adding { file, sums, .. } => file.settle().and_then(|()| sums.settle()),
            State::Mending { .. } => Ok(()),
        }
    }

    /// The same for what was added more than a second ago.
    pub fn settle_when_due(&mut self) -> Result<(), TableError> {
        match &mut self.state {
            State::Adding { file, sums, .. } => file.settle_when_due().and_then(|()| sums.settle_when_due()),
            State::Mending { .. } => Ok(()),
        }
    }

    /// What the rows come to, when all are written.
    pub fn tally(&mut self, columns: &Columns, origin: &Provenance, cases: usize) -> Result<Tallies, TableError> {
        match provenance::read(&self.path) {
            // Nobody else could put it back.
            Err(Unread::Missing) => write(origin, &self.path)?,
            Ok(there) if is_as_summed(&there) && same(&there, origin) => {}
            Ok(theirs) => self.origin_changed(&theirs, origin)?,
            Err(unread) => return Err(silent(&self.path, ".origin", MADE_FROM, unread)),
        }
        let (path, mut tallies, mut is_headed) = (&self.path, Tallies::new(cases), false);
        let add = |piece: &[u8]| {
            let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(piece);
            for row in reader.records().skip(usize::from(!std::mem::replace(&mut is_headed, true))) {
                let row = row.map_err(|error| TableError::Disk(path.clone(), error.into()))?;
                tallies.add(columns, &row.iter().collect::<Vec<_>>());
            }
            Ok(())
        };
        match &mut self.state {
            State::Adding { file, sums, .. } => {
                sums.is_whole()?;
                file.read(add)?;
            }
            State::Mending { file, .. } => file.read(add)?,
        }
        Ok(tallies)
    }
}

/// Where the row of a known line stands among the lines: an error if it is none of these.
fn place(
    path: &Path,
    number: usize,
    cells: Option<&StringRecord>,
    columns: &Columns,
    rows: Rows,
) -> Result<usize, TableError> {
    let asked = |message: String, help: String| {
        Err(TableError::Asked(message, format!("{help}, or choose another file with `--out`")))
    };
    let Some((seed, case)) = run_of(cells, columns) else {
        let message = match number {
            1 => format!("`{}` has other columns than this campaign", path.display()),
            _ => format!("`{}`, line {number}: this is no row of this campaign", path.display()),
        };
        return asked(message, "give the `--reports` that it was begun with".to_string());
    };
    match rows.order().number(seed, case).filter(|row| *row < rows.count()) {
        Some(row) => Ok(row as usize + 1),
        None => {
            let message = format!("`{}`, line {number}: this has seed {seed}", path.display());
            asked(message, format!("`--seeds {}` ends before it: ask for more seeds", rows.seeds))
        }
    }
}

/// Whether the end of a table may be a row, or the beginning of that.
fn may_be_row(tail: &[u8], row: u64, columns: &Columns, rows: Rows) -> bool {
    !tail.contains(&b'\n') || run_of(LineReader::default().cells(tail), columns) == Some(rows.order().run(row))
}

/// Keeps what was found of a table and of what lies beside it, under the first name that is free: who wrote into it may want that back.
/// A campaign that was interrupted before it had mended all has kept the same already.
fn keep(table: &Path, found: &[(&str, &[u8])]) -> Result<Vec<PathBuf>, TableError> {
    let found: Vec<_> = found.iter().filter(|(_, bytes)| !bytes.is_empty()).collect();
    let mut copy = beside(table, ".found");
    for number in 2u64.. {
        let kept: Vec<PathBuf> = found.iter().map(|(suffix, _)| beside(&copy, suffix)).collect();
        let holds = |path: &PathBuf, bytes: &[u8]| read_file(path, bytes.len() as u64).is_ok_and(|kept| kept == bytes);
        if kept.iter().zip(&found).all(|(path, (_, bytes))| holds(path, bytes)) {
            return Ok(kept);
        }
        if !is_there(&copy) && !neighbours(&copy).iter().any(|left| is_there(left)) {
            for (path, (_, bytes)) in kept.iter().zip(&found) {
                disk::keep(path, bytes).map_err(disk_of(path))?;
            }
            return Ok(kept);
        }
        copy = beside(table, &format!(".found-{number}"));
    }
    Ok(Vec::new())
}

/// The seed and the case of a row that has all columns.
fn run_of(cells: Option<&StringRecord>, columns: &Columns) -> Option<(u64, usize)> {
    columns.run(&cells?.iter().collect::<Vec<_>>())
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
