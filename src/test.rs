//! `albacore test`: runs the `test` blocks of scripts and compares behavior traces with their snapshots.

mod coverage;
mod junit;
mod kept;
mod results;
mod review;
mod snapshots;
mod told;

pub use snapshots::snapshot_file;

use crate::campaign::{THREADS_MAX, from_1_to};
use crate::disk::not_written;
use crate::exit::Exit;
use crate::output::{self, Lines};
use crate::plan::Faults;
use crate::{interruption, message};
use albacore_session::seen::one_line;
use albacore_session::{Coverage, PlanError, Script, TestOptions, TestProgram, TestResult, run_test_with};
use indicatif::{ProgressBar, ProgressStyle};
use results::{Outcome, Results, Seeds, Whole, Wrong};
use snapshots::Snapshot;
use std::collections::BTreeSet;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use told::{Named, Problem, failed_runs, told};

/// Run the tests of scripts.
///
/// The first run that fails a test is kept as a folder, for `albacore why`, `repl` and `report`. The exit code is 0 when all tests pass, and 1
/// when one fails, when they cover less than `--threshold`, or when interrupted.
#[derive(clap::Args)]
pub struct Test {
    /// Scripts, or folders of scripts; else the folder `missions`, or this one where there is none.
    #[arg(value_name = "PATH")]
    paths: Vec<PathBuf>,
    /// Only the tests whose names contain this.
    #[arg(long, value_name = "TEXT")]
    filter: Option<String>,
    /// Accept the new snapshots: write them over the old. They are of runs without `--fault`, and are left out with
    /// it.
    #[arg(long, conflicts_with = "texts")]
    accept: bool,
    /// Show the snapshots that are new or changed one by one, and ask which to accept.
    #[arg(long, conflicts_with_all = ["accept", "texts", "junit", "json"])]
    review: bool,
    #[command(flatten)]
    faults: Faults,
    /// Tell which behaviors and transitions of the missions no run has come to.
    #[arg(long)]
    coverage: bool,
    /// Fail where less of the behaviors or of the transitions is covered, in per cent.
    #[arg(long, value_name = "PERCENT", requires = "coverage", value_parser = clap::value_parser!(u8).range(0..=100))]
    threshold: Option<u8>,
    /// Count the standard library, too: for tests of the library itself.
    #[arg(long, requires = "coverage")]
    library: bool,
    /// Runs at once; else as many as there are cores. The results are the same.
    #[arg(long, value_name = "N", value_parser = from_1_to(THREADS_MAX))]
    threads: Option<usize>,
    /// Write the results as an XML file in the form of JUnit.
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    /// Print the results as one JSON object on standard output.
    #[arg(long)]
    json: bool,
    /// The folder in which the first failing run of each test is kept, in a folder of its own; else `albacore-runs/tests`.
    #[arg(long, value_name = "FOLDER")]
    keep: Option<PathBuf>,
    /// Keep no runs.
    #[arg(long, conflicts_with = "keep")]
    no_keep: bool,
}

/// Tests under way.
struct Testing<'a> {
    asked: &'a Test,
    faults: albacore_session::Faults,
    results: Results,
    coverage: Coverage,
    /// Whether the standard library is counted.
    counts_library: bool,
    /// The folders of runs that this command has kept.
    taken: BTreeSet<PathBuf>,
    /// Whether a snapshot could not be written.
    unwritten: bool,
    /// Whether a person ended the review.
    quit: bool,
    interrupted: Arc<AtomicBool>,
    /// What was under way when it was interrupted.
    broken_off: String,
}

impl Test {
    /// Runs all tests; one that fails makes the whole fail.
    pub fn run(&self) -> Exit {
        let scripts = match self.scripts() {
            Ok(scripts) => scripts,
            Err(exit) => return exit,
        };
        let faults = match self.faults.read() {
            Ok(faults) => faults,
            Err(exit) => return exit,
        };
        let mut testing = Testing {
            asked: self,
            faults,
            results: Results::default(),
            coverage: Coverage::default(),
            counts_library: self.library,
            taken: BTreeSet::new(),
            unwritten: false,
            quit: false,
            interrupted: interruption::flag(),
            broken_off: String::new(),
        };
        let mut exit = Exit::Well;
        for path in &scripts {
            if testing.is_over() {
                break;
            }
            // Of several files of one name a test is told by its path.
            let is_alone = scripts.iter().filter(|other| other.file_name() == path.file_name()).count() == 1;
            let at = Named { path, is_alone };
            let script = match albacore_session::load(path, None, &[]) {
                Ok(script) => script,
                Err(error) => {
                    message::error(&error.message, error.help.as_deref());
                    return Exit::Usage;
                }
            };
            if !script.is_sound() {
                message::findings(&script.findings, &script.sources);
                testing.results.scripts_with_errors.push(path.display().to_string());
                exit = Exit::Script;
                continue;
            }
            testing.counts_library |= albacore_session::is_of_library(&script);
            if let Err(failed) = testing.tests_of(&script, &at) {
                testing.results.scripts_with_errors.push(path.display().to_string());
                exit = failed;
            }
        }
        testing.end(exit)
    }

    /// The scripts whose tests are run, or what is wrong with what was named.
    fn scripts(&self) -> Result<Vec<PathBuf>, Exit> {
        let usual = Path::new(if Path::new("missions").is_dir() { "missions" } else { "." });
        let paths = if self.paths.is_empty() { vec![usual.to_path_buf()] } else { self.paths.clone() };
        let mut scripts = Vec::new();
        for path in &paths {
            match scripts_of(path) {
                Ok(found) => scripts.extend(found),
                Err(error) => {
                    message::error(&format!("`{}` cannot be read: {error}", path.display()), None);
                    return Err(Exit::Usage);
                }
            }
        }
        Ok(scripts)
    }

    /// Says a line, where it is a person that reads.
    fn say(&self, line: &str) {
        if !self.json {
            let mut lines = Lines::default();
            lines.add(line);
            lines.print();
        }
    }

    /// Progress, where a person looks at it.
    fn bar(&self, test: &TestProgram) -> ProgressBar {
        if self.json || !std::io::stderr().is_terminal() {
            return ProgressBar::hidden();
        }
        let bar = ProgressBar::new(runs(test));
        let style = ProgressStyle::with_template("{bar:40} {pos}/{len} runs, {eta} to go  {msg}")
            .unwrap_or_else(|_| ProgressStyle::default_bar());
        bar.set_style(style);
        bar.set_message(one_line(&test.name));
        bar
    }
}

impl Testing<'_> {
    /// Whether the person wants it to end.
    fn is_stopped(&self) -> bool {
        self.interrupted.load(Ordering::Relaxed)
    }

    fn is_over(&self) -> bool {
        self.quit || self.is_stopped()
    }

    fn tests_of(&mut self, script: &Script, at: &Named) -> Result<(), Exit> {
        for test in script.tests() {
            let test = match test {
                Ok(test) => test,
                Err(findings) => {
                    message::findings(&findings, &script.sources);
                    return Err(Exit::Script);
                }
            };
            if self.asked.filter.as_ref().is_some_and(|text| !test.name.contains(text.as_str())) {
                continue;
            }
            if self.is_over() {
                return Ok(());
            }
            let Some(result) = self.run(script, at, &test)? else { return Ok(()) };
            self.coverage.add(&result.coverage);
            self.judge(script, at, &test, &result);
        }
        Ok(())
    }

    /// Runs a test; none when that was interrupted.
    fn run(&mut self, script: &Script, at: &Named, test: &TestProgram) -> Result<Option<TestResult>, Exit> {
        let bar = self.asked.bar(test);
        let ran = std::sync::atomic::AtomicU64::new(0);
        let options = TestOptions {
            faults: &self.faults,
            threads: self.asked.threads,
            coverage: self.asked.coverage,
            stop: &self.interrupted,
            ran: &|| {
                ran.fetch_add(1, Ordering::Relaxed);
                bar.inc(1);
            },
        };
        let result = run_test_with(script, test, &options);
        bar.finish_and_clear();
        match result {
            Ok(result) => {
                if result.is_none() {
                    let ran = ran.load(Ordering::Relaxed);
                    let all = runs(test);
                    self.broken_off = format!(" in \"{}\": {ran} of its {all} runs were over", test.name);
                }
                Ok(result)
            }
            Err(PlanError::Script(findings, sources)) => {
                message::findings(&findings, &sources);
                Err(Exit::Script)
            }
            Err(PlanError::Asked(what, help)) => {
                message::error(&format!("{}: {what}", at.place(&test.place)), help.as_deref());
                Err(Exit::Usage)
            }
        }
    }

    /// Holds a test to what is expected of it, and says what became of it.
    fn judge(&mut self, script: &Script, at: &Named, test: &TestProgram, result: &TestResult) {
        let mut problems: Vec<Problem> = failed_runs(result).into_iter().collect();
        problems.extend(result.failures.iter().map(|failure| told(at, failure)));
        let compared = snapshots::compare(self, at, result, !problems.is_empty());
        problems.extend(compared.problems);
        let rows = if result.rows > 1 { format!(" of {} rows", result.rows) } else { String::new() };
        let (place, (first, last)) = (at.place(&result.place), result.seeds);
        let head = format!("{place}  \"{}\"  seeds {first}..{last}{rows}", result.name);
        let left_out = match () {
            () if !problems.is_empty() || self.faults.is_empty() => None,
            () if test.expects.is_empty() => {
                Some("it expects nothing, and its snapshots are of runs without `--fault`")
            }
            () if !result.met_faults => Some("its runs are over before anything of `--fault` begins"),
            () => None,
        };
        let mut outcome = outcome(at, result, &problems, compared.snapshots);
        if let Some(why) = left_out {
            self.results.left_out += 1;
            self.asked.say(&format!("left out  {head}"));
            self.asked.say(&format!("        {why}"));
            outcome.left_out = left_out;
        } else if problems.is_empty() {
            self.results.passed += 1;
            self.asked.say(&format!("ok      {head}"));
            outcome.passed = true;
        } else {
            self.results.failed += 1;
            self.asked.say(&format!("FAILED  {head}"));
            problems.iter().flat_map(|problem| &problem.lines).for_each(|line| self.asked.say(line));
            let failing = result.first_failing.as_ref().or(compared.differing.as_ref());
            outcome.kept = failing.and_then(|run| kept::keep(self, script, at, (test, result), run));
            outcome.kept.iter().flat_map(|kept| kept.lines()).for_each(|line| self.asked.say(&line));
        }
        self.results.tests.push(outcome);
    }

    /// Says how all of it ended, and writes what was asked for.
    fn end(mut self, exit: Exit) -> Exit {
        interruption::nobody_looks();
        let is_cut = self.is_over();
        self.results.interrupted = is_cut;
        if exit == Exit::Well && self.results.is_empty() && !is_cut {
            let filter = self.asked.filter.as_ref();
            let what = filter
                .map_or("there are no tests here".to_string(), |text| format!("no test's name contains `{text}`"));
            message::error(&what, Some("`albacore test PATH` runs the `test` blocks of the scripts in PATH"));
            return Exit::Usage;
        }
        let coverage = self.asked.coverage.then(|| {
            let threshold = self.asked.threshold;
            coverage::Told::new(&self.coverage, threshold, self.counts_library)
        });
        self.asked.say(&self.results.line());
        if let Some(coverage) = coverage.as_ref().filter(|_| !self.asked.json && !self.results.is_empty()) {
            coverage.print();
        }
        let missed = coverage.as_ref().and_then(coverage::Told::missed).filter(|_| !is_cut && !self.results.is_empty());
        if self.asked.json {
            output::print_json(&Whole { results: &self.results, coverage });
        }
        if is_cut {
            return self.tell_cut();
        }
        if let Some(path) = &self.asked.junit
            && let Err(error) = junit::write(path, &self.results)
        {
            message::error(&not_written(path, &error), Some("choose another file with `--junit`"));
            return Exit::Failed;
        }
        if let Some(missed) = &missed {
            let help = "test what was never entered and what never fired, or ask for less with `--threshold`";
            message::error(missed, Some(help));
        }
        match exit {
            Exit::Well if self.unwritten => Exit::Failed,
            Exit::Well if self.results.failed > 0 || missed.is_some() => Exit::NotWell,
            Exit::Well if self.results.passed == 0 => {
                let help = "let the fault begin while the mission lasts, and add an `expect` that holds with it, too";
                message::error("nothing was tested with what `--fault` says", Some(help));
                Exit::Usage
            }
            exit => exit,
        }
    }

    /// Says that it was ended before all tests were run.
    fn tell_cut(&self) -> Exit {
        let run = self.results.tests.len();
        let tests = if run == 1 { "1 test was run".to_string() } else { format!("{run} tests were run") };
        let what = if self.is_stopped() { "interrupted" } else { "the review was ended" };
        let unwritten = self.asked.junit.as_ref().map(|path| format!(", and `{}` is not written", path.display()));
        let help = format!("{tests}{}: the same command runs all", unwritten.unwrap_or_default());
        message::error(&format!("{what}{}", self.broken_off), Some(&help));
        if self.unwritten { Exit::Failed } else { Exit::NotWell }
    }
}

/// How many runs a test has.
fn runs(test: &TestProgram) -> u64 {
    (test.seeds.1 - test.seeds.0 + 1) * test.rows.len() as u64
}

fn outcome(at: &Named, result: &TestResult, problems: &[Problem], snapshots: Vec<Snapshot>) -> Outcome {
    Outcome {
        name: result.name.clone(),
        script: at.path.display().to_string(),
        place: at.place(&result.place),
        seeds: Seeds { first: result.seeds.0, last: result.seeds.1 },
        rows: result.rows,
        passed: false,
        left_out: None,
        failures: problems.iter().map(Wrong::from).collect(),
        snapshots,
        kept: None,
    }
}

/// A script itself, or the scripts of a folder, in the order of their names.
fn scripts_of(path: &Path) -> std::io::Result<Vec<PathBuf>> {
    if !path.is_dir() {
        return Ok(vec![path.to_path_buf()]);
    }
    let mut found = Vec::new();
    for entry in std::fs::read_dir(path)? {
        let path = entry?.path();
        if path.extension().is_some_and(|e| e == "alb") {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}
