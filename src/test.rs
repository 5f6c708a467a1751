//! `albacore test`: runs the `test` blocks of scripts and compares behavior traces with their snapshots.

use crate::disk::{self, not_written};
use crate::exit::Exit;
use crate::message;
use crate::output::Lines;
use crate::plan::Faults;
use crate::shell;
use albacore_session::{
    Digest, Failure, PlanError, SOURCE_BYTES_MAX, Script, TestResult, TestRun, Unread, first_difference,
    first_foreign_line, read_file, run_test,
};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// A snapshot's name has so many bytes at most, without its ending: systems take 255 and less.
const NAME_BYTES_MAX: usize = 200;

/// Run the tests of scripts.
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
    #[command(flatten)]
    faults: Faults,
}

/// How many tests passed and failed, and how many there was nothing to hold to.
#[derive(Default)]
struct Count {
    passed: usize,
    failed: usize,
    left_out: usize,
    /// Whether a snapshot could not be written.
    unwritten: bool,
}

impl Test {
    /// Runs all tests; one that fails makes the whole fail.
    pub fn run(&self) -> Exit {
        let usual = Path::new(if Path::new("missions").is_dir() { "missions" } else { "." });
        let paths = if self.paths.is_empty() { vec![usual.to_path_buf()] } else { self.paths.clone() };
        let mut scripts = Vec::new();
        for path in &paths {
            match scripts_of(path) {
                Ok(found) => scripts.extend(found),
                Err(error) => {
                    message::error(&format!("`{}` cannot be read: {error}", path.display()), None);
                    return Exit::Usage;
                }
            }
        }
        let faults = match self.faults.read() {
            Ok(faults) => faults,
            Err(exit) => return exit,
        };
        let mut count = Count::default();
        let mut exit = Exit::Well;
        for path in &scripts {
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
                exit = Exit::Script;
                continue;
            }
            if let Err(failed) = self.tests_of(&script, &at, &faults, &mut count) {
                exit = failed;
            }
        }
        if exit == Exit::Well && count.passed + count.failed + count.left_out == 0 {
            let what = self
                .filter
                .as_ref()
                .map_or("there are no tests here".to_string(), |text| format!("no test's name contains `{text}`"));
            message::error(&what, Some("`albacore test PATH` runs the `test` blocks of the scripts in PATH"));
            return Exit::Usage;
        }
        let left_out = if count.left_out > 0 { format!(", {} left out", count.left_out) } else { String::new() };
        say(&format!("{} passed, {} failed{left_out}", count.passed, count.failed));
        match exit {
            Exit::Well if count.unwritten => Exit::Failed,
            Exit::Well if count.failed > 0 => Exit::NotWell,
            Exit::Well if count.passed == 0 => {
                let help = "let the fault begin while the mission lasts, and add an `expect` that holds with it, too";
                message::error("nothing was tested with what `--fault` says", Some(help));
                Exit::Usage
            }
            exit => exit,
        }
    }

    fn tests_of(
        &self,
        script: &Script,
        at: &Named,
        faults: &albacore_session::Faults,
        count: &mut Count,
    ) -> Result<(), Exit> {
        for test in script.tests() {
            let test = match test {
                Ok(test) => test,
                Err(findings) => {
                    message::findings(&findings, &script.sources);
                    return Err(Exit::Script);
                }
            };
            if self.filter.as_ref().is_some_and(|text| !test.name.contains(text.as_str())) {
                continue;
            }
            let result = match run_test(script, &test, faults) {
                Ok(result) => result,
                Err(PlanError::Script(findings, sources)) => {
                    message::findings(&findings, &sources);
                    return Err(Exit::Script);
                }
                Err(PlanError::Asked(what, help)) => {
                    message::error(&format!("{}: {what}", at.place(&test.place)), help.as_deref());
                    return Err(Exit::Usage);
                }
            };
            let problems = self.problems(at, &result, faults, count);
            let rows = if result.rows > 1 { format!(" of {} rows", result.rows) } else { String::new() };
            let (place, (first, last)) = (at.place(&result.place), result.seeds);
            let seeds = format!("seeds {first}..{last}{rows}");
            let untested = match () {
                () if !problems.is_empty() || faults.is_empty() => None,
                () if test.expects.is_empty() => {
                    Some("it expects nothing, and its snapshots are of runs without `--fault`")
                }
                () if !result.met_faults => Some("its runs are over before anything of `--fault` begins"),
                () => None,
            };
            if let Some(why) = untested {
                count.left_out += 1;
                say(&format!("left out  {place}  \"{}\"  {seeds}", result.name));
                say(&format!("        {why}"));
            } else if problems.is_empty() {
                count.passed += 1;
                say(&format!("ok      {place}  \"{}\"  {seeds}", result.name));
            } else {
                count.failed += 1;
                say(&format!("FAILED  {place}  \"{}\"  {seeds}", result.name));
                problems.iter().for_each(|problem| say(problem));
            }
        }
        Ok(())
    }

    /// What is wrong with what became of a test, in lines.
    fn problems(
        &self,
        at: &Named,
        result: &TestResult,
        faults: &albacore_session::Faults,
        count: &mut Count,
    ) -> Vec<String> {
        let mut problems = failed_runs(result);
        problems.extend(result.failures.iter().flat_map(|failure| told(at, failure)));
        // A snapshot is of a run in which only the scenario's own faults were.
        let traces: &[(TestRun, String)] = if faults.is_empty() { &result.traces } else { &[] };
        if self.accept && !problems.is_empty() {
            // What is not as it was expected to be is never what is right.
            if !traces.is_empty() {
                problems.push("        its snapshots are left as they were: what fails is not accepted".to_string());
            }
            return problems;
        }
        let fails = !problems.is_empty();
        for (run, trace) in traces {
            let file = snapshot_file(at.path, result, run);
            problems.extend(match stored(&file, trace) {
                Err(error) if self.accept => {
                    vec![format!("        `{}` is there already, and {error}", file.display())]
                }
                Err(error) => vec![format!("        `{}` cannot be read: {error}", file.display())],
                Ok(Some(stored)) if is_same(&stored, trace) => Vec::new(),
                Ok(stored) if self.accept => accept(&file, stored.as_deref(), trace, count),
                Ok(stored) => self.compare(&file, stored, run, trace, fails),
            });
        }
        problems
    }

    /// Compares a trace with its snapshot, of a test that `fails` or does not; gives what is wrong, in lines.
    fn compare(&self, file: &Path, stored: Option<String>, run: &TestRun, trace: &str, fails: bool) -> Vec<String> {
        let foreign = foreign(stored.as_deref());
        let Some(stored) = stored else {
            return vec![
                format!("        {run}: there is no snapshot `{}`", file.display()),
                self.advice("look at the run, then", fails),
            ];
        };
        let mut told = Vec::new();
        let behavior = first_difference(&stored, trace);
        // Of a snapshot into which somebody wrote, that is what differs, where the behavior does not.
        if behavior.is_some() || foreign.is_none() {
            let verdict = match behavior {
                Some(_) => "behaved differently",
                None if written(&stored).eq(written(trace)) => "the same, but for blank lines",
                None if without_lines(&stored) == without_lines(trace) => "same behavior, by rules on other lines",
                None => "numerically different, same behavior",
            };
            told.push(format!("        {run}: {verdict}  ({})", file.display()));
            let lines = behavior.map_or_else(|| first_lines(&stored, trace), |d| (d.left, d.right));
            for (sign, line) in [("-", lines.0), ("+", lines.1)] {
                let line = line.as_deref().unwrap_or("(nothing more)");
                told.push(format!("          {sign} {}", if line.is_empty() { "(an empty line)" } else { line }));
            }
        }
        match foreign {
            Some(line) => {
                told.push(format!("        {run}: line {line} of `{}` is none of a trace", file.display()));
                let text = stored.lines().nth(line - 1).unwrap_or_default();
                told.extend([format!("          {text}"), THEIRS.to_string()]);
            }
            None => told.push(self.advice("when this is right:", fails)),
        }
        told
    }

    /// What to do about a snapshot that is not as the run: nothing that fails is accepted.
    fn advice(&self, when: &str, fails: bool) -> String {
        match fails {
            true => "        what fails is not accepted: mend the test or the mission first".to_string(),
            false => format!("        {when} `{}`", self.accepting()),
        }
    }

    /// The command that accepts what this one has found, as a shell takes it: of what was named, and of nothing else.
    fn accepting(&self) -> String {
        let mut words = vec!["albacore test --accept".to_string()];
        words.extend(self.filter.as_ref().map(|text| format!("--filter={}", shell::word(OsStr::new(text)))));
        if self.paths.iter().any(|path| path.as_os_str().as_encoded_bytes().starts_with(b"-")) {
            words.push("--".to_string());
        }
        words.extend(self.paths.iter().map(|path| shell::word(path.as_os_str())));
        words.join(" ")
    }
}

/// A trace without the numbers of the lines on which rules stand.
fn without_lines(trace: &str) -> Vec<&str> {
    let place = |word: &str| {
        let parts = word.rsplit_once(':');
        parts.is_some_and(|(file, line)| file.ends_with(".alb") && line.bytes().all(|b| b.is_ascii_digit()))
    };
    trace.split_whitespace().map(|word| if place(word) { "" } else { word }).collect()
}

/// A script, as it is named.
struct Named<'a> {
    path: &'a Path,
    /// Whether no other that is tested has its file's name.
    is_alone: bool,
}

impl Named<'_> {
    /// `file:line` of it, with as much of its path as tells it from the others.
    fn place(&self, place: &str) -> String {
        match place.rsplit_once(':') {
            Some((_, line)) if !self.is_alone => format!("{}:{line}", self.path.display()),
            _ => place.to_string(),
        }
    }
}

/// What to do about a snapshot that holds more than one.
const THEIRS: &str = "        move it away, or take what you wrote out of it";

/// The snapshot that is stored, if there is one. One much larger than the trace is none of it.
fn stored(file: &Path, trace: &str) -> Result<Option<String>, String> {
    match read_file(file, SOURCE_BYTES_MAX.max(2 * trace.len()) as u64) {
        Ok(bytes) => String::from_utf8(bytes).map(Some).map_err(|_| "it is no text in UTF-8".to_string()),
        Err(Unread::System(error)) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error.to_string()),
    }
}

/// Makes a trace the snapshot; gives why that cannot be, in lines.
fn accept(file: &Path, stored: Option<&str>, trace: &str, count: &mut Count) -> Vec<String> {
    if let Some(line) = foreign(stored) {
        return vec![
            format!("        `{}` is there already, and its line {line} is none of a trace", file.display()),
            THEIRS.to_string(),
        ];
    }
    let made = file.parent().map_or(Ok(()), std::fs::create_dir_all);
    match made.and_then(|()| disk::rewrite(file, stored, trace)) {
        Ok(others) => {
            say(&format!("        wrote {}", file.display()));
            message::parted(file, others);
            Vec::new()
        }
        Err(error) => {
            count.unwritten = true;
            vec![format!("        {}", not_written(file, &error))]
        }
    }
}

/// Whether a snapshot is a trace. The ends of lines belong to who keeps the file: version control and editors write their own.
fn is_same(stored: &str, trace: &str) -> bool {
    stored.lines().eq(trace.lines())
}

/// The lines in which something stands.
fn written(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter(|line| !line.trim().is_empty())
}

/// The line of a snapshot that somebody else wrote: what it holds is no old snapshot.
fn foreign(stored: Option<&str>) -> Option<usize> {
    stored.filter(|stored| !stored.is_empty()).and_then(first_foreign_line)
}

/// The first lines in which two texts differ.
fn first_lines(a: &str, b: &str) -> (Option<String>, Option<String>) {
    let (mut a, mut b) = (a.lines(), b.lines());
    loop {
        match (a.next(), b.next()) {
            (Some(x), Some(y)) if x == y => {}
            (x, y) => return (x.map(str::to_string), y.map(str::to_string)),
        }
    }
}

/// `missions/snapshots/duck_single-one_source-1.trace`; of the second row `…-one_source.2-1.trace`. No test's name has a `-` or a `.` there,
/// so that no two scripts share a name, whatever they are called.
pub fn snapshot_file(script: &Path, test: &TestResult, run: &TestRun) -> PathBuf {
    let stem = disk::stem(script);
    let row = run.row.map_or(String::new(), |row| format!(".{row}"));
    let name = short(format!("{stem}-{}{row}-{}", test.file_name, run.seed));
    script.with_file_name("snapshots").join(format!("{name}.trace"))
}

/// A name that a file can have: of one that is too long the end is a digest of it.
fn short(name: String) -> String {
    if name.len() <= NAME_BYTES_MAX {
        return name;
    }
    let mut digest = Digest::new();
    digest.text(&name);
    let kept = (0..=NAME_BYTES_MAX - 17).rev().find(|end| name.is_char_boundary(*end)).unwrap_or_default();
    format!("{}-{digest}", &name[..kept])
}

/// Says a line.
fn say(line: &str) {
    let mut lines = Lines::default();
    lines.add(line);
    lines.print();
}

/// The runs that could not go on, in lines.
fn failed_runs(result: &TestResult) -> Vec<String> {
    let (failed, runs) = result.failed_of;
    if failed == 0 {
        return Vec::new();
    }
    let mut lines = vec![format!("        {failed} of {runs} runs failed: nothing is known of what came after")];
    lines.extend(result.failed.iter().map(|(run, why)| example(run, why)));
    lines
}

/// A run that is told of as one of several.
fn example(run: &impl std::fmt::Display, found: &str) -> String {
    format!("          {run}: {found}")
}

/// A failed expectation as a person reads it, in lines.
fn told(at: &Named, failure: &Failure) -> Vec<String> {
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
    lines
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
