//! How two runs differ, in a mission's own terms.

use crate::past::PastRun;
use crate::summary::{BehaviorSummary, Report, Summary};
use albacore_geometry::Point;
use albacore_trace::journal::{Entry, JournalHeader, Reader};
use albacore_trace::{Step, TickRecord, deeds, same_behavior};
use albacore_vehicle::{Sample, Snapshot, TICK_S, seconds};
use serde::Serialize;
use similar::{Algorithm, DiffOp, capture_diff_slices};
use std::collections::BTreeMap;

/// So many deeds of each run are held against each other: of two runs that have nothing in common each would be with each.
const DEEDS_MAX: usize = 10_000;

/// How two runs differ.
#[derive(Debug, Serialize)]
pub struct RunDifference {
    /// What of them is not the same in what was run: `seed 1, and 2`.
    pub run: Vec<String>,
    /// The first tick in which something else was sensed.
    pub sensed_at: Option<u64>,
    /// The first tick in which something else was commanded.
    pub commanded_at: Option<u64>,
    /// Whether the same was done in the same order, whatever the numbers.
    pub same_behavior: bool,
    /// What was done by one alone, or at another time.
    pub deeds: Vec<DeedDifference>,
    /// Whether only the first deeds of a run were held against the other's.
    pub is_cut: bool,
    /// The behaviors that were entered otherwise often, or active otherwise long.
    pub behaviors: Vec<BehaviorDifference>,
    /// The reports that only one has, or that differ.
    pub reports: Vec<ReportDifference>,
    /// How each ended.
    pub ends: [End; 2],
}

/// What was done by one run alone, or at another time than by the other.
#[derive(Debug, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum DeedDifference {
    /// By the first alone.
    First {
        /// Its tick.
        tick: u64,
        /// What.
        deed: String,
    },
    /// By the second alone.
    Second {
        /// Its tick.
        tick: u64,
        /// What.
        deed: String,
    },
    /// By both, and the second comes later by another time than it did before.
    Shift {
        /// The tick of each.
        ticks: [u64; 2],
        /// What.
        deed: String,
    },
}

/// A behavior of both runs.
#[derive(Debug, Serialize)]
pub struct BehaviorDifference {
    /// Its name.
    pub name: String,
    /// How often each run entered it.
    pub entered: [u64; 2],
    /// How long it was active in each, s.
    pub time_s: [f64; 2],
}

/// A report of either run.
#[derive(Debug, Serialize)]
pub struct ReportDifference {
    /// Its name.
    pub name: String,
    /// Which of those of its name, from 1.
    pub nth: usize,
    /// When each run reported it, s.
    pub t_s: [Option<f64>; 2],
    /// How far apart the two places are, m.
    pub apart_m: Option<f64>,
    /// How far each is from the true place, m.
    pub error_m: [Option<f64>; 2],
    /// What each reported in words, beside the place.
    pub told: [String; 2],
}

/// How a run ended.
#[derive(Debug, PartialEq, Serialize)]
pub struct End {
    /// `completed`, `timed_out`, …
    pub outcome: &'static str,
    /// Why, when there is something to say.
    pub reason: String,
    /// After how many seconds.
    pub time_s: f64,
    /// The way over ground, m.
    pub path_length_m: f64,
    /// The digest.
    pub digest: String,
}

impl RunDifference {
    /// Of two runs, with their journals.
    pub fn of(runs: [&PastRun; 2], journals: [Reader<'_>; 2]) -> Self {
        let traces = runs.map(|run| run.trace().to_string());
        let summaries = runs.map(PastRun::summary);
        let (deeds, is_cut) = deed_differences(&traces);
        let headers = runs.map(PastRun::header);
        let (sensed_at, commanded_at) = numbers(journals);
        RunDifference {
            run: of_what(headers),
            sensed_at,
            commanded_at,
            same_behavior: same_behavior(&traces[0], &traces[1]),
            deeds,
            is_cut,
            behaviors: behaviors(&summaries),
            reports: reports(&summaries),
            ends: summaries.map(End::of),
        }
    }

    /// Whether nothing at all differs in what was sensed, commanded and done.
    pub fn is_same(&self) -> bool {
        self.sensed_at.is_none()
            && self.commanded_at.is_none()
            && self.same_behavior
            && self.deeds.is_empty()
            && self.ends[0] == self.ends[1]
    }
}

impl End {
    fn of(summary: Summary) -> Self {
        let Summary { outcome, reason, sim_time_s, path_length_m, digest, .. } = summary;
        End { outcome, reason, time_s: sim_time_s, path_length_m, digest }
    }
}

/// What of two runs is not the same in what was run.
fn of_what([a, b]: [&JournalHeader; 2]) -> Vec<String> {
    let mut out = Vec::new();
    let mut told = |what: &str, a: &str, b: &str| {
        if a != b {
            out.push(format!("{what} {a}, and {b}"));
        }
    };
    told("mission", &a.mission, &b.mission);
    told("scenario", &a.scenario, &b.scenario);
    told("seed", &a.seed.to_string(), &b.seed.to_string());
    let set = |header: &JournalHeader| match header.set.as_slice() {
        [] => "none".to_string(),
        set => set.join(" "),
    };
    told("parameters", &set(a), &set(b));
    let sources = |header: &JournalHeader| -> BTreeMap<String, u64> {
        header.sources.iter().map(|source| (source.name.clone(), source.digest)).collect()
    };
    let (first, second) = (sources(a), sources(b));
    let changed = first.iter().filter(|(name, digest)| second.get(*name).is_some_and(|other| other != *digest));
    out.extend(changed.map(|(name, _)| format!("`{name}` was changed")));
    let alone = |of: &BTreeMap<String, u64>, other: &BTreeMap<String, u64>, which: &str| {
        let names = of.keys().filter(|name| !other.contains_key(*name) && !name.starts_with("--set "));
        names.map(|name| format!("`{name}` in the {which} alone")).collect::<Vec<_>>()
    };
    out.extend(alone(&first, &second, "first"));
    out.extend(alone(&second, &first, "second"));
    out
}

/// The first ticks in which something else was sensed, and commanded. Where one has ended that of the other is something else.
fn numbers(journals: [Reader<'_>; 2]) -> (Option<u64>, Option<u64>) {
    let ticks = |journal| Reader::into_iter(journal).filter_map(tick);
    let [mut first, mut second] = journals.map(ticks);
    let (mut sensed, mut commanded) = (None, None);
    while sensed.is_none() || commanded.is_none() {
        let (a, b) = (first.next(), second.next());
        let Some(tick) = a.as_ref().or(b.as_ref()).map(|record| record.tick) else { break };
        let differs = |part: &dyn Fn(&TickRecord, &TickRecord) -> bool| match (&a, &b) {
            (Some(a), Some(b)) => a.tick != b.tick || part(a, b),
            _ => true,
        };
        if differs(&|a, b| !is_same_snapshot(&a.snapshot, &b.snapshot)) {
            sensed.get_or_insert(tick);
        }
        if differs(&|a, b| a.command != b.command) {
            commanded.get_or_insert(tick);
        }
    }
    (sensed, commanded)
}

/// Whether the same was sensed, to the bit: what is no number is itself.
fn is_same_snapshot(a: &Snapshot, b: &Snapshot) -> bool {
    let bits = |sample: &Sample| (sample.measurement, sample.reading.map(f64::to_bits));
    a.samples.iter().map(bits).eq(b.samples.iter().map(bits))
        && (a.control, a.aground, &a.answers) == (b.control, b.aground, &b.answers)
}

fn tick(entry: Entry) -> Option<Box<TickRecord>> {
    match entry {
        Entry::Step(record) if matches!(record.step, Step::Tick) => Some(record),
        _ => None,
    }
}

/// What was done by one of two traces alone, or at another time; and whether only the first of it was looked at.
pub(crate) fn deed_differences(traces: &[String; 2]) -> (Vec<DeedDifference>, bool) {
    let all = traces.each_ref().map(|trace| deeds(trace).take(DEEDS_MAX + 1).collect::<Vec<_>>());
    let is_cut = all.iter().any(|deeds| deeds.len() > DEEDS_MAX);
    let [first, second] = all.each_ref().map(|deeds| &deeds[..deeds.len().min(DEEDS_MAX)]);
    let said = |deeds: &[(u64, albacore_trace::Deed, &str)]| -> Vec<String> {
        deeds.iter().map(|(_, deed, _)| deed.said.clone()).collect()
    };
    let mut out = Vec::new();
    let mut shift = 0_i128;
    for operation in capture_diff_slices(Algorithm::Myers, &said(first), &said(second)) {
        if let DiffOp::Equal { old_index, new_index, len } = operation {
            for at in 0..len {
                let ((a, deed, _), (b, ..)) = (&first[old_index + at], &second[new_index + at]);
                let now = i128::from(*b) - i128::from(*a);
                if now != shift {
                    out.push(DeedDifference::Shift { ticks: [*a, *b], deed: deed.short().to_string() });
                    shift = now;
                }
            }
            continue;
        }
        let alone = |(tick, deed, _): &(u64, albacore_trace::Deed, &str)| (*tick, deed.short().to_string());
        let (old, new) = (first[operation.old_range()].iter(), second[operation.new_range()].iter());
        out.extend(old.map(alone).map(|(tick, deed)| DeedDifference::First { tick, deed }));
        out.extend(new.map(alone).map(|(tick, deed)| DeedDifference::Second { tick, deed }));
    }
    (out, is_cut)
}

/// The behaviors of either run that were entered otherwise often, or active otherwise long.
fn behaviors(summaries: &[Summary; 2]) -> Vec<BehaviorDifference> {
    let of = |summary: &Summary, name: &str| {
        let behavior = summary.behaviors.iter().find(|behavior| behavior.name == name);
        behavior.map_or((0, 0.0), |BehaviorSummary { entered, time_s, .. }| (*entered, *time_s))
    };
    let mut names: Vec<&str> = Vec::new();
    for behavior in summaries.iter().flat_map(|summary| &summary.behaviors) {
        if !names.contains(&&*behavior.name) {
            names.push(&behavior.name);
        }
    }
    let both = names.into_iter().map(|name| {
        let [a, b] = summaries.each_ref().map(|summary| of(summary, name));
        BehaviorDifference { name: name.to_string(), entered: [a.0, b.0], time_s: [a.1, b.1] }
    });
    let differs = |behavior: &BehaviorDifference| {
        let [a, b] = behavior.time_s;
        behavior.entered[0] != behavior.entered[1] || (a - b).abs() > TICK_S / 2.0
    };
    both.filter(differs).collect()
}

/// The reports that only one has, or that differ.
fn reports(summaries: &[Summary; 2]) -> Vec<ReportDifference> {
    let by_name = |summary: &Summary| {
        let mut reports: BTreeMap<String, Vec<Report>> = BTreeMap::new();
        for report in &summary.reports {
            reports.entry(report.name.clone()).or_default().push(report.clone());
        }
        reports
    };
    let [first, second] = summaries.each_ref().map(by_name);
    let mut out = Vec::new();
    for name in first.keys().chain(second.keys().filter(|name| !first.contains_key(*name))) {
        let none = Vec::new();
        let (a, b) = (first.get(name).unwrap_or(&none), second.get(name).unwrap_or(&none));
        for nth in 0..a.len().max(b.len()) {
            out.extend(report(name, nth, [a.get(nth), b.get(nth)]));
        }
    }
    out
}

fn report(name: &str, nth: usize, both: [Option<&Report>; 2]) -> Option<ReportDifference> {
    let place = |report: &Report| Some(Point::new(report.north_m?, report.east_m?));
    let apart_m = match both.map(|report| report.and_then(place)) {
        [Some(a), Some(b)] => Some(a.distance(b)),
        _ => None,
    };
    let same_time = |a: &Report, b: &Report| (a.t_s - b.t_s).abs() < TICK_S / 2.0;
    if let [Some(a), Some(b)] = both
        && same_time(a, b)
        && a.value == b.value
        && a.labelled == b.labelled
    {
        return None;
    }
    Some(ReportDifference {
        name: name.to_string(),
        nth: nth + 1,
        t_s: both.map(|report| report.map(|report| report.t_s)),
        apart_m,
        error_m: both.map(|report| report.and_then(|report| report.error_m)),
        told: both.map(|report| report.map_or_else(String::new, |report| report.told.clone())),
    })
}

impl DeedDifference {
    /// In words: `- 234.0 s  track_out -> scan` was done by the first alone, `+` by the second; a shift is how much later the second is.
    pub fn line(&self) -> String {
        match self {
            DeedDifference::First { tick, deed } => format!("- {:8.1} s  {deed}", seconds(*tick)),
            DeedDifference::Second { tick, deed } => format!("+ {:8.1} s  {deed}", seconds(*tick)),
            DeedDifference::Shift { ticks: [a, b], deed } => {
                let (by, which) = (seconds(a.abs_diff(*b)), if b > a { "later" } else { "earlier" });
                let when = if a == b { "at the same time again".to_string() } else { format!("{by:.1} s {which}") };
                format!("  {:8.1} s  {deed}  {when}", seconds(*a))
            }
        }
    }
}
