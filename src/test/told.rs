//! What is wrong with a test, in the lines that a person reads.

use albacore_session::{Failure, TestResult};
use serde::Serialize;
use std::path::Path;

/// A script, as it is named.
pub struct Named<'a> {
    /// Where it is.
    pub path: &'a Path,
    /// Whether no other that is tested has its file's name.
    pub is_alone: bool,
}

impl Named<'_> {
    /// `file:line` of it, with as much of its path as tells it from the others.
    pub fn place(&self, place: &str) -> String {
        match place.rsplit_once(':') {
            Some((_, line)) if !self.is_alone => format!("{}:{line}", self.path.display()),
            _ => place.to_string(),
        }
    }
}

/// What is wrong with a test.
pub struct Problem {
    /// With what of it.
    pub kind: ProblemKind,
    /// The lines that are printed.
    pub lines: Vec<String>,
}

/// What of a test is not as it should be.
#[derive(Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ProblemKind {
    /// Runs could not go on.
    Run,
    /// An expectation does not hold.
    Expectation,
    /// A snapshot is not as the run, not there, or cannot be read or written.
    Snapshot,
}

/// The runs that could not go on, if there are any.
pub fn failed_runs(result: &TestResult) -> Option<Problem> {
    let (failed, runs) = result.failed_of;
    if failed == 0 {
        return None;
    }
    let mut lines = vec![format!("        {failed} of {runs} runs failed: nothing is known of what came after")];
    lines.extend(result.failed.iter().map(|(run, why)| example(run, why)));
    Some(Problem { kind: ProblemKind::Run, lines })
}

/// A run that is told of as one of several.
fn example(run: &impl std::fmt::Display, found: &str) -> String {
    format!("          {run}: {found}")
}

/// A failed expectation as a person reads it.
pub fn told(at: &Named, failure: &Failure) -> Problem {
    let (held, runs) = failure.held;
    // Without the last bits of a product.
    let digits = |w: f64| (w * 1e12).round() / 1e12;
    let wanted = failure.wanted.filter(|w| *w < 100.0).map(|w| format!(", {} % wanted", digits(w))).unwrap_or_default();
    let with = if failure.with.is_empty() { String::new() } else { format!(" {}", failure.with) };
    let how_often = match runs {
        0 => format!("this behavior was active in none of the runs{with}"),
        _ => format!("held in {held} of {runs} runs{with}{wanted}"),
    };
    let mut lines =
        vec![format!("        {}  {}", at.place(&failure.place), failure.text), format!("        {how_often}")];
    lines.extend(failure.examples.iter().map(|(seed, found)| example(&format!("seed {seed}"), found)));
    Problem { kind: ProblemKind::Expectation, lines }
}
