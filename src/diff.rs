//! `albacore diff`: how two runs differ, in a mission's own terms.

use crate::exit::Exit;
use crate::output::{self, Lines};
use crate::past::PastJournal;
use albacore_session::{PastRun, RunDifference};
use std::path::PathBuf;

/// So many of what was done otherwise are told unless all are wanted.
const TOLD_MAX: usize = 40;

/// Tell how two runs differ: what was done otherwise, and when; behaviors, reports and ends.
///
/// The exit code is 0 when both did the same in the same order, whatever the numbers, and 1 when they did not.
#[derive(clap::Args)]
pub struct Diff {
    /// The folder of the first run, or its journal.
    first: PathBuf,
    /// The folder of the second run, or its journal.
    second: PathBuf,
    /// Tell all that was done otherwise, not the first 40.
    #[arg(long)]
    all: bool,
    /// Print the result as JSON.
    #[arg(long)]
    json: bool,
    /// The folder of the project, where files of data are that the scripts read; else where each was run.
    #[arg(long, value_name = "FOLDER")]
    project: Option<PathBuf>,
}

impl Diff {
    /// Tells it.
    pub fn run(&self) -> Exit {
        self.differ().unwrap_or_else(|exit| exit)
    }

    fn differ(&self) -> Result<Exit, Exit> {
        let (first, second) = (PastJournal::open(&self.first)?, PastJournal::open(&self.second)?);
        let runs = [first.past_run(self.project.as_deref())?, second.past_run(self.project.as_deref())?];
        let difference = RunDifference::of([&runs[0], &runs[1]], [first.reader()?, second.reader()?]);
        match self.json {
            true => output::print_json(&difference),
            false => self.tell(&runs, &difference),
        }
        Ok(if difference.same_behavior { Exit::Well } else { Exit::NotWell })
    }

    fn tell(&self, runs: &[PastRun; 2], difference: &RunDifference) {
        let mut lines = Lines::default();
        let title = |run: &PastRun| {
            let header = run.header();
            format!("{} in {}, seed {}", header.mission, header.scenario, header.seed)
        };
        lines.add(&format!("- {}: {}", self.first.display(), title(&runs[0])));
        lines.add(&format!("+ {}: {}", self.second.display(), title(&runs[1])));
        difference.run.iter().for_each(|what| lines.add(&format!("  {what}")));
        lines.add("");
        lines.add(verdict(difference));
        let first = |what: &str, tick: Option<u64>| {
            tick.map(|tick| format!("  first {what} otherwise at {:.1} s", tick as f64 / 10.0))
        };
        first("sensed", difference.sensed_at).iter().for_each(|line| lines.add(line));
        first("commanded", difference.commanded_at).iter().for_each(|line| lines.add(line));
        self.tell_deeds(difference, &mut lines);
        tell_behaviors(difference, &mut lines);
        tell_reports(difference, &mut lines);
        tell_ends(difference, &mut lines);
        lines.print();
    }

    fn tell_deeds(&self, difference: &RunDifference, lines: &mut Lines) {
        let most = if self.all { usize::MAX } else { TOLD_MAX };
        if !difference.deeds.is_empty() {
            lines.add("");
        }
        difference.deeds.iter().take(most).for_each(|deed| lines.add(&deed.line()));
        match difference.deeds.len().saturating_sub(most) {
            0 => {}
            more => lines.add(&format!("  and {more} more: `--all` tells them")),
        }
        if difference.is_cut {
            lines.add("  only the first 10000 of each run were held against each other");
        }
    }
}

fn verdict(difference: &RunDifference) -> &'static str {
    match difference {
        _ if difference.is_same() => "the same to the bit",
        _ if difference.same_behavior => "numerically different, same behavior",
        _ => "different behavior",
    }
}

fn tell_behaviors(difference: &RunDifference, lines: &mut Lines) {
    if difference.behaviors.is_empty() {
        return;
    }
    lines.add("");
    let width = difference.behaviors.iter().map(|behavior| behavior.name.chars().count()).max().unwrap_or(0);
    for behavior in &difference.behaviors {
        let [a, b] = behavior.entered;
        let times = match b as i128 - a as i128 {
            0 => format!("{a} times"),
            1 => format!("{a} times -> {b}, one more"),
            -1 => format!("{a} times -> {b}, one less"),
            more if more > 0 => format!("{a} times -> {b}, {more} more"),
            less => format!("{a} times -> {b}, {} less", -less),
        };
        let [a, b] = behavior.time_s;
        lines.add(&format!("  {:width$}  {times:<26}  {a:.1} s -> {b:.1} s", behavior.name));
    }
}

fn tell_reports(difference: &RunDifference, lines: &mut Lines) {
    if !difference.reports.is_empty() {
        lines.add("");
    }
    for report in &difference.reports {
        let nth = if report.nth > 1 { format!(" no. {}", report.nth) } else { String::new() };
        let mut text = format!("  report {}{nth}", report.name);
        match report.t_s {
            [Some(a), Some(b)] => text += &format!("  {a:.1} s -> {b:.1} s"),
            [Some(a), None] => text += &format!("  at {a:.1} s by the first alone"),
            [None, Some(b)] => text += &format!("  at {b:.1} s by the second alone"),
            [None, None] => {}
        }
        if let Some(apart) = report.apart_m {
            text += &format!(", {apart:.1} m apart");
        }
        if let [Some(a), Some(b)] = report.error_m {
            text += &format!(", error {a:.1} m -> {b:.1} m");
        }
        if report.told[0] != report.told[1] && report.t_s.iter().all(Option::is_some) {
            text += &format!(": {} -> {}", report.told[0], report.told[1]);
        }
        lines.add(&text);
    }
}

fn tell_ends(difference: &RunDifference, lines: &mut Lines) {
    let [a, b] = &difference.ends;
    if a == b {
        return;
    }
    lines.add("");
    let end = |outcome: &str, reason: &str| match reason {
        _ if outcome == "running" => "end not known".to_string(),
        "" => outcome.replace('_', " "),
        reason => format!("{} ({reason})", outcome.replace('_', " ")),
    };
    lines.add(&format!(
        "  ended {} after {:.1} s and {:.0} m -> {} after {:.1} s and {:.0} m",
        end(a.outcome, &a.reason),
        a.time_s,
        a.path_length_m,
        end(b.outcome, &b.reason),
        b.time_s,
        b.path_length_m
    ));
}
