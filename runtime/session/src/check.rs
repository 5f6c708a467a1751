//! What only the lowering and the simulator find wrong with a script: missions and scenarios that `run` would refuse.

use crate::plan::PlanError;
use crate::{suit, world};
use albacore_lang::Script;
use albacore_lang::diagnostic::Diagnostic;

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
        Ok(understood) => {
            let missions = script.missions().filter(|mission| mission.scenario.as_deref() == Some(name));
            missions.flat_map(|mission| suit::findings(script, &mission.name, name, &understood.world)).collect()
        }
    }
}
