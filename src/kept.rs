//! The files that a run leaves: begun before its first tick, and never the reason why a mission stops.

use crate::disk::{self, whole};
use crate::message;
use albacore_session::Run;
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

/// A folder of files, as far as it can be written.
pub struct Kept {
    /// `None` if nothing is wanted, or nothing can be written.
    folder: Option<PathBuf>,
    failed: bool,
}

impl Kept {
    /// No files.
    pub fn nothing() -> Self {
        Kept { folder: None, failed: false }
    }

    /// Makes the folder. Without it the run is left as it is, which is said at once: who reads it can still stop the mission.
    pub fn begin(folder: PathBuf) -> Self {
        match std::fs::create_dir_all(&folder).and_then(|()| forget(&folder)) {
            Ok(()) => Kept { folder: Some(folder), failed: false },
            Err(error) => {
                let help = "the mission goes on without; choose another folder with `--out`, or `--no-out`";
                message::error(&format!("`{}` cannot be written: {error}", folder.display()), Some(help));
                Kept { folder: None, failed: true }
            }
        }
    }

    /// The journal's file, empty. It is not buffered: what the program has written survives the program.
    pub fn journal(&mut self) -> Option<File> {
        let path = self.folder.as_ref()?.join("journal");
        match disk::new_file(&path) {
            Ok(file) => Some(file),
            Err(error) => {
                self.journal_failed(&error);
                None
            }
        }
    }

    /// The journal can be written no further.
    pub fn journal_failed(&mut self, error: &io::Error) {
        let path = self.folder.as_deref().unwrap_or(Path::new("")).join("journal");
        let help = "the mission goes on without; what the journal holds up to here can be read";
        message::error(&format!("`{}` cannot be written: {error}", path.display()), Some(help));
        self.failed = true;
    }

    /// Writes trace and picture; gives the picture's path.
    pub fn finish(&mut self, run: &Run) -> Option<PathBuf> {
        let folder = self.folder.as_ref()?;
        let picture = folder.join("run.svg");
        let written =
            whole(&folder.join("trace.txt"), &run.trace().to_string()).and_then(|()| whole(&picture, &run.svg()));
        match written {
            Ok(()) => Some(picture),
            Err(error) => {
                message::error(&format!("`{}` cannot be written: {error}", folder.display()), None);
                self.failed = true;
                None
            }
        }
    }

    /// Whether something that was wanted could not be written.
    pub fn has_failed(&self) -> bool {
        self.failed
    }
}

/// Removes what an earlier run has left here: if this one is killed, its journal must not lie beside another run's trace.
fn forget(folder: &Path) -> io::Result<()> {
    for name in ["journal", "trace.txt", "run.svg"] {
        disk::remove(&folder.join(name))?;
    }
    Ok(())
}
