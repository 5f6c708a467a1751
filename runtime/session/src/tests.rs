//! Running `test` blocks: a mission over its seeds, its expectations, and the traces that snapshots compare.

use crate::coverage::Coverage;
use crate::faults::Faults;
use crate::plan::{Plan, PlanError};
use crate::recorders::covered::Covered;
use crate::recorders::expectations::Expectations;
use crate::recorders::trace::Trace;
use crate::run::Driver;
use crate::threads::pool;
use albacore_lang::hir::When;
use albacore_lang::{RowProgram, Script, TestProgram};
use albacore_vehicle::TICK_S;
use rayon::prelude::*;
use std::fmt;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

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
    /// The first run that failed, or in which an expectation did not hold that was to hold.
    pub first_failing: Option<TestRun>,
    /// The traces that snapshots compare, by their runs.
    pub traces: Vec<(TestRun, String)>,
    /// What its runs have come to of the mission, where that was asked for.
    pub coverage: Coverage,
}

/// How a test is run.
pub struct TestOptions<'a> {
    /// What goes wrong beside what the scenario says.
    pub faults: &'a Faults,
    /// Runs at once; else one for each core.
    pub threads: Option<usize>,
    /// Whether to tell what the runs come to of the mission.
    pub coverage: bool,
    /// Whoever raises it ends all runs, and there is no result.
    pub stop: &'a AtomicBool,
    /// Called when a run has come to its end, on its thread.
    pub ran: &'a (dyn Fn() + Sync),
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

/// Runs one test to its end on all cores. `faults` are added to those of its scenario.
pub fn run_test(script: &Script, test: &TestProgram, faults: &Faults) -> Result<TestResult, PlanError> {
    let options = TestOptions { faults, threads: None, coverage: false, stop: &AtomicBool::new(false), ran: &|| () };
    let interrupted = || PlanError::Asked("the test was interrupted".to_string(), None);
    run_test_with(script, test, &options)?.ok_or_else(interrupted)
}

/// Runs one test: all its seeds, in each row of its table. The result does not depend on the number of threads. `None`: it was stopped.
pub fn run_test_with(
    script: &Script,
    test: &TestProgram,
    options: &TestOptions,
) -> Result<Option<TestResult>, PlanError> {
    let plans: Vec<Plan> =
        test.rows.iter().map(|row| plan(script, test, row, options.faults)).collect::<Result<_, _>>()?;
    let seeds = test.seeds.0..=test.seeds.1;
    let all: Vec<(usize, u64)> = (0..plans.len()).flat_map(|row| seeds.clone().map(move |seed| (row, seed))).collect();
    let covered: Vec<Mutex<Covered>> = plans.iter().map(|_| Mutex::default()).collect();
    let judged = |&(row, seed): &(usize, u64)| {
        let of = &test.rows[row];
        let run = TestRun { row: (!of.text.is_empty()).then_some(row + 1), with: of.text.clone(), seed };
        let judged = judge(&plans[row], test, of, run, options)?.map(|(judged, came)| {
            if let Some(came) = came {
                covered[row].lock().unwrap_or_else(PoisonError::into_inner).add(came);
            }
            judged
        });
        judged.iter().for_each(|_| (options.ran)());
        Ok(judged)
    };
    // A system that gives no more threads has one: it takes longer, and the result is the same.
    let runs: Vec<Result<Option<Judged>, PlanError>> = match pool(options.threads) {
        Ok(pool) => pool.install(|| all.par_iter().map(judged).collect()),
        Err(_) => all.iter().map(judged).collect(),
    };
    // Of several errors the first by its run is told.
    let runs = runs.into_iter().collect::<Result<Option<Vec<Judged>>, PlanError>>()?;
    let mut coverage = Coverage::default();
    for (row, covered) in test.rows.iter().zip(covered).filter(|_| options.coverage) {
        coverage.add_runs(script, &row.mission, &covered.into_inner().unwrap_or_else(PoisonError::into_inner));
    }
    Ok(runs.map(|runs| result(test, options.faults, runs, coverage)))
}

/// The mission of a row in its world.
fn plan(script: &Script, test: &TestProgram, row: &RowProgram, faults: &Faults) -> Result<Plan, PlanError> {
    let plan = Plan::with(script, Arc::new(row.mission.clone()), &test.scenario)?;
    plan.suiting(script)?.with_faults(faults)
}

/// What one run of a test is of, and what the mission is given in it, as the texts of `--set`: by these a journal of it is read again.
pub fn test_run_plan(
    script: &Script,
    test: &TestProgram,
    run: &TestRun,
    faults: &Faults,
) -> Result<(Plan, Vec<String>), PlanError> {
    let no_row = || PlanError::Asked("the test has no such row".to_string(), None);
    let row = test.rows.get(run.row.map_or(0, |row| row - 1)).ok_or_else(no_row)?;
    let plan = plan(script, test, row, faults)?;
    Ok((plan.of_module(Path::new(&test.mission_source)), row.set.clone()))
}

/// What the runs of a test come to, in the order of its rows and seeds.
fn result(test: &TestProgram, faults: &Faults, runs: Vec<Judged>, coverage: Coverage) -> TestResult {
    let each = (runs.len() / test.rows.len().max(1)).max(1);
    let mut failing = runs.iter().position(|run| run.failed.is_some());
    let mut told = Vec::new();
    for (at, (row, runs)) in test.rows.iter().zip(runs.chunks(each)).enumerate() {
        for (failure, first) in failures(test, row, runs) {
            told.push(failure);
            failing = Some(failing.map_or(at * each + first, |before| before.min(at * each + first)));
        }
    }
    let first_failing = failing.and_then(|at| runs.get(at)).map(|run| run.run.clone());
    let met_faults = faults.is_empty() || runs.iter().any(|run| faults.begin_within(run.lasted));
    let failed = || runs.iter().filter_map(|r| Some((r.run.clone(), r.failed.clone()?)));
    let failed_of = (failed().count(), runs.len());
    let failed = failed().take(EXAMPLES_MAX).collect();
    let traces = runs.into_iter().filter_map(|r| Some((r.run, r.trace?))).collect();
    TestResult {
        name: test.name.clone(),
        file_name: test.file_name.clone(),
        place: test.place.clone(),
        seeds: test.seeds,
        rows: test.rows.len(),
        met_faults,
        failed,
        failed_of,
        failures: told,
        first_failing,
        traces,
        coverage,
    }
}

/// The expectations that did not hold in the runs of a row, each with the first of those in which it did not, or could not be looked at.
fn failures(test: &TestProgram, row: &RowProgram, runs: &[Judged]) -> Vec<(Failure, usize)> {
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
            let failure = Failure {
                text: expect.text.clone(),
                place: expect.place.clone(),
                with: row.text.clone(),
                held: (held, looked),
                wanted: share.map(|s| s * 100.0),
                examples: examples.take(EXAMPLES_MAX).collect(),
            };
            failures.push((failure, runs.iter().position(|r| r.breaches[i].is_some()).unwrap_or(0)));
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

/// Lives a run to its end, unless it is stopped.
fn judge(
    plan: &Plan,
    test: &TestProgram,
    row: &RowProgram,
    run: TestRun,
    options: &TestOptions,
) -> Result<Option<(Judged, Option<Covered>)>, PlanError> {
    if options.stop.load(Ordering::Relaxed) {
        return Ok(None);
    }
    let seed = run.seed;
    let (mut driver, start) = Driver::simulated(plan, seed)?;
    let expectations = Expectations::new(plan, test, row, seed, (start, driver.vehicle().measurements()));
    let trace = test.snapshots.contains(&seed).then(|| Trace::new(plan, seed, driver.vehicle().measurements()));
    let mut recorders = (expectations, (trace, options.coverage.then(Covered::default)));
    if driver.fold(&mut recorders, options.stop).is_none() {
        return Ok(None);
    }
    let (expectations, (trace, covered)) = recorders;
    let (failed, lasted) = (expectations.failure(), driver.tick() as f64 * TICK_S);
    let judged = Judged {
        run,
        lasted,
        looked: expectations.looked,
        breaches: expectations.breaches,
        failed,
        trace: trace.map(|trace| trace.lines().to_string()),
    };
    Ok(Some((judged, covered)))
}
