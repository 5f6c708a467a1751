//! The files that a run leaves: begun before its first tick, and never the reason why a mission stops.

mod folder;
mod record;
mod watch;

use crate::clock::Utc;
use crate::disk;
use crate::exit::Exit;
use crate::message;
use crate::synced::WRITTEN_INTO;
use albacore_session::{PICTURE, Run, RunFile, Summary, TRACE};
use folder::{Folder, Refusal};
pub use folder::{JOURNAL, LEFT_BYTES_MAX, Place, RECORD, is_of_a_run};
pub use record::{Record, RunRequest, told};
use std::fmt::Display;
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;
use watch::Watch;

/// The files of a run.
pub struct RunFolder {
    /// `None` if nothing is wanted.
    files: Option<(Folder, Record)>,
    failed: bool,
}

/// What a run has left, as far as it has.
#[derive(Default)]
pub struct Left {
    /// Its folder.
    pub folder: Option<PathBuf>,
    /// The names of the files in it that were written whole, beside journal and record.
    files: Vec<&'static str>,
    /// What could not be written.
    troubles: Vec<Trouble>,
}

/// What went wrong with a file, and what to do.
type Trouble = (String, Option<String>);

impl Left {
    /// What nobody knows of: the disk holds whoever writes.
    pub fn unknown(folder: Option<PathBuf>, waited: Duration) -> Self {
        let seconds = waited.as_secs();
        let what =
            format!("`run.json` and what else is left at the end are not on the disk after {seconds} s: it is stalled");
        let help = "`run.json` may say for ever that the run goes on; how it ended is said here alone";
        Left { folder, files: Vec::new(), troubles: vec![(what, Some(help.into()))] }
    }

    /// One of the files that the run left, if it was written.
    pub fn file(&self, file: &RunFile) -> Option<PathBuf> {
        let folder = self.folder.as_ref().filter(|_| self.files.contains(&file.name))?;
        Some(folder.join(file.name))
    }

    /// Tells what could not be written. Apart from the writing: a terminal that is held is no disk that is stalled.
    pub fn tell_troubles(&self) {
        self.troubles.iter().for_each(|(what, help)| message::error(what, help.as_deref()));
    }
}

impl RunFolder {
    /// No files.
    pub fn nothing() -> Self {
        RunFolder { files: None, failed: false }
    }

    /// Makes the folder, or takes one that holds no run. Where that cannot be it is said, and nothing is begun: no vehicle has been
    /// told anything yet.
    pub fn begin(place: &Place, started: Utc, record: Record) -> Result<Self, Exit> {
        RunFolder::claimed(place, started, record).map_err(|Refusal(what, help, exit)| {
            message::error(&what, Some(help));
            exit
        })
    }

    /// The same, which says nothing: gives what stands in the way.
    pub fn claim(place: &Place, started: Utc, record: Record) -> Result<Self, String> {
        RunFolder::claimed(place, started, record).map_err(|Refusal(what, ..)| what)
    }

    fn claimed(place: &Place, started: Utc, mut record: Record) -> Result<Self, Refusal> {
        // The first text of a record is as long as it is.
        let text = record.json(usize::MAX).map_err(io::Error::from);
        let text = text.map_err(|error| folder::unwritable(Path::new(folder::RECORD), &error))?;
        let folder = Folder::claim(place, started, &text)?;
        Ok(RunFolder { files: Some((folder, record)), failed: false })
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

    /// Tells under way if a file of the run loses its name, as long as what this gives is kept.
    pub fn watch(&self) -> Option<Watch> {
        // Where no thread is to be had it is told at the end.
        self.files.as_ref().and_then(|(folder, _)| Watch::begin(folder).ok())
    }

    /// The journal can be written no further; gives what to tell.
    pub fn journal_failed(&mut self, error: &io::Error) -> String {
        self.loses_journal(error);
        let help = match error.to_string() == WRITTEN_INTO {
            true => "the mission goes on without; what the journal holds by now is left as it is",
            false => "the mission goes on without; what the journal holds up to here can be read",
        };
        message::error_text(&disk::not_written(&self.journal_path(), error), Some(help))
    }

    /// The disk takes no more of the journal; gives what to tell.
    pub fn journal_stalled(&mut self) -> String {
        self.loses_journal("the disk has taken nothing for 3 s");
        let text = format!("`{}` is cut short: the disk has taken nothing for 3 s", self.journal_path().display());
        message::error_text(&text, Some("what it holds up to there can be read; the vehicle was given back before"))
    }

    fn loses_journal(&mut self, why: impl Display) {
        self.failed = true;
        if let Some((_, record)) = &mut self.files {
            record.loses(JOURNAL, why);
        }
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

    /// The run could not be begun, for a reason. It leaves an empty journal, and its record, which says so.
    pub fn never_began(&mut self, why: &str) {
        let Some((folder, record)) = self.files.as_mut() else { return };
        record.fails(why);
        [JOURNAL, TRACE.name, PICTURE.name]
            .into_iter()
            .for_each(|name| record.loses(name, "the run could not be begun"));
        let ended = record.json(folder.record.room()).map_err(io::Error::from);
        if let Err(error) = ended.and_then(|text| folder.record.finish(&text)) {
            message::error(&disk::not_written(&folder.path.join(RECORD), &error), None);
        }
    }

    /// Writes how it ended, trace and picture. The record is the first, and has room on a disk that is full: how a mission ended is
    /// told, whatever becomes of the others. What became of them is told in it last.
    pub fn finish(&mut self, run: &Run, summary: &Summary) -> Left {
        let Some((folder, record)) = self.files.as_mut() else { return Left::default() };
        let (path, room) = (folder.path.clone(), folder.record.room());
        record.ends(summary);
        run.files().for_each(|file| record.loses(file.name, "not written yet"));
        // What they hold is told before there are any: by that alone they are known to be this run's.
        let texts: Vec<_> = run.files().map(|file| (file.name, run.file(file))).collect();
        texts.iter().for_each(|(name, text)| record.holds(name, text.as_bytes()));
        let begun = record.json(room).map_err(io::Error::from).and_then(|text| folder.record.write(&text));
        let (is_there, mut files, mut troubles) = (folder.is_there(), Vec::new(), Vec::new());
        if is_there {
            for (name, text) in texts {
                match disk::keep(&path.join(name), text.as_bytes()) {
                    Ok(()) => {
                        record.has(name);
                        files.push(name);
                    }
                    Err(error) => {
                        record.loses(name, &error);
                        troubles.push((disk::not_written(&path.join(name), &error), None));
                    }
                }
            }
        } else {
            run.files().for_each(|file| record.loses(file.name, "the run's folder may be another's by then"));
            if folder.is_recorded() {
                record.also_loses(JOURNAL, GONE);
            }
        }
        // One that the disk has cut may have been written into besides.
        if is_there && !record.has_lost_by(JOURNAL, WRITTEN_INTO) {
            troubles.extend(journal_trouble(folder, record));
        }
        let ended = record.json(room).map_err(io::Error::from).and_then(|text| folder.record.finish(&text));
        if let Err(error) = begun.and(ended) {
            troubles.push((
                disk::not_written(&path.join(RECORD), &error),
                Some(format!("the run ended: {}", record.end())),
            ));
        }
        troubles.extend(lost_folder(folder, is_there, record, run));
        self.failed |= !troubles.is_empty();
        Left { folder: is_there.then_some(path), files, troubles }
    }

    /// The run's folder, if it has one.
    pub fn path(&self) -> Option<&Path> {
        self.files.as_ref().map(|(folder, _)| folder.path.as_path())
    }

    /// Whether something that was wanted could not be written.
    pub fn has_failed(&self) -> bool {
        self.failed
    }
}

/// What became of a file that has the name of a run's file no more.
const GONE: &str = "it was removed or replaced";

fn not_ours(path: &Path) -> String {
    format!("`{}` is not this run's any more: {GONE}", path.display())
}

/// Reads the journal back, and records what it holds; gives what is wrong with it.
fn journal_trouble(folder: &Folder, record: &mut Record) -> Option<Trouble> {
    let journal = folder.path.join(JOURNAL);
    let (why, what, help) = match folder.whole_journal() {
        Ok(Some(bytes)) => {
            record.holds(JOURNAL, &bytes);
            return None;
        }
        Ok(None) => (
            WRITTEN_INTO.to_string(),
            format!("`{}` is not as this run wrote it: {WRITTEN_INTO}", journal.display()),
            "it is left as it is; what was overwritten is lost",
        ),
        Err(error) => (
            format!("it could not be read back: {error}"),
            format!("`{}` could not be read back: {error}", journal.display()),
            "it was written, and is left as it is",
        ),
    };
    record.also_loses(JOURNAL, &why);
    Some((what, Some(help.to_string())))
}

/// What to say of a run that ends, where its folder or its record is not its own any more.
fn lost_folder(folder: &Folder, is_there: bool, record: &Record, run: &Run) -> Option<Trouble> {
    let end = record.end();
    let unwritten: Vec<_> = run.files().map(|file| file.name).collect();
    let unwritten = format!("not written: {}", unwritten.join(", "));
    match (is_there, folder.is_recorded()) {
        (true, true) => None,
        (true, false) => {
            let help = format!("the run ended: {end}; what has its name now was left as it is");
            Some((not_ours(&folder.path.join(RECORD)), Some(help)))
        }
        (false, true) => {
            let help = format!("{unwritten}; another run may have the folder");
            Some((not_ours(&folder.path.join(JOURNAL)), Some(help)))
        }
        (false, false) => {
            let path = folder.path.display();
            let message = format!("`{path}` is not this run's folder any more: it was moved or removed");
            let help = "`run.json` and the journal are where the folder is now, if anywhere";
            Some((message, Some(format!("the run ended: {end}; {unwritten}; {help}"))))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use albacore_session::{Plan, load};

    #[test]
    fn a_run_that_could_not_be_begun_is_recorded_as_that() {
        let folder = std::env::temp_dir().join(format!("albacore-never-began-{}", std::process::id()));
        let script = load(Path::new("missions/box.alb"), None, &[]).unwrap();
        let plan = Plan::new(&script, "box.alb", None, None).unwrap();
        let asked = RunRequest { seed: 1, link: None, rate: None, set: &[], fault: &[] };
        let place = Place::Named { folder: folder.clone(), replace: false };
        let record = Record::new(&plan, &asked, Utc::now());
        let mut kept = RunFolder::begin(&place, Utc::now(), record).unwrap_or_else(|_| unreachable!());
        kept.never_began("no thread can be started");
        let told = std::fs::read_to_string(folder.join(RECORD)).unwrap();
        std::fs::remove_dir_all(&folder).unwrap();
        assert!(told.contains(r#""outcome": "failed""#) && told.contains("no thread can be started"), "{told}");
        for name in [JOURNAL, TRACE.name, PICTURE.name] {
            assert!(told.contains(&format!("\"{name}\": \"the run could not be begun\"")), "{told}");
        }
    }
}
