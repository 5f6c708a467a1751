//! What became of all tests, for the end of the command and for programs.

use super::coverage::Told;
use super::kept::Kept;
use super::snapshots::Snapshot;
use super::told::{Problem, ProblemKind};
use albacore_session::seen::one_line;
use serde::Serialize;

/// What became of all tests.
#[derive(Default, Serialize)]
pub struct Results {
    /// Each of them, in the order in which they were run.
    pub tests: Vec<Outcome>,
    /// Scripts whose tests were not run, for they have errors.
    pub scripts_with_errors: Vec<String>,
    /// So many passed.
    pub passed: usize,
    /// So many failed.
    pub failed: usize,
    /// With so many there was nothing to hold to.
    pub left_out: usize,
    /// Whether it was ended before all were run.
    pub interrupted: bool,
}

/// The same with what was asked for besides.
#[derive(Serialize)]
pub struct Whole<'a> {
    /// What became of all tests.
    #[serde(flatten)]
    pub results: &'a Results,
    /// What they came to of the missions.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coverage: Option<Told<'a>>,
}

/// What became of a test.
#[derive(Serialize)]
pub struct Outcome {
    /// Its name.
    pub name: String,
    /// Its script, as it was named.
    pub script: String,
    /// `file:line`.
    pub place: String,
    /// The seeds, both ends included.
    pub seeds: Seeds,
    /// The rows of its table; 1 without one.
    pub rows: usize,
    /// Whether it passed.
    pub passed: bool,
    /// Why there was nothing to hold it to, where that is so.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_out: Option<&'static str>,
    /// What is wrong with it.
    pub failures: Vec<Wrong>,
    /// Its snapshots, where it has been held against them.
    pub snapshots: Vec<Snapshot>,
    /// The run that was kept of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kept: Option<Kept>,
}

/// The first seed and the last.
#[derive(Serialize)]
pub struct Seeds {
    /// The first.
    pub first: u64,
    /// The last.
    pub last: u64,
}

/// What is wrong with a test: the text that was printed.
#[derive(Serialize)]
pub struct Wrong {
    /// With what of it.
    pub kind: ProblemKind,
    /// Its lines, without the margin that all of them have.
    pub text: String,
}

/// The margin of what is printed below a test.
pub const MARGIN: &str = "        ";

impl From<&Problem> for Wrong {
    fn from(problem: &Problem) -> Self {
        let lines = problem.lines.iter().map(|line| one_line(line.strip_prefix(MARGIN).unwrap_or(line)));
        Wrong { kind: problem.kind, text: lines.collect::<Vec<_>>().join("\n") }
    }
}

impl Results {
    /// How many passed and failed, and were left out.
    pub fn line(&self) -> String {
        let left_out = if self.left_out > 0 { format!(", {} left out", self.left_out) } else { String::new() };
        format!("{} passed, {} failed{left_out}", self.passed, self.failed)
    }

    /// Whether no test was found.
    pub fn is_empty(&self) -> bool {
        self.tests.is_empty()
    }
}
