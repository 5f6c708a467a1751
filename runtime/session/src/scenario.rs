//! From what a scenario's script says to the simulator's own plain numbers.

mod bottom;
mod clause;
mod fault;
mod flow;
mod objected;
mod plume;
mod recorded;
mod sensors;
mod vehicle;

use crate::files::{FileError, Files};
use albacore_geometry::TangentFrame;
use albacore_lang::code::Code;
use albacore_lang::diagnostic::Diagnostic;
use albacore_lang::{ScenarioClause, ScenarioProgram};
use albacore_link::Dialect;
use albacore_machine::Evaluation;
use albacore_sim::Scenario;
use albacore_trace::journal::SourceDigest;
pub(crate) use clause::Clause;
pub(crate) use objected::objected;
use std::path::Path;

/// A scenario that was understood.
pub(crate) struct Understood {
    /// The simulator's own.
    pub world: Scenario,
    /// What its vehicle speaks at the end of a link, if that is said.
    pub dialect: Option<Dialect>,
    /// The files of numbers that it was read from.
    pub files: Vec<SourceDigest>,
}

/// The simulator's scenario; else what of it cannot be understood, and where.
pub(crate) fn scenario(program: &ScenarioProgram, files: &Files) -> Result<Understood, Vec<Diagnostic>> {
    let words = words(program);
    let mut understood = Understood { world: Scenario::default(), dialect: None, files: Vec::new() };
    let pairs = [["bottom", "bottom_grid"], ["rows", "waypoints"]];
    let twice = pairs.into_iter().filter_map(|pair| one_of(program, pair));
    let mut findings: Vec<Diagnostic> = twice.chain(two_plumes(program)).collect();
    let frame = program.origin.map(|origin| TangentFrame { origin });
    for clause in &program.clauses {
        let clause = Clause { clause, words: &words };
        if let Err(Wrong(faults)) = read(&mut understood, &clause, files, frame) {
            findings.extend(faults.into_iter().map(|fault| fault.at(&clause)));
        }
    }
    if findings.is_empty() {
        findings.extend(bottom::elsewhere(program, &understood.world));
    }
    if findings.is_empty() { Ok(understood) } else { Err(findings) }
}

/// Whether a world would be as it is if its scenario said this too.
pub(crate) fn changes_nothing(world: &Scenario, clause: &ScenarioClause, words: &[f64]) -> bool {
    let mut understood = Understood { world: world.clone(), dialect: None, files: Vec::new() };
    let read = read(&mut understood, &Clause { clause, words }, &Files::around(Path::new("")), None);
    read.is_ok() && understood.world == *world && understood.dialect.is_none()
}

/// Adds what a clause says.
fn read(understood: &mut Understood, c: &Clause, files: &Files, frame: Option<TangentFrame>) -> Result<(), Wrong> {
    match c.clause.name.as_str() {
        "bottom_grid" => bottom::grid(understood, c, files, frame),
        "recorded_plume" => recorded::recorded_plume(understood, c, files),
        "vehicle" => vehicle::vehicle(&mut understood.world, c),
        "fault" => fault::fault(&mut understood.world, c),
        "dialect" => vehicle::dialect(c).map(|dialect| understood.dialect = Some(dialect)),
        _ => apply(&mut understood.world, c).map_err(Into::into),
    }
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
struct Wrong(Vec<Fault>);

/// What is wrong, and its mend if that is known.
struct Fault {
    message: String,
    help: Option<String>,
}

impl Wrong {
    /// What is wrong, and its mend.
    fn with(message: impl Into<String>, mend: impl Into<String>) -> Self {
        Wrong(vec![Fault { message: message.into(), help: Some(mend.into()) }])
    }
}

impl From<FileError> for Wrong {
    fn from(error: FileError) -> Wrong {
        Wrong(vec![Fault { message: error.message, help: error.help }])
    }
}

impl From<String> for Wrong {
    fn from(what: String) -> Wrong {
        Wrong(vec![Fault { message: format!("this clause cannot be: {what}"), help: None }])
    }
}

impl Fault {
    fn at(self, clause: &Clause) -> Diagnostic {
        let finding = Diagnostic::error(Code::ScenariosClause, clause.clause.span, self.message);
        match self.help {
            Some(help) => finding.help(help),
            None => finding,
        }
    }
}

/// The words that the clauses' arguments point into.
pub(crate) fn words(program: &ScenarioProgram) -> Vec<f64> {
    let mut evaluation = Evaluation::new(&program.program);
    evaluation.run(&program.program, program.program.mission.activity);
    evaluation.words(0, program.program.words).to_vec()
}

fn apply(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    match c.clause.name.as_str() {
        "flow" => flow::flow(scenario, c),
        "turning" => flow::turning(scenario, c),
        "tide" => flow::tide(scenario, c),
        "waves" => flow::waves(scenario, c),
        "upper_layer" => flow::upper_layer(scenario, c),
        "stratification" => flow::stratification(scenario, c),
        "region" => flow::region(scenario, c),
        "bottom" => bottom::bottom(scenario, c),
        "pit" => bottom::pit(scenario, c),
        "no_go" => bottom::no_go(scenario, c),
        "plume" => plume::plume(scenario, c),
        "source" => plume::source(scenario, c),
        "leak" => plume::leak(scenario, c),
        "patch" => plume::patch(scenario, c),
        "limits" => vehicle::limits(scenario, c),
        "rows" => vehicle::rows(scenario, c),
        "waypoints" => vehicle::waypoints(scenario, c),
        "handover" => vehicle::handover(scenario, c),
        "navigation" => sensors::navigation(scenario, c),
        "fluorometer" => sensors::fluorometer(scenario, c),
        "adcp" => sensors::adcp(scenario, c),
        "compass" => sensors::compass(scenario, c),
        "pressure" => sensors::pressure(scenario, c),
        "dvl" => sensors::dvl(scenario, c),
        "gps" => sensors::gps(scenario, c),
        "battery" => sensors::battery(scenario, c),
        "ctd" => sensors::ctd(scenario, c),
        "sounder" => sensors::sounder(scenario, c),
        "link_fault" => Err("it is what `albacore vehicle --link-faults` takes, not part of a world".to_string()),
        other => Err(format!("the simulator knows no `{other}`")),
    }
}
