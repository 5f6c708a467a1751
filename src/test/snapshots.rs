//! Snapshots of behavior traces: where they are kept, how a run differs from one, and how a new one is accepted.

use super::review::Answer;
use super::told::{Named, Problem, ProblemKind};
use super::{Testing, review};
use crate::disk::{self, not_written};
use crate::{message, shell};
use albacore_session::{
    Digest, SOURCE_BYTES_MAX, TestResult, TestRun, Unread, first_difference, first_foreign_line, read_file,
};
use serde::Serialize;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// A name has so many bytes at most, without its ending: systems take 255 and less.
const NAME_BYTES_MAX: usize = 200;

/// What to do about a snapshot that holds more than one.
const THEIRS: &str = "        move it away, or take what you wrote out of it";

/// A snapshot beside the run that it is of.
#[derive(Serialize)]
pub struct Snapshot {
    /// The run: `seed 2`.
    pub run: String,
    /// Where it is kept.
    pub file: String,
    /// How it stands.
    pub state: State,
}

/// How a snapshot stands to its run.
#[derive(Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum State {
    /// It is as the run.
    Same,
    /// There is none.
    Missing,
    /// It is not as the run.
    Changed,
    /// The run was written over it.
    Accepted,
    /// The run was to be written over it, which failed.
    Unwritten,
    /// It cannot be read.
    Unreadable,
    /// It holds what is no trace: somebody wrote it.
    Foreign,
    /// Nothing was looked at: what fails is not accepted.
    Left,
}

/// What became of the snapshots of a test.
#[derive(Default)]
pub struct Compared {
    /// What is wrong with them.
    pub problems: Vec<Problem>,
    /// Each of them.
    pub snapshots: Vec<Snapshot>,
    /// The first run that is not as its snapshot.
    pub differing: Option<TestRun>,
}

/// Holds the snapshots of a test against its runs, of one that `fails` or does not otherwise.
pub fn compare(testing: &mut Testing, at: &Named, result: &TestResult, fails: bool) -> Compared {
    let mut compared = Compared::default();
    // A snapshot is of a run in which only the scenario's own faults were.
    let traces: &[(TestRun, String)] = if testing.faults.is_empty() { &result.traces } else { &[] };
    if testing.asked.accept && fails {
        // What is not as it was expected to be is never what is right.
        if !traces.is_empty() {
            let line = "        its snapshots are left as they were: what fails is not accepted".to_string();
            compared.problems.push(Problem { kind: ProblemKind::Snapshot, lines: vec![line] });
        }
        compared.snapshots = traces.iter().map(|(run, _)| entry(at, result, run, State::Left)).collect();
        return compared;
    }
    for (run, trace) in traces {
        let file = snapshot_file(at.path, result, run);
        let (state, lines) = one(testing, &file, (run, trace), fails);
        let is_differing = matches!(state, State::Missing | State::Changed | State::Foreign);
        if is_differing && compared.differing.is_none() && !testing.asked.accept {
            compared.differing = Some(run.clone());
        }
        if !lines.is_empty() {
            compared.problems.push(Problem { kind: ProblemKind::Snapshot, lines });
        }
        compared.snapshots.push(entry(at, result, run, state));
    }
    compared
}

fn entry(at: &Named, result: &TestResult, run: &TestRun, state: State) -> Snapshot {
    Snapshot { run: run.to_string(), file: snapshot_file(at.path, result, run).display().to_string(), state }
}

/// How one snapshot stands, and what is wrong with it, in lines.
fn one(testing: &mut Testing, file: &Path, (run, trace): (&TestRun, &str), fails: bool) -> (State, Vec<String>) {
    let stored = match stored(file, trace) {
        Err(error) => {
            let how = if testing.asked.accept { "is there already, and" } else { "cannot be read:" };
            return (State::Unreadable, vec![format!("        `{}` {how} {error}", file.display())]);
        }
        Ok(Some(stored)) if is_same(&stored, trace) => return (State::Same, Vec::new()),
        Ok(stored) => stored,
    };
    let is_foreign = foreign(stored.as_deref()).is_some();
    let is_wanted = match testing.asked.review && !fails && !is_foreign {
        true => match review::ask(testing, file, run, stored.as_deref(), trace) {
            Answer::Accept => true,
            Answer::Leave => false,
            Answer::Quit => {
                testing.quit = true;
                false
            }
        },
        false => testing.asked.accept,
    };
    if is_wanted {
        return accept(testing, file, stored.as_deref(), trace);
    }
    let state = match &stored {
        _ if is_foreign => State::Foreign,
        None => State::Missing,
        Some(_) => State::Changed,
    };
    (state, differences(testing, file, stored, (run, trace), fails))
}

/// How a trace differs from its snapshot, of a test that `fails` or does not, in lines.
fn differences(
    testing: &Testing,
    file: &Path,
    stored: Option<String>,
    (run, trace): (&TestRun, &str),
    fails: bool,
) -> Vec<String> {
    let foreign = foreign(stored.as_deref());
    let Some(stored) = stored else {
        return vec![
            format!("        {run}: there is no snapshot `{}`", file.display()),
            advice(testing, "look at the run, then", fails),
        ];
    };
    let mut told = Vec::new();
    let behavior = first_difference(&stored, trace);
    // Of a snapshot into which somebody wrote, that is what differs, where the behavior does not.
    if behavior.is_some() || foreign.is_none() {
        told.push(format!("        {run}: {}  ({})", verdict(&stored, trace), file.display()));
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
        None => told.push(advice(testing, "when this is right:", fails)),
    }
    told
}

/// In what a trace differs from its snapshot.
pub fn verdict(stored: &str, trace: &str) -> &'static str {
    match first_difference(stored, trace) {
        Some(_) => "behaved differently",
        None if written(stored).eq(written(trace)) => "the same, but for blank lines",
        None if without_lines(stored) == without_lines(trace) => "same behavior, by rules on other lines",
        None => "numerically different, same behavior",
    }
}

/// What to do about a snapshot that is not as the run: nothing that fails is accepted.
fn advice(testing: &Testing, when: &str, fails: bool) -> String {
    match fails {
        true => "        what fails is not accepted: mend the test or the mission first".to_string(),
        false => format!("        {when} `{}`", accepting(testing)),
    }
}

/// The command that accepts what this one has found, as a shell takes it: of what was named, and of nothing else.
fn accepting(testing: &Testing) -> String {
    let asked = testing.asked;
    let mut words = vec!["albacore test --accept".to_string()];
    words.extend(asked.filter.as_ref().map(|text| format!("--filter={}", shell::word(OsStr::new(text)))));
    if asked.paths.iter().any(|path| path.as_os_str().as_encoded_bytes().starts_with(b"-")) {
        words.push("--".to_string());
    }
    words.extend(asked.paths.iter().map(|path| shell::word(path.as_os_str())));
    words.join(" ")
}

/// A trace without the numbers of the lines on which rules stand.
fn without_lines(trace: &str) -> Vec<&str> {
    let place = |word: &str| {
        let parts = word.rsplit_once(':');
        parts.is_some_and(|(file, line)| file.ends_with(".alb") && line.bytes().all(|b| b.is_ascii_digit()))
    };
    trace.split_whitespace().map(|word| if place(word) { "" } else { word }).collect()
}

/// The snapshot that is stored, if there is one. One much larger than the trace is none of it.
fn stored(file: &Path, trace: &str) -> Result<Option<String>, String> {
    match read_file(file, SOURCE_BYTES_MAX.max(2 * trace.len()) as u64) {
        Ok(bytes) => String::from_utf8(bytes).map(Some).map_err(|_| "it is no text in UTF-8".to_string()),
        Err(Unread::System(error)) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error.to_string()),
    }
}

/// Makes a trace the snapshot; gives why that cannot be, in lines.
fn accept(testing: &mut Testing, file: &Path, stored: Option<&str>, trace: &str) -> (State, Vec<String>) {
    if let Some(line) = foreign(stored) {
        let lines = vec![
            format!("        `{}` is there already, and its line {line} is none of a trace", file.display()),
            THEIRS.to_string(),
        ];
        return (State::Foreign, lines);
    }
    let made = file.parent().map_or(Ok(()), std::fs::create_dir_all);
    match made.and_then(|()| disk::rewrite(file, stored, trace)) {
        Ok(others) => {
            testing.asked.say(&format!("        wrote {}", file.display()));
            message::parted(file, others);
            (State::Accepted, Vec::new())
        }
        Err(error) => {
            testing.unwritten = true;
            (State::Unwritten, vec![format!("        {}", not_written(file, &error))])
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
    let name = short(format!("{}-{}", run_name(script, test, run), run.seed));
    script.with_file_name("snapshots").join(format!("{name}.trace"))
}

/// What runs of a test have in their files' names: `duck_single-one_source`, of the second row `duck_single-one_source.2`.
pub fn run_name(script: &Path, test: &TestResult, run: &TestRun) -> String {
    let row = run.row.map_or(String::new(), |row| format!(".{row}"));
    format!("{}-{}{row}", disk::stem(script), test.file_name)
}

/// A name that a file can have: of one that is too long the end is a digest of it.
pub fn short(name: String) -> String {
    if name.len() <= NAME_BYTES_MAX {
        return name;
    }
    let mut digest = Digest::new();
    digest.text(&name);
    let kept = (0..=NAME_BYTES_MAX - 17).rev().find(|end| name.is_char_boundary(*end)).unwrap_or_default();
    format!("{}-{digest}", &name[..kept])
}
