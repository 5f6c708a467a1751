//! The folder of one run: whoever creates the journal in it has it, and has it alone.

use super::record::{ToldDigests, is_record};
use crate::clock::Utc;
use crate::disk::{self, Reserved};
use crate::exit::Exit;
use crate::report::REPORT;
use albacore_session::{RUN_FILES, is_journal, is_journal_as_left, read_file};
use std::fs::{File, TryLockError};
use std::io::{self, ErrorKind, Read, Seek};
use std::path::{Path, PathBuf};

/// All that a run leaves.
pub const JOURNAL: &str = "journal";
/// What the run was of, and what became of it.
pub const RECORD: &str = "run.json";

/// All that it leaves but its journal.
fn beside_journal() -> impl Iterator<Item = &'static str> + Clone {
    std::iter::once(RECORD).chain(RUN_FILES.iter().map(|file| file.name))
}

/// Where runs go of which nobody says where.
const RUNS: &str = "albacore-runs";

/// So many bytes are kept for what the record does not say before the end.
const RECORD_MORE: usize = 4096;

/// No file beside a journal has more bytes.
pub const LEFT_BYTES_MAX: u64 = 1 << 30;

const ELSEWHERE: &str = "move it away, or choose another folder with `--out`";

/// Where a run's files go.
pub enum Place {
    /// A new folder below `albacore-runs`, for a mission.
    New(String),
    /// A folder that was named; `replace` takes it from the run that is in it.
    Named {
        /// The folder, which need not be there.
        folder: PathBuf,
        /// Whether an earlier run's files may be removed.
        replace: bool,
    },
}

/// A folder that is ours, with an empty journal and the record of a run that begins.
pub struct Folder {
    /// Where it is.
    pub path: PathBuf,
    /// The journal; closed with the last of its handles, and until then nobody can replace this run.
    pub journal: File,
    /// The record.
    pub record: Reserved,
}

/// Removes a file of an earlier run, as [`disk::remove`] does.
type Remove<'a> = &'a mut dyn FnMut(&Path) -> io::Result<()>;

/// Why a folder is not ours: what is wrong, a fix, and how the program ends.
pub struct Refusal(pub String, pub &'static str, pub Exit);

/// Whether a path is one of the files that a run leaves, in a folder that a run has.
pub fn is_of_a_run(path: &Path) -> bool {
    let has = |name: &str| path.with_file_name(name).symlink_metadata().is_ok();
    path.file_name().is_some_and(|name| beside_journal().any(|file| name == file) || name == JOURNAL)
        && (has(JOURNAL) || has(RECORD))
}

impl Folder {
    /// Makes the folder, or takes it, for a run that started at a time.
    pub fn claim(place: &Place, started: Utc, record: &str) -> Result<Self, Refusal> {
        Folder::claim_by(&mut disk::remove, place, started, record)
    }

    fn claim_by(remove: Remove, place: &Place, started: Utc, record: &str) -> Result<Self, Refusal> {
        let (path, is_new) = match place {
            Place::New(mission) => {
                let runs = Path::new(RUNS).join(mission);
                (disk::new_folder(&runs, &started.file_name()).map_err(|error| unwritable(&runs, &error))?, true)
            }
            Place::Named { folder, replace } => {
                let is_new = !folder.exists();
                std::fs::create_dir_all(folder).map_err(|error| unwritable(folder, &error))?;
                make_room(remove, folder, *replace)?;
                (folder.clone(), is_new)
            }
        };
        let claimed = begun(&path).and_then(|journal| match Reserved::new(&path.join(RECORD), record, RECORD_MORE) {
            Ok(record) => Ok(Folder { path: path.clone(), journal, record }),
            Err(error) => {
                let _ = disk::remove(&path.join(JOURNAL));
                Err(unwritable(&path, &error))
            }
        });
        if claimed.is_err() && is_new {
            let _ = disk::remove_empty(&path);
        }
        claimed
    }

    /// Whether its path leads to its journal still, and with that to the folder: whoever moved or removed them may have put others
    /// there.
    pub fn is_there(&self) -> bool {
        disk::is_at(&self.journal, &self.path.join(JOURNAL)).unwrap_or(false)
    }

    /// What the journal holds, where that is what the run wrote, as far as it was written. An error where it cannot be read.
    pub fn whole_journal(&self) -> io::Result<Option<Vec<u8>>> {
        let mut bytes = Vec::new();
        File::open(self.path.join(JOURNAL))?.read_to_end(&mut bytes)?;
        let is_whole = is_journal(bytes.as_slice())? && is_journal_as_left(&bytes);
        Ok(is_whole.then_some(bytes))
    }

    /// The files that are written as the run goes on, and where they should be.
    pub fn names(&self) -> io::Result<[(File, PathBuf); 2]> {
        let at = |name: &str| self.path.join(name);
        Ok([(self.journal.try_clone()?, at(JOURNAL)), (self.record.file()?, at(RECORD))])
    }

    /// Whether its path leads to its record still.
    pub fn is_recorded(&self) -> bool {
        self.record.is_at(&self.path.join(RECORD))
    }
}

/// Sees to it that a folder holds none of a run's files: with `replace` an earlier run is removed, and nothing that no run left so.
fn make_room(remove: Remove, folder: &Path, replace: bool) -> Result<(), Refusal> {
    let is_there = |name: &&str| folder.join(name).symlink_metadata().is_ok();
    // Whoever begins a run creates its journal first, and whoever replaces one removes that last.
    if !is_there(&JOURNAL) {
        return beside_journal().find(|name| is_there(name)).map_or(Ok(()), |name| Err(alone(&folder.join(name))));
    }
    let path = folder.join(JOURNAL);
    if !path.is_file() || path.is_symlink() {
        return Err(foreign(&path));
    }
    let mut journal = match disk::old_file(&path) {
        // Another has removed it since: whoever creates the next one has the folder.
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(()),
        journal => journal.map_err(|error| unwritable(&path, &error))?,
    };
    let unread = |error| unreadable(&path, &error);
    if !is_journal(&mut journal).map_err(unread)? {
        return Err(foreign(&path));
    }
    if !replace {
        return Err(taken(folder));
    }
    own(&journal, folder)?;
    let mut bytes = Vec::new();
    journal.rewind().and_then(|()| journal.read_to_end(&mut bytes)).map_err(unread)?;
    // A run that was killed, or goes on where no lock tells it, has told no digest of its journal.
    let told = ToldDigests::read(&folder.join(RECORD));
    let is_another = told.tells(JOURNAL) && !told.is_of_the_run(JOURNAL, &bytes);
    if is_another || !is_journal_as_left(&bytes) {
        return Err(foreign(&path));
    }
    // What is not to be removed is said before anything is.
    if let Some(name) = beside_journal().find(|name| is_there(name) && !is_left(&folder.join(name), &told)) {
        return Err(foreign(&folder.join(name)));
    }
    // The page that was made of this run would be taken for one of the next.
    let report = folder.join(REPORT);
    if report.symlink_metadata().is_ok_and(|there| there.is_file()) && disk::spare(&report).is_ok() {
        remove(&report).map_err(|error| unwritable(&report, &error))?;
    }
    // Whoever ends this in between finds no record beside another journal, and the record as long as there is anything that it alone tells to
    // be the run's.
    let done = RUN_FILES.iter().map(|file| file.name).chain([RECORD, JOURNAL]).try_for_each(|name| {
        let path = folder.join(name);
        remove(&path).map_err(|error| unwritable(&path, &error))
    });
    // Locked until it is gone: what has its name from then on is another's.
    drop(journal);
    done
}

/// Whether a file beside a journal is as the run has left it.
fn is_left(path: &Path, told: &ToldDigests) -> bool {
    let is_file = path.symlink_metadata().is_ok_and(|there| there.is_file());
    let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    let is_of_the_run = || read_file(path, LEFT_BYTES_MAX).is_ok_and(|bytes| told.is_of_the_run(name, &bytes));
    is_file && if name == RECORD { is_record(path) } else { is_of_the_run() }
}

/// Creates the journal: of several runs that do so at once, one succeeds.
fn begun(folder: &Path) -> Result<File, Refusal> {
    let path = folder.join(JOURNAL);
    let journal = match disk::new_file(&path) {
        Ok(journal) => journal,
        Err(error) if error.kind() == ErrorKind::AlreadyExists => return Err(taken(folder)),
        Err(error) => return Err(unwritable(&path, &error)),
    };
    own(&journal, folder)?;
    Ok(journal)
}

/// Locks a journal: who has the lock on what is the folder's journal by then has the folder. It ends with its process, however
/// that ends. Where a disk knows no locks, nothing is said.
fn own(journal: &File, folder: &Path) -> Result<(), Refusal> {
    let is_locked = !matches!(journal.try_lock(), Err(TryLockError::WouldBlock));
    // Between its opening and its locking another run may have replaced it, and be over.
    if is_locked && disk::is_at(journal, &folder.join(JOURNAL)).unwrap_or(false) {
        return Ok(());
    }
    let message = format!("another run is writing into `{}`", folder.display());
    Err(Refusal(message, "choose another folder with `--out`, or wait for its end", Exit::Usage))
}

fn taken(folder: &Path) -> Refusal {
    let message = format!("`{}` holds a run already", folder.display());
    Refusal(message, "choose another folder with `--out`, or give `--replace` to remove that run's files", Exit::Usage)
}

fn foreign(path: &Path) -> Refusal {
    let message = format!("`{}` is there already, and is not as a run left it", path.display());
    Refusal(message, ELSEWHERE, Exit::Usage)
}

/// A file that no journal tells to be a run's.
fn alone(path: &Path) -> Refusal {
    let message =
        format!("`{}` is there already, and beside it no `{JOURNAL}` of the run that left it", path.display());
    Refusal(message, ELSEWHERE, Exit::Usage)
}

/// The disk will not have it.
pub fn unwritable(path: &Path, error: &io::Error) -> Refusal {
    let message = disk::not_written(path, error);
    Refusal(message, "choose another folder with `--out`, or run without files with `--no-out`", Exit::Failed)
}

/// Nobody knows whose it is.
fn unreadable(path: &Path, error: &io::Error) -> Refusal {
    Refusal(format!("`{}` is there already, and cannot be read: {error}", path.display()), ELSEWHERE, Exit::Failed)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whoever is killed while he replaces a run leaves nothing of it beside another journal, and the record as long as there is anything that it
    /// alone tells to be the run's.
    #[test]
    fn a_run_is_replaced_from_its_record_to_its_journal() {
        for allowed in 0..2 + RUN_FILES.len() {
            let folder = tempfile::tempdir().unwrap();
            // As they are when they have just been created.
            let files = || beside_journal().chain([JOURNAL]);
            files().for_each(|name| std::fs::write(folder.path().join(name), "").unwrap());
            let mut removed = 0;
            let mut remove = |path: &Path| {
                let old: Vec<&str> = files().filter(|name| folder.path().join(name).exists()).collect();
                assert!(old.contains(&JOURNAL), "after {removed}: {old:?}");
                assert!(old.contains(&RECORD) || old == [JOURNAL], "after {removed}: {old:?}");
                removed += 1;
                if removed > allowed { Err(ErrorKind::PermissionDenied.into()) } else { disk::remove(path) }
            };
            let place = Place::Named { folder: folder.path().to_path_buf(), replace: true };
            assert!(Folder::claim_by(&mut remove, &place, Utc::now(), "new").is_err());
            assert_eq!(removed, allowed + 1);
        }
    }
}
