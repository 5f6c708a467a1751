//! What a campaign comes to, made from the rows of its table alone: a resumed campaign comes to the same.

use super::columns::Columns;
use super::statistics::{Quantiles, Share};
use serde::Serialize;
use std::collections::BTreeMap;

/// Metres within which a source counts as found; three answers, as one would hide too much. Farther off than the last is missed.
pub const WITHIN_M: [f64; 3] = [15.0, 30.0, 50.0];
/// Seeds of one cause of misses that are listed.
const MISSED_MAX: usize = 5;
/// Results, and causes of misses, that are told apart: they may be numbers, or hold some. All further ones are one.
const APART_MAX: usize = 100;
/// What these are called.
const OTHERS: &str = "others";

/// The rows taken in so far.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    runs: usize,
    outcomes: BTreeMap<String, usize>,
    results: BTreeMap<String, usize>,
    missed: BTreeMap<String, Missed>,
    error_m: Vec<f64>,
    error_along_m: Vec<f64>,
    error_across_m: Vec<f64>,
    report_t_s: Vec<f64>,
    sim_time_s: Vec<f64>,
    path_length_m: Vec<f64>,
    reports_max: usize,
    crowded: usize,
}

/// A share of all runs, whether they reported or not.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Within {
    /// The first report was so near to the nearest source, or nearer.
    pub m: f64,
    /// How many were.
    #[serde(flatten)]
    pub share: Share,
}

/// Runs that missed what they were for, of one cause.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Missed {
    /// How many.
    pub count: usize,
    /// The seeds of the first of them.
    pub seeds: Vec<u64>,
}

/// What the rows of each case come to, counted apart.
#[derive(Clone, Debug)]
pub struct Tallies {
    /// One for each case.
    pub cases: Vec<Tally>,
}

impl Tallies {
    /// Those of so many cases, before the first row.
    pub fn new(cases: usize) -> Self {
        Tallies { cases: vec![Tally::default(); cases] }
    }

    /// Takes in the cells of a row.
    pub fn add(&mut self, columns: &Columns, cells: &[&str]) {
        let case = columns.case(cells);
        if let Some((case, tally)) = case.and_then(|case| Some((case, self.cases.get_mut(case)?))) {
            tally.add(columns, case, cells);
        }
    }

    /// How many runs there were.
    pub fn runs(&self) -> usize {
        self.cases.iter().map(|tally| tally.runs).sum()
    }

    /// How long the longest run lasted, s.
    pub fn longest_s(&self) -> f64 {
        self.cases.iter().flat_map(|tally| &tally.sim_time_s).copied().fold(0.0, f64::max)
    }

    /// How many runs reported more often than their rows can tell, and how often a run reported at most.
    pub fn crowded(&self) -> (usize, usize) {
        let most = self.cases.iter().map(|tally| tally.reports_max).max();
        (self.cases.iter().map(|tally| tally.crowded).sum(), most.unwrap_or(0))
    }
}

impl Tally {
    fn add(&mut self, columns: &Columns, case: usize, cells: &[&str]) {
        let cell = |name| columns.cell(cells, name);
        let number = |name| cell(name).parse::<f64>().ok();
        self.runs += 1;
        *self.outcomes.entry(cell("outcome").to_string()).or_default() += 1;
        if !cell("result").is_empty() {
            *told_apart(&mut self.results, cell("result").to_string()) += 1;
        }
        if let Some(why) = missed(columns, case, cells) {
            let missed = told_apart(&mut self.missed, why);
            missed.count += 1;
            missed.seeds.extend(cell("seed").parse::<u64>().ok().filter(|_| missed.count <= MISSED_MAX));
        }
        self.error_m.extend(number("error_m"));
        self.error_along_m.extend(number("error_along_m"));
        self.error_across_m.extend(number("error_across_m"));
        self.report_t_s.extend(number("report_t_s"));
        self.sim_time_s.extend(number("sim_time_s"));
        self.path_length_m.extend(number("path_length_m"));
        let reports = cell("reports").parse().unwrap_or(0);
        self.reports_max = self.reports_max.max(reports);
        if columns.report_count(case, cells) < reports {
            self.crowded += 1;
        }
    }

    /// How many runs there were.
    pub fn runs(&self) -> usize {
        self.runs
    }

    /// How many of them ended how.
    pub fn outcomes(&self) -> &BTreeMap<String, usize> {
        &self.outcomes
    }

    /// How many had which result.
    pub fn results(&self) -> &BTreeMap<String, usize> {
        &self.results
    }

    /// The runs that missed what they were for, by the cause: that they did not complete, reported nothing, or reported far off. The most
    /// frequent cause comes first.
    pub fn missed(&self) -> Vec<(&str, &Missed)> {
        let mut missed: Vec<(&str, &Missed)> = self.missed.iter().map(|(why, missed)| (why.as_str(), missed)).collect();
        missed.sort_by_key(|(_, missed)| std::cmp::Reverse(missed.count));
        missed
    }

    /// The share of runs that reported anything.
    pub fn reported(&self) -> Share {
        Share::of(self.report_t_s.len(), self.runs)
    }

    /// The shares of runs whose first report was near a source.
    pub fn within(&self) -> [Within; 3] {
        WITHIN_M.map(|m| {
            let near = self.error_m.iter().filter(|error| **error <= m).count();
            Within { m, share: Share::of(near, self.runs) }
        })
    }

    /// Metres from the first report to the nearest source.
    pub fn error_m(&self) -> Option<Quantiles> {
        Quantiles::of(&self.error_m)
    }

    /// Metres down-flow of what there was to be found; up-flow where negative.
    pub fn error_along_m(&self) -> Option<Quantiles> {
        Quantiles::of(&self.error_along_m)
    }

    /// Metres to the right of it, looking down-flow.
    pub fn error_across_m(&self) -> Option<Quantiles> {
        Quantiles::of(&self.error_across_m)
    }

    /// Seconds until the first report.
    pub fn report_t_s(&self) -> Option<Quantiles> {
        Quantiles::of(&self.report_t_s)
    }

    /// Seconds until the end.
    pub fn sim_time_s(&self) -> Option<Quantiles> {
        Quantiles::of(&self.sim_time_s)
    }

    /// Metres over ground.
    pub fn path_length_m(&self) -> Option<Quantiles> {
        Quantiles::of(&self.path_length_m)
    }
}

/// What is kept under a name, or with that of all others where there are too many.
fn told_apart<T: Default>(kept: &mut BTreeMap<String, T>, name: String) -> &mut T {
    let is_one_more = !kept.contains_key(&name) && kept.len() >= APART_MAX;
    kept.entry(if is_one_more { OTHERS.to_string() } else { name }).or_default()
}

/// Why a run missed what it was for, if it did.
fn missed(columns: &Columns, case: usize, cells: &[&str]) -> Option<String> {
    let cell = |name| columns.cell(cells, name);
    let because = |what: String, why: &str| if why.is_empty() { what } else { format!("{what}: {why}") };
    let outcome = cell("outcome").replace('_', " ");
    match cell("error_m").parse::<f64>() {
        _ if outcome != "completed" => Some(because(outcome, cell("reason"))),
        Ok(error) => WITHIN_M.last().filter(|far| error > **far).map(|far| format!("more than {far} m off")),
        Err(_) if columns.has_reports(case) && cell("report_t_s").is_empty() => {
            Some(because("nothing declared".to_string(), &cell("result").replace('_', " ")))
        }
        Err(_) => None,
    }
}
