//! A run that is over, as it is named on a command line: its folder, or the journal in it.

use crate::clock::Utc;
use crate::exit::Exit;
use crate::plan::refused;
use crate::run_folder::{JOURNAL, LEFT_BYTES_MAX, RECORD};
use crate::{message, run_folder};
use albacore_session::journal::{Ending, JournalHeader, Reader, Unreadable};
use albacore_session::{Changes, PastRun, Plan, PlanError, Script, read_file};
use std::path::{Path, PathBuf};

/// So many folders are named in a message at most.
const NAMED_MAX: usize = 5;

/// A journal that was read, and what beside it tells of the run.
pub struct PastJournal {
    /// The folder or the file, as it was named.
    pub path: PathBuf,
    /// All of its bytes.
    pub bytes: Vec<u8>,
    /// What was run.
    pub header: JournalHeader,
    /// When its first tick was, if its record tells; of a program that was killed, when it began.
    pub first_tick: Option<Utc>,
    /// The record tells when the program began, and not when the first tick was.
    began_alone: bool,
    /// The script as it was named when it was run, where it is still there.
    pub script: Option<PathBuf>,
}

impl PastJournal {
    /// Reads the journal of a run, or says what is wrong.
    pub fn open(path: &Path) -> Result<Self, Exit> {
        let journal = if path.is_dir() { path.join(JOURNAL) } else { path.to_path_buf() };
        if path.is_dir() && journal.symlink_metadata().is_err() {
            let help = runs_in(path);
            message::error(&format!("`{}` holds no run: there is no `{JOURNAL}` in it", path.display()), Some(&help));
            return Err(Exit::Usage);
        }
        let bytes = read_file(&journal, LEFT_BYTES_MAX).map_err(|unread| {
            let help = "name the folder of a run, or the journal in it: `albacore run` tells where it is";
            message::error(&format!("`{}` cannot be read: {unread}", journal.display()), Some(help));
            Exit::Usage
        })?;
        let header = match Reader::new(&bytes) {
            Ok(reader) => reader.header().clone(),
            Err(unreadable) => {
                let help = match unreadable {
                    Unreadable::Version(_) => {
                        "a `trace.txt` and a `run.json` beside it are texts, and tell what happened"
                    }
                    _ => {
                        "name the folder of a run; where its journal is lost, `trace.txt` and `run.json` in it tell what happened"
                    }
                };
                message::error(&format!("`{}`: {unreadable}", journal.display()), Some(help));
                return Err(Exit::Failed);
            }
        };
        let told = run_folder::told(&journal.with_file_name(RECORD));
        let [first_tick, began] = ["first_tick", "started"].map(|moment| told[moment].as_str().and_then(Utc::read));
        let began_alone = first_tick.is_none() && began.is_some();
        let script = told["scripts"][0]["name"].as_str().and_then(|script| found(Path::new(script), &journal));
        Ok(PastJournal {
            path: path.to_path_buf(),
            bytes,
            header,
            first_tick: first_tick.or(began),
            began_alone,
            script,
        })
    }

    /// Reads it from its beginning.
    pub fn reader(&self) -> Result<Reader<'_>, Exit> {
        Reader::new(&self.bytes).map_err(|unreadable| {
            message::error(&unreadable.to_string(), None);
            Exit::Failed
        })
    }

    /// The script and the plan of the run as it was; what in the way of that is said.
    pub fn plan(&self, project: Option<&Path>) -> Result<(Script, Plan), Exit> {
        self.changed(&Changes::default(), project)
    }

    /// The same with changes.
    pub fn changed(&self, changes: &Changes, project: Option<&Path>) -> Result<(Script, Plan), Exit> {
        let named = project.map(|folder| folder.join("script.alb"));
        let changes = Changes { beside: named.as_deref().or(self.script.as_deref()), ..*changes };
        let planned = Plan::of_journal(&self.header, &changes).map_err(|error| {
            let exit = refused(&error);
            // The scripts were sound when they were run.
            if changes.is_empty() && matches!(error, PlanError::Script(..)) {
                message::warning(
                    "the journal holds the scripts, and not the files of data that they read",
                    "`--project FOLDER` names the folder of the project, where they lie by now",
                );
            }
            exit
        });
        let (script, plan) = planned?;
        if !changes.is_empty() {
            message::findings(&script.findings, &script.sources);
        }
        Ok((script, plan))
    }

    /// The run, as what it left tells of it; what is not as it should be is said.
    pub fn past_run(&self, project: Option<&Path>) -> Result<PastRun, Exit> {
        let (_, plan) = self.plan(project)?;
        self.warn_of_changes(&plan);
        let run = PastRun::read(&plan, &self.bytes).map_err(|unreadable| {
            message::error(&format!("`{}`: {unreadable}", self.path.display()), None);
            Exit::Failed
        })?;
        self.warn_of_end(run.ending());
        Ok(run)
    }

    /// Warns of what the run was made from that is other by now.
    pub fn warn_of_changes(&self, plan: &Plan) {
        for name in self.changed_since(plan) {
            message::warning(&format!("`{name}` is not what it was in the run"), "what is told is of what it is now");
        }
    }

    /// Warns where times of the clock are about right alone: nobody has written when the first tick was.
    pub fn warn_of_clock(&self) {
        if let Some(began) = self.first_tick.filter(|_| self.began_alone) {
            let help = format!("times of the clock count from when the program began, {}", began.time_of_day());
            message::warning(
                "`run.json` does not tell when the first tick was: the program was killed, or runs still",
                &help,
            );
        }
    }

    /// Warns where no clock is known, and of what is done without.
    pub fn warn_of_no_clock(&self, otherwise: &str) {
        if self.first_tick.is_none() {
            message::warning("when the run was is not known: no `run.json` beside the journal tells it", otherwise);
        }
    }

    /// Warns of a journal without its end.
    pub fn warn_of_end(&self, ending: &Ending) {
        let (how, flaw) = match ending {
            Ending::Complete(_) => return,
            Ending::CutShort(flaw) => ("cut short", flaw),
            Ending::Damaged(flaw) => ("damaged", flaw),
        };
        message::warning(&format!("the journal is {how} {flaw}"), "what is told is of all before that");
    }

    /// What the run was made from that is other by now, by name: files of data, and modules of the standard library.
    fn changed_since(&self, plan: &Plan) -> Vec<String> {
        let now = plan.sources_from_script();
        let is_other = |source: &&albacore_session::SourceDigest| {
            let named = now.iter().filter(|known| known.name == source.name);
            let mut digests = named.map(|known| known.digest).peekable();
            digests.peek().is_some() && digests.all(|digest| digest != source.digest)
        };
        self.header.sources.iter().filter(is_other).map(|source| source.name.clone()).collect()
    }
}

/// The script of a run as its record names it, seen from here, or from a folder above the run: that was where it was run.
fn found(script: &Path, journal: &Path) -> Option<PathBuf> {
    let above = std::path::absolute(journal).ok()?;
    let from = std::iter::once(Path::new("")).chain(above.ancestors().skip(1));
    from.map(|folder| folder.join(script)).find(|script| script.is_file())
}

/// The runs in the folders of a folder, to be named in a help.
fn runs_in(folder: &Path) -> String {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut runs: Vec<PathBuf> = entries.map(|entry| entry.path()).filter(|path| path.join(JOURNAL).exists()).collect();
    runs.sort();
    runs.reverse();
    let named: Vec<String> = runs.iter().take(NAMED_MAX).map(|run| format!("`{}`", run.display())).collect();
    match named.as_slice() {
        [] => "name the folder of a run: `albacore run` tells where it is".to_string(),
        [only] => format!("did you mean {only}?"),
        several if runs.len() > NAMED_MAX => format!("its last runs are {}", several.join(", ")),
        several => format!("its runs are {}", several.join(", ")),
    }
}
