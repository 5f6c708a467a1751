//! The columns of a campaign's table, all known before the first run, and the cells of a row.

use super::cell::plain;
use super::report_columns::{ReportColumns, parts};
use crate::recorders::account::behavior_names;
use crate::summary::Summary;
use albacore_program::{Program, number};
use std::collections::BTreeSet;

/// The columns of every table. What was declared, when and how far off, is of the first report; `reports` counts all.
const FIXED: [&str; 19] = [
    "scenario",
    "seed",
    "outcome",
    "result",
    "reason",
    "report_t_s",
    "error_m",
    "declared_north_m",
    "declared_east_m",
    "true_north_m",
    "true_east_m",
    "error_along_m",
    "error_across_m",
    "sim_time_s",
    "path_length_m",
    "switches",
    "holds",
    "digest",
    "reports",
];

/// Decimals of times: a tick is a tenth of a second.
const SECOND_DECIMALS: u8 = 1;
/// Decimals of lengths: so fine that no figure made from the table shows the rounding.
pub(super) const METRE_DECIMALS: u8 = 3;

/// The columns of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Columns {
    reports: Vec<ReportColumns>,
    /// The behaviors that have columns, by their names.
    behaviors: Vec<String>,
    names: Vec<String>,
}

/// A row: a cell for each column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// The seed.
    pub seed: u64,
    /// Its cells.
    pub cells: Vec<String>,
}

impl Columns {
    /// The columns for a program's runs. What its reports hold has columns for the first report of each name, and for each further one that is
    /// asked for: how often a loop reports shows only when it runs. So have their times and errors, but for those of the first report of an
    /// only name, which are among the columns of every table. Last come how long each behavior was active, and the way meanwhile.
    pub fn new(program: &Program, reports_of_each: usize) -> Self {
        let mut reported: Vec<&str> = Vec::new();
        for site in &program.reports {
            if !reported.contains(&site.name.as_str()) {
                reported.push(&site.name);
            }
        }
        let has_one_name = reported.len() == 1;
        let mut names: Vec<String> = FIXED.map(str::to_string).to_vec();
        let mut taken: BTreeSet<String> = names.iter().cloned().collect();
        let mut reports = Vec::new();
        for name in reported {
            let parts = parts(&program.reports, name);
            for nth in 0..reports_of_each {
                let is_timed = nth > 0 || !has_one_name;
                let columns = ReportColumns { name: name.to_string(), nth, is_timed, parts: parts.clone() };
                names.extend(columns.names().into_iter().map(|name| unused(&mut taken, &name)));
                reports.push(columns);
            }
        }
        let behaviors: Vec<String> = behavior_names(program).into_iter().map(str::to_string).collect();
        for behavior in &behaviors {
            names.extend(["s", "m"].map(|unit| unused(&mut taken, &format!("{behavior}_{unit}"))));
        }
        Columns { reports, behaviors, names }
    }

    /// Their names.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Whether the mission reports anything.
    pub(super) fn has_reports(&self) -> bool {
        !self.reports.is_empty()
    }

    /// How many of its reports a row tells.
    pub(super) fn report_count(&self, cells: &[&str]) -> usize {
        let mut at = FIXED.len();
        let is_told = |columns: &ReportColumns| {
            let time = if columns.is_timed { cells.get(at) } else { None };
            at += columns.count();
            !time.copied().unwrap_or_else(|| Self::cell(cells, "report_t_s")).is_empty()
        };
        self.reports.iter().map(is_told).filter(|told| *told).count()
    }

    /// A cell of a row by the name of its column, which is one of every table.
    pub(super) fn cell<'a>(cells: &[&'a str], name: &str) -> &'a str {
        FIXED.iter().position(|fixed| *fixed == name).and_then(|i| cells.get(i)).copied().unwrap_or_default()
    }

    /// The row of a run that is over.
    pub(super) fn row(&self, run: &Summary) -> Row {
        let first = run.reports.first();
        let mut cells = vec![
            run.scenario.clone(),
            run.seed.to_string(),
            run.outcome.to_string(),
            run.result.as_ref().map(|result| result.word.clone()).unwrap_or_default(),
            run.reason.clone(),
            seconds(first.map(|r| r.t_s)),
            metres(first.and_then(|r| r.error_m)),
            metres(first.and_then(|r| r.north_m)),
            metres(first.and_then(|r| r.east_m)),
            metres(first.and_then(|r| r.true_north_m)),
            metres(first.and_then(|r| r.true_east_m)),
            metres(first.and_then(|r| r.error_along_m)),
            metres(first.and_then(|r| r.error_across_m)),
            seconds(Some(run.sim_time_s)),
            metres(Some(run.path_length_m)),
            run.switches.to_string(),
            run.holds.to_string(),
            run.digest.clone(),
            (run.reports.len() as u64 + run.more_reports).to_string(),
        ];
        for columns in &self.reports {
            let report = run.reports.iter().find(|r| r.name == columns.name && r.nth == columns.nth as u64);
            if columns.is_timed {
                cells.push(seconds(report.map(|r| r.t_s)));
                cells.push(metres(report.and_then(|r| r.error_m)));
            }
            cells.extend(columns.parts.iter().map(|part| report.map(|report| part.cell(report)).unwrap_or_default()));
        }
        for behavior in &self.behaviors {
            let spent = run.behaviors.iter().find(|spent| spent.name == *behavior);
            cells.push(seconds(Some(spent.map_or(0.0, |spent| spent.time_s))));
            cells.push(metres(Some(spent.map_or(0.0, |spent| spent.path_length_m))));
        }
        Row { seed: run.seed, cells }
    }

    /// The row of a run of which nothing is known but why it failed.
    pub(super) fn failed(&self, scenario: &str, seed: u64, why: &str) -> Row {
        let known = [("scenario", scenario), ("seed", &seed.to_string()), ("outcome", "failed"), ("reason", why)];
        let cell = |name: &String| known.iter().find(|(known, _)| known == name).map_or("", |(_, cell)| cell);
        Row { seed, cells: self.names.iter().map(|name| cell(name).to_string()).collect() }
    }
}

/// The name as it stands in the table, or what is made of it when another column has it.
fn unused(taken: &mut BTreeSet<String>, name: &str) -> String {
    let mut name = plain(name);
    while !taken.insert(name.clone()) {
        name.push('_');
    }
    name
}

fn seconds(t_s: Option<f64>) -> String {
    t_s.map(|t| number::fixed(t, SECOND_DECIMALS)).unwrap_or_default()
}

fn metres(length_m: Option<f64>) -> String {
    length_m.map(|m| number::fixed(m, METRE_DECIMALS)).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::{Columns, FIXED};
    use albacore_program::{Program, ReportSite};

    fn further(names: &[&str], reports: usize) -> Vec<String> {
        let site = |name: &&str| ReportSite { name: name.to_string(), fields: Vec::new() };
        let program = Program { reports: names.iter().map(site).collect(), ..Program::default() };
        Columns::new(&program, reports).names()[FIXED.len()..].to_vec()
    }

    #[test]
    fn further_reports_get_columns_of_their_own() {
        assert!(further(&[], 3).is_empty());
        assert!(further(&["source"], 1).is_empty());
        assert!(further(&["source", "source"], 1).is_empty());
        assert_eq!(further(&["a", "b", "a"], 1), ["a_t_s", "a_error_m", "b_t_s", "b_error_m"]);
        assert_eq!(further(&["source"], 2), ["source_2_t_s", "source_2_error_m"]);
    }

    #[test]
    fn no_two_columns_have_one_name() {
        assert_eq!(further(&["report", "end"], 1)[0], "report_t_s_");
        assert_eq!(further(&["a", "a_2"], 2)[4], "a_2_t_s_");
        // What is made of a name for a spreadsheet may be another name.
        let made = further(&["=1", "'=1", "a\u{1b}", "a\\u{1b}"], 1);
        assert_eq!((made[0].as_str(), made[2].as_str()), ("'=1_t_s", "'=1_t_s_"));
        assert_eq!((made[4].as_str(), made[6].as_str()), ("a\\u{1b}_t_s", "a\\u{1b}_t_s_"));
    }
}
