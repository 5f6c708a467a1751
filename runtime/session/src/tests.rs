//! Running `test` blocks: a mission over its seeds, its expectations, and the traces that snapshots compare.

use crate::faults::Faults;
use crate::plan::{Plan, PlanError};
use crate::run::{Run, Running};
use albacore_geometry::Point;
use albacore_lang::{ExpectProgram, Script, TestProgram};
use albacore_machine::{Evaluation, Outcome};
use albacore_program::{AREA_WORDS, number};
use albacore_vehicle::TICK_S;
use rayon::prelude::*;
use std::sync::Arc;

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
    /// The first of the runs that failed, whatever was expected of them: the seed, why and when.
    pub failed: Vec<(u64, String)>,
    /// How many failed of how many.
    pub failed_of: (usize, usize),
    /// Expectations that did not hold.
    pub failures: Vec<Failure>,
    /// The traces that snapshots compare, by seed.
    pub traces: Vec<(u64, String)>,
}

/// An expectation that did not hold.
#[derive(Clone, Debug)]
pub struct Failure {
    /// As it is written.
    pub text: String,
    /// `file:line`.
    pub place: String,
    /// In how many of how many runs it held; for `always` how many runs were without a breach.
    pub held: (usize, usize),
    /// The share that was asked for, in per cent; none for `always`.
    pub wanted: Option<f64>,
    /// The first runs in which it did not hold: the seed, when, and what was found.
    pub examples: Vec<(u64, String)>,
}

/// Examples of a failure that are told.
const EXAMPLES_MAX: usize = 3;

/// Runs one test: all its seeds, on all cores; the result does not depend on how many there are. `faults` are added to those of
/// its scenario.
pub fn run_test(script: &Script, test: &TestProgram, faults: &Faults) -> Result<TestResult, PlanError> {
    let plan = Plan::with(script, Arc::new(test.mission.clone()), &test.scenario)?;
    let plan = plan.suiting(script)?.with_faults(faults)?;
    let seeds: Vec<u64> = (test.seeds.0..=test.seeds.1).collect();
    let runs: Result<Vec<Judged>, PlanError> = seeds.par_iter().map(|&seed| judge(&plan, test, seed)).collect();
    let runs = runs?;
    let mut failures = Vec::new();
    for (i, expect) in test.expects.iter().enumerate() {
        let broken: Vec<&Judged> = runs.iter().filter(|r| r.breaches[i].is_some()).collect();
        let held = runs.len() - broken.len();
        let enough = match expect.share {
            // A share of whole runs, of one at least: no run is missing for the last bits of a product.
            Some(share) => held > 0 && held as f64 >= share * runs.len() as f64 - 1e-6,
            None => broken.is_empty(),
        };
        if !enough {
            let examples =
                broken.iter().filter_map(|r| Some((r.seed, r.breaches[i].clone()?))).take(EXAMPLES_MAX).collect();
            failures.push(Failure {
                text: expect.text.clone(),
                place: expect.place.clone(),
                held: (held, runs.len()),
                wanted: expect.share.map(|s| s * 100.0),
                examples,
            });
        }
    }
    let failed = || runs.iter().filter_map(|r| Some((r.seed, r.failed.clone()?)));
    let failed_of = (failed().count(), runs.len());
    let failed = failed().take(EXAMPLES_MAX).collect();
    let traces = runs.into_iter().filter_map(|r| Some((r.seed, r.trace?))).collect();
    Ok(TestResult {
        name: test.name.clone(),
        file_name: test.file_name.clone(),
        place: test.place.clone(),
        seeds: test.seeds,
        failed,
        failed_of,
        failures,
        traces,
    })
}

/// One run and what was expected of it.
struct Judged {
    seed: u64,
    /// For each expectation what was found where it first did not hold.
    breaches: Vec<Option<String>>,
    /// Why it could not go on, and when.
    failed: Option<String>,
    trace: Option<String>,
}

fn judge(plan: &Plan, test: &TestProgram, seed: u64) -> Result<Judged, PlanError> {
    let mut run = Run::new(plan, seed)?;
    let mut evaluation = Evaluation::new(&test.program);
    let mut breaches: Vec<Option<String>> = vec![None; test.expects.len()];
    let always: Vec<usize> = (0..test.expects.len()).filter(|&i| test.expects[i].share.is_none()).collect();
    loop {
        let over = matches!(run.step(), Running::Over(_));
        if over || !always.is_empty() {
            tell(&mut evaluation, test, &run, over);
        }
        for &i in always.iter().filter(|&&i| (run.tick() > 1 || over) && breaches[i].is_none()).collect::<Vec<_>>() {
            breaches[i] = breach(&mut evaluation, test, &test.expects[i], &run);
        }
        if over {
            break;
        }
    }
    for (i, expect) in test.expects.iter().enumerate().filter(|(_, e)| e.share.is_some()) {
        breaches[i] = breach(&mut evaluation, test, expect, &run);
    }
    let failed =
        (run.outcome() == Some(Outcome::Failed)).then(|| format!("{} ({})", run.summary(0.0).reason, time(&run)));
    let trace = test.snapshots.contains(&seed).then(|| run.trace().to_string());
    Ok(Judged { seed, breaches, failed, trace })
}

/// How long a run has lasted.
fn time(run: &Run) -> String {
    number::seconds(run.tick().saturating_sub(1)).trim().to_string()
}

/// What was found, when an expectation does not hold.
fn breach(evaluation: &mut Evaluation, test: &TestProgram, expect: &ExpectProgram, run: &Run) -> Option<String> {
    let when = || {
        let ending = expect.share.and_then(|_| ending(run));
        ending.map_or_else(|| time(run), |ending| format!("{}, {ending}", time(run)))
    };
    for (need, without) in &expect.needs {
        if evaluation.words(*need, 1)[0] == 0.0 {
            return Some(format!("{without} ({})", when()));
        }
    }
    for (point, answer) in &expect.depths {
        evaluation.run(&test.program, point.entry);
        let words = evaluation.words(point.value, 2);
        let depth = run.water_depth(Point::new(words[0], words[1]));
        evaluation.set(*answer, &[depth]);
    }
    evaluation.run(&test.program, expect.holds.entry);
    if evaluation.words(expect.holds.value, 1)[0] != 0.0 {
        return None;
    }
    let mut found: Vec<String> = Vec::new();
    for (name, code, shape) in &expect.watched {
        evaluation.run(&test.program, code.entry);
        let value = number::value(shape, evaluation.words(code.value, shape.words()));
        found.push(format!("{name} = {value}"));
    }
    let found = if found.is_empty() { "it does not hold".to_string() } else { found.join(", ") };
    Some(format!("{found} ({})", when()))
}

/// How a run ended that did not come to its own end, and why.
fn ending(run: &Run) -> Option<String> {
    let crate::Summary { outcome, reason, .. } = run.summary(0.0);
    let why = if reason.is_empty() || reason == outcome { String::new() } else { format!(": {reason}") };
    (outcome != Outcome::Completed.name()).then(|| format!("{}{why}", outcome.replace('_', " ")))
}

/// Puts what is true now where the expectations look for it.
fn tell(evaluation: &mut Evaluation, test: &TestProgram, run: &Run, over: bool) {
    let slots = &test.slots;
    let position = run.true_position();
    evaluation.set(slots.position, &[position.north, position.east]);
    let start = run.start();
    evaluation.set(slots.start, &[start.north, start.east]);
    evaluation.set(slots.deepest, &if_any(run.deepest()));
    evaluation.set(slots.time, &[run.tick().saturating_sub(1) as f64 * TICK_S]);
    evaluation.set(slots.area, run.area_words().unwrap_or(&[0.0; AREA_WORDS as usize]));
    let reports = run.reports();
    evaluation.set(slots.completed, &[f64::from(u8::from(over && run.outcome() == Some(Outcome::Completed)))]);
    let place = |r: &crate::Report| Some(Point::new(r.north_m?, r.east_m?));
    let from = reports.latest.unwrap_or(position);
    evaluation.set(slots.nearest_source, &if_any(run.nearest_source(from)));
    for (name, slot) in &slots.reported {
        let first = reports.listed.iter().find(|r| r.name == *name).and_then(place);
        evaluation.set(*slot, &if_any(first));
    }
    for (name, slot) in &slots.reported_at {
        let first = reports.listed.iter().find(|r| r.name == *name);
        evaluation.set(*slot, &[f64::from(u8::from(first.is_some())), first.map_or(0.0, |r| r.t_s)]);
    }
}

/// The words of a place that may be absent.
fn if_any(place: Option<Point>) -> [f64; 3] {
    place.map_or([0.0; 3], |place| [1.0, place.north, place.east])
}
