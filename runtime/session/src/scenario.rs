//! From what a scenario's script says to the simulator's own plain numbers.

mod bottom;
mod clause;
mod flow;
mod plume;
mod recorded;
mod sensors;
mod vehicle;

use albacore_lang::ScenarioProgram;
use albacore_lang::code::Code;
use albacore_lang::diagnostic::Diagnostic;
use albacore_lang::source::Sources;
use albacore_machine::Evaluation;
use albacore_sim::Scenario;
use clause::Clause;

/// The simulator's scenario; else what of it cannot be understood, and where.
pub(crate) fn scenario(program: &ScenarioProgram, sources: &Sources) -> Result<Scenario, Diagnostic> {
    let words = words(program);
    let mut scenario = Scenario::default();
    for clause in &program.clauses {
        let file = &sources.get(clause.span.file).name;
        let clause = Clause { clause, words: &words, file };
        apply(&mut scenario, &clause).map_err(|what| {
            let message = format!("this clause cannot be: {what}");
            Diagnostic::error(Code::ScenariosClause, clause.clause.span, message)
        })?;
    }
    match program.clauses.iter().find(|clause| recorded::BROUGHT.contains(&clause.name.as_str())) {
        Some(clause) if scenario.recording.is_some() => {
            let message = format!("the record brings its own `{}`", clause.name);
            Err(Diagnostic::error(Code::ScenariosClause, clause.span, message)
                .help("leave it out, or `recorded_plume`"))
        }
        _ => Ok(scenario),
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
        "region" => flow::region(scenario, c),
        "bottom" => bottom::bottom(scenario, c),
        "pit" => bottom::pit(scenario, c),
        "plume" => plume::plume(scenario, c),
        "source" => plume::source(scenario, c),
        "leak" => plume::leak(scenario, c),
        "patch" => plume::patch(scenario, c),
        "recorded_plume" => recorded::recorded_plume(scenario, c),
        "vehicle" => vehicle::vehicle(scenario, c),
        "limits" => vehicle::limits(scenario, c),
        "rows" => vehicle::rows(scenario, c),
        "handover" => vehicle::handover(scenario, c),
        "navigation" => sensors::navigation(scenario, c),
        "fluorometer" => sensors::fluorometer(scenario, c),
        "adcp" => sensors::adcp(scenario, c),
        "sounder" => sensors::sounder(scenario, c),
        other => Err(format!("the simulator knows no `{other}`")),
    }
}
