//! `albacore campaign`: runs missions with many seeds, on all cores, into a table.

mod cases;
mod compare;
mod digested_file;
mod line_reader;
mod merge;
mod neighbours;
mod plot;
mod provenance;
pub mod seeds;
mod summary;
mod sums;
mod sweep;
mod table;
mod written;

use crate::disk::{self, not_written};
use crate::exit::Exit;
use crate::plan::{Faults, warn_of_faults_after};
use crate::{interruption, message};
use albacore_session::campaign::{Campaign as MissionCampaign, Delivery, Tallies};
use cases::{AskedCases, Cases};
use indicatif::{ProgressBar, ProgressStyle};
use provenance::{CaseOrigin, Provenance};
use seeds::{Rows, Seeds, Shard};
use std::collections::BTreeSet;
use std::io::{self, IsTerminal};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use sweep::SweepSummary;
use table::{Foreign, Standing, Table, TableError};

/// Columns for so many reports of each name, at most.
const REPORTS_MAX: usize = 1_000;
/// So many ranges of lines are listed in a message, at most.
const LISTED_MAX: usize = 12;
/// Threads, at most.
pub const THREADS_MAX: usize = 4_096;

/// Run missions with many seeds, or do something with the tables of such.
#[derive(clap::Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct Campaigns {
    #[command(subcommand)]
    tables: Option<OfTables>,
    #[command(flatten)]
    campaign: Asked,
}

#[derive(clap::Subcommand)]
enum OfTables {
    Compare(compare::Compare),
    Merge(merge::Merge),
    Plot(plot::Plot),
}

impl Campaigns {
    /// Does what is asked for.
    pub fn run(&self) -> Exit {
        match (&self.tables, self.campaign.whole()) {
            (Some(OfTables::Compare(compare)), _) => compare.run(),
            (Some(OfTables::Merge(merge)), _) => merge.run(),
            (Some(OfTables::Plot(plot)), _) => plot.run(),
            (None, Some(campaign)) => campaign.run(),
            // The parser asks for what a campaign needs.
            (None, None) => Exit::Usage,
        }
    }
}

/// Run missions with many seeds, on all cores, into a table.
#[derive(clap::Args)]
struct Asked {
    #[command(flatten)]
    cases: AskedCases,
    #[command(flatten)]
    faults: Faults,
    /// The seeds: `1..100` with both ends, `1..<100` without the last, or one.
    #[arg(long, value_name = "A..B", allow_hyphen_values = true, required = true)]
    seeds: Option<Seeds>,
    /// Run one of so many shards of the seeds, which `albacore campaign merge` puts together: `3/8` is the third of eight.
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// The table. What it was made from is kept beside it, in `FILE.csv.origin`, and a
    /// checksum of each line in `FILE.csv.sums`.
    #[arg(long, value_name = "FILE.csv", required = true)]
    out: Option<PathBuf>,
    /// Go on with a table that was begun by the same campaign, to its end or to more seeds. Every row is held against its
    /// checksum; the seeds of those that were changed on the disk are run again. This guards against accidents, not against
    /// forgery: whoever writes a row can write its checksum.
    #[arg(long)]
    resume: bool,
    /// Columns for so many reports of each name, with what they hold: a mission may report in a loop.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = from_1_to(REPORTS_MAX))]
    reports: usize,
    /// Runs at once; else as many as there are cores.
    #[arg(long, value_name = "N", value_parser = from_1_to(THREADS_MAX))]
    threads: Option<usize>,
    /// Print the summary as one JSON object on standard output.
    #[arg(long)]
    json: bool,
}

impl Asked {
    /// What a campaign needs, where it is there: who asks for tables alone gives none of it.
    fn whole(&self) -> Option<Campaign<'_>> {
        let (seeds, out) = (self.seeds?, self.out.as_deref()?);
        Some(Campaign { seeds, out, asked: self })
    }
}

/// Missions that are run with many seeds, on all cores, into a table.
struct Campaign<'a> {
    seeds: Seeds,
    out: &'a Path,
    asked: &'a Asked,
}

impl Campaign<'_> {
    /// Runs all that the table does not have.
    fn run(&self) -> Exit {
        let Some(seeds) = self.asked.shard.map_or(Some(self.seeds), |shard| shard.of(self.seeds)) else {
            let message = format!("`--seeds {}` are too few for so many shards: this one has none", self.seeds);
            message::error(&message, Some("ask for fewer shards"));
            return Exit::Usage;
        };
        let cases = self.asked.cases.read().and_then(|cases| {
            cases
                .fit(self.seeds.count())
                .map_err(|message| (message, "ask for fewer seeds, or sweep fewer values".to_string()))?;
            Ok(cases)
        });
        let cases = match cases {
            Ok(cases) => cases,
            Err((message, help)) => {
                message::error(&message, Some(&help));
                return Exit::Usage;
            }
        };
        let planned = match cases.planned(&self.asked.faults, seeds.first) {
            Ok(planned) => planned,
            Err(exit) => return exit,
        };
        let rows = Rows { seeds, cases: planned.len() as u64 };
        let campaign = MissionCampaign::new(planned, &cases.columns(), self.asked.reports, seeds.first);
        match self.carry_out(&campaign, &cases, rows) {
            Ok(exit) => exit,
            Err(trouble) => self.told(trouble),
        }
    }

    fn origin(&self, campaign: &MissionCampaign, cases: &Cases, first_seed: u64) -> Provenance {
        let plans = || campaign.cases().iter().map(|case| &case.plan);
        let of_case = |(case, plan): (&cases::Case, _)| CaseOrigin::new(plan, &case.choice.set);
        let origins = cases.all.iter().zip(plans()).map(of_case).collect();
        Provenance::new(origins, plans(), &self.asked.faults.texts, first_seed)
    }

    fn carry_out(&self, campaign: &MissionCampaign, cases: &Cases, rows: Rows) -> Result<Exit, TableError> {
        let (columns, origin) = (campaign.columns(), self.origin(campaign, cases, rows.seeds.first));
        origin.is_small_enough().map_err(|(message, help)| TableError::Asked(message, help))?;
        // Who interrupts finds a table that can be gone on with.
        let interrupted = interruption::flag();
        let mut table = if self.asked.resume {
            Table::resume(self.out, columns, &origin, rows)?
        } else {
            Table::begin(self.out, columns, &origin)?
        };
        self.warn(&mut table);
        let bar = self.bar(rows.count(), table.rows());
        let mut trouble = None;
        let all = campaign.run(table.missing(rows), self.asked.threads, &interrupted, |delivery| {
            let done = match delivery {
                Delivery::Row(row) => table.add(&row),
                Delivery::Nothing => table.settle_when_due(),
            };
            if let Err(error) = done {
                trouble = Some(error);
                return ControlFlow::Break(());
            }
            bar.set_position(table.rows());
            ControlFlow::Continue(())
        });
        bar.finish_and_clear();
        // A line that was taken for one that was being written may have been another's.
        self.warn(&mut table);
        if let Some(trouble) = trouble {
            return Err(trouble);
        }
        table.settle()?;
        match all {
            Ok(true) => {}
            Ok(false) => {
                let (path, has, count) = (self.out.display(), table.rows(), rows.count());
                let help = "the same command with `--resume` goes on from there";
                message::error(&format!("interrupted: `{path}` has {has} of {count} runs"), Some(help));
                return Ok(Exit::NotWell);
            }
            Err(error) => {
                message::error(&format!("no threads can be started: {error}"), Some("try fewer with `--threads`"));
                return Ok(Exit::Failed);
            }
        }
        let tallies = table.tally(columns, &origin, cases.all.len())?;
        self.warn(&mut table);
        self.sum_up(campaign, cases, rows.seeds, &tallies);
        Ok(Exit::Well)
    }

    /// Says what others did to the table, and what becomes of it.
    fn warn(&self, table: &mut Table) {
        let path = self.out.display();
        for foreign in table.take_foreign() {
            let (what, done, copies) = match foreign {
                Foreign::Lines(lines, copies) => {
                    let lines = listed(&lines);
                    let what = format!("`{path}` or its `.sums` was changed since it was written: {lines}");
                    (what, "rows that were changed are run again, and what is no row is taken out", copies)
                }
                Foreign::Provenance(copies) => {
                    let what = format!("`{path}.origin` was changed since it was written");
                    (what, "it is written again, of this campaign", copies)
                }
            };
            let copies: Vec<String> = copies.iter().map(|copy| format!("`{}`", copy.display())).collect();
            let kept = match copies.is_empty() {
                true => String::new(),
                false => format!("; as it was found it is kept in {}", copies.join(" and ")),
            };
            message::warning(&what, &format!("{done}{kept}"));
        }
    }

    fn sum_up(&self, campaign: &MissionCampaign, cases: &Cases, seeds: Seeds, tallies: &Tallies) {
        interruption::nobody_looks();
        let told = SweepSummary::new(campaign, cases, &self.asked.faults, seeds, self.out, tallies);
        if self.asked.json {
            told.print_json();
        } else {
            told.human().print();
        }
        warn_of_faults_after(campaign.cases().iter().map(|case| &case.plan), tallies.longest_s());
        let (crowded, most) = tallies.crowded();
        if crowded > 0 {
            let what =
                format!("{crowded} of {} runs reported more often than the table has columns for", tallies.runs());
            let help = match most <= REPORTS_MAX {
                true => format!(
                    "with `--reports {most}` there is room for all: it counts the reports of one name, and fewer may do"
                ),
                false => format!("`--reports {REPORTS_MAX}` is the most: `run --seed N --json` has more of one run"),
            };
            message::warning(&what, &help);
        }
    }

    /// Says why there is no table, or only a part of one.
    fn told(&self, trouble: TableError) -> Exit {
        match trouble {
            TableError::Asked(what, help) => {
                message::error(&what, Some(&help));
                Exit::Usage
            }
            TableError::Gone(path) => {
                let what = format!("`{}` is not this campaign's any more: it was removed or replaced", path.display());
                let help = "what has its name now is left as it is: with the file back in its place the same command with \
                            `--resume` goes on; without it, begin anew with another `--out`";
                message::error(&what, Some(help));
                Exit::Failed
            }
            TableError::Changed(path) => {
                let what = format!("`{}` was changed by another program while the campaign went on", path.display());
                let help = "the same command with `--resume` keeps the rows that are as they were written, and runs the \
                            others again";
                message::error(&what, Some(help));
                Exit::Failed
            }
            TableError::Disk(path, error) => {
                message::error(&not_written(&path, &error), Some(&self.left(&error)));
                Exit::Failed
            }
        }
    }

    /// What is known of a table that the disk takes no more of, and how it can be gone on with. Nothing is said of a row that was not
    /// looked at: who could not write may not even have read it.
    fn left(&self, error: &io::Error) -> String {
        if !self.out.is_file() {
            return "choose another file with `--out`".to_string();
        }
        let (known, then) = match table::standing(self.out) {
            Standing::Whole(0) | Standing::Unknown => (String::new(), ""),
            Standing::Whole(1) => ("its first row is as it was written; ".to_string(), ""),
            Standing::Whole(rows) => (format!("its first {rows} rows are as they were written; "), ""),
            Standing::Changed(lines) => (
                format!("it or its `.sums` was changed since it was written: {}; ", listed(&lines)),
                ", and runs the rows that were changed again",
            ),
        };
        let again = match () {
            () if disk::is_full(error) => "when there is room again, the same command with `--resume` goes on",
            () if disk::is_forbidden(error) => {
                "when you may write it, its `.origin`, its `.sums` and their folder, or with a copy of the three as `--out`, the same \
                 command with `--resume` goes on"
            }
            () => "when the disk takes it again, the same command with `--resume` goes on",
        };
        format!("{known}{again}{then}")
    }

    fn bar(&self, count: u64, rows: u64) -> ProgressBar {
        if self.asked.json || !std::io::stderr().is_terminal() {
            return ProgressBar::hidden();
        }
        let bar = ProgressBar::new(count).with_position(rows);
        let style = ProgressStyle::with_template("{bar:40} {pos}/{len} runs, {eta} to go")
            .unwrap_or_else(|_| ProgressStyle::default_bar());
        bar.set_style(style);
        bar
    }
}

/// Line numbers as a person reads them: `lines 3, 7..9`.
fn listed(lines: &BTreeSet<usize>) -> String {
    let mut ranges: Vec<(usize, usize)> = Vec::new();
    for &line in lines {
        match ranges.last_mut() {
            Some((_, last)) if *last + 1 == line => *last = line,
            _ => ranges.push((line, line)),
        }
    }
    let shown = ranges.iter().take(LISTED_MAX);
    let shown: Vec<String> = shown.map(|(a, b)| if a == b { a.to_string() } else { format!("{a}..{b}") }).collect();
    let more = if ranges.len() > LISTED_MAX { " and more" } else { "" };
    format!("line{} {}{more}", if lines.len() == 1 { "" } else { "s" }, shown.join(", "))
}

/// Reads a number of things of which there is at least one.
pub fn from_1_to(most: usize) -> impl Fn(&str) -> Result<usize, String> + Clone {
    move |text| match text.parse() {
        Ok(number) if (1..=most).contains(&number) => Ok(number),
        _ => Err(format!("a whole number from 1 to {most} is needed")),
    }
}
