//! What only the lowering and the simulator find wrong with a script: missions and scenarios that `run` would refuse.

use crate::compatibility::{self, Held};
use crate::plan::{Plan, PlanError};
use crate::scenario;
use crate::scenario::Understood;
use crate::wanted::Wanted;
use albacore_geometry::Geodetic;
use albacore_lang::diagnostic::Diagnostic;
use albacore_lang::{MissionInfo, ScenarioProgram, Script};
use albacore_program::Program;

/// All that is wrong with a script's sound missions, in the scenarios that they name, and with its own sound scenarios, and notes
/// of what is worth knowing.
pub fn findings(script: &Script) -> Vec<Diagnostic> {
    let mut findings = of_scenarios(script);
    let mut world = None;
    for mission in sound_missions(script) {
        match script.mission(&mission.name) {
            Some(Ok(program)) => findings.extend(own_misfits(script, mission, &program, &mut world)),
            Some(Err(found)) => findings.extend(found),
            None => {}
        }
    }
    findings
}

/// The same in a scenario that `run` would be given: by its name, or as `file.alb#name`.
pub fn findings_in(script: &Script, wanted: &Wanted) -> Result<Vec<Diagnostic>, PlanError> {
    let mut findings = of_missions(script);
    findings.extend(of_scenarios(script));
    for mission in sound_missions(script).filter(|m| wanted.mission.is_none_or(|wanted| wanted == m.name)) {
        // A mission that cannot be has been told of.
        if script.mission(&mission.name).is_some_and(|mission| mission.is_ok()) {
            findings.extend(misfits(script, mission, wanted)?);
        }
    }
    Ok(findings)
}

fn sound_missions(script: &Script) -> impl Iterator<Item = &MissionInfo> {
    script.missions().filter(|m| script.mission_is_sound(&m.name))
}

fn of_missions(script: &Script) -> Vec<Diagnostic> {
    sound_missions(script).filter_map(|m| script.mission(&m.name)?.err()).flatten().collect()
}

fn of_scenarios(script: &Script) -> Vec<Diagnostic> {
    let own = script.own_scenarios().filter(|name| script.scenario_is_sound(name) && runs_are_sound(script, name));
    own.flat_map(|name| scenario(script, name)).collect()
}

/// The world of a scenario in the frame of a mission: missions that share both share it, with its files.
struct Computed {
    scenario: String,
    origin: Option<Geodetic>,
    /// None for a scenario that is wrong in itself.
    world: Option<(ScenarioProgram, Understood)>,
}

impl Computed {
    /// The world, and what is wrong with the scenario itself, where that has not been told already: of those of the script's own file it has.
    fn new(script: &Script, scenario: &str, origin: Option<Geodetic>) -> (Self, Vec<Diagnostic>) {
        let is_own = script.own_scenarios().any(|own| own == scenario);
        let (world, wrong) = match scenario::named(script, scenario, origin) {
            Ok(world) => (Some(world), Vec::new()),
            Err(PlanError::Script(findings, _)) if !is_own => (None, findings),
            Err(_) => (None, Vec::new()),
        };
        (Computed { scenario: scenario.to_string(), origin, world }, wrong)
    }
}

/// What a mission misses in the scenario that it names. `last`: the world of the mission before it.
fn own_misfits(
    script: &Script,
    mission: &MissionInfo,
    program: &Program,
    last: &mut Option<Computed>,
) -> Vec<Diagnostic> {
    let Some(named) = mission.scenario.as_ref().filter(|named| script.scenario_is_sound(named)) else {
        return Vec::new();
    };
    let origin = program.mission.origin;
    let same = last.take().filter(|last| last.scenario == *named && last.origin == origin);
    let (computed, mut findings) = same.map_or_else(|| Computed::new(script, named, origin), |same| (same, Vec::new()));
    if let Some((lowered, understood)) = &last.insert(computed).world {
        let held = Held { name: &lowered.name, world: &understood.world, places: &lowered.places, origin };
        findings.extend(compatibility::findings(script, &mission.name, &held));
    }
    findings
}

/// What a mission misses in a world.
fn misfits(script: &Script, mission: &MissionInfo, wanted: &Wanted) -> Result<Vec<Diagnostic>, PlanError> {
    let wanted = Wanted { mission: Some(&mission.name), ..*wanted };
    Ok(Plan::unsuited(script, "", &wanted)?.misfits(script))
}

/// Whether the mission in whose frame a scenario lies is sound, if there is one.
fn runs_are_sound(script: &Script, scenario: &str) -> bool {
    let mut runs = script.missions().filter(|m| m.scenario.as_deref() == Some(scenario));
    runs.all(|m| script.mission_is_sound(&m.name))
}

/// What cannot be in a scenario, in the frame of the missions that run in it.
fn scenario(script: &Script, name: &str) -> Vec<Diagnostic> {
    // A mission that cannot be has been told of.
    let Ok(origin) = scenario::place_of(script, name) else { return Vec::new() };
    let lowered = match script.scenario(name, origin) {
        Some(Ok(lowered)) => lowered,
        Some(Err(findings)) => return findings,
        None => return Vec::new(),
    };
    match scenario::sound(&lowered, script) {
        Err(PlanError::Script(findings, _)) => findings,
        Err(PlanError::Asked(..)) | Ok(_) => Vec::new(),
    }
}
