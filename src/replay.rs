//! `albacore replay`: a run once more, on what its vehicle sensed.

use crate::exit::Exit;
use crate::output::{self, Lines};
use crate::past::PastJournal;
use crate::plan::refused;
use crate::why::tell_conditions;
use albacore_session::journal::Ending;
use albacore_session::{Changes, DeedDifference, Departure, Parting, Repeated, depart, repeat};
use std::path::PathBuf;

/// So many differences are told at most.
const TOLD_MAX: usize = 20;

/// Run a mission again on what its vehicle sensed, as it was or with changes.
///
/// The exit code is 0 when the replay does the same, and 1 when it departs from the run or the journal is damaged.
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
    /// Print the result as JSON.
    #[arg(long)]
    json: bool,
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
        past.warn_of_changes(&original);
        if changes.is_empty() {
            let repeated = repeat(past.reader()?, &original).map_err(|error| refused(&error))?;
            match self.json {
                true => output::print_json(&repeated),
                false => tell_repeated(&repeated),
            }
            past.warn_of_end(&repeated.ending);
            return Ok(exit(repeated.is_same(), &repeated.ending));
        }
        let (_, changed) = past.changed(&changes, project)?;
        let departure = depart(&past.bytes, &original, &changed).map_err(|error| refused(&error))?;
        match self.json {
            true => output::print_json(&departure),
            false => tell_departure(&departure),
        }
        past.warn_of_end(&departure.ending);
        Ok(exit(departure.decided.is_none(), &departure.ending))
    }
}

/// Nobody knows what a damaged journal held behind the damage; one that was cut short has told all that there was.
fn exit(is_same: bool, ending: &Ending) -> Exit {
    if is_same && !matches!(ending, Ending::Damaged(_)) { Exit::Well } else { Exit::NotWell }
}

fn tell_repeated(repeated: &Repeated) {
    let mut lines = Lines::default();
    let ticks = repeated.ticks;
    match repeated.differs_at {
        None => lines.add(&format!("{ticks} ticks replayed: the same to the bit")),
        Some(tick) => lines.add(&format!("{ticks} ticks replayed: not the same from {:.1} s on", seconds(tick))),
    }
    if repeated.has_gaps {
        lines.add("ticks are missing in the journal: behind each the replay goes on from a checkpoint, and its digest is not the run's");
    } else if let Some(digest) = repeated.run_digest() {
        lines.add(&format!("digest {:016x}, the run's {digest:016x}", repeated.digest));
    }
    lines.print();
}

fn tell_departure(departure: &Departure) {
    let mut lines = Lines::default();
    lines.add(&format!("{} ticks replayed with changes", departure.ticks));
    match &departure.commanded {
        None => lines.add("the same commands to the end"),
        Some((tick, [run, replay])) => {
            lines.add(&format!("other commands from {:.1} s on", seconds(*tick)));
            lines.add(&format!("  run     {run}"));
            lines.add(&format!("  replay  {replay}"));
        }
    }
    match &departure.decided {
        None => lines.add("the same behavior to the end"),
        Some(parting) => tell_parting(parting, &mut lines),
    }
    let later = departure.deeds.iter().map(DeedDifference::line);
    let (told, more) = (TOLD_MAX, departure.deeds.len().saturating_sub(TOLD_MAX));
    if !departure.deeds.is_empty() {
        lines.add("");
        lines.add("on what the run's vehicle sensed, which a replay cannot change (- run, + replay):");
    }
    later.take(told).for_each(|line| lines.add(&line));
    if more > 0 {
        lines.add(&format!("  and {more} more"));
    }
    if let Some(tick) = departure.stopped_at {
        lines.add(&format!(
            "ticks from {:.1} s on are missing in the journal: a changed mission is not replayed beyond",
            seconds(tick)
        ));
    }
    lines.print();
}

fn tell_parting(parting: &Parting, lines: &mut Lines) {
    lines.add("");
    lines.add(&format!("other behavior from {:.1} s on", seconds(parting.tick)));
    for (at, which) in ["run   ", "replay"].into_iter().enumerate() {
        if parting.lines[at].is_empty() {
            lines.add(&format!("  {which}  goes on: {}", parting.under_way[at].join(" > ")));
        }
        parting.lines[at].iter().for_each(|line| lines.add(&format!("  {which}  {line}")));
        tell_conditions(&parting.conditions[at], lines);
    }
}

fn seconds(tick: u64) -> f64 {
    tick as f64 / 10.0
}
