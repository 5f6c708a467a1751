//! Running `test` blocks: a mission over its seeds, its expectations, and the traces that snapshots compare.

use crate::faults::Faults;
use crate::plan::{Plan, PlanError};
use crate::recorders::expectations::Expectations;
use crate::recorders::trace::Trace;
use crate::run::Driver;
use crate::threads::pool;
use albacore_lang::hir::When;
use albacore_lang::{RowProgram, Script, TestProgram};
use albacore_vehicle::TICK_S;
use rayon::prelude::*;
use std::fmt;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// What became of a test.
#[derive(Clone, Debug)]
pub struct TestResult {
    /// Its name.
    pub name: String,
    /// Its name as that of a file.
    pub file_name: String,
    /// `file:line`.
    pub place: String,
    /// The seeds that were run.
    pub seeds: (u64, u64),
    /// In how many rows of its table of parameters; 1 without one.
    pub rows: usize,
    /// Whether a run lasted until something of `faults` went wrong; true without any.
    pub met_faults: bool,
    /// The first of the runs that failed, whatever was expected of them: which, why and when.
    pub failed: Vec<(TestRun, String)>,
    /// How many failed of how many.
    pub failed_of: (usize, usize),
    /// Expectations that did not hold.
    pub failures: Vec<Failure>,
    /// The traces that snapshots compare, by their runs.
    pub traces: Vec<(TestRun, String)>,
}

/// Which of the runs of a test.
#[derive(Clone, Debug)]
pub struct TestRun {
    /// The row of its table, if it has one: 1 for the first.
    pub row: Option<usize>,
    /// What that row says, `with leg: 30 s`; empty without a table.
    pub with: String,
    /// The seed.
    pub seed: u64,
}

impl fmt::Display for TestRun {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "seed {}", self.seed)?;
        if self.with.is_empty() { Ok(()) } else { write!(f, " {}", self.with) }
    }
}

/// An expectation that did not hold.
#[derive(Clone, Debug)]
pub struct Failure {
    /// As it is written.
    pub text: String,
    /// `file:line`.
    pub place: String,
    /// The row of the table in whose runs it did not, `with leg: 30 s`; empty without a table.
    pub with: String,
    /// In how many of how many runs it held, from first to last for `always` and `while`; for `while` of those alone in which its behavior
    /// was active.
    pub held: (usize, usize),
    /// The share that was asked for, in per cent; none for `always` and `while`.
    pub wanted: Option<f64>,
    /// The first runs in which it did not hold: the seed, when, and what was found.
    pub examples: Vec<(u64, String)>,
}

/// Examples of a failure that are told.
const EXAMPLES_MAX: usize = 3;

/// Runs one test: all its seeds, in each row of its table, on all cores; the result does not depend on how many there are. `faults` are
/// added to those of its scenario.
pub fn run_test(script: &Script, test: &TestProgram, faults: &Faults) -> Result<TestResult, PlanError> {
    let plan = |row: &RowProgram| {
        let plan = Plan::with(script, Arc::new(row.mission.clone()), &test.scenario)?;
        plan.suiting(script)?.with_faults(faults)
    };
    let plans: Vec<(Plan, &RowProgram)> =
        test.rows.iter().map(|row| Ok((plan(row)?, row))).collect::<Result<_, PlanError>>()?;
    let seeds = test.seeds.0..=test.seeds.1;
    let all: Vec<(usize, u64)> = (0..plans.len()).flat_map(|row| seeds.clone().map(move |seed| (row, seed))).collect();
    let judged = |&(row, seed): &(usize, u64)| {
        let (plan, of) = &plans[row];
        let run = TestRun { row: (!of.text.is_empty()).then_some(row + 1), with: of.text.clone(), seed };
        judge(plan, test, of, run)
    };
    // A system that gives no more threads has one: it takes longer, and the result is the same.
    let runs = match pool(None) {
        Ok(pool) => pool.install(|| all.par_iter().map(judged).collect()),
        Err(_) => all.iter().map(judged).collect::<Result<Vec<Judged>, PlanError>>(),
    }?;
    let each = seeds.count().max(1);
    let rows = test.rows.iter().zip(runs.chunks(each));
    let failures = rows.flat_map(|(row, runs)| failures(test, row, runs)).collect();
    let met_faults = faults.is_empty() || runs.iter().any(|run| faults.begin_within(run.lasted));
    let failed = || runs.iter().filter_map(|r| Some((r.run.clone(), r.failed.clone()?)));
    let failed_of = (failed().count(), runs.len());
    let failed = failed().take(EXAMPLES_MAX).collect();
    let traces = runs.into_iter().filter_map(|r| Some((r.run, r.trace?))).collect();
    Ok(TestResult {
        name: test.name.clone(),
        file_name: test.file_name.clone(),
        place: test.place.clone(),
        seeds: test.seeds,
        rows: test.rows.len(),
        met_faults,
        failed,
        failed_of,
        failures,
        traces,
    })
}

/// The expectations that did not hold in the runs of a row.
fn failures(test: &TestProgram, row: &RowProgram, runs: &[Judged]) -> Vec<Failure> {
    let mut failures = Vec::new();
    for (i, expect) in test.expects.iter().enumerate() {
        let broken: Vec<&Judged> = runs.iter().filter(|r| r.breaches[i].is_some()).collect();
        let looked = runs.iter().filter(|r| r.looked[i]).count();
        let held = looked - broken.len();
        let share = match expect.when {
            When::AtTheEnd(share) => Some(share),
            When::Always | When::Once | When::While(_) => None,
        };
        // A share of whole runs, of one at least: no run is missing for the last bits of a product. What was never looked at does not hold.
        let enough = held > 0 && held as f64 >= share.unwrap_or(1.0) * looked as f64 - 1e-6;
        if !enough {
            let examples = broken.iter().filter_map(|r| Some((r.run.seed, r.breaches[i].clone()?)));
            failures.push(Failure {
                text: expect.text.clone(),
                place: expect.place.clone(),
                with: row.text.clone(),
                held: (held, looked),
                wanted: share.map(|s| s * 100.0),
                examples: examples.take(EXAMPLES_MAX).collect(),
            });
        }
    }
    failures
}

/// One run and what was expected of it.
struct Judged {
    run: TestRun,
    /// How long, s.
    lasted: f64,
    /// For each expectation whether there was a moment to look at it.
    looked: Vec<bool>,
    /// For each expectation what was found where it first did not hold.
    breaches: Vec<Option<String>>,
    /// Why it could not go on, and when.
    failed: Option<String>,
    trace: Option<String>,
}

fn judge(plan: &Plan, test: &TestProgram, row: &RowProgram, run: TestRun) -> Result<Judged, PlanError> {
    let seed = run.seed;
    let (mut driver, start) = Driver::simulated(plan, seed)?;
    let expectations = Expectations::new(plan, test, row, seed, (start, driver.vehicle().measurements()));
    let trace = test.snapshots.contains(&seed).then(|| Trace::new(plan, seed, driver.vehicle().measurements()));
    let mut recorders = (expectations, trace);
    driver.fold(&mut recorders, &AtomicBool::new(false));
    let (expectations, trace) = recorders;
    let (failed, lasted) = (expectations.failure(), driver.tick() as f64 * TICK_S);
    Ok(Judged {
        run,
        lasted,
        looked: expectations.looked,
        breaches: expectations.breaches,
        failed,
        trace: trace.map(|trace| trace.lines().to_string()),
    })
}
