//! The columns of a campaign's table, all known before the first run, and the cells of a row.

use super::Case;
use super::cell::plain;
use super::navigation_columns;
use super::report_columns::{ReportColumns, by_names, parts};
use crate::recorders::account::behavior_names;
use crate::summary::{BehaviorSummary, Report, Summary};
use albacore_program::{Program, number};
use std::collections::{BTreeMap, BTreeSet};

/// The report that says where a source is, in a mission that makes others of places beside it.
const SOURCE: &str = "source";

/// The columns of every table. What was declared, when and how far off, is of the first report of a place, or of the first called `source` where a
/// mission has such; `reports` counts all.
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
    /// How many columns stand before those of every table: the case, its mission, and what a sweep changes.
    before: usize,
    cases: Vec<CaseColumns>,
    names: Vec<String>,
}

/// The columns that the runs of one case fill, beside those of every table.
#[derive(Clone, Debug, PartialEq, Eq)]
struct CaseColumns {
    mission: String,
    reports: Vec<ReportColumns>,
    /// The behaviors that have columns, by their names.
    behaviors: Vec<String>,
    /// Where in the table each of them stands.
    places: Vec<usize>,
    /// Whether its vehicle has an inertial navigator.
    is_inertial: bool,
}

/// A row: a cell for each column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// Its number, from 0.
    pub number: u64,
    /// The seed.
    pub seed: u64,
    /// Its cells.
    pub cells: Vec<String>,
}

impl Columns {
    /// The columns for the runs of programs, one for each case, and whether its vehicle has an inertial navigator. What their reports hold has columns for the first report of each name, and for
    /// each further one that is asked for: how often a loop reports shows only when it runs. So have their times and errors, but for those of the
    /// first report of an only name, which are among the columns of every table. Then come how long each behavior was active, and
    /// the way meanwhile, and last how good the navigation was of a vehicle with an inertial navigator. Where there are several cases, the case, its mission and what is swept come first, and cases
    /// share a column that they call alike.
    pub(super) fn new(programs: &[(&Program, bool)], swept: &[String], reports_of_each: usize) -> Self {
        let mut taken: BTreeSet<String> = FIXED.map(str::to_string).into();
        let before = if programs.len() > 1 { vec!["case".to_string(), "mission".to_string()] } else { Vec::new() };
        let before = before.into_iter().chain(swept.iter().cloned());
        let mut names: Vec<String> = before.map(|name| unused(&mut taken, &name)).collect();
        let before = names.len();
        names.extend(FIXED.map(str::to_string));
        let mut known: BTreeMap<String, usize> = BTreeMap::new();
        let cases = programs.iter().map(|&(program, is_inertial)| {
            // Of its own columns no two have one name.
            let (case, own) =
                CaseColumns::new(program, is_inertial, reports_of_each, names[..before + FIXED.len()].iter().cloned());
            let place = |name: String| {
                *known.entry(name).or_insert_with_key(|name| {
                    names.push(name.clone());
                    names.len() - 1
                })
            };
            CaseColumns { places: own.into_iter().map(place).collect(), ..case }
        });
        let cases = cases.collect();
        Columns { before, cases, names }
    }

    /// Their names.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The names of those of what is swept.
    pub fn swept(&self) -> &[String] {
        let of_case = if self.cases.len() > 1 { 2 } else { 0 };
        self.names.get(of_case..self.before).unwrap_or_default()
    }

    /// The seed and the case, from 0, of a row that has all columns.
    pub fn run(&self, cells: &[&str]) -> Option<(u64, usize)> {
        let seed = self.cell(cells, "seed").parse().ok()?;
        Some((seed, self.case(cells)?)).filter(|_| cells.len() == self.names.len())
    }

    /// The case of a row, from 0.
    pub(super) fn case(&self, cells: &[&str]) -> Option<usize> {
        if self.cases.len() == 1 {
            return Some(0);
        }
        cells.first()?.parse::<usize>().ok()?.checked_sub(1).filter(|case| *case < self.cases.len())
    }

    /// Whether the mission of a case reports anything.
    pub(super) fn has_reports(&self, case: usize) -> bool {
        self.cases.get(case).is_some_and(|case| !case.reports.is_empty())
    }

    /// How many of its reports a row tells.
    pub(super) fn report_count(&self, case: usize, cells: &[&str]) -> usize {
        let Some(case) = self.cases.get(case) else { return 0 };
        let mut at = 0;
        let is_told = |columns: &ReportColumns| {
            let time = case.places.get(at).filter(|_| columns.is_timed).and_then(|place| cells.get(*place));
            at += columns.count();
            !time.copied().unwrap_or_else(|| self.cell(cells, "report_t_s")).is_empty()
        };
        case.reports.iter().map(is_told).filter(|told| *told).count()
    }

    /// A cell of a row by the name of its column, which is one of every table.
    pub(super) fn cell<'a>(&self, cells: &[&'a str], name: &str) -> &'a str {
        let place = FIXED.iter().position(|fixed| *fixed == name);
        place.and_then(|i| cells.get(self.before + i)).copied().unwrap_or_default()
    }

    /// The cells of a run that is over.
    pub(super) fn cells(&self, at: usize, swept: &[String], run: &Summary) -> Vec<String> {
        let Some(case) = self.cases.get(at) else { return Vec::new() };
        let mut cells = self.cells_before(at, swept);
        cells.extend(fixed_cells(run, case.declared(run)));
        cells.resize(self.names.len(), String::new());
        for (place, cell) in case.places.iter().zip(case.cells(run)) {
            cells[*place] = cell;
        }
        cells
    }

    /// The cells of a run of which nothing is known but why it failed.
    pub(super) fn failed(&self, at: usize, case: &Case, seed: u64, why: &str) -> Vec<String> {
        let scenario = case.plan.scenario_name.as_str();
        let known = [("scenario", scenario), ("seed", &seed.to_string()), ("outcome", "failed"), ("reason", why)];
        let cell = |name: &&str| known.iter().find(|(known, _)| known == name).map_or("", |(_, cell)| cell);
        let mut cells = self.cells_before(at, &case.swept);
        cells.extend(FIXED.iter().map(|name| cell(name).to_string()));
        cells.resize(self.names.len(), String::new());
        cells
    }

    fn cells_before(&self, at: usize, swept: &[String]) -> Vec<String> {
        let case = self.cases.get(at).filter(|_| self.cases.len() > 1);
        let case = case.map(|case| [(at + 1).to_string(), case.mission.clone()]);
        case.into_iter().flatten().chain(swept.iter().cloned()).collect()
    }
}

impl CaseColumns {
    /// The columns of a program's runs, and their names, which are none of those that are taken.
    fn new(
        program: &Program,
        is_inertial: bool,
        reports_of_each: usize,
        taken: impl Iterator<Item = String>,
    ) -> (Self, Vec<String>) {
        let mut taken: BTreeSet<String> = taken.collect();
        let reported = by_names(&program.reports);
        let has_one_name = reported.len() == 1;
        let (mut names, mut reports) = (Vec::new(), Vec::new());
        for (name, sites) in reported {
            let parts = parts(&sites);
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
        if is_inertial {
            names.extend(navigation_columns::names().map(|name| unused(&mut taken, name)));
        }
        let mission = program.mission.name.clone();
        (CaseColumns { mission, reports, behaviors, places: Vec::new(), is_inertial }, names)
    }

    /// What a run declared: its first report of a place, of a mission that reports a `source` the first of that; of a mission whose reports are of one
    /// name or hold no places, its first.
    fn declared<'a>(&self, run: &'a Summary) -> Option<&'a Report> {
        if self.reports.iter().any(|columns| columns.name == SOURCE && columns.tells_places()) {
            return run.reports.iter().find(|report| report.name == SOURCE && report.north_m.is_some());
        }
        let name = self.reports.first().map(|columns| &columns.name);
        let has_one_name = self.reports.iter().all(|columns| Some(&columns.name) == name);
        let is_any = has_one_name || !self.reports.iter().any(ReportColumns::tells_places);
        run.reports.iter().find(|report| is_any || report.north_m.is_some())
    }

    /// The cells of a run that is over, in the order of the columns.
    fn cells(&self, run: &Summary) -> Vec<String> {
        let mut cells = Vec::new();
        let reports: BTreeMap<(&str, u64), &Report> =
            run.reports.iter().map(|r| ((r.name.as_str(), r.nth), r)).collect();
        let behaviors: BTreeMap<&str, &BehaviorSummary> = run.behaviors.iter().map(|b| (b.name.as_str(), b)).collect();
        for columns in &self.reports {
            let report = reports.get(&(columns.name.as_str(), columns.nth as u64)).copied();
            if columns.is_timed {
                cells.push(seconds(report.map(|r| r.t_s)));
                cells.push(metres(report.and_then(|r| r.error_m)));
            }
            cells.extend(columns.parts.iter().map(|part| report.map(|report| part.cell(report)).unwrap_or_default()));
        }
        for behavior in &self.behaviors {
            let spent = behaviors.get(behavior.as_str());
            cells.push(seconds(Some(spent.map_or(0.0, |spent| spent.time_s))));
            cells.push(metres(Some(spent.map_or(0.0, |spent| spent.path_length_m))));
        }
        if self.is_inertial {
            cells.extend(navigation_columns::cells(run.navigation.as_ref()));
        }
        cells
    }
}

/// The cells of a run in the columns of every table.
fn fixed_cells(run: &Summary, declared: Option<&Report>) -> [String; FIXED.len()] {
    [
        run.scenario.clone(),
        run.seed.to_string(),
        run.outcome.to_string(),
        run.result.as_ref().map(|result| result.word.clone()).unwrap_or_default(),
        run.reason.clone(),
        seconds(declared.map(|r| r.t_s)),
        metres(declared.and_then(|r| r.error_m)),
        metres(declared.and_then(|r| r.north_m)),
        metres(declared.and_then(|r| r.east_m)),
        metres(declared.and_then(|r| r.true_north_m)),
        metres(declared.and_then(|r| r.true_east_m)),
        metres(declared.and_then(|r| r.error_along_m)),
        metres(declared.and_then(|r| r.error_across_m)),
        seconds(Some(run.sim_time_s)),
        metres(Some(run.path_length_m)),
        run.switches.to_string(),
        run.holds.to_string(),
        run.digest.clone(),
        (run.reports.len() as u64 + run.more_reports).to_string(),
    ]
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

    fn program(names: &[&str]) -> Program {
        let site = |name: &&str| ReportSite { name: name.to_string(), fields: Vec::new() };
        Program { reports: names.iter().map(site).collect(), ..Program::default() }
    }

    fn further(names: &[&str], reports: usize) -> Vec<String> {
        Columns::new(&[(&program(names), false)], &[], reports).names()[FIXED.len()..].to_vec()
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

    #[test]
    fn cases_share_what_they_call_alike() {
        let (one, other) = (program(&["a", "b"]), program(&["seed", "b", "c"]));
        let columns = Columns::new(&[(&one, false), (&other, false)], &["seed".to_string(), "b_t_s".to_string()], 1);
        assert_eq!(columns.names()[..4], ["case", "mission", "seed_", "b_t_s"]);
        let further = ["a_t_s", "a_error_m", "b_t_s_", "b_error_m", "seed_t_s", "seed_error_m", "c_t_s", "c_error_m"];
        assert_eq!(columns.names()[4 + FIXED.len()..], further);
        assert_eq!(columns.cases[1].places, [4, 5, 2, 3, 6, 7].map(|place| 4 + FIXED.len() + place));
        let mut row = vec![""; columns.names().len()];
        (row[0], row[5]) = ("2", "7");
        assert_eq!((columns.run(&row), columns.run(&row[1..])), (Some((7, 1)), None));
        for case in ["0", "3", ""] {
            row[0] = case;
            assert_eq!(columns.run(&row), None);
        }
    }
}
