//! What only the lowering and the simulator find wrong with a script: missions and scenarios that `run` would refuse.

use crate::files::Files;
use crate::world;
use albacore_lang::code::Code;
use albacore_lang::diagnostic::Diagnostic;
use albacore_lang::{ScenarioProgram, Script};

/// All that is wrong with a script's sound missions and with its own sound scenarios.
pub fn findings(script: &Script) -> Vec<Diagnostic> {
    let missions = script.missions().filter(|m| script.mission_is_sound(&m.name));
    let missions = missions.filter_map(|m| script.mission(&m.name)?.err()).flatten();
    let scenarios =
        script.own_scenarios().filter(|name| script.scenario_is_sound(name) && runs_are_sound(script, name));
    missions.chain(scenarios.flat_map(|name| scenario(script, name))).collect()
}

/// Whether the mission in whose frame a scenario lies is sound, if there is one.
fn runs_are_sound(script: &Script, scenario: &str) -> bool {
    let mut runs = script.missions().filter(|m| m.scenario.as_deref() == Some(scenario));
    runs.all(|m| script.mission_is_sound(&m.name))
}

/// What cannot be in a scenario, in the frame of the missions that run in it.
fn scenario(script: &Script, name: &str) -> Vec<Diagnostic> {
    // A mission that cannot be has been told of.
    let Ok(origin) = world::place_of(script, name) else { return Vec::new() };
    let lowered = match script.scenario(name, origin) {
        Some(Ok(lowered)) => lowered,
        Some(Err(findings)) => return findings,
        None => return Vec::new(),
    };
    match crate::scenario::scenario(&lowered, &Files::of(script)) {
        Err(findings) => findings,
        Ok(understood) => match understood.world.validate() {
            Err(error) => error.faults.iter().map(|fault| of_fault(&lowered, fault)).collect(),
            Ok(()) => Vec::new(),
        },
    }
}

/// A fault of the simulator's, at the clause that it names.
fn of_fault(scenario: &ScenarioProgram, fault: &str) -> Diagnostic {
    let named = fault.split(|c: char| !c.is_alphanumeric() && c != '_').find(|word| !word.is_empty()).unwrap_or("");
    let clause = scenario.clauses.iter().find(|clause| clause.name == named.trim_end_matches('s'));
    let span = clause.map_or(scenario.span, |c| c.span);
    let found = |message: &str| Diagnostic::error(Code::ScenariosWorld, span, message);
    // What must be is the mend; what is needed and missing is another clause.
    match fault.rsplit_once(": ") {
        Some((message, must)) if must.starts_with("it must") => found(message).help(must),
        _ if fault.contains("flow.mean` is 0") => {
            found(fault).help("add `flow(12 cm/s toward 140 deg)` to the scenario")
        }
        _ => match fault.split_once(" a `").and_then(|(_, needed)| needed.split_once('`')) {
            Some((needed, _)) => found(fault).help(format!("add `{needed}(…)` to the scenario")),
            None => found(fault),
        },
    }
}
