//! What only the lowering and the simulator find wrong with a script: missions and scenarios that `run` would refuse.

use crate::plan::PlanError;
use crate::world;
use albacore_lang::code::Code;
use albacore_lang::diagnostic::Diagnostic;
use albacore_lang::{ScenarioProgram, Script};
use albacore_sim::Scenario;

/// All that is wrong with a script's sound missions and with its own sound scenarios, and notes of what is worth knowing.
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
    match world::sound(&lowered, script) {
        Err(PlanError::Script(findings, _)) => findings,
        Err(PlanError::Asked(..)) => Vec::new(),
        Ok(understood) => uncovered(script, name, &lowered, &understood.world),
    }
}

/// The areas of missions that a recorded plume does not cover, or not all of them.
fn uncovered(script: &Script, name: &str, scenario: &ScenarioProgram, world: &Scenario) -> Vec<Diagnostic> {
    let record = scenario.clauses.iter().find(|clause| clause.name == "recorded_plume");
    let span = record.map_or(scenario.span, |clause| clause.span);
    let missions = script.missions().filter(|mission| mission.scenario.as_deref() == Some(name));
    let found = missions.filter_map(|mission| {
        let (area, written) = script.operating_area(&mission.name)?;
        let beyond = crate::scenario::uncovered(world, &mission.name, &area)?;
        let finding = if beyond.all { Diagnostic::error } else { Diagnostic::note };
        let finding = finding(Code::ScenariosOutside, written, beyond.message);
        Some(finding.label(span, "the record").help(beyond.help))
    });
    found.collect()
}
