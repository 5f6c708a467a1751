//! `albacore campaign compare`: two tables of one world, seed by seed.

use super::written::{Unusable, WrittenTable};
use crate::exit::Exit;
use crate::output::Lines;
use crate::{message, output};
use albacore_session::campaign::{MEDIAN_INTERVAL, PairedDifference, PairedShare, SHARE_INTERVAL, TEST, WITHIN_M};
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Compare two tables, seed by seed.
///
/// The tables are of one world, and of missions, parameters, vehicles or faults that differ: the same seed is the same water in both. Shares are
/// compared by McNemar's test and Newcombe's interval for paired shares; errors, times and ways by the median of their
/// differences. Tables of other water, bottom or plume, of different versions, or without a seed in common, are refused.
#[derive(clap::Args)]
pub struct Compare {
    /// One table.
    #[arg(value_name = "A.csv")]
    a: PathBuf,
    /// The other: differences are what it has more.
    #[arg(value_name = "B.csv")]
    b: PathBuf,
    /// Print the comparison as one JSON object on standard output.
    #[arg(long)]
    json: bool,
}

/// What is compared as a quantity: its column, its name and its unit. The first two are shares, too.
const QUANTITIES: [(&str, &str, &str); 5] = [
    ("error_m", "error", "m"),
    ("report_t_s", "first report", "s"),
    ("sim_time_s", "end", "s"),
    ("path_length_m", "over ground", "m"),
    ("switches", "switches", ""),
];

/// A smaller probability is told as this.
const P_MIN: f64 = 0.001;

/// What two tables come to together.
#[derive(Serialize)]
struct Comparison {
    a: Side,
    b: Side,
    /// Seeds that both have.
    pairs: usize,
    /// Whether they are of scripts that differ.
    scripts_differ: bool,
    shares: Vec<ShareOf>,
    differences: Vec<DifferenceOf>,
    share_interval: &'static str,
    median_interval: &'static str,
    test: &'static str,
}

#[derive(Serialize)]
struct Side {
    table: String,
    /// Mission, scenario, and what was changed of them.
    of: String,
    /// Seeds that the other has not.
    left_out: usize,
}

#[derive(Serialize)]
struct ShareOf {
    what: String,
    #[serde(flatten)]
    share: PairedShare,
}

#[derive(Serialize)]
struct DifferenceOf {
    what: &'static str,
    unit: &'static str,
    #[serde(flatten)]
    difference: PairedDifference,
}

/// What is compared of a run.
struct Compared {
    completed: bool,
    /// Each of [`QUANTITIES`], where the run has it.
    numbers: [Option<f64>; QUANTITIES.len()],
}

impl Compared {
    /// Metres from what was reported first to what there was to be found.
    fn error_m(&self) -> Option<f64> {
        self.numbers[0]
    }

    fn has_reported(&self) -> bool {
        self.numbers[1].is_some()
    }
}

impl Compare {
    /// Prints the comparison, or says why there is none.
    pub fn run(&self) -> Exit {
        let read = || Ok((WrittenTable::read(&self.a)?, WrittenTable::read(&self.b)?));
        match read().and_then(|(a, b)| Comparison::of(&a, &b)) {
            Ok(comparison) if self.json => output::print_json(&comparison),
            Ok(comparison) => comparison.human().print(),
            Err((message, help)) => {
                message::error(&message, Some(&help));
                return Exit::Usage;
            }
        }
        Exit::Well
    }
}

impl Comparison {
    fn of(a: &WrittenTable, b: &WrittenTable) -> Result<Self, Unusable> {
        if let Some(why) = a.origin.other_world(&b.origin) {
            let help = "only in one world the same seed is the same water: run both in it";
            return Err((format!("the tables cannot be compared: {why}"), help.to_string()));
        }
        let (first, second) = (compared(a)?, compared(b)?);
        let pairs: Vec<_> = first.iter().filter_map(|(seed, a)| Some((a, second.get(seed)?))).collect();
        if pairs.is_empty() {
            let seeds = |table: &WrittenTable| format!("{}..{}", table.first(), table.last());
            let message = format!("the tables have no seed in common: {}, and {}", seeds(a), seeds(b));
            return Err((message, "run both with the same `--seeds`".to_string()));
        }
        let side = |table: &WrittenTable| Side {
            table: table.path.display().to_string(),
            of: table.origin.told(),
            left_out: table.rows.len() - pairs.len(),
        };
        let difference = |(i, (_, what, unit)): (usize, (&str, &'static str, &'static str))| {
            let numbers: Vec<_> = pairs.iter().filter_map(|(a, b)| a.numbers[i].zip(b.numbers[i])).collect();
            PairedDifference::of(&numbers).map(|difference| DifferenceOf { what, unit, difference })
        };
        Ok(Comparison {
            a: side(a),
            b: side(b),
            pairs: pairs.len(),
            scripts_differ: a.origin.scripts_differ(&b.origin),
            shares: shares(&pairs),
            differences: QUANTITIES.into_iter().enumerate().filter_map(difference).collect(),
            share_interval: SHARE_INTERVAL,
            median_interval: MEDIAN_INTERVAL,
            test: TEST,
        })
    }

    fn human(&self) -> Lines {
        let mut lines = Lines::default();
        for (name, Side { table, of, left_out }) in [("A", &self.a), ("B", &self.b)] {
            let more = match left_out {
                0 => String::new(),
                1 => ", one seed of which the other has not".to_string(),
                seeds => format!(", {seeds} seeds of which the other has not"),
            };
            lines.add(&format!("{name}  {of}  ({table}{more})"));
        }
        let scripts = if self.scripts_differ { "; the scripts differ" } else { "" };
        let seeds = if self.pairs == 1 { "1 seed".to_string() } else { format!("{} seeds", self.pairs) };
        lines.add(&format!("{seeds} in both{scripts}"));
        lines.add("                      A         B    B - A                      A alone  B alone  p");
        for ShareOf { what, share } in &self.shares {
            let percent = |x: f64| format!("{:.1} %", 100.0 * x);
            let signed = |x: f64| format!("{:+.1}", 100.0 * x + 0.0);
            let difference =
                format!("{} % ({} to {})", signed(share.difference), signed(share.low), signed(share.high));
            let PairedShare { a, b, only_a, only_b, p, .. } = share;
            let (a, b) = (percent(a.share), percent(b.share));
            let p = if *p < P_MIN { format!("< {P_MIN}") } else { format!("{p:.3}") };
            lines.add(&format!("  {what:<13} {a:>8}  {b:>8}    {difference:<25} {only_a:>8} {only_b:>8}  {p}"));
        }
        for DifferenceOf { what, unit, difference } in &self.differences {
            let PairedDifference { pairs, a, b, difference, interval } = difference;
            let interval = interval.map(|(low, high)| format!(" ({low:+.1} to {high:+.1})")).unwrap_or_default();
            let difference = format!("{difference:+.1}{interval}");
            let pairs = if *pairs == self.pairs { String::new() } else { format!("of {pairs} pairs") };
            lines.add(format!("  {what:<13} {a:>8.1}  {b:>8.1}  {unit:<1} {difference:<25} {pairs}").trim_end());
        }
        lines.add(&format!("  shares: {}; p: {}", self.share_interval, self.test));
        lines.add(&format!("  errors, times and ways are medians; intervals: {}", self.median_interval));
        lines
    }
}

/// What runs achieve, as shares of the pairs: where none reports anything there is nothing to be said of reports.
fn shares(pairs: &[(&Compared, &Compared)]) -> Vec<ShareOf> {
    let share = |what: String, holds: &dyn Fn(&Compared) -> bool| {
        let pairs: Vec<(bool, bool)> = pairs.iter().map(|(a, b)| (holds(a), holds(b))).collect();
        ShareOf { what, share: PairedShare::of(&pairs) }
    };
    let any = |has: &dyn Fn(&Compared) -> bool| pairs.iter().any(|(a, b)| has(a) || has(b));
    let mut shares = vec![share("completed".to_string(), &|run| run.completed)];
    if any(&Compared::has_reported) {
        shares.push(share("reported".to_string(), &Compared::has_reported));
    }
    if any(&|run| run.error_m().is_some()) {
        let near = |m: f64| share(format!("within {m} m"), &|run| run.error_m().is_some_and(|error| error <= m));
        shares.extend(WITHIN_M.map(near));
    }
    shares
}

/// What is compared of all runs of a table, by their seeds.
fn compared(table: &WrittenTable) -> Result<BTreeMap<u64, Compared>, Unusable> {
    let unread = |error: csv::Error| {
        let help = "name a table of `albacore campaign`".to_string();
        (format!("`{}` cannot be read: {error}", table.path.display()), help)
    };
    let lines = std::iter::once(&table.head).chain(table.rows.iter().map(|(_, line)| line));
    let text: Vec<u8> = lines.flatten().copied().collect();
    let mut reader = csv::Reader::from_reader(text.as_slice());
    let names = reader.headers().map_err(unread)?.clone();
    let column = |name: &str| names.iter().position(|other| other == name);
    let (outcome, columns) = (column("outcome"), QUANTITIES.map(|(name, ..)| column(name)));
    let row = |(seed, row): (u64, Result<csv::StringRecord, csv::Error>)| {
        let row = row.map_err(unread)?;
        let cell = |column: Option<usize>| row.get(column?);
        let numbers = columns.map(|column| cell(column)?.parse().ok());
        Ok((seed, Compared { completed: cell(outcome) == Some("completed"), numbers }))
    };
    table.rows.iter().map(|(seed, _)| *seed).zip(reader.records()).map(row).collect()
}
