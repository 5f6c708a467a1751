//! What a campaign comes to, made from the rows of its table alone: a resumed campaign comes to the same.

use super::columns::Columns;
use super::statistics::{Quantiles, Share};
use serde::Serialize;
use std::collections::BTreeMap;

/// Metres within which a source counts as found; three answers, as one would hide too much.
const WITHIN_M: [f64; 3] = [15.0, 30.0, 50.0];

/// The rows taken in so far.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    runs: usize,
    outcomes: BTreeMap<String, usize>,
    error_m: Vec<f64>,
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

impl Tally {
    /// Takes in the cells of a row.
    pub fn add(&mut self, columns: &Columns, cells: &[&str]) {
        let cell = |name| Columns::cell(cells, name);
        let number = |name| cell(name).parse::<f64>().ok();
        self.runs += 1;
        *self.outcomes.entry(cell("outcome").to_string()).or_default() += 1;
        self.error_m.extend(number("error_m"));
        self.report_t_s.extend(number("report_t_s"));
        self.sim_time_s.extend(number("sim_time_s"));
        self.path_length_m.extend(number("path_length_m"));
        let reports = cell("reports").parse().unwrap_or(0);
        self.reports_max = self.reports_max.max(reports);
        if columns.report_count(cells) < reports {
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

    /// Seconds until the first report.
    pub fn report_t_s(&self) -> Option<Quantiles> {
        Quantiles::of(&self.report_t_s)
    }

    /// Seconds until the end.
    pub fn sim_time_s(&self) -> Option<Quantiles> {
        Quantiles::of(&self.sim_time_s)
    }

    /// How long the longest run lasted, s.
    pub fn longest_s(&self) -> f64 {
        self.sim_time_s.iter().copied().fold(0.0, f64::max)
    }

    /// Metres over ground.
    pub fn path_length_m(&self) -> Option<Quantiles> {
        Quantiles::of(&self.path_length_m)
    }

    /// How many runs reported more often than their rows can tell, and how often a run reported at most.
    pub fn crowded(&self) -> (usize, usize) {
        (self.crowded, self.reports_max)
    }
}
