//! What the runs of one mission come to, as a person and as a program reads it.

use super::seeds::Seeds;
use crate::output::Lines;
use albacore_session::campaign::{INTERVAL, Missed, QUANTILE, Quantiles, Share, Tally, Within, tells_places};
use albacore_session::{Plan, number};
use serde::Serialize;
use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::path::Path;

/// Results, and causes of misses, that a person is shown.
pub const LISTED_MAX: usize = 8;

/// The summary of one mission, as `--json` prints it. Where nothing was reported there are no quantiles; without a source, no errors.
#[derive(Serialize)]
pub struct CampaignSummary<'a> {
    pub(super) mission: &'a str,
    pub(super) scenario: &'a str,
    pub(super) seeds: [u64; 2],
    pub(super) table: String,
    pub(super) runs: usize,
    pub(super) outcomes: &'a BTreeMap<String, usize>,
    pub(super) results: &'a BTreeMap<String, usize>,
    pub(super) reported: Share,
    pub(super) within: Option<[Within; 3]>,
    pub(super) interval: &'static str,
    pub(super) error_m: Option<Quantiles>,
    pub(super) error_along_m: Option<Quantiles>,
    pub(super) error_across_m: Option<Quantiles>,
    pub(super) report_t_s: Option<Quantiles>,
    pub(super) sim_time_s: Option<Quantiles>,
    pub(super) path_length_m: Option<Quantiles>,
    pub(super) quantile: &'static str,
    pub(super) missed: Vec<Cause<'a>>,
}

/// Why runs missed what they were for, and how to look at one of them.
#[derive(Serialize)]
pub struct Cause<'a> {
    why: &'a str,
    #[serde(flatten)]
    pub(super) missed: &'a Missed,
    /// Runs the first of them.
    command: String,
}

impl Cause<'_> {
    /// What is said of it, of a case.
    pub(super) fn listed(&self, case: &str) -> [String; 2] {
        let Cause { why, missed: Missed { count, seeds }, command } = self;
        let listed: Vec<String> = seeds.iter().map(u64::to_string).collect();
        let more = if *count > seeds.len() { ", …" } else { "" };
        let seeds = format!("seed{} {}{more}", if *count == 1 { "" } else { "s" }, listed.join(", "));
        [format!("  missed        {case}{count}, {why}: {seeds}"), format!("                {command}")]
    }
}

impl<'a> CampaignSummary<'a> {
    /// The summary of a table's only case, or of one of several. `run` is the command that runs its mission, but for the seed.
    pub fn new(plan: &'a Plan, seeds: Seeds, table: &Path, tally: &'a Tally, run: &str) -> Self {
        let cause = |(why, missed): (&'a str, &'a Missed)| Cause {
            why,
            missed,
            command: missed.seeds.first().map(|seed| format!("{run} --seed {seed}")).unwrap_or_default(),
        };
        CampaignSummary {
            mission: &plan.program.mission.name,
            scenario: &plan.scenario_name,
            seeds: [seeds.first, seeds.last],
            table: table.display().to_string(),
            runs: tally.runs(),
            outcomes: tally.outcomes(),
            results: tally.results(),
            reported: tally.reported(),
            within: (tells_places(&plan.program) && !plan.scenario.environment.sources.is_empty())
                .then(|| tally.within()),
            interval: INTERVAL,
            error_m: tally.error_m(),
            error_along_m: tally.error_along_m(),
            error_across_m: tally.error_across_m(),
            report_t_s: tally.report_t_s(),
            sim_time_s: tally.sim_time_s(),
            path_length_m: tally.path_length_m(),
            quantile: QUANTILE,
            missed: tally.missed().into_iter().map(cause).collect(),
        }
    }

    /// The summary as a person reads it.
    pub fn human(&self) -> Lines {
        let mut lines = Lines::default();
        let [first, last] = self.seeds;
        let seeds = Seeds { first, last }.named();
        let outcomes: Vec<String> =
            self.outcomes.iter().map(|(name, count)| format!("{count} {}", name.replace('_', " "))).collect();
        lines.add(&format!("{} in {}, {seeds}: {}", self.mission, self.scenario, outcomes.join(", ")));
        if !self.results.is_empty() {
            let mut results: Vec<_> = self.results.iter().collect();
            results.sort_by_key(|(_, count)| Reverse(**count));
            let told =
                results.iter().take(LISTED_MAX).map(|(name, count)| format!("{count} {}", name.replace('_', " ")));
            let more = if results.len() > LISTED_MAX { ", …" } else { "" };
            lines.add(&format!("  {:<13} {}{more}", "result", told.collect::<Vec<_>>().join(", ")));
        }
        lines.add(&self.share("reported", &self.reported));
        for within in self.within.iter().flatten() {
            lines.add(&self.share(&format!("within {} m", within.m), &within.share));
        }
        let quantities = [
            ("error", self.error_m, "m"),
            ("  down-flow", self.error_along_m, "m"),
            ("  across", self.error_across_m, "m"),
            ("first report", self.report_t_s, "s"),
            ("end", self.sim_time_s, "s"),
            ("over ground", self.path_length_m, "m"),
        ];
        for (what, quantiles, unit) in quantities {
            if let Some(Quantiles { median, p90, mean }) = quantiles {
                let [median, p90, mean] = [median, p90, mean].map(|x| number::fixed(x, 1));
                lines.add(&format!(
                    "  {what:<13} median {median:>8} {unit}, p90 {p90:>8} {unit}, mean {mean:>8} {unit}"
                ));
            }
        }
        lines.add(&format!("  intervals: {}; quantiles: {}", self.interval, self.quantile));
        for cause in self.missed.iter().take(LISTED_MAX) {
            cause.listed("").iter().for_each(|line| lines.add(line));
        }
        if self.missed.len() > LISTED_MAX {
            lines.add(&format!("  missed        by {} causes more: `--json` has them", self.missed.len() - LISTED_MAX));
        }
        lines.add(&format!("  table {}", self.table));
        lines
    }

    fn share(&self, what: &str, share: &Share) -> String {
        let percent = |x: f64| format!("{:.1}", 100.0 * x);
        let Share { count, share, low, high } = share;
        let (share, low, high) = (percent(*share), percent(*low), percent(*high));
        format!("  {what:<13} {count} of {}: {share} % ({low} to {high})", self.runs)
    }
}
