//! What a campaign of several cases comes to: a line for each, which tells them apart.

use super::cases::{Case, Cases};
use super::seeds::Seeds;
use super::summary::{CampaignSummary, LISTED_MAX};
use crate::output::{self, Lines};
use crate::plan::Faults;
use crate::shell;
use albacore_session::Plan;
use albacore_session::campaign::{Campaign, INTERVAL, Quantiles, Share, Tallies, Tally};
use serde::Serialize;
use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::path::Path;

/// What a campaign comes to, with all its cases.
pub struct SweepSummary<'a> {
    seeds: Seeds,
    table: &'a Path,
    /// The columns of what is swept.
    swept: Vec<String>,
    cases: Vec<CaseSummary<'a>>,
}

/// What a case comes to, as `--json` prints it.
#[derive(Serialize)]
struct CaseSummary<'a> {
    /// Its number in the table, from 1.
    case: usize,
    script: String,
    /// What is swept, by the names of the columns.
    swept: BTreeMap<String, String>,
    #[serde(flatten)]
    summary: CampaignSummary<'a>,
}

impl<'a> SweepSummary<'a> {
    /// The summary of a table.
    pub fn new(
        campaign: &'a Campaign,
        cases: &Cases,
        faults: &Faults,
        seeds: Seeds,
        table: &'a Path,
        tallies: &'a Tallies,
    ) -> Self {
        let swept = campaign.columns().swept().to_vec();
        let of_case = |(case, ((asked, plan), tally)): (usize, ((&Case, &'a Plan), &'a Tally))| {
            let command = vec!["albacore run".to_string(), shell::path(&asked.script)];
            let run = [command, asked.choice.words(), faults.words()].concat().join(" ");
            CaseSummary {
                case,
                script: asked.script.display().to_string(),
                swept: swept.iter().cloned().zip(cases.cells(asked)).collect(),
                summary: CampaignSummary::new(plan, seeds, table, tally, &run),
            }
        };
        let plans = campaign.cases().iter().map(|case| &case.plan);
        let of_cases = (1usize..).zip(cases.all.iter().zip(plans).zip(&tallies.cases));
        let cases = of_cases.map(of_case).collect();
        SweepSummary { seeds, table, swept, cases }
    }

    /// Prints it as one JSON object: that of the only case, or one with all.
    pub fn print_json(&self) {
        match self.cases.as_slice() {
            [only] => output::print_json(&only.summary),
            cases => {
                output::print_json(&serde_json::json!({ "table": self.table.display().to_string(), "cases": cases }))
            }
        }
    }

    /// The summary as a person reads it.
    pub fn human(&self) -> Lines {
        if let [only] = self.cases.as_slice() {
            return only.summary.human();
        }
        let mut lines = Lines::default();
        let runs: usize = self.cases.iter().map(|case| case.summary.runs).sum();
        lines.add(&format!("{} cases, {}: {runs} runs", self.cases.len(), self.seeds.named()));
        aligned(&self.grid()).iter().for_each(|line| lines.add(line));
        lines.add(&format!("  errors and times are medians; intervals: {INTERVAL}; `--json` has more of each case"));
        let mut missed: Vec<_> =
            self.cases.iter().flat_map(|case| case.summary.missed.iter().map(|cause| (case.case, cause))).collect();
        missed.sort_by_key(|(_, cause)| Reverse(cause.missed.count));
        for (case, cause) in missed.iter().take(LISTED_MAX) {
            cause.listed(&format!("case {case}, ")).iter().for_each(|line| lines.add(line));
        }
        if missed.len() > LISTED_MAX {
            lines.add(&format!("  missed        in {} ways more: `--json` has them", missed.len() - LISTED_MAX));
        }
        lines.add(&format!("  table {}", self.table.display()));
        lines
    }

    /// A row for each case, behind one with the names: what tells the cases apart, and what they come to.
    fn grid(&self) -> Vec<Vec<String>> {
        type Cell<'b> = Box<dyn Fn(&CaseSummary) -> String + 'b>;
        let differ = |of: fn(&CampaignSummary) -> String| {
            let mut all = self.cases.iter().map(|case| of(&case.summary));
            let first = all.next();
            all.any(|other| Some(other) != first)
        };
        let mut columns: Vec<(String, Cell)> = vec![("case".to_string(), Box::new(|case| case.case.to_string()))];
        if self.cases.iter().any(|case| case.script != self.cases[0].script) {
            columns.push(("script".to_string(), Box::new(|case| case.script.clone())));
        }
        if differ(|summary| summary.mission.to_string()) {
            columns.push(("mission".to_string(), Box::new(|case| case.summary.mission.to_string())));
        }
        if differ(|summary| summary.scenario.to_string()) {
            columns.push(("scenario".to_string(), Box::new(|case| case.summary.scenario.to_string())));
        }
        for name in &self.swept {
            columns.push((name.clone(), Box::new(move |case| case.swept.get(name).cloned().unwrap_or_default())));
        }
        let percent = |share: &Share| format!("{:.1} %", 100.0 * share.share);
        columns.push((
            "completed".to_string(),
            Box::new(move |case| {
                let completed = case.summary.outcomes.get("completed").copied().unwrap_or(0);
                percent(&Share::of(completed, case.summary.runs))
            }),
        ));
        columns.push(("reported".to_string(), Box::new(move |case| percent(&case.summary.reported))));
        if self.cases.iter().any(|case| case.summary.within.is_some()) {
            columns.push((
                "within 30 m".to_string(),
                Box::new(move |case| {
                    let within = case.summary.within.as_ref().map(|within| within[1].share);
                    let told = |share: Share| {
                        format!("{} ({:.1} to {:.1})", percent(&share), 100.0 * share.low, 100.0 * share.high)
                    };
                    within.map(told).unwrap_or_default()
                }),
            ));
        }
        let median = |of: fn(&CampaignSummary) -> Option<Quantiles>, unit: &'static str| {
            move |case: &CaseSummary| of(&case.summary).map(|q| format!("{:.1} {unit}", q.median)).unwrap_or_default()
        };
        columns.push(("error".to_string(), Box::new(median(|summary| summary.error_m, "m"))));
        columns.push(("first report".to_string(), Box::new(median(|summary| summary.report_t_s, "s"))));
        columns.push(("end".to_string(), Box::new(median(|summary| summary.sim_time_s, "s"))));
        let names = columns.iter().map(|(name, _)| name.clone()).collect();
        let cells = self.cases.iter().map(|case| columns.iter().map(|(_, cell)| cell(case)).collect());
        std::iter::once(names).chain(cells).collect()
    }
}

/// The lines of a grid whose columns stand below one another.
fn aligned(grid: &[Vec<String>]) -> Vec<String> {
    let columns = grid.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| grid.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count()).max();
    let widths: Vec<usize> = (0..columns).map(|column| width(column).unwrap_or(0)).collect();
    let line = |row: &Vec<String>| {
        let cells = row.iter().zip(&widths).map(|(cell, &width)| format!("  {cell:<width$}"));
        cells.collect::<String>().trim_end().to_string()
    };
    grid.iter().map(line).collect()
}
