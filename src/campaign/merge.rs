//! `albacore campaign merge`: the tables of shards become one, the same bytes as of one campaign over all their seeds.

use super::neighbours::{self, is_there};
use super::seeds::Seeds;
use super::sums::Sums;
use super::table::TableError;
use super::written::{Unusable, WrittenTable};
use crate::disk;
use crate::exit::Exit;
use crate::{interruption, message, output};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

/// Put the tables of shards together.
///
/// The parts are tables of one campaign over seeds that follow one another, such as `--shard 1/8` to `--shard 8/8` wrote. The table
/// that comes of them, with its `.origin` and its `.sums`, has the same bytes as that of one process over all seeds, and can be gone on with by
/// `albacore campaign --resume`. Parts that leave seeds out, have some twice, or are of different missions, worlds, parameters or versions
/// are refused.
#[derive(clap::Args)]
pub struct Merge {
    /// The tables, in any order.
    #[arg(value_name = "PART.csv", required = true)]
    parts: Vec<PathBuf>,
    /// The table to write.
    #[arg(long, value_name = "FILE.csv")]
    out: PathBuf,
    /// The seeds that it must have: of parts that end before the last nothing else can tell.
    #[arg(long, value_name = "A..B", allow_hyphen_values = true)]
    seeds: Option<Seeds>,
}

/// What to do about rows that are missing.
const GO_ON: &str = "run what is missing: the campaign of a part goes on with `--resume`";

impl Merge {
    /// Writes the table, or says why not.
    pub fn run(&self) -> Exit {
        let read = || {
            let mut parts = self.parts.iter().map(|part| WrittenTable::read(part)).collect::<Result<Vec<_>, _>>()?;
            parts.sort_by_key(WrittenTable::first);
            self.belong_together(&parts)?;
            Ok(parts)
        };
        let merged = read().and_then(|parts: Vec<WrittenTable>| self.write(&parts).map(|()| parts));
        match merged {
            Ok(parts) => {
                let rows: usize = parts.iter().map(|part| part.rows.len()).sum();
                let seeds = parts.first().zip(parts.last()).map(|(first, last)| (first.first(), last.last()));
                let (first, last) = seeds.unwrap_or_default();
                output::print(&format!("{rows} rows, seeds {first}..{last}, in {}\n", self.out.display()));
                Exit::Well
            }
            Err((message, help)) => {
                message::error(&message, Some(&help));
                Exit::Usage
            }
        }
    }

    /// An error if parts, in the order of their seeds, are not of one campaign, each seed once.
    fn belong_together(&self, parts: &[WrittenTable]) -> Result<(), Unusable> {
        let Some(first) = parts.first() else { return Ok(()) };
        let name = |part: &WrittenTable| part.path.display().to_string();
        for part in parts {
            if let Some(difference) = part.origin.other_campaign(&first.origin) {
                let message = format!("`{}` {difference}, as `{}` was", name(part), name(first));
                return Err((message, "merge the parts of one campaign".to_string()));
            }
            if part.head != first.head {
                let message = format!("`{}` has other columns than `{}`", name(part), name(first));
                return Err((message, "give each part the same `--reports`".to_string()));
            }
            if !part.is_even() {
                let message = format!("`{}` ends before it has all cases of seed {}", name(part), part.last());
                return Err((message, GO_ON.to_string()));
            }
        }
        let seeds = |first: u64, last: u64| {
            if first == last { format!("seed {first} is") } else { format!("seeds {first}..{last} are") }
        };
        for pair in parts.windows(2) {
            let (before, after) = (&pair[0], &pair[1]);
            if after.first() <= before.last() {
                let twice = seeds(after.first(), before.last().min(after.last()));
                let message = format!("{twice} in `{}` and in `{}`", name(before), name(after));
                return Err((message, "name each part once".to_string()));
            }
            if after.first() > before.last() + 1 {
                let missing = seeds(before.last() + 1, after.first() - 1);
                return Err((
                    format!("{missing} in no part, between `{}` and `{}`", name(before), name(after)),
                    GO_ON.to_string(),
                ));
            }
        }
        let (Some(wanted), Some(last)) = (self.seeds, parts.last()) else { return Ok(()) };
        if first.first() > wanted.first {
            return Err((format!("{} in no part", seeds(wanted.first, first.first() - 1)), GO_ON.to_string()));
        }
        if last.last() < wanted.last {
            let message = format!("{} in no part: `{}` ends before", seeds(last.last() + 1, wanted.last), name(last));
            return Err((message, GO_ON.to_string()));
        }
        if first.first() < wanted.first || last.last() > wanted.last {
            let message = format!("the parts have seeds {}..{}, not {wanted}", first.first(), last.last());
            return Err((message, "name the parts of these seeds alone".to_string()));
        }
        Ok(())
    }

    /// Writes the three files. Whoever writes to that name at once, another merge or a campaign, finds that it is there: the table is begun
    /// first, and nobody else's file is touched.
    fn write(&self, parts: &[WrittenTable]) -> Result<(), Unusable> {
        let Some(first) = parts.first() else { return Ok(()) };
        let out = self.out.as_path();
        let mut files = std::iter::once(out.to_path_buf()).chain(neighbours::neighbours(out));
        if let Some(there) = files.find(|path| is_there(path)) {
            return Err(is_there_already(&there));
        }
        // Who interrupts finds all three, or none.
        let _held = interruption::held();
        let mut table = match disk::new_file(out) {
            Err(error) if error.kind() == ErrorKind::AlreadyExists => return Err(is_there_already(out)),
            table => table.map_err(|error| not_written(out, TableError::Disk(out.to_path_buf(), error)))?,
        };
        let lines = || {
            let rows = parts.iter().flat_map(|part| &part.rows).map(|row| row.line.as_slice());
            std::iter::once(first.head.as_slice()).chain(rows)
        };
        let origin = &first.origin;
        // Whoever goes on with what is there already owns it from here on.
        neighbours::lock(&table, out).map_err(|error| not_written(out, error))?;
        let written =
            neighbours::write(origin, out).and_then(|()| Sums::go_on(out, origin.key(), &[], lines())).and_then(|_| {
                let bytes = lines().collect::<Vec<_>>().concat();
                let added = table.write_all(&bytes).and_then(|()| table.sync_all());
                added.map_err(|error| TableError::Disk(out.to_path_buf(), error))
            });
        written.map_err(|error| {
            std::iter::once(out.to_path_buf())
                .chain(neighbours::neighbours(out))
                .for_each(|left| drop(disk::remove(&left)));
            not_written(out, error)
        })
    }
}

fn is_there_already(path: &Path) -> Unusable {
    let help = "choose another file with `--out`; what a merge has left that was killed can be removed";
    (format!("`{}` is there already", path.display()), help.to_string())
}

fn not_written(out: &Path, error: TableError) -> Unusable {
    let message = match error {
        TableError::Disk(path, error) => disk::not_written(&path, &error),
        TableError::Asked(message, _) => message,
        TableError::Gone(path) | TableError::Changed(path) => {
            format!("`{}` was changed by another program", path.display())
        }
    };
    (message, format!("nothing is left of `{}`: choose another file with `--out`, or make room", out.display()))
}
