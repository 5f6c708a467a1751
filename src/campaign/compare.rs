//! `albacore campaign compare`: two tables of one world, or the cases of one, seed by seed.

use super::provenance::CaseOrigin;
use super::written::{Unusable, WrittenTable};
use crate::exit::Exit;
use crate::output::Lines;
use crate::{message, output};
use albacore_session::campaign::{MEDIAN_INTERVAL, PairedDifference, PairedShare, SHARE_INTERVAL, TEST, WITHIN_M};
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Compare two tables, or the cases of one, seed by seed.
///
/// What is compared is of one world, and of missions, parameters, vehicles or faults that differ: the same seed is the same water in both. Shares are
/// compared by McNemar's test and Newcombe's interval for paired shares; errors, times and ways by the median of their
/// differences. Of one table each case is compared with the first of its world. Of two tables one may have a single case, with which
/// all of the other are compared; else they have the same cases. Tables of other water, bottom or plume, of different versions, or
/// without a seed in common, are refused.
#[derive(clap::Args)]
pub struct Compare {
    /// One table.
    #[arg(value_name = "A.csv")]
    a: PathBuf,
    /// The other: differences are what it has more. Without it the cases of the one are compared.
    #[arg(value_name = "B.csv")]
    b: Option<PathBuf>,
    /// Print the comparisons as one JSON object on standard output.
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

/// All that is compared, as `--json` prints it.
#[derive(Serialize)]
struct Comparisons {
    comparisons: Vec<Comparison>,
    share_interval: &'static str,
    median_interval: &'static str,
    test: &'static str,
}

/// A table, and what is compared of the runs of each of its cases, by their seeds.
struct Side {
    table: WrittenTable,
    cases: Vec<BTreeMap<u64, Compared>>,
}

/// A case of a table.
#[derive(Clone, Copy)]
struct CaseOf<'a> {
    of: &'a Side,
    case: usize,
}

impl<'a> CaseOf<'a> {
    fn origin(self) -> &'a CaseOrigin {
        &self.of.table.origin.cases()[self.case]
    }

    fn runs(self) -> &'a BTreeMap<u64, Compared> {
        &self.of.cases[self.case]
    }

    /// Which it is, where its table has several.
    fn number(self) -> Option<usize> {
        (self.of.table.origin.cases().len() > 1).then_some(self.case + 1)
    }
}

/// What two cases come to together.
#[derive(Serialize)]
struct Comparison {
    a: Told,
    b: Told,
    /// Seeds that both have.
    pairs: usize,
    /// Whether they are of scripts that differ.
    scripts_differ: bool,
    shares: Vec<ShareOf>,
    differences: Vec<DifferenceOf>,
}

#[derive(Serialize)]
struct Told {
    table: String,
    /// Which of its cases, where it has several.
    case: Option<usize>,
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
    /// Prints the comparisons, or says why there are none.
    pub fn run(&self) -> Exit {
        match self.comparisons() {
            Ok(comparisons) if self.json => output::print_json(&comparisons),
            Ok(comparisons) => comparisons.human().print(),
            Err((message, help)) => {
                message::error(&message, Some(&help));
                return Exit::Usage;
            }
        }
        Exit::Well
    }

    fn comparisons(&self) -> Result<Comparisons, Unusable> {
        let a = Side::read(&self.a)?;
        let b = self.b.as_deref().map(Side::read).transpose()?;
        let pairs = match &b {
            None => of_one(&a)?,
            Some(b) => of_two(&a, b)?,
        };
        let comparisons = pairs.into_iter().map(|(a, b)| Comparison::of(a, b)).collect::<Result<_, _>>()?;
        Ok(Comparisons { comparisons, share_interval: SHARE_INTERVAL, median_interval: MEDIAN_INTERVAL, test: TEST })
    }
}

/// The cases of a table, each but the first of its world with that.
fn of_one(side: &Side) -> Result<Vec<(CaseOf<'_>, CaseOf<'_>)>, Unusable> {
    let cases = side.table.origin.cases();
    let pair = |(case, origin): (usize, &CaseOrigin)| {
        let first = cases[..case].iter().position(|first| first.other_world(origin).is_none())?;
        Some((CaseOf { of: side, case: first }, CaseOf { of: side, case }))
    };
    // A table that is not finished may have no row of its last cases.
    let has_runs = |case: CaseOf| !case.runs().is_empty();
    let pairs = cases.iter().enumerate().filter_map(pair).filter(|(a, b)| has_runs(*a) && has_runs(*b));
    let pairs: Vec<_> = pairs.collect();
    if !pairs.is_empty() {
        return Ok(pairs);
    }
    let shown = side.table.path.display();
    Err(match cases.len() {
        1 => (format!("`{shown}` has one case, and nothing to compare it with"), "name another table".to_string()),
        _ if side.cases.iter().any(BTreeMap::is_empty) => {
            let message = format!("`{shown}` ends before it has all cases of its first seed");
            (message, "the campaign that began it goes on with `--resume`".to_string())
        }
        _ => {
            let message = format!("no two cases of `{shown}` are of one world");
            (message, "only in one world the same seed is the same water: sweep a parameter of the mission".to_string())
        }
    })
}

/// The cases of two tables that are compared: all with the only one of the other table, or each with the same.
fn of_two<'a>(a: &'a Side, b: &'a Side) -> Result<Vec<(CaseOf<'a>, CaseOf<'a>)>, Unusable> {
    let (of_a, of_b) = (a.cases.len(), b.cases.len());
    let pair = |in_a: usize, in_b: usize| (CaseOf { of: a, case: in_a }, CaseOf { of: b, case: in_b });
    match (of_a, of_b) {
        (1, _) => Ok((0..of_b).map(|case| pair(0, case)).collect()),
        (_, 1) => Ok((0..of_a).map(|case| pair(case, 0)).collect()),
        _ => {
            let told = |side: &Side| side.table.origin.cases().iter().map(CaseOrigin::told).collect::<Vec<_>>();
            if told(a) != told(b) {
                let message = format!("`{}` and `{}` have other cases", a.table.path.display(), b.table.path.display());
                return Err((message, "compare tables of the same cases, or of one case with any".to_string()));
            }
            Ok((0..of_a).map(|case| pair(case, case)).collect())
        }
    }
}

impl Comparison {
    fn of(a: CaseOf, b: CaseOf) -> Result<Self, Unusable> {
        let (origin_a, origin_b) = (a.origin(), b.origin());
        let (first, second) = (a.runs(), b.runs());
        let why = origin_a.other_world(origin_b).or_else(|| a.of.table.origin.other_version(&b.of.table.origin));
        if let Some(why) = why {
            let help = "only in one world the same seed is the same water: run both in it";
            return Err((format!("the tables cannot be compared: {why}"), help.to_string()));
        }
        let pairs: Vec<_> = first.iter().filter_map(|(seed, a)| Some((a, second.get(seed)?))).collect();
        if pairs.is_empty() {
            let seeds = |case: CaseOf| format!("{}..{}", case.of.table.first(), case.of.table.last());
            let message = format!("the tables have no seed in common: {}, and {}", seeds(a), seeds(b));
            return Err((message, "run both with the same `--seeds`".to_string()));
        }
        let side = |case: CaseOf, origin: &CaseOrigin, rows: usize| Told {
            table: case.of.table.path.display().to_string(),
            case: case.number(),
            of: origin.told() + &case.of.table.origin.faults(),
            left_out: rows - pairs.len(),
        };
        let difference = |(i, (_, what, unit)): (usize, (&str, &'static str, &'static str))| {
            let numbers: Vec<_> = pairs.iter().filter_map(|(a, b)| a.numbers[i].zip(b.numbers[i])).collect();
            PairedDifference::of(&numbers).map(|difference| DifferenceOf { what, unit, difference })
        };
        Ok(Comparison {
            a: side(a, origin_a, first.len()),
            b: side(b, origin_b, second.len()),
            pairs: pairs.len(),
            scripts_differ: origin_a.scripts_differ(origin_b),
            shares: shares(&pairs),
            differences: QUANTITIES.into_iter().enumerate().filter_map(difference).collect(),
        })
    }

    fn tell(&self, lines: &mut Lines) {
        for (name, Told { table, case, of, left_out }) in [("A", &self.a), ("B", &self.b)] {
            let more = match left_out {
                0 => String::new(),
                1 => ", one seed of which the other has not".to_string(),
                seeds => format!(", {seeds} seeds of which the other has not"),
            };
            let case = case.map(|case| format!(", case {case}")).unwrap_or_default();
            lines.add(&format!("{name}  {of}  ({table}{case}{more})"));
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
    }
}

impl Comparisons {
    fn human(&self) -> Lines {
        let mut lines = Lines::default();
        for (i, comparison) in self.comparisons.iter().enumerate() {
            if i > 0 {
                lines.add("");
            }
            comparison.tell(&mut lines);
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

impl Side {
    /// Reads a table.
    fn read(path: &Path) -> Result<Self, Unusable> {
        let table = WrittenTable::read(path)?;
        let mut cases: Vec<BTreeMap<u64, Compared>> = Vec::new();
        cases.resize_with(table.origin.cases().len(), BTreeMap::new);
        let [error, report, end, way, switches] = QUANTITIES.map(|(name, ..)| name);
        table.each_row(["outcome", error, report, end, way, switches], |written, [outcome, numbers @ ..]| {
            let numbers = numbers.map(|cell| cell?.parse().ok());
            cases[written.case].insert(written.seed, Compared { completed: outcome == Some("completed"), numbers });
        })?;
        Ok(Side { table, cases })
    }
}
