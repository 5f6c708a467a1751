//! `albacore run`: checks a mission and runs it.

use crate::called::Call;
use crate::campaign::seeds;
use crate::clock::{self, Pace, Utc, now};
use crate::exit::Exit;
use crate::live::Live;
use crate::live_page::Waiting;
use crate::output::Lines;
use crate::plan::{Choice, Faults, refused, warn_of_faults_after};
use crate::run_folder::{Left, Place, Record, RunFolder, RunRequest};
use crate::speaker::{Speaker, hears_requests, no_thread};
use crate::synced::Synced;
use crate::{interruption, message, output, zoom};
use albacore_session::{
    FieldLog, LOG_BYTES_MAX, Outcome, PICTURE, Plan, RECORDED, Run as MissionRun, Running, SOURCE_BYTES_MAX, Script,
    Sink, Summary, column_names, read_file,
};
use indicatif::{ProgressBar, ProgressStyle};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io::IsTerminal;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Reports that are printed; the trace has all of them.
const REPORTS_TOLD_MAX: usize = 20;
/// Characters of what was reported that are printed.
const VALUE_CHARS_MAX: usize = 160;
/// Ticks between two looks of the person at the progress.
const TICKS_AT_ONCE: u64 = 100;
/// ... and of a run that is looked at while it goes on.
const STATUS_TICKS: u64 = 10;

/// A plan, a run of it at its first tick, and what is raised when nothing is left to go on with.
type Prepared = (Plan, MissionRun, Arc<AtomicBool>);

/// Check a mission script and run it.
#[derive(clap::Args)]
pub struct Run {
    /// The script.
    #[arg(value_name = "MISSION.alb")]
    script: PathBuf,
    #[command(flatten)]
    choice: Choice,
    #[command(flatten)]
    faults: Faults,
    /// The seed of all that is random.
    #[arg(long, default_value_t = 1, value_parser = seeds::one, allow_negative_numbers = true)]
    seed: u64,
    /// Drive a vehicle at the end of a link instead of a simulated one: `serial:/dev/ttyUSB0?dialect=recon`,
    /// `udp:HOST:PORT?dialect=recon`. `dialect` may be left out where the vehicle of the mission's scenario says it.
    #[arg(long, value_name = "URL", conflicts_with_all = ["scenario", "texts"])]
    link: Option<String>,
    /// Play a log of the field through the mission: `dive.csv`, or `dive.alog` of MOOS. It tells what the mission would have done; nothing
    /// is driven.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["scenario", "texts", "link", "rate"])]
    log: Option<PathBuf>,
    /// What the columns of the log are, a line for each that has another name than in our tables: `depth (m) = Depth_m`.
    #[arg(long, value_name = "FILE", requires = "log")]
    columns: Option<PathBuf>,
    /// How many times faster than real time; else a simulation runs as fast as it can, and a vehicle in real time.
    #[arg(long, value_name = "N", value_parser = clock::rate, allow_negative_numbers = true)]
    rate: Option<f64>,
    /// The folder for `run.json`, the journal, the trace and the picture; else a new one below `albacore-runs/MISSION`, named by
    /// the time of the start.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Remove the files of the run that the folder holds.
    #[arg(long, requires = "out")]
    replace: bool,
    /// Write no files.
    #[arg(long, conflicts_with_all = ["out", "replace"])]
    no_out: bool,
    /// The picture shows this time of the run alone: `2400s..2600s`.
    #[arg(long, value_name = "A..B", value_parser = zoom::parse, conflicts_with = "no_out", allow_negative_numbers = true)]
    zoom: Option<RangeInclusive<u64>>,
    /// Serve a page of the run while it goes on, to browsers of this machine alone: a map, timelines and what happened, as `albacore report`
    /// shows them afterwards. Its address is printed.
    #[arg(long)]
    live: bool,
    /// The port of that page; else any that is free.
    #[arg(long, value_name = "N", requires = "live", default_value_t = 0, hide_default_value = true)]
    port: u16,
    /// Print the result as one JSON object on standard output.
    #[arg(long)]
    json: bool,
}

impl Run {
    /// Runs the mission to its end.
    pub fn run(&self) -> Exit {
        interruption::hear_faults();
        // A terminal that takes nothing holds no run on a link, from the first message on.
        let speaks = self.link.is_some() || self.live;
        let speaker = match speaks.then(Speaker::new).transpose() {
            Ok(speaker) => speaker,
            Err(error) => return no_thread(&error),
        };
        if self.link.is_some()
            && let Err(exit) = hears_requests()
        {
            return exit;
        }
        self.prepared(speaker).unwrap_or_else(|exit| exit)
    }

    /// Prepares the run and goes on with it.
    fn prepared(&self, speaker: Option<Speaker>) -> Result<Exit, Exit> {
        // A port that is taken costs nobody a run.
        let waiting = self.live.then(|| Waiting::at(self.port)).transpose()?;
        let script = self.choice.script(&self.script)?;
        let started = now();
        let (plan, mut run, is_over) = self.prepare(&script)?;
        if let Some(ticks) = &self.zoom {
            run.zoom(ticks.clone());
        }
        let printer = ResultPrinter { json: self.json, on_link: self.link.is_some(), started };
        let interrupted = interruption::flag();
        if self.replace && self.link.is_some() {
            self.hear(&mut run, &interrupted)?;
        }
        let page = waiting.map(|waiting| {
            let report = run.watched(&script, &self.changes()).map_err(|error| no_thread(&error))?;
            waiting.serve(report)
        });
        let page = page.transpose()?;
        let mut kept = self.kept(&plan)?;
        // On a link each tick is in the file at once; a simulated run can be had again.
        let sink = if self.link.is_some() { Synced::new } else { Synced::gathering };
        let journal = kept.journal().map(|file| (Box::new(sink(file, 0)) as Sink, self.changes()));
        if let Some(speaker) = &speaker {
            let (json, doing) = (self.json, plan.program.mission.name.clone());
            speaker.shows(move || status_bar(json, &doing));
        }
        match speaker {
            Some(speaker) if self.link.is_some() => {
                Ok(Live { speaker, page, journal, interrupted, kept, printer }.run(run))
            }
            speaker => {
                if let Some((journal, changes)) = journal {
                    run.with_journal(journal, &changes);
                }
                let outcome = self.drive(&mut run, &mut kept, &interrupted, &is_over, speaker.as_ref());
                drop(speaker);
                let exit = self.finish(&plan, &run, &mut kept, printer, outcome);
                if let Some(page) = page {
                    page.end();
                }
                Ok(exit)
            }
        }
    }

    /// Waits for a vehicle at the end of a link: one that never answers costs nobody the run that was there.
    fn hear(&self, run: &mut MissionRun, interrupted: &AtomicBool) -> Result<(), Exit> {
        let folder = self.out.as_deref().unwrap_or(Path::new(""));
        let help = format!("nothing in `{}` was touched", folder.display());
        match run.hear(interrupted) {
            Ok(true) => Ok(()),
            Ok(false) => {
                message::error("interrupted before the vehicle was heard", Some(&help));
                Err(Exit::NotWell)
            }
            Err(error) => {
                message::error(&error.to_string(), Some(&help));
                Err(Exit::Failed)
            }
        }
    }

    /// Writes what a run in a simulated world leaves, and tells its result.
    fn finish(
        &self,
        plan: &Plan,
        run: &MissionRun,
        kept: &mut RunFolder,
        printer: ResultPrinter,
        outcome: Outcome,
    ) -> Exit {
        let summary = run.summary(printer.wall_s());
        warn_of_faults_after(std::iter::once(plan), summary.sim_time_s);
        if self.zoom.as_ref().is_some_and(|ticks| *ticks.start() > summary.ticks) {
            let message = format!("nothing is in the picture: the run was over after {:.1} s", summary.sim_time_s);
            message::warning(&message, "choose an earlier time for `--zoom`");
        }
        let left = kept.finish(run, &summary);
        left.tell_troubles();
        printer.print(&RunResult::new(&summary, left.folder.as_deref()), outcome, &left);
        ResultPrinter::exit(outcome, kept.has_failed() || run.release_failed())
    }

    /// The plan, and a run of it at its first tick: in a simulated world or on a link.
    fn prepare(&self, script: &Script) -> Result<Prepared, Exit> {
        let refused = |error| refused(&error);
        if let Some(log) = &self.log {
            return self.played(script, log);
        }
        let Some(link) = &self.link else {
            let plan = self.choice.plan(script, &self.script)?;
            let plan = plan.with_faults(&self.faults.read()?).map_err(refused)?;
            // In a wide and slow sea a plume is hours old, and those are computed first.
            let bar = bar(self.json, &format!("{} before the run", plan.scenario_name));
            let run = MissionRun::new(&plan, self.seed);
            bar.finish_and_clear();
            return Ok((plan, run.map_err(refused)?, Arc::default()));
        };
        let mission = self.choice.mission.as_deref();
        let Call { plan, vehicle, .. } = Call::open(script, &self.script, mission, link, self.rate)?;
        let run = MissionRun::on_link(&plan, self.seed, vehicle).map_err(refused)?;
        Ok((plan, run, Arc::default()))
    }

    /// The plan and a run of it on what a log of the field holds.
    fn played(&self, script: &Script, path: &Path) -> Result<Prepared, Exit> {
        let unreadable = |path: &Path, error: &dyn std::fmt::Display| {
            message::error(&format!("`{}` cannot be read: {error}", path.display()), None);
            Exit::Usage
        };
        let bytes = read_file(path, LOG_BYTES_MAX).map_err(|error| unreadable(path, &error))?;
        let names = match &self.columns {
            None => BTreeMap::new(),
            Some(columns) => {
                let text = read_file(columns, SOURCE_BYTES_MAX as u64).map_err(|error| unreadable(columns, &error))?;
                column_names(&String::from_utf8_lossy(&text)).map_err(|fault| {
                    message::error(&format!("`{}`: {}", columns.display(), fault.message), Some(&fault.help));
                    Exit::Usage
                })?
            }
        };
        let is_alog = path.extension().is_some_and(|ending| ending == "alog");
        let (file, mission) = (self.script.display().to_string(), self.choice.mission.as_deref());
        let plan =
            Plan::on_link(script, &file, mission, &format!("log {}", path.display())).map_err(|e| refused(&e))?;
        let vehicle = FieldLog { bytes: &bytes, is_alog, names }.vehicle(&plan).map_err(|fault| {
            message::error(&format!("`{}`: {}", path.display(), fault.message), Some(&fault.help));
            Exit::Usage
        })?;
        let told = vehicle.senses().collect::<Vec<_>>().join(", ");
        message::write(&message::line(&format!("the log tells {told}")));
        let is_over = vehicle.is_over();
        let run = MissionRun::on_link(&plan, self.seed, Box::new(vehicle)).map_err(|error| {
            let exit = refused(&error);
            let help = "`--columns FILE` says what a column of it is, such as `course (deg) = NAV_HEADING`";
            message::warning("the log tells too little for this mission", help);
            exit
        })?;
        Ok((plan, run, is_over))
    }

    /// What was changed for this run, as the journal keeps it.
    fn changes(&self) -> Vec<String> {
        let faults = self.faults.texts.iter().map(|text| format!("--fault {text}"));
        self.choice.set.iter().cloned().chain(faults).collect()
    }

    /// The run's files, if any are wanted, where they overwrite no other run's.
    fn kept(&self, plan: &Plan) -> Result<RunFolder, Exit> {
        if self.no_out {
            return Ok(RunFolder::nothing());
        }
        let place = match &self.out {
            Some(folder) => Place::Named { folder: folder.clone(), replace: self.replace },
            None => Place::New(plan.program.mission.name.clone()),
        };
        let started = Utc::now();
        let asked = RunRequest {
            seed: self.seed,
            link: self.link.as_deref(),
            rate: self.rate,
            set: &self.choice.set,
            fault: &self.faults.texts,
        };
        RunFolder::begin(&place, started, Record::new(plan, &asked, started))
    }

    /// Ticks in a simulated world until the mission ends or the person interrupts it.
    fn drive(
        &self,
        run: &mut MissionRun,
        kept: &mut RunFolder,
        interrupted: &AtomicBool,
        is_over: &AtomicBool,
        speaker: Option<&Speaker>,
    ) -> Outcome {
        // Who speaks draws, and may be held by the terminal.
        let bar = if speaker.is_some() { ProgressBar::hidden() } else { bar(self.json, "") };
        let mut pace = self.rate.map(Pace::new);
        loop {
            if let Some(pace) = &mut pace {
                std::thread::sleep(pace.left(false));
                pace.begin();
            }
            let running = match () {
                () if interrupted.load(Ordering::Relaxed) => run.interrupt(),
                () if is_over.load(Ordering::Relaxed) => run.end_because("the log ends here"),
                () => run.step(),
            };
            if run.tick() > 0 {
                kept.ticks();
            }
            if let Some(error) = run.journal_failure() {
                bar.suspend(|| message::write(&kept.journal_failed(&error)));
            }
            for notice in run.take_notices() {
                bar.suspend(|| message::write(&message::line(&format!("vehicle: {notice}"))));
            }
            if let Running::Over(outcome) = running {
                bar.finish_and_clear();
                return outcome;
            }
            if let Some(speaker) = speaker.filter(|_| run.tick().is_multiple_of(STATUS_TICKS)) {
                speaker.progress(|| run.status_line());
            } else if run.tick().is_multiple_of(TICKS_AT_ONCE) {
                bar.set_position(run.tick() / 10);
                bar.set_message(run.under_way().join(" > "));
            }
        }
    }
}

/// Progress, where a person looks at it.
fn bar(json: bool, doing: &str) -> ProgressBar {
    bar_with("{spinner} {pos} s  {msg}", json, doing)
}

/// How a run stands, on one line of the terminal, however long it is.
fn status_bar(json: bool, doing: &str) -> ProgressBar {
    bar_with("{spinner} {wide_msg}", json, doing)
}

fn bar_with(template: &str, json: bool, doing: &str) -> ProgressBar {
    if json || !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new_spinner();
    let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_spinner());
    bar.set_style(style);
    bar.set_message(doing.to_string());
    bar
}

/// How the result of a run is told.
#[derive(Clone, Copy)]
pub struct ResultPrinter {
    json: bool,
    on_link: bool,
    started: Duration,
}

impl ResultPrinter {
    /// Seconds since the run was asked for.
    pub fn wall_s(&self) -> f64 {
        now().saturating_sub(self.started).as_secs_f64()
    }

    /// Tells it.
    pub fn print(&self, told: &RunResult, outcome: Outcome, left: &Left) {
        interruption::nobody_looks();
        let summary = told.summary;
        let link_failed = self.on_link && outcome == Outcome::Failed;
        if link_failed {
            message::error(&summary.reason, None);
        }
        if self.json {
            output::print_json(told);
        } else if !link_failed || summary.ticks > 0 {
            // Of a vehicle that was never heard there is no more to tell.
            human(summary, left).print();
        }
    }

    /// The exit code; `failed` tells whether something that was wanted could not be done besides.
    pub fn exit(outcome: Outcome, failed: bool) -> Exit {
        match outcome {
            _ if failed => Exit::Failed,
            Outcome::Failed | Outcome::LinkLost => Exit::Failed,
            Outcome::Completed => Exit::Well,
            _ => Exit::NotWell,
        }
    }
}

/// The result as a program reads it.
#[derive(serde::Serialize)]
pub struct RunResult<'a> {
    /// The result.
    #[serde(flatten)]
    pub summary: &'a Summary,
    /// Where the run's files are, if it has any. A name need not be a text: what is none in it is U+FFFD.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub folder: Option<Cow<'a, str>>,
}

impl<'a> RunResult<'a> {
    /// The result of a run whose files are in this folder.
    pub fn new(summary: &'a Summary, folder: Option<&'a Path>) -> Self {
        RunResult { summary, folder: folder.map(Path::to_string_lossy) }
    }
}

/// The result as a person reads it.
fn human(summary: &Summary, left: &Left) -> Lines {
    let mut lines = Lines::default();
    let minutes = |seconds: f64| format!("{} min {:02} s", (seconds / 60.0).floor(), (seconds % 60.0).floor());
    let mut head = format!(
        "{} in {}, seed {}: {}",
        summary.mission,
        summary.scenario,
        summary.seed,
        summary.outcome.replace('_', " ")
    );
    if !summary.reason.is_empty() && summary.outcome != "completed" && summary.outcome != summary.reason {
        head.push_str(&format!(" ({})", summary.reason));
    }
    lines.add(&head);
    lines.add(&format!(
        "  {} of the vehicle's time in {:.2} s, {:.0} m over ground, {} switches",
        minutes(summary.sim_time_s),
        summary.wall_s,
        summary.path_length_m,
        summary.switches
    ));
    if let Some(origin) = summary.origin {
        lines.add(&format!("  about {origin}"));
    }
    for report in summary.reports.iter().take(REPORTS_TOLD_MAX) {
        let mut text = format!("  reported {} after {}", report.name, minutes(report.t_s));
        if let (Some(north), Some(east)) = (report.north_m, report.east_m) {
            text.push_str(&format!(" at ({north:.1}, {east:.1}) m"));
        }
        if let Some(position) = report.position() {
            text.push_str(&format!(", {position}"));
        }
        if let (Some(error), Some(from)) = (report.error_m, report.error_from) {
            text.push_str(&format!(", {error:.1} m from {from}"));
        }
        if !report.told.is_empty() {
            text.push_str(&format!(": {}", bounded(&report.told)));
        }
        lines.add(&text);
    }
    match summary.reports_beyond(REPORTS_TOLD_MAX) {
        0 => {}
        more => lines.add(&format!("  and {more} more reports, in the trace")),
    }
    if let Some(rows) = summary.recorded_rows {
        let more = match summary.recorded_rows_left_out {
            0 => String::new(),
            more => format!(", and {more} more than are kept"),
        };
        let where_to = match left.file(&RECORDED) {
            Some(table) => format!(", in {}", table.display()),
            None => ", which were not kept".to_string(),
        };
        lines.add(&format!("  recorded {rows} rows{more}{where_to}"));
    }
    lines.add(&format!("  digest {}", summary.digest));
    if let Some(picture) = left.file(&PICTURE) {
        lines.add(&format!("  picture {}", picture.display()));
    }
    lines
}

/// A value, or as much of it as is read at a glance; `--json` and the trace have all of it.
fn bounded(value: &str) -> Cow<'_, str> {
    output::beginning(value, VALUE_CHARS_MAX).map_or(value.into(), |beginning| format!("{beginning}…").into())
}
