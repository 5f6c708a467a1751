//! A scenario of a script by its name.

use super::Understood;
use crate::files::Files;
use crate::plan::PlanError;
use albacore_geometry::Geodetic;
use albacore_lang::diagnostic::{Diagnostic, settle};
use albacore_lang::{MissionInfo, ScenarioProgram, Script};

use albacore_sim::ScenarioError;

/// Where the missions lie that run in a scenario.
pub(crate) fn place_of(script: &Script, scenario: &str) -> Result<Option<Geodetic>, PlanError> {
    let runs_in_it = |mission: &&MissionInfo| mission.scenario.as_deref() == Some(scenario);
    let Some(mission) = script.missions().find(runs_in_it) else { return Ok(None) };
    match script.mission(&mission.name) {
        Some(Ok(program)) => Ok(program.mission.origin),
        Some(Err(findings)) => Err(PlanError::script(findings, script)),
        None => Ok(None),
    }
}

/// A scenario of a script by its name, and its numbers in the frame about `origin`; files that it names lie in the script's
/// project.
pub(crate) fn named(
    script: &Script,
    wanted: &str,
    origin: Option<Geodetic>,
) -> Result<(ScenarioProgram, Understood), PlanError> {
    let lowered = match script.scenario(wanted, origin) {
        Some(Ok(lowered)) => lowered,
        Some(Err(findings)) => return Err(PlanError::script(findings, script)),
        None => {
            let known: Vec<&str> = script.scenarios().collect();
            let own: Vec<&str> = script.own_scenarios().collect();
            let message = format!("there is no scenario `{wanted}`");
            let help = match wanted.ends_with(".alb") {
                true => Some(format!("name one of the file: `{wanted}#NAME`")),
                false => albacore_wording::help(wanted, known.iter().copied())
                    .or_else(|| albacore_wording::help(wanted, own.iter().copied())),
            };
            return Err(PlanError::Asked(message, help));
        }
    };
    let understood = sound(&lowered, script)?;
    Ok((lowered, understood))
}

/// The numbers of a scenario of a script, if there can be such a world: else all that cannot be, at its place.
pub(crate) fn sound(lowered: &ScenarioProgram, script: &Script) -> Result<Understood, PlanError> {
    let wrong = |mut findings: Vec<Diagnostic>| {
        settle(&mut findings);
        PlanError::script(findings, script)
    };
    let understood = super::scenario(lowered, &Files::of(script)).map_err(wrong)?;
    let objections = understood.world.validate().err().map_or_else(Vec::new, |error| error.faults);
    if objections.is_empty() {
        return Ok(understood);
    }
    Err(wrong(objections.iter().map(|objection| super::objected(lowered, objection)).collect()))
}

/// What is said of a world that turns out to be impossible only when it is begun.
pub(crate) fn cannot_begin(error: &ScenarioError) -> PlanError {
    PlanError::Asked("the scenario cannot be".into(), Some(error.to_string()))
}
