//! The files beside a table, `.origin` and `.sums`: which campaign they are of, and what is said of those that are of no table.

use super::provenance::{self, Provenance, Unread, beside};
use super::sums;
use super::table::TableError;
use crate::disk;
use crate::made::is_as_summed;
use std::fs::{File, TryLockError};
use std::path::{Path, PathBuf};

/// The files that lie beside a table.
pub(super) fn neighbours(table: &Path) -> [PathBuf; 2] {
    [".origin", ".sums"].map(|suffix| beside(table, suffix))
}

pub(super) fn write(origin: &Provenance, table: &Path) -> Result<(), TableError> {
    origin.write(table).map_err(|error| TableError::Disk(beside(table, ".origin"), error))
}

pub(super) fn is_there(path: &Path) -> bool {
    path.symlink_metadata().is_ok()
}

pub(super) fn no_stray_link(path: &Path) -> Result<(), TableError> {
    if !path.is_symlink() || path.exists() {
        return Ok(());
    }
    let message = format!("`{}` is there already: a link that leads nowhere", path.display());
    Err(TableError::Asked(message, "remove it, or choose another file with `--out`".to_string()))
}

/// Says what lies beside a table of which nothing is left.
pub(super) fn alone(table: &Path) -> TableError {
    let [of, sums] = neighbours(table);
    let (left, why, again) = match (is_there(&of), sums::are_sums(table)) {
        (_, false) => (sums, "holds no checksums of a table", ""),
        (true, true) => {
            (of, "nothing is left of its table", "with `--resume` the same campaign makes the table again; or ")
        }
        (false, true) => (sums, "nothing is left of its table and its `.origin`", ""),
    };
    let message = format!("`{}` is there already, and {why}", left.display());
    TableError::Asked(message, format!("{again}move it away, or choose another file with `--out`"))
}

/// A table that is gone, or empty, is made again where what lies beside it is its own, and no other in its place. Gives the origin if it
/// is not as it was written.
pub(super) fn left_by(path: &Path, origin: &Provenance) -> Result<Option<Vec<u8>>, TableError> {
    let [of, sums] = neighbours(path);
    let changed = if is_there(&of) { belongs(path, origin)? } else { None };
    if is_there(&sums) && !(is_there(&of) && sums::are_sums(path)) { Err(alone(path)) } else { Ok(changed) }
}

/// What is written into a table that is gone on with would be in a backup, too, that is another name of it or of what lies beside it.
pub(super) fn alone_of_name(path: &Path) -> Result<(), TableError> {
    let [of, sums] = neighbours(path);
    if sums.is_symlink() {
        let message = format!("`{}` is a link, and a row is written into the file itself", sums.display());
        return Err(TableError::Asked(message, "put the file that it leads to in its place".to_string()));
    }
    let Some(linked) = [path, &of, &sums].into_iter().find(|path| disk::names(path) > 1) else { return Ok(()) };
    let message = format!("`{}` has another name (a hard link), under which it would be changed too", linked.display());
    Err(TableError::Asked(
        message,
        "go on with a copy of the table, its `.origin` and its `.sums` as `--out`".to_string(),
    ))
}

/// Two campaigns must not write one file. Where a disk knows no locks, nothing is said.
pub(super) fn lock(file: &File, path: &Path) -> Result<(), TableError> {
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => {
            let message = format!("another campaign is writing `{}`", path.display());
            Err(TableError::Asked(message, "wait for its end, or choose another file with `--out`".to_string()))
        }
        _ => Ok(()),
    }
}

/// Says that a file beside a table does not tell what it should.
pub(super) fn silent(table: &Path, suffix: &str, what: &str, unread: Unread) -> TableError {
    let message = match unread {
        Unread::Missing => format!("`{}` has no `{suffix}` beside it, {what}", table.display()),
        Unread::Wrong(error) => format!("`{}{suffix}`, {what}, cannot be read: {error}", table.display()),
    };
    TableError::Asked(message, "put that back as it was, or begin anew with another `--out`".to_string())
}

/// What a table's origin is.
pub(super) const MADE_FROM: &str = "which tells what it was made from";

/// An error if this campaign is not the one that the table was begun by. Gives the origin if it says the same, and is not as it was
/// written.
pub(super) fn belongs(path: &Path, origin: &Provenance) -> Result<Option<Vec<u8>>, TableError> {
    let silent = |unread| silent(path, ".origin", MADE_FROM, unread);
    let bytes = provenance::read(path).map_err(silent)?;
    let problem = Provenance::of(&bytes).map_err(silent)?.difference(origin);
    match problem {
        None if is_as_summed(&bytes) => Ok(None),
        None => Ok(Some(bytes)),
        Some(problem) if is_as_summed(&bytes) => {
            let help = "a table holds one campaign: give what it was begun with, or choose another file with `--out`";
            Err(TableError::Asked(format!("`{}` {problem}", path.display()), help.to_string()))
        }
        Some(problem) => {
            let why = format!("it was changed since it was written, and says that the table {problem}");
            Err(silent(Unread::Wrong(why)))
        }
    }
}

/// Whether an origin is that of this campaign.
pub(super) fn same(bytes: &[u8], origin: &Provenance) -> bool {
    Provenance::of(bytes).is_ok_and(|there| there.difference(origin).is_none())
}
