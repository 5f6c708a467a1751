//! From what a scenario's script says to the simulator's own plain numbers.

mod bottom;
mod clause;
mod fault;
mod flow;
mod plume;
mod sensors;
mod vehicle;

use albacore_lang::ScenarioProgram;
use albacore_lang::code::Code;
use albacore_lang::diagnostic::Diagnostic;
use albacore_machine::Evaluation;
use albacore_sim::Scenario;
use clause::Clause;

/// The simulator's scenario; else what of it cannot be understood, and where.
pub(crate) fn scenario(program: &ScenarioProgram) -> Result<Scenario, Diagnostic> {
    let words = words(program);
    let mut scenario = Scenario::default();
    for clause in &program.clauses {
        let clause = Clause { clause, words: &words };
        apply(&mut scenario, &clause).map_err(|what| {
            let message = format!("this clause cannot be: {what}");
            Diagnostic::error(Code::ScenariosClause, clause.clause.span, message)
        })?;
    }
    Ok(scenario)
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
        "vehicle" => vehicle::vehicle(scenario, c),
        "limits" => vehicle::limits(scenario, c),
        "rows" => vehicle::rows(scenario, c),
        "handover" => vehicle::handover(scenario, c),
        "navigation" => sensors::navigation(scenario, c),
        "fluorometer" => sensors::fluorometer(scenario, c),
        "adcp" => sensors::adcp(scenario, c),
        "compass" => sensors::compass(scenario, c),
        "pressure" => sensors::pressure(scenario, c),
        "dvl" => sensors::dvl(scenario, c),
        "gps" => sensors::gps(scenario, c),
        "fault" => fault::fault(scenario, c),
        "sounder" => sensors::sounder(scenario, c),
        other => Err(format!("the simulator knows no `{other}`")),
    }
}
