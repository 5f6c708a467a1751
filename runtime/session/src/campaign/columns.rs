//! The columns of a campaign's table, all known before the first run, and the cells of a row.

use super::cell::plain;
use crate::summary::Summary;
use albacore_program::{Program, number};

/// The columns of every table. `report_t_s` and `error_m` are of the first report; `reports` counts all.
const FIXED: [&str; 11] = [
    "scenario",
    "seed",
    "outcome",
    "reason",
    "report_t_s",
    "error_m",
    "sim_time_s",
    "path_length_m",
    "switches",
    "digest",
    "reports",
];

/// Decimals of times: a tick is a tenth of a second.
const SECOND_DECIMALS: u8 = 1;
/// Decimals of lengths: so fine that no figure made from the table shows the rounding.
const METRE_DECIMALS: u8 = 3;

/// The columns of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Columns {
    /// Further reports that have columns: the name, and which of that name it is, from 0.
    further: Vec<(String, usize)>,
    /// Which report of each name is the first of those.
    from: usize,
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
    /// The columns for a program's runs. One that reports under several names has two columns for each of them, and for
    /// each further report of a name that is asked for two more: how often a loop reports shows only when it runs.
    pub fn new(program: &Program, reports_of_each: usize) -> Self {
        let mut reported: Vec<&str> = Vec::new();
        for site in &program.reports {
            if !reported.contains(&site.name.as_str()) {
                reported.push(&site.name);
            }
        }
        let mut names: Vec<String> = FIXED.map(str::to_string).to_vec();
        let mut further = Vec::new();
        // The first report of an only name has its columns already.
        let from = if reported.len() == 1 { 1 } else { 0 };
        for name in reported {
            for nth in from..reports_of_each {
                let prefix = if nth == 0 { name.to_string() } else { format!("{name}_{}", nth + 1) };
                for unit in ["t_s", "error_m"] {
                    names.push(unused(&names, format!("{prefix}_{unit}")));
                }
                further.push((name.to_string(), nth));
            }
        }
        Columns { further, names, from }
    }

    /// Their names.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// How many of its reports a row tells.
    pub(super) fn report_count(&self, cells: &[&str]) -> usize {
        let further = cells.iter().skip(FIXED.len()).step_by(2).filter(|t_s| !t_s.is_empty()).count();
        let first = !Self::cell(cells, "report_t_s").is_empty();
        if self.from == 0 { further } else { further + usize::from(first) }
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
            run.reason.clone(),
            seconds(first.map(|r| r.t_s)),
            metres(first.and_then(|r| r.error_m)),
            seconds(Some(run.sim_time_s)),
            metres(Some(run.path_length_m)),
            run.switches.to_string(),
            run.digest.clone(),
            (run.reports.len() as u64 + run.more_reports).to_string(),
        ];
        for (name, nth) in &self.further {
            let report = run.reports.iter().filter(|r| r.name == *name).nth(*nth);
            cells.push(seconds(report.map(|r| r.t_s)));
            cells.push(metres(report.and_then(|r| r.error_m)));
        }
        Row { seed: run.seed, cells }
    }

    /// The row of a run of which nothing is known but why it failed.
    pub(super) fn failed(&self, scenario: &str, seed: u64, why: &str) -> Row {
        let mut cells = vec![scenario.to_string(), seed.to_string(), "failed".to_string(), why.to_string()];
        cells.resize(self.names.len(), String::new());
        Row { seed, cells }
    }
}

/// The name as it stands in the table, or what is made of it when another column has it.
fn unused(names: &[String], name: String) -> String {
    let mut name = plain(&name);
    while names.contains(&name) {
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
