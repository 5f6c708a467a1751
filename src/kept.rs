//! The files that a run leaves: begun before its first tick, and never the reason why a mission stops.

mod folder;
mod record;

use crate::clock::Utc;
use crate::disk::whole;
use crate::message;
use albacore_session::{Run, Summary};
pub use folder::Place;
use folder::{Folder, JOURNAL, PICTURE, RECORD, Refusal, TRACE};
pub use record::{Asked, Record};
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

/// A folder of files, as far as it can be written.
pub struct Kept {
    /// `None` if nothing is wanted, or nothing can be written.
    files: Option<(Folder, Record)>,
    failed: bool,
}

/// A folder that is another run's: what is wrong, and a fix.
pub struct Taken(pub String, pub &'static str);

impl Kept {
    /// No files.
    pub fn nothing() -> Self {
        Kept { files: None, failed: false }
    }

    /// Makes the folder, or takes one that holds no run. Where nothing can be written the run is left as it is, which is said
    /// at once: who reads it can still stop the mission.
    pub fn begin(place: &Place, started: Utc, record: Record) -> Result<Self, Taken> {
        match Folder::claim(place, started) {
            Ok(folder) => {
                let mut kept = Kept { files: Some((folder, record)), failed: false };
                let written = kept.write_record();
                kept.tell(written);
                Ok(kept)
            }
            Err(Refusal::Taken(what, help)) => Err(Taken(what, help)),
            Err(Refusal::Disk(path, error)) => {
                let help = "the mission goes on without; choose another folder with `--out`, or `--no-out`";
                message::error(&format!("`{}` cannot be written: {error}", path.display()), Some(help));
                Ok(Kept { files: None, failed: true })
            }
        }
    }

    /// The journal's file, empty. It is not buffered: what the program has written survives the program.
    pub fn journal(&mut self) -> Option<File> {
        let (folder, _) = self.files.as_ref()?;
        match folder.journal.try_clone() {
            Ok(file) => Some(file),
            Err(error) => {
                message::write(&self.journal_failed(&error));
                None
            }
        }
    }

    /// The journal can be written no further; gives what to tell.
    pub fn journal_failed(&mut self, error: &io::Error) -> String {
        self.failed = true;
        let help = "the mission goes on without; what the journal holds up to here can be read";
        message::error_text(&format!("`{}` cannot be written: {error}", self.journal_path().display()), Some(help))
    }

    /// The disk takes no more of the journal; gives what to tell.
    pub fn journal_stalled(&mut self) -> String {
        self.failed = true;
        let text = format!("`{}` is cut short: the disk has taken nothing for 3 s", self.journal_path().display());
        message::error_text(&text, Some("what it holds up to there can be read; the vehicle was given back before"))
    }

    fn journal_path(&self) -> PathBuf {
        self.path().unwrap_or(Path::new("")).join(JOURNAL)
    }

    /// The mission's clock runs.
    pub fn ticks(&mut self) {
        if let Some((_, record)) = &mut self.files {
            record.ticks();
        }
    }

    /// Writes trace and picture, and how it ended; gives the picture's path.
    pub fn finish(&mut self, run: &Run, summary: &Summary) -> Option<PathBuf> {
        let (folder, record) = self.files.as_mut()?;
        record.ends(summary);
        let picture = folder.path.join(PICTURE);
        let trace = whole(&folder.path.join(TRACE), &run.trace().to_string());
        let written = trace.and_then(|()| whole(&picture, &run.svg()));
        // How it ended is told, whatever became of the others.
        let recorded = self.write_record();
        self.tell(written.and(recorded)).then_some(picture)
    }

    /// The run's folder, if it has one.
    pub fn path(&self) -> Option<&Path> {
        self.files.as_ref().map(|(folder, _)| folder.path.as_path())
    }

    /// Whether something that was wanted could not be written.
    pub fn has_failed(&self) -> bool {
        self.failed
    }

    fn write_record(&self) -> io::Result<()> {
        let Some((folder, record)) = &self.files else { return Ok(()) };
        whole(&folder.path.join(RECORD), &(serde_json::to_string_pretty(record)? + "\n"))
    }

    /// Says what could not be written; whether all was.
    fn tell(&mut self, written: io::Result<()>) -> bool {
        let Err(error) = written else { return true };
        let path = self.path().unwrap_or(Path::new(""));
        message::error(&format!("`{}` cannot be written: {error}", path.display()), None);
        self.failed = true;
        false
    }
}
