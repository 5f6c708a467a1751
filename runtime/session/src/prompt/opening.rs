//! What a prompt is opened with, and what stands in the way.

use super::Prompt;
use super::moment::{Moment, Past};
use crate::FileError;
use crate::faults::Faults;
use crate::files::Files;
use crate::plan::{Plan, PlanError};
use crate::scenario;
use crate::wanted::Wanted;
use albacore_lang::diagnostic::Diagnostic;
use albacore_lang::prompt::Prompt as Lines;
use albacore_lang::source::{Source, Sources};
use albacore_sim::{Scenario, Simulator};
use std::path::Path;
use std::sync::Arc;

/// The world when no script names one.
const SCENARIO_AT_FIRST: &str = "calm";

/// What a prompt is opened with.
#[derive(Clone, Debug, Default)]
pub struct Opening<'a> {
    /// The script; none for an empty one.
    pub script: Option<&'a Path>,
    /// Its mission, when there are several.
    pub mission: Option<&'a str>,
    /// The world, when the mission's own is not wanted.
    pub scenario: Option<&'a str>,
    /// The seed of all that is random.
    pub seed: u64,
    /// Parameters changed, as in [`crate::load`].
    pub set: &'a [String],
    /// What goes wrong beside what the world's scenario says.
    pub faults: Faults,
}

/// Why a prompt cannot be opened.
pub enum OpenError {
    /// The script cannot be read.
    File(FileError),
    /// The script has errors.
    Script(Box<(Vec<Diagnostic>, Sources)>),
    /// What was asked for does not exist or makes no sense: message and help.
    Asked(String, Option<String>),
}

impl Prompt {
    /// Loads a script, makes its world, and takes control of the vehicle in it.
    pub fn open(opening: &Opening) -> Result<Self, OpenError> {
        let (source, files, name) = match opening.script {
            Some(path) => {
                (crate::files::read(path).map_err(OpenError::File)?, Files::around(path), path.display().to_string())
            }
            None => {
                let empty = Source { name: "<prompt>".into(), text: "".into() };
                (empty, Files::around(Path::new("prompt.alb")), String::new())
            }
        };
        let wanted = Wanted { mission: opening.mission, scenario: opening.scenario, set: opening.set };
        let (own, _) = wanted.parted();
        let (lines, script) = Lines::open(source, &files, &wanted.of_script(&own));
        if !script.is_sound() {
            return Err(OpenError::Script(Box::new((script.findings, script.sources))));
        }
        let refused = |error: PlanError| match error {
            PlanError::Script(findings, sources) => OpenError::Script(Box::new((findings, sources))),
            PlanError::Asked(what, help) => OpenError::Asked(what, help),
        };
        let has_mission = script.missions().next().is_some();
        let (mission, scenario_name, scenario) = if has_mission {
            let plan = Plan::wanted(&script, &name, &wanted).map_err(refused)?;
            (Some(plan.program), plan.scenario_name, plan.scenario)
        } else {
            let wanted = opening.scenario.unwrap_or(SCENARIO_AT_FIRST);
            let (lowered, understood) = scenario::named(&script, wanted, None).map_err(refused)?;
            (None, lowered.name, Arc::new(understood.world))
        };
        let scenario = opening.faults.in_scenario(scenario).map_err(refused)?;
        let now = Moment::first(vehicle(&scenario, opening.seed)?)
            .map_err(|error| OpenError::Asked(error.to_string(), None))?;
        let past = Past::beginning_with(&now);
        let seed = opening.seed;
        Ok(Prompt { files, lines, script, mission, scenario_name, scenario, seed, now, past, stopped: false })
    }
}

fn vehicle(scenario: &Scenario, seed: u64) -> Result<Simulator, OpenError> {
    // At the prompt the vehicle is the person's from the first moment on.
    let scenario = Scenario { handover: None, ..scenario.clone() };
    Simulator::new(&scenario, seed)
        .map_err(|error| OpenError::Asked("the scenario cannot be".into(), Some(error.to_string())))
}
