//! A simulated world with a vehicle in it that is served to others: the far end of a link.

use crate::faults::Faults;
use crate::files::Files;
use crate::plan::PlanError;
use crate::scenario::{Understood, objected};
use albacore_geometry::{Geodetic, TangentFrame};
use albacore_lang::diagnostic::{Diagnostic, settle};
use albacore_lang::{ScenarioProgram, Script, suggestion};
use albacore_link::Dialect;
use albacore_link::recon::{FrontSeat, Route, Rows};
use albacore_sim::{Scenario, ScenarioError, Simulator};
use albacore_vehicle::Vertical;
use std::sync::Arc;

/// A vehicle at the surface swims its rows this far above the bottom, m.
const ROWS_ALTITUDE: f64 = 2.0;

/// A world on the globe.
#[derive(Clone, Debug)]
pub struct World {
    /// Its name.
    pub name: String,
    /// What its vehicle speaks, if that is said.
    pub dialect: Option<Dialect>,
    scenario: Arc<Scenario>,
    frame: TangentFrame,
}

/// A simulated vehicle and the computer in its front seat.
pub type FarEnd = FrontSeat<Simulator>;

impl World {
    /// A scenario that the script knows, by its name, else the one that the script's mission runs in. It lies where that
    /// mission lies, else where its own positions are.
    pub fn new(script: &Script, file: &str, wanted: Option<&str>) -> Result<Self, PlanError> {
        let own = |mission: &albacore_lang::MissionInfo| mission.scenario.clone();
        let known: Vec<&str> = script.scenarios().collect();
        let Some(wanted) = wanted.map(str::to_string).or_else(|| script.missions().find_map(own)) else {
            let help = format!("name it: `{file}#NAME`; there is {}", known.join(", "));
            return Err(PlanError::Asked(format!("which scenario of `{file}` is to be served?"), Some(help)));
        };
        let (lowered, understood) = self::scenario(script, &wanted, place_of(script, &wanted)?)?;
        let Some(origin) = lowered.origin else {
            let help =
                "give its `start:` as latitude and longitude, or serve it from a script with a mission that runs in it";
            return Err(PlanError::Asked(
                format!("the scenario `{wanted}` has no place on the globe"),
                Some(help.into()),
            ));
        };
        let (scenario, dialect) = (Arc::new(understood.world), understood.dialect);
        Ok(World { name: lowered.name, dialect, scenario, frame: TangentFrame { origin } })
    }

    /// The same with faults added to those of the scenario.
    pub fn with_faults(self, faults: &Faults) -> Result<Self, PlanError> {
        Ok(World { scenario: faults.in_scenario(self.scenario)?, ..self })
    }

    /// The vehicle in it, with rows to swim, else the mission of the scenario, else rows all the same: the first from where it
    /// starts and along its heading, at the depth at which it starts, or near the bottom if that is the surface.
    pub fn far_end(&self, seed: u64, rows: Option<Rows>) -> Result<FarEnd, PlanError> {
        // Its computer is the front seat's: the simulated one gives way to that at once.
        let handover = self.scenario.handover.clone().unwrap_or_default();
        let scenario = Scenario { handover: None, ..(*self.scenario).clone() };
        let simulator = Simulator::new(&scenario, seed).map_err(|error| cannot_be(&error))?;
        let vehicle = &self.scenario.vehicle;
        let own = self.scenario.own_mission.as_ref();
        let vertical = match (own, vehicle.depth) {
            (Some(own), _) => own.vertical,
            (None, depth) if depth > 0.0 => Vertical::Depth(depth),
            _ => Vertical::Altitude(ROWS_ALTITUDE),
        };
        let route = rows.map(Route::Rows).or(own.map(|own| own.route.clone())).unwrap_or_default();
        let start = simulator.truth().position;
        let far_end = FrontSeat::new(simulator, self.frame, &route, (start, vehicle.heading), vertical);
        Ok(far_end.answering(handover))
    }
}

/// Where the missions lie that run in a scenario.
pub(crate) fn place_of(script: &Script, scenario: &str) -> Result<Option<Geodetic>, PlanError> {
    let runs_in_it = |mission: &&albacore_lang::MissionInfo| mission.scenario.as_deref() == Some(scenario);
    let Some(mission) = script.missions().find(runs_in_it) else { return Ok(None) };
    match script.mission(&mission.name) {
        Some(Ok(program)) => Ok(program.mission.origin),
        Some(Err(findings)) => Err(PlanError::script(findings, script)),
        None => Ok(None),
    }
}

/// A scenario of a script by its name, and its numbers in the frame about `origin`; files that it names lie in the script's
/// project.
pub(crate) fn scenario(
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
                false => suggestion(wanted, known.iter().copied()).or_else(|| suggestion(wanted, own.iter().copied())),
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
    let understood = crate::scenario::scenario(lowered, &Files::of(script)).map_err(wrong)?;
    let objections = understood.world.validate().err().map_or_else(Vec::new, |error| error.faults);
    if objections.is_empty() {
        return Ok(understood);
    }
    Err(wrong(objections.iter().map(|objection| objected(lowered, objection)).collect()))
}

/// What is said of a world that turns out to be impossible only when it is begun.
pub(crate) fn cannot_be(error: &ScenarioError) -> PlanError {
    PlanError::Asked("the scenario cannot be".into(), Some(error.to_string()))
}
