//! `albacore campaign plot`: what a table comes to, as a picture.

use super::provenance::CaseOrigin;
use super::seeds::Seeds;
use super::written::{Unusable, WrittenTable};
use crate::exit::Exit;
use crate::made::{Comment, Made};
use crate::output::Lines;
use crate::{disk, message};
use albacore_session::campaign::{CASES_MAX, CampaignPicture, CasePicture};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Draw a table as a picture.
///
/// The picture shows where the first reports lie from what there was to be found, along and across the flow where there is one, how far off and
/// how late they are, and how the runs ended. Each case of a table has its colour. Of what a table does not hold, such as places of a mission that
/// reports none, nothing is drawn.
#[derive(clap::Args)]
pub struct Plot {
    /// The table.
    #[arg(value_name = "TABLE.csv")]
    table: PathBuf,
    /// The picture.
    #[arg(long, value_name = "FILE.svg")]
    out: PathBuf,
    /// Draw this case alone, by its number in the table; can be given several times.
    #[arg(long = "case", value_name = "N")]
    cases: Vec<usize>,
}

impl Plot {
    /// Writes the picture, or says why not.
    pub fn run(&self) -> Exit {
        let picture = match self.picture() {
            Ok(picture) => picture,
            Err((message, help)) => {
                message::error(&message, Some(&help));
                return Exit::Usage;
            }
        };
        match disk::remake(&self.out, &Made::new(picture.svg(), Comment::Markup)) {
            Ok(()) => {
                let mut lines = Lines::default();
                lines.add(&format!("picture {}", self.out.display()));
                lines.print();
                Exit::Well
            }
            Err(error) => {
                message::error(&disk::not_written(&self.out, &error), Some("choose another file with `--out`"));
                Exit::Failed
            }
        }
    }

    fn picture(&self) -> Result<CampaignPicture, Unusable> {
        let table = WrittenTable::read(&self.table)?;
        let chosen = self.chosen(&table)?;
        let origins: Vec<&CaseOrigin> = chosen.iter().map(|case| &table.origin.cases()[*case]).collect();
        let of: BTreeSet<String> = origins.iter().map(|origin| origin.mission_and_scenario()).collect();
        let name = |(number, origin): (&usize, &&CaseOrigin)| {
            let told = if of.len() > 1 { origin.told() } else { origin.set().join(", ") };
            let told = if told.is_empty() { "as written".to_string() } else { told };
            CasePicture { name: format!("{}: {told}", number + 1), ..CasePicture::default() }
        };
        let mut cases: Vec<CasePicture> = chosen.iter().zip(&origins).map(name).collect();
        table.each_row(COLUMNS, |row, cells| {
            let place = chosen.iter().position(|case| *case == row.case);
            if let Some(case) = place.and_then(|place| cases.get_mut(place)) {
                take(case, cells);
            }
        })?;
        let (runs, seeds) =
            (cases.iter().map(|case| case.runs).sum(), Seeds { first: table.first(), last: table.last() });
        let title = match origins.as_slice() {
            [only] => only.told(),
            _ => of.into_iter().collect::<Vec<_>>().join("; "),
        };
        Ok(CampaignPicture {
            title: title + &table.origin.faults(),
            subtitle: vec![counted(&self.table, seeds, runs, (chosen.len(), table.origin.cases().len()))],
            cases,
        })
    }

    /// The cases that are drawn, from 0.
    fn chosen(&self, table: &WrittenTable) -> Result<Vec<usize>, Unusable> {
        let (count, shown) = (table.origin.cases().len(), self.table.display());
        let some = "name those to be drawn with `--case`, such as `--case 1 --case 2`".to_string();
        if let Some(none) = self.cases.iter().find(|case| !(1..=count).contains(*case)) {
            let cases = if count == 1 { "1 case".to_string() } else { format!("the cases 1 to {count}") };
            return Err((format!("`{shown}` has no case {none}"), format!("it has {cases}")));
        }
        let named: BTreeSet<usize> = self.cases.iter().map(|case| case - 1).collect();
        let chosen: Vec<usize> = if named.is_empty() { (0..count).collect() } else { named.into_iter().collect() };
        match chosen.len() <= CASES_MAX {
            true => Ok(chosen),
            false => {
                let message =
                    format!("{} cases of `{shown}` are more than the {CASES_MAX} that have colours", chosen.len());
                Err((message, some))
            }
        }
    }
}

/// What stands beneath the title.
fn counted(table: &Path, seeds: Seeds, runs: usize, (drawn, cases): (usize, usize)) -> String {
    let name = table.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    let runs = if runs == 1 { "1 run".to_string() } else { format!("{runs} runs") };
    let cases = match (drawn, cases) {
        (_, 1) => String::new(),
        (1, cases) => format!(" of one of {cases} cases"),
        (drawn, cases) if drawn == cases => format!(" of {cases} cases"),
        (drawn, cases) => format!(" of {drawn} of {cases} cases"),
    };
    format!("{}: {runs}{cases}, table {name}", seeds.named())
}

/// What is drawn of a row.
const COLUMNS: [&str; 11] = [
    "outcome",
    "result",
    "error_m",
    "declared_north_m",
    "declared_east_m",
    "true_north_m",
    "true_east_m",
    "error_along_m",
    "error_across_m",
    "report_t_s",
    "sim_time_s",
];

/// Takes in a row.
fn take(case: &mut CasePicture, cells: [Option<&str>; COLUMNS.len()]) {
    let [outcome, result, ..] = cells;
    let number = |i: usize| cells[i].and_then(|cell| cell.parse::<f64>().ok()).filter(|x| x.is_finite());
    let count = |counts: &mut std::collections::BTreeMap<String, usize>, word: Option<&str>| {
        if let Some(word) = word.filter(|word| !word.is_empty()) {
            *counts.entry(word.to_string()).or_default() += 1;
        }
    };
    case.runs += 1;
    count(&mut case.outcomes, outcome);
    count(&mut case.results, result);
    case.errors.extend(number(2));
    let [declared, truth, in_flow] = [3, 5, 7].map(|i| number(i).zip(number(i + 1)));
    case.on_map.extend(declared.zip(truth).map(|(declared, truth)| (declared.0 - truth.0, declared.1 - truth.1)));
    case.in_flow.extend(in_flow);
    case.report_s.extend(number(9));
    case.end_s.extend(number(10));
}
