//! The files that a run leaves: begun before its first tick, and never the reason why a mission stops.

mod folder;
mod record;

use crate::clock::Utc;
use crate::disk::whole;
use crate::exit::Exit;
use crate::message;
use albacore_session::{Run, Summary};
pub use folder::Place;
use folder::{Folder, JOURNAL, PICTURE, Refusal, TRACE};
pub use record::{Asked, Record};
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

/// The files of a run.
pub struct Kept {
    /// `None` if nothing is wanted.
    files: Option<(Folder, Record)>,
    failed: bool,
}

/// What a run has left, as far as it has.
#[derive(Default)]
pub struct Left {
    /// Its folder.
    pub folder: Option<PathBuf>,
    /// Its picture.
    pub picture: Option<PathBuf>,
}

impl Kept {
    /// No files.
    pub fn nothing() -> Self {
        Kept { files: None, failed: false }
    }

    /// Makes the folder, or takes one that holds no run. Where that cannot be it is said, and nothing is begun: no vehicle has been
    /// told anything yet.
    pub fn begin(place: &Place, started: Utc, mut record: Record) -> Result<Self, Exit> {
        let refused = |Refusal(what, help, exit)| {
            message::error(&what, Some(help));
            exit
        };
        // The first text of a record is as long as it is.
        let text = record.json(usize::MAX).map_err(io::Error::from);
        let text = text.map_err(|error| refused(folder::unwritable(Path::new(folder::RECORD), &error)))?;
        let folder = Folder::claim(place, started, &text).map_err(refused)?;
        Ok(Kept { files: Some((folder, record)), failed: false })
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

    /// Writes how it ended, trace and picture. The record is the first, and has room on a disk that is full: how a mission ended is
    /// told, whatever becomes of the others.
    pub fn finish(&mut self, run: &Run, summary: &Summary) -> Left {
        let Some((folder, record)) = self.files.as_mut() else { return Left::default() };
        record.ends(summary);
        let room = folder.record.room();
        let recorded = record.json(room).map_err(io::Error::from).and_then(|text| folder.record.finish(&text));
        let (path, is_there) = (folder.path.clone(), folder.is_there());
        let is_recorded = self.tell(recorded);
        if !is_there {
            let message = format!("`{}` is not this run's folder any more: it was moved or removed", path.display());
            let help = "trace and picture were not written; `run.json` and the journal are where the folder is now, if anywhere";
            message::error(&message, Some(help));
            self.failed = true;
            return Left::default();
        }
        let picture = path.join(PICTURE);
        let written = whole(&path.join(TRACE), &run.trace().to_string()).and_then(|()| whole(&picture, &run.svg()));
        let is_written = self.tell(written) && is_recorded;
        Left { folder: Some(path), picture: is_written.then_some(picture) }
    }

    /// The run's folder, if it has one.
    pub fn path(&self) -> Option<&Path> {
        self.files.as_ref().map(|(folder, _)| folder.path.as_path())
    }

    /// Whether something that was wanted could not be written.
    pub fn has_failed(&self) -> bool {
        self.failed
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
