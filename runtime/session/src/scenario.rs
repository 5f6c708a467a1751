//! From what a scenario's script says to the simulator's own plain numbers.

mod bottom;
mod clause;
mod defaults;
mod listed;
mod named;
mod objected;
pub(crate) mod played;
mod recorded;

use crate::files::{FileError, Files};
use albacore_geometry::TangentFrame;
use albacore_lang::code::Code;
use albacore_lang::diagnostic::Diagnostic;
use albacore_lang::{ScenarioClause, ScenarioProgram};
use albacore_link::Dialect;
use albacore_machine::Evaluation;
use albacore_sim::{EnvironmentSetting, InstrumentSetting, Scenario, Setting};
use albacore_trace::Digest;
use albacore_trace::journal::SourceDigest;
pub(crate) use clause::Clause;
pub(crate) use defaults::DEFAULTS;
pub(crate) use named::{cannot_begin, named, place_of, sound};
pub(crate) use objected::objected;
pub(crate) use played::parts;
use serde::Deserialize;

/// A scenario that was understood.
pub(crate) struct Understood {
    /// The simulator's own.
    pub world: Scenario,
    /// What its vehicle speaks at the end of a link, if that is said.
    pub dialect: Option<&'static Dialect>,
    /// The files of numbers that it was read from.
    pub files: Vec<SourceDigest>,
}

impl Understood {
    /// Notes that it was read from a file: who goes on with a run wants it to be the same.
    fn note_file(&mut self, name: String, bytes: &[u8]) {
        let mut digest = Digest::new();
        digest.bytes(bytes);
        self.files.push(SourceDigest { name, digest: digest.value() });
    }
}

/// The simulator's scenario; else what of it cannot be understood, and where.
pub(crate) fn scenario(program: &ScenarioProgram, files: &Files) -> Result<Understood, Vec<Diagnostic>> {
    let words = words(program);
    let mut understood = Understood { world: DEFAULTS.world.clone(), dialect: None, files: Vec::new() };
    let pairs = [["bottom", "bottom_grid"], ["rows", "waypoints"]];
    let twice = pairs.into_iter().filter_map(|pair| one_of(program, pair));
    let mut findings: Vec<Diagnostic> = twice.chain(two_plumes(program)).collect();
    let frame = program.origin.map(|origin| TangentFrame { origin });
    for clause in &program.clauses {
        let clause = Clause { clause, words: &words };
        if let Err(wrong) = read(&mut understood, clause, files, frame) {
            findings.extend(wrong.of(clause.clause));
        }
    }
    if findings.is_empty() {
        findings.extend(bottom::elsewhere(program, &understood.world));
    }
    if findings.is_empty() { Ok(understood) } else { Err(findings) }
}

/// Adds what a clause says.
fn read(understood: &mut Understood, c: Clause, files: &Files, frame: Option<TangentFrame>) -> Result<(), Wrong> {
    match c.clause.name.as_str() {
        "bottom_grid" => bottom::grid(understood, c.read()?, files, frame),
        "recorded_plume" => recorded::recorded_plume(understood, c.read()?, files),
        "played" => played::played(understood, c, files),
        "dialect" => dialect(c.read()?).map(|dialect| understood.dialect = Some(dialect)),
        "link_fault" => Err(cannot_be("it is what `albacore vehicle --link-faults` takes, not part of a world")),
        name if EnvironmentSetting::NAMES.contains(&name) => {
            c.read().map(|setting| understood.world.set(Setting::Environment(setting)))
        }
        name if InstrumentSetting::NAMES.contains(&name) => {
            c.read().map(|setting| understood.world.set(Setting::Instrument(setting)))
        }
        _ => c.read().map(|setting| understood.world.set(setting)),
    }
}

/// `dialect(…)`: what the vehicle's computer speaks at the end of a link.
#[derive(Deserialize)]
struct Speaks {
    speaks: Option<String>,
}

fn dialect(clause: Speaks) -> Result<&'static Dialect, Wrong> {
    let like = Dialect::example();
    let speaks =
        clause.speaks.ok_or_else(|| Wrong::with("`dialect` needs a protocol", format!("write `dialect({like})`")))?;
    Dialect::named(&speaks).map_err(|error| cannot_be(&error.message))
}

/// The ground is a plane or a survey, the vehicle's own mission rows or waypoints: of two that are said, neither can be the one
/// that is meant.
fn one_of(program: &ScenarioProgram, names: [&str; 2]) -> Option<Diagnostic> {
    let mut said = program.clauses.iter().filter(|c| names.contains(&c.name.as_str()));
    let (first, second) = (said.next()?, said.next()?);
    let message = format!("a scenario has one `{}` or one `{}`", names[0], names[1]);
    let finding = Diagnostic::error(Code::ScenariosTwice, second.span, message);
    Some(finding.label(first.span, "the first").help("leave one of them out"))
}

/// A record brings its own water.
fn two_plumes(program: &ScenarioProgram) -> Option<Diagnostic> {
    let record = program.clauses.iter().find(|c| c.name == "recorded_plume")?;
    let second = program.clauses.iter().find(|c| recorded::BROUGHT.contains(&c.name.as_str()))?;
    let message = format!("the record brings its own `{}`", second.name);
    let finding = Diagnostic::error(Code::ScenariosClause, second.span, message);
    Some(finding.label(record.span, "the record").help("leave it out, or `recorded_plume`"))
}

/// All that is wrong with a clause.
pub(crate) struct Wrong(Vec<Fault>);

/// What is wrong, and its mend if that is known.
struct Fault {
    message: String,
    help: Option<String>,
    /// The parameter that it is of, if it is of one alone.
    param: Option<&'static str>,
}

impl Wrong {
    /// The same at its clause.
    pub fn of(self, clause: &ScenarioClause) -> impl Iterator<Item = Diagnostic> {
        self.0.into_iter().map(|Fault { message, help, param }| {
            let written = clause.args.iter().find(|arg| !arg.is_default && param == Some(arg.name.as_str()));
            let span = written.map_or(clause.span, |arg| arg.span);
            let finding = Diagnostic::error(Code::ScenariosClause, span, message);
            help.into_iter().fold(finding, Diagnostic::help)
        })
    }

    /// What is wrong in a file.
    fn in_file(path: &str, faults: Vec<albacore_formats::Fault>) -> Self {
        let told = |fault: albacore_formats::Fault| Fault {
            message: format!("`{path}`: {}", fault.message),
            help: Some(fault.help),
            param: None,
        };
        Wrong(faults.into_iter().map(told).collect())
    }

    /// What is wrong, and its mend.
    fn with(message: impl Into<String>, mend: impl Into<String>) -> Self {
        Wrong(vec![Fault { message: message.into(), help: Some(mend.into()), param: None }])
    }

    /// The same, of a parameter.
    fn at(mut self, param: &'static str) -> Self {
        self.0.iter_mut().for_each(|fault| fault.param = Some(param));
        self
    }
}

/// What is wrong with a clause as a whole.
fn cannot_be(what: &str) -> Wrong {
    Wrong(vec![Fault { message: format!("this clause cannot be: {what}"), help: None, param: None }])
}

impl From<FileError> for Wrong {
    fn from(error: FileError) -> Wrong {
        Wrong(vec![Fault { message: error.message, help: error.help, param: None }])
    }
}

/// The words that the clauses' arguments point into.
pub(crate) fn words(program: &ScenarioProgram) -> Vec<f64> {
    let mut evaluation = Evaluation::new(&program.program);
    evaluation.run(&program.program, program.program.mission.activity);
    evaluation.words(0, program.program.words).to_vec()
}
