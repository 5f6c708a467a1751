//! `albacore run`: checks a mission and runs it.

use crate::exit::Exit;
use crate::kept::Kept;
use crate::{interruption, message, plan};
use albacore_session::{Outcome, Plan, Run as MissionRun, Running, Summary};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Ticks between two looks of the person at the progress.
const TICKS_AT_ONCE: u64 = 100;

/// Check a mission script and run it.
#[derive(clap::Args)]
pub struct Run {
    /// The script.
    #[arg(value_name = "MISSION.alb")]
    script: PathBuf,
    /// The mission; else the one named like the file, else the only one.
    #[arg(long)]
    mission: Option<String>,
    /// The scenario; else the one that the mission names.
    #[arg(long = "in", value_name = "SCENARIO")]
    scenario: Option<String>,
    /// The seed of all that is random.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Change a parameter: `lambda=6s`, `cpt_2005.beta=30deg`.
    #[arg(long = "set", value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// The folder for the journal, the trace and the picture; else `albacore-runs/MISSION-SEED`.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Write no files.
    #[arg(long, conflicts_with = "out")]
    no_out: bool,
    /// Print the result as one JSON object on standard output.
    #[arg(long)]
    json: bool,
}

impl Run {
    /// Runs the mission to its end.
    pub fn run(&self) -> Exit {
        let (mission, scenario) = (self.mission.as_deref(), self.scenario.as_deref());
        let (script, plan) = match plan::plan(&self.script, mission, scenario, &self.set) {
            Ok(planned) => planned,
            Err(exit) => return exit,
        };
        let started = now();
        let mut run = match MissionRun::new(&plan, self.seed) {
            Ok(run) => run,
            Err(error) => return plan::refused(&error, &script),
        };
        let interrupted = interruption::flag();
        let mut kept = self.folder(&plan).map_or_else(Kept::nothing, Kept::begin);
        if let Some(journal) = kept.journal() {
            run.with_journal(Box::new(journal), &self.set);
        }
        let outcome = self.drive(&mut run, &plan, &mut kept, &interrupted);
        let summary = run.summary(started.elapsed().as_secs_f64());
        let picture = kept.finish(&run);
        self.tell(&summary, picture.as_deref());
        match outcome {
            _ if kept.has_failed() => Exit::Failed,
            Outcome::Failed | Outcome::LinkLost => Exit::Failed,
            Outcome::Completed => Exit::Well,
            _ => Exit::NotWell,
        }
    }

    /// Where files go, if any are wanted.
    fn folder(&self, plan: &Plan) -> Option<PathBuf> {
        let usual = || Path::new("albacore-runs").join(format!("{}-{}", plan.program.mission.name, self.seed));
        (!self.no_out).then(|| self.out.clone().unwrap_or_else(usual))
    }

    /// Ticks until the mission ends or the person interrupts it.
    fn drive(&self, run: &mut MissionRun, plan: &Plan, kept: &mut Kept, interrupted: &AtomicBool) -> Outcome {
        let bar = self.bar(plan);
        loop {
            let running = if interrupted.load(Ordering::Relaxed) { run.interrupt() } else { run.step() };
            if let Some(error) = run.journal_failure() {
                bar.suspend(|| kept.journal_failed(&error));
            }
            if let Running::Over(outcome) = running {
                bar.finish_and_clear();
                return outcome;
            }
            if run.tick().is_multiple_of(TICKS_AT_ONCE) {
                bar.set_position(run.tick() / 10);
                bar.set_message(run.active().join(" > "));
            }
        }
    }

    fn bar(&self, plan: &Plan) -> ProgressBar {
        if self.json || !std::io::stderr().is_terminal() {
            return ProgressBar::hidden();
        }
        let bar = ProgressBar::new_spinner();
        let style = ProgressStyle::with_template("{spinner} {pos} s  {msg}")
            .unwrap_or_else(|_| ProgressStyle::default_spinner());
        bar.set_style(style);
        bar.set_message(plan.program.mission.name.clone());
        bar.enable_steady_tick(Duration::from_millis(100));
        bar
    }

    fn tell(&self, summary: &Summary, picture: Option<&Path>) {
        let text = if self.json {
            match serde_json::to_string_pretty(summary) {
                Ok(text) => text + "\n",
                Err(error) => {
                    message::error(&error.to_string(), None);
                    return;
                }
            }
        } else {
            human(summary, picture)
        };
        // A closed pipe is silent.
        let _ = std::io::stdout().lock().write_all(text.as_bytes());
    }
}

/// The result as a person reads it.
fn human(summary: &Summary, picture: Option<&Path>) -> String {
    let minutes = |seconds: f64| format!("{} min {:02} s", (seconds / 60.0).floor(), (seconds % 60.0).floor());
    let mut text = format!(
        "{} in {}, seed {}: {}",
        summary.mission,
        summary.scenario,
        summary.seed,
        summary.outcome.replace('_', " ")
    );
    if !summary.reason.is_empty() && summary.outcome != "completed" {
        text.push_str(&format!(" ({})", summary.reason));
    }
    text.push_str(&format!(
        "\n  {} of the vehicle's time in {:.2} s, {:.0} m over ground, {} switches\n",
        minutes(summary.sim_time_s),
        summary.wall_s,
        summary.path_length_m,
        summary.switches
    ));
    for report in &summary.reports {
        text.push_str(&format!("  reported {} after {}", report.name, minutes(report.t_s)));
        if let (Some(north), Some(east)) = (report.north_m, report.east_m) {
            text.push_str(&format!(" at ({north:.1}, {east:.1}) m"));
        }
        if let Some(error) = report.error_m {
            text.push_str(&format!(", {error:.1} m from the true one"));
        }
        text.push('\n');
    }
    text.push_str(&format!("  digest {}\n", summary.digest));
    if let Some(picture) = picture {
        text.push_str(&format!("  picture {}\n", picture.display()));
    }
    text
}

/// The wall clock, which only the command line may read.
#[expect(clippy::disallowed_methods, reason = "how long a run took is told to the person and is no part of its result")]
fn now() -> Instant {
    Instant::now()
}
