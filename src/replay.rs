//! `albacore replay`: a run once more, on what its vehicle sensed.

use crate::exit::Exit;
use crate::message;
use crate::output::Lines;
use crate::past::PastJournal;
use crate::plan::refused;
use albacore_session::journal::Ending;
use albacore_session::{Changes, Repeated, repeat};
use std::path::PathBuf;

/// Run a mission again on what its vehicle sensed, as it was or with changes.
#[derive(clap::Args)]
pub struct ReplayRun {
    /// The folder of the run, or its journal.
    run: PathBuf,
    /// Another script, or the same as it is by now; else the one that the journal holds.
    #[arg(long, value_name = "SCRIPT.alb")]
    script: Option<PathBuf>,
    /// Another mission of the script.
    #[arg(long)]
    mission: Option<String>,
    /// Change a parameter: `lambda=6s`, `cpt_2005.beta=30deg`.
    #[arg(long = "set", value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// The folder of the project, where files of data are that the script reads; else where it was run.
    #[arg(long, value_name = "FOLDER")]
    project: Option<PathBuf>,
}

impl ReplayRun {
    /// Replays it.
    pub fn run(&self) -> Exit {
        self.replay().unwrap_or_else(|exit| exit)
    }

    fn replay(&self) -> Result<Exit, Exit> {
        let past = PastJournal::open(&self.run)?;
        let project = self.project.as_deref();
        let (_, original) = past.plan(project)?;
        let changes = Changes {
            script: self.script.as_deref(),
            mission: self.mission.as_deref(),
            set: &self.set,
            ..Changes::default()
        };
        for name in past.changed_since(&original) {
            message::warning(&format!("`{name}` is not what it was in the run"), "the replay is of what it is now");
        }
        if changes.is_empty() {
            let repeated = repeat(past.reader()?, &original).map_err(|error| refused(&error))?;
            return Ok(tell(&repeated));
        }
        Ok(Exit::Well)
    }
}

fn tell(repeated: &Repeated) -> Exit {
    let mut lines = Lines::default();
    let mut exit = Exit::Well;
    match repeated.differs_at {
        None => lines.add(&format!("{} ticks replayed: the same to the bit", repeated.ticks)),
        Some(tick) => {
            lines.add(&format!("{} ticks replayed: otherwise from {:.1} s on", repeated.ticks, tick as f64 / 10.0));
            exit = Exit::NotWell;
        }
    }
    match &repeated.ending {
        Ending::Complete(end) => {
            let digest = end.ending().map_or(0, |ending| ending.digest);
            lines.add(&format!("digest {:016x}, the run's {digest:016x}", repeated.digest));
        }
        Ending::CutShort(flaw) | Ending::Damaged(flaw) => lines.add(&format!("the journal ends {flaw}")),
    }
    lines.print();
    exit
}
