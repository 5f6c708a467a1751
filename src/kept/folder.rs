//! The folder of one run: whoever creates the journal in it has it, and has it alone.

use crate::clock::Utc;
use crate::disk;
use std::fs::{File, TryLockError};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// All that a run leaves.
pub const JOURNAL: &str = "journal";
/// What the run was of, and what became of it.
pub const RECORD: &str = "run.json";
/// What the mission did.
pub const TRACE: &str = "trace.txt";
/// Where it went.
pub const PICTURE: &str = "run.svg";

const FILES: [&str; 4] = [JOURNAL, RECORD, TRACE, PICTURE];

/// Where runs go of which nobody says where.
const RUNS: &str = "albacore-runs";

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

/// A folder that is ours, with an empty journal.
pub struct Folder {
    /// Where it is.
    pub path: PathBuf,
    /// The journal; closed with the last of its handles, and until then nobody can replace this run.
    pub journal: File,
    /// The journal of the run that was replaced: who waits to replace that one too finds it locked.
    _replaced: Option<File>,
}

/// Why a folder is not ours.
pub enum Refusal {
    /// What was asked for cannot be: what is wrong, and a fix.
    Taken(String, &'static str),
    /// The disk will not have it.
    Disk(PathBuf, io::Error),
}

impl Folder {
    /// Makes the folder, or takes it, for a run that started at a time.
    pub fn claim(place: &Place, started: Utc) -> Result<Self, Refusal> {
        match place {
            Place::New(mission) => {
                let runs = Path::new(RUNS).join(mission);
                let path = disk::new_folder(&runs, &started.file_name()).map_err(|e| Refusal::Disk(runs, e))?;
                let journal = begun(&path)?;
                Ok(Folder { path, journal, _replaced: None })
            }
            Place::Named { folder, replace } => named(folder, *replace),
        }
    }
}

fn named(folder: &Path, replace: bool) -> Result<Folder, Refusal> {
    let failed = |error| Refusal::Disk(folder.to_path_buf(), error);
    std::fs::create_dir_all(folder).map_err(failed)?;
    let holds_a_run = FILES.iter().any(|name| folder.join(name).symlink_metadata().is_ok());
    if holds_a_run && !replace {
        return Err(taken(folder));
    }
    let replaced = if holds_a_run { removed(folder)? } else { None };
    let journal = begun(folder)?;
    // From here on the folder is ours.
    [RECORD, TRACE, PICTURE].iter().try_for_each(|name| disk::remove(&folder.join(name))).map_err(failed)?;
    Ok(Folder { path: folder.to_path_buf(), journal, _replaced: replaced })
}

/// Removes the journal of an earlier run, and gives it, locked; a run that still writes it is not to be replaced.
fn removed(folder: &Path) -> Result<Option<File>, Refusal> {
    let path = folder.join(JOURNAL);
    let failed = |error| Refusal::Disk(path.clone(), error);
    let Ok(there) = path.symlink_metadata() else { return Ok(None) };
    let journal = if there.is_file() { Some(disk::old_file(&path).map_err(failed)?) } else { None };
    journal.as_ref().map_or(Ok(()), |journal| lock(journal, folder))?;
    disk::remove(&path).map_err(failed)?;
    Ok(journal)
}

/// Creates the journal: of several runs that do so at once, one succeeds.
fn begun(folder: &Path) -> Result<File, Refusal> {
    let path = folder.join(JOURNAL);
    let journal = match disk::new_file(&path) {
        Ok(journal) => journal,
        Err(error) if error.kind() == ErrorKind::AlreadyExists => return Err(taken(folder)),
        Err(error) => return Err(Refusal::Disk(path, error)),
    };
    lock(&journal, folder)?;
    Ok(journal)
}

/// A lock ends with its process, however that ends. Where a disk knows no locks, nothing is said.
fn lock(journal: &File, folder: &Path) -> Result<(), Refusal> {
    match journal.try_lock() {
        Err(TryLockError::WouldBlock) => {
            let message = format!("another run is writing into `{}`", folder.display());
            Err(Refusal::Taken(message, "choose another folder with `--out`, or wait for its end"))
        }
        _ => Ok(()),
    }
}

fn taken(folder: &Path) -> Refusal {
    let message = format!("`{}` holds a run already", folder.display());
    Refusal::Taken(message, "choose another folder with `--out`, or give `--replace` to remove that run's files")
}
