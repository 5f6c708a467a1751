//! What a prompt is opened with, and what stands in the way.

use super::Prompt;
use super::moment::{Moment, Past};
use super::timeline::FIRST_FORK;
use super::vehicle::PastVehicle;
use crate::FileError;
use crate::faults::Faults;
use crate::files::Files;
use crate::kept::{self, Changes};
use crate::plan::{Plan, PlanError};
use crate::scenario;
use crate::wanted::Wanted;
use albacore_lang::diagnostic::Diagnostic;
use albacore_lang::prompt::Prompt as Lines;
use albacore_lang::source::{Source, Sources};
use albacore_lang::{Library, Script};
use albacore_machine::{Chart, Machine};
use albacore_program::Program;
use albacore_sim::{Scenario, Simulator};
use albacore_trace::journal::{Ending, Entry, JournalHeader, Reader};
use albacore_trace::{Step, TickRecord};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The world when no script names one.
const SCENARIO_AT_FIRST: &str = "calm";

/// What a prompt is opened with.
#[derive(Clone, Debug, Default)]
pub struct Opening {
    /// The script; none for an empty one.
    pub script: Option<PathBuf>,
    /// Its mission, when there are several.
    pub mission: Option<String>,
    /// The world, when the mission's own is not wanted.
    pub scenario: Option<String>,
    /// The seed of all that is random.
    pub seed: u64,
    /// Parameters changed, as in [`crate::load`].
    pub set: Vec<String>,
    /// What goes wrong beside what the world's scenario says.
    pub faults: Faults,
    /// The vehicle at the end of a link that is driven, by its URL; none for a simulated one.
    pub link: Option<String>,
    /// A run that is over, in place of a script: its mission goes through what its vehicle sensed.
    pub past: Option<Arc<PastTicks>>,
}

/// What the journal of a run holds, for a prompt.
#[derive(Debug)]
pub struct PastTicks {
    header: JournalHeader,
    ticks: Arc<[TickRecord]>,
    /// A file of the project, from which files of data are looked for.
    beside: Option<PathBuf>,
}

impl PastTicks {
    /// Reads all ticks of a journal, as far as it is whole, and tells how it ends. Behind ticks that are missing nothing is read: what the
    /// mission did in them is not known.
    pub fn read(mut journal: Reader<'_>, beside: Option<PathBuf>) -> (Self, Ending) {
        let header = journal.header().clone();
        let mut ticks = Vec::new();
        for entry in journal.by_ref() {
            match entry {
                Entry::Step(record) if matches!(record.step, Step::Tick) => ticks.push(*record),
                Entry::Step(_) => {}
                Entry::Gap(_) => break,
            }
        }
        (PastTicks { header, ticks: ticks.into(), beside }, journal.into_ending())
    }
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

/// A script that was read for a prompt, and what it makes of it.
pub(super) struct Loaded {
    pub files: Arc<dyn Library>,
    pub lines: Lines,
    pub script: Script,
    pub mission: Option<Arc<Program>>,
    pub scenario_name: String,
    pub scenario: Arc<Scenario>,
    /// What is known of the bottom beforehand.
    pub chart: Option<Chart>,
}

impl Opening {
    /// Loads the script, and makes its world.
    pub(super) fn load(&self) -> Result<Loaded, OpenError> {
        let refused = |error: PlanError| match error {
            PlanError::Script(findings, sources) => OpenError::Script(Box::new((findings, sources))),
            PlanError::Asked(what, help) => OpenError::Asked(what, help),
        };
        if let Some(past) = &self.past {
            return self.load_past(past).map_err(refused);
        }
        let (source, files, name) = match &self.script {
            Some(path) => {
                (crate::files::read(path).map_err(OpenError::File)?, Files::around(path), path.display().to_string())
            }
            None => {
                let empty = Source { name: "<prompt>".into(), text: "".into() };
                (empty, Files::around(Path::new("prompt.alb")), String::new())
            }
        };
        let wanted = Wanted { mission: self.mission.as_deref(), scenario: self.scenario.as_deref(), set: &self.set };
        let (own, _) = wanted.parted();
        let (lines, script) = Lines::open(source, &files, &wanted.of_script(&own));
        if !script.is_sound() {
            return Err(OpenError::Script(Box::new((script.findings, script.sources))));
        }
        let has_mission = script.missions().next().is_some();
        let plan = match &self.link {
            Some(link) => Some(Plan::on_link(&script, &name, wanted.mission, link).map_err(refused)?),
            None if has_mission => Some(Plan::wanted(&script, &name, &wanted).map_err(refused)?),
            None => None,
        };
        let chart = plan.as_ref().and_then(Plan::chart);
        let (mission, scenario_name, scenario) = if let Some(plan) = plan {
            (Some(plan.program), plan.scenario_name, plan.scenario)
        } else {
            let wanted = wanted.scenario.unwrap_or(SCENARIO_AT_FIRST);
            let (lowered, understood) = scenario::named(&script, wanted, None).map_err(refused)?;
            (None, lowered.name, Arc::new(understood.world))
        };
        let scenario = self.faults.in_scenario(scenario).map_err(refused)?;
        Ok(Loaded { files: Arc::new(files), lines, script, mission, scenario_name, scenario, chart })
    }

    /// The script as a journal holds it.
    fn load_past(&self, past: &PastTicks) -> Result<Loaded, PlanError> {
        let changes = Changes { set: &self.set, beside: past.beside.as_deref(), ..Changes::default() };
        let (_, plan) = Plan::of_journal(&past.header, &changes)?;
        let (files, lines, script) = kept::lines(&past.header, &changes)?;
        let chart = plan.chart();
        let Plan { program, scenario, scenario_name, .. } = plan;
        Ok(Loaded { files, lines, script, mission: Some(program), scenario_name, scenario, chart })
    }
}

impl Prompt {
    /// Loads a script, makes its world, and takes control of the vehicle in it.
    pub fn open(opening: Opening) -> Result<Self, OpenError> {
        let loaded = opening.load()?;
        let asked = |what: String| OpenError::Asked(what, None);
        let now = match (&opening.past, &loaded.mission) {
            (Some(past), Some(program)) => {
                let machine = Machine::new(Arc::clone(program), &past.header.measurements);
                let machine = machine.map_err(|missing| asked(missing.to_string()))?.with_chart(loaded.chart.clone());
                let vehicle = PastVehicle::new(past.header.measurements.clone().into(), Arc::clone(&past.ticks));
                Moment::of_past(vehicle, machine)
            }
            _ => Moment::first(vehicle(&loaded.scenario, opening.seed)?),
        };
        let now = now.map_err(|error| asked(error.to_string()))?;
        Ok(Prompt::beginning(opening, loaded, now))
    }

    /// At its first moment.
    pub(super) fn beginning(opening: Opening, loaded: Loaded, now: Moment) -> Self {
        let past = Past::beginning_with(&now);
        let mut prompt = Prompt {
            opening,
            loaded,
            entered: Vec::new(),
            ahead: Vec::new(),
            now,
            past,
            here: FIRST_FORK.to_string(),
            forks: BTreeMap::new(),
            stopped: false,
            has_lost_link: false,
        };
        prompt.look_ahead();
        prompt
    }
}

fn vehicle(scenario: &Scenario, seed: u64) -> Result<Simulator, OpenError> {
    // At the prompt the vehicle is the person's from the first moment on.
    let scenario = Scenario { handover: None, ..scenario.clone() };
    Simulator::new(&scenario, seed)
        .map_err(|error| OpenError::Asked("the scenario cannot be".into(), Some(error.to_string())))
}
