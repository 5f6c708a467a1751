//! The run of the first seed that failed, kept as a folder as `albacore run` leaves one.

use super::Testing;
use super::snapshots::{run_name, short};
use super::told::Named;
use crate::clock::Utc;
use crate::plan::refused;
use crate::run_folder::{Place, Record, RunFolder, RunRequest};
use crate::synced::Synced;
use crate::{message, shell};
use albacore_session::{Run, Running, Script, Sink, TestProgram, TestResult, TestRun, test_run_plan};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Where runs of tests go of which nobody says where.
const RUNS: &str = "albacore-runs/tests";

/// The verbs that look into a run.
const VERBS: [&str; 3] = ["why", "repl", "report"];

/// A run that was kept.
#[derive(Serialize)]
pub struct Kept {
    /// Which: `seed 3`.
    pub run: String,
    /// Its folder.
    pub folder: String,
    /// The commands that look into it.
    pub commands: Vec<String>,
}

impl Kept {
    /// What is said of it, in lines.
    pub fn lines(&self) -> Vec<String> {
        let mut lines = vec![format!("        {} is kept in `{}`:", self.run, self.folder)];
        lines.extend(self.commands.iter().map(|command| format!("          {command}")));
        lines
    }
}

/// Runs a run of a test once more, with all that a run leaves. What stands in the way of that is said, and the test has failed all the same.
pub fn keep(
    testing: &mut Testing,
    script: &Script,
    at: &Named,
    (test, result): (&TestProgram, &TestResult),
    run: &TestRun,
) -> Option<Kept> {
    if testing.asked.no_keep || testing.is_stopped() {
        return None;
    }
    let (plan, mut set) = test_run_plan(script, test, run, &testing.faults).map_err(|error| refused(&error)).ok()?;
    let folder = testing.folder(at.path, result, run);
    let (faults, started) = (&testing.asked.faults.texts, Utc::now());
    let asked = RunRequest { seed: run.seed, link: None, rate: None, set: &set, fault: faults };
    let record = Record::new(&plan, &asked, started);
    let mut files = match RunFolder::claim(&Place::Named { folder: folder.clone(), replace: true }, started, record) {
        Ok(files) => files,
        Err(what) => {
            let help = "move it away, keep runs elsewhere with `--keep FOLDER`, or none with `--no-keep`";
            message::error(&format!("the run of {run} is not kept: {what}"), Some(help));
            return None;
        }
    };
    set.extend(faults.iter().map(|text| format!("--fault {text}")));
    let mut mission = match Run::new(&plan, run.seed) {
        Ok(mission) => mission,
        Err(error) => {
            files.never_began("the run could not be begun");
            let _ = refused(&error);
            return None;
        }
    };
    if let Some(journal) = files.journal() {
        let sink: Sink = Box::new(Synced::gathering(journal, 0));
        mission.with_journal(sink, &set);
    }
    to_end(testing, &mut mission, &mut files);
    files.finish(&mission, &mission.summary(0.0)).tell_troubles();
    let path = shell::path(&folder);
    let commands = VERBS.map(|verb| format!("albacore {verb} {path}")).to_vec();
    Some(Kept { run: run.to_string(), folder: folder.display().to_string(), commands })
}

/// Lives it to its end, or until somebody interrupts it.
fn to_end(testing: &Testing, mission: &mut Run, files: &mut RunFolder) {
    loop {
        let running = if testing.is_stopped() { mission.interrupt() } else { mission.step() };
        if mission.tick() > 0 {
            files.ticks();
        }
        if let Some(error) = mission.journal_failure() {
            message::write(&files.journal_failed(&error));
        }
        if let Running::Over(_) = running {
            return;
        }
    }
}

impl Testing<'_> {
    /// Where a run of a test is kept: in the place of an earlier one, but of none of this command.
    fn folder(&mut self, script: &Path, result: &TestResult, run: &TestRun) -> PathBuf {
        let runs = self.asked.keep.clone().unwrap_or_else(|| PathBuf::from(RUNS));
        let name = short(format!("{}-seed{}", run_name(script, result, run), run.seed));
        let names = std::iter::once(name.clone()).chain((2u64..).map(|number| format!("{name}-{number}")));
        let mut free = names.map(|name| runs.join(name)).filter(|folder| !self.taken.contains(folder));
        let folder = free.next().unwrap_or_else(|| runs.join(&name));
        self.taken.insert(folder.clone());
        folder
    }
}
