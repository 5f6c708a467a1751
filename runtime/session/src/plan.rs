//! What is to be run: a mission, chosen from a script, and the world that it runs in.

use crate::compatibility::{self, Held};
use crate::faults::Faults;
use crate::kept;
use crate::scenario;
use crate::wanted::Wanted;
use albacore_geometry::{Area, Geodetic, Point, TangentFrame};
use albacore_lang::Script;
use albacore_lang::diagnostic::{Diagnostic, Severity};
use albacore_lang::source::{FileId, Sources};

use albacore_link::Dialect;
use albacore_machine::Chart;
use albacore_program::Program;
use albacore_sim::{Bottom, Environment, Fault, Ground, Scenario};
use albacore_trace::Digest;
use albacore_trace::journal::{KeptScript, SourceDigest, World};
use std::fmt::{self, Write};
use std::path::Path;
use std::sync::{Arc, OnceLock};

/// A mission and the world it runs in, ready to run with any seed.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The mission.
    pub program: Arc<Program>,
    /// The world.
    pub scenario: Arc<Scenario>,
    /// The world's name.
    pub scenario_name: String,
    /// The script that the world stands in; none for a vehicle at the end of a link.
    pub scenario_script: Option<SourceDigest>,
    /// What both were made from.
    pub sources: Vec<SourceDigest>,
    /// The texts of the mission's scripts, for the journal.
    pub(crate) scripts: Arc<[KeptScript]>,
    /// What it runs in, for the journal.
    pub(crate) world: Arc<World>,
    /// What the one may miss in the other, with places in the mission's script.
    pub warnings: Vec<Diagnostic>,
    /// The scenario's own positions on the globe.
    places: Vec<Geodetic>,
    /// The survey of the bottom that the mission's scenario names: what is known of the water's depth beforehand.
    survey: Option<Arc<Bottom>>,
    /// The area that was asked for first, and its deepest point: the runs of a campaign ask for the same.
    deepest: Arc<OnceLock<(Area, Point)>>,
}

/// A digest of what is written to it.
struct DebugDigest<'a>(&'a mut Digest);

impl fmt::Write for DebugDigest<'_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.bytes(text.as_bytes());
        Ok(())
    }
}

/// Why a script cannot be run as asked.
#[derive(Debug)]
pub enum PlanError {
    /// The script, or the one that the scenario is in, has errors; with the sources that they point into.
    Script(Vec<Diagnostic>, Sources),
    /// What was asked for does not exist or makes no sense: message and help.
    Asked(String, Option<String>),
}

impl PlanError {
    /// What is wrong with a script.
    pub(crate) fn script(findings: Vec<Diagnostic>, script: &Script) -> Self {
        PlanError::Script(findings, script.sources.clone())
    }
}

impl Plan {
    /// The deepest point of an area in the world, which takes long to find in a survey.
    pub(crate) fn deepest(&self, area: Area) -> Point {
        let bottom = &self.scenario.environment.bottom;
        let (known, deepest) = self.deepest.get_or_init(|| (area.clone(), bottom.deepest(&area)));
        if *known == area { *deepest } else { bottom.deepest(&area) }
    }

    /// A digest of the world's water, bottom and plume, whatever swims in it: where it is the same, the same seed is the same water.
    pub fn world_digest(&self) -> u64 {
        // A recorded plume is what its files are.
        let environment = Environment { recording: None, ..self.scenario.environment.clone() };
        let mut digest = Digest::new();
        let recorded = self.scenario.environment.recording.as_ref();
        let told = recorded.map(|plume| (plume.kernel, plume.start, plume.start_spread, plume.threshold));
        // Memory takes everything.
        let _ = write!(DebugDigest(&mut digest), "{environment:?} {told:?}");
        let is_data = |source: &&SourceDigest| recorded.is_some() && !source.name.ends_with(".alb");
        self.sources.iter().filter(is_data).for_each(|source| digest.bytes(&source.digest.to_le_bytes()));
        digest.value()
    }

    /// What both were made from, by names as seen from the folder of the script: equal runs leave equal journals, wherever the files
    /// lie and however their paths were written.
    pub fn sources_from_script(&self) -> Vec<SourceDigest> {
        let script = self.sources.first().map_or("", |source| source.name.as_str());
        let folder = Path::new(script).parent().unwrap_or(Path::new(""));
        let named = |source: &SourceDigest| SourceDigest { name: seen_from(folder, &source.name), ..source.clone() };
        self.sources.iter().map(named).collect()
    }

    /// Chooses the mission (by name, else the one named like the file, else the only one) and the scenario (by name, or as
    /// `file.alb#name`, else the mission's own).
    pub fn new(script: &Script, file: &str, mission: Option<&str>, scenario: Option<&str>) -> Result<Self, PlanError> {
        Plan::wanted(script, file, &Wanted { mission, scenario, set: &[] })
    }

    /// The same, with the parameters of a scenario of another script changed.
    pub fn wanted(script: &Script, file: &str, wanted: &Wanted) -> Result<Self, PlanError> {
        Plan::unsuited(script, file, wanted)?.suiting(script)
    }

    /// The same, whether or not the world has what the mission needs.
    pub(crate) fn unsuited(script: &Script, file: &str, wanted: &Wanted) -> Result<Self, PlanError> {
        let (name, program) = chosen(script, file, wanted.mission)?;
        let own = script.own_scenario(&name).map(str::to_string);
        let known: Vec<&str> = script.scenarios().collect();
        let Some(scenario) = wanted.scenario.map(str::to_string).or(own) else {
            let message = format!("in which world does the mission `{name}` run?");
            let help =
                format!("name one with `--in`, or write `mission {name} in SCENARIO`; there is {}", known.join(", "));
            return Err(PlanError::Asked(message, Some(help)));
        };
        let program = Arc::new(program);
        match scenario.split_once('#') {
            None => Plan::with(script, program, &scenario),
            Some((file, scenario)) => {
                let other = other_script(file, scenario, wanted)?;
                Plan::in_world_of(&other, script, program, scenario)
            }
        }
    }

    /// The same in a scenario of another script.
    pub(crate) fn in_world_of(
        other: &Script,
        script: &Script,
        program: Arc<Program>,
        scenario: &str,
    ) -> Result<Self, PlanError> {
        let plan = Plan::with(other, program, scenario)?;
        // The file may be the mission's own, or import what that imports.
        let mut sources = sources(script);
        for source in plan.sources {
            if sources.iter().all(|known| *known != source) {
                sources.push(source);
            }
        }
        let scripts = kept::scripts(script);
        let world = Arc::new(World::Scenario { called: scenario.to_string(), scripts: plan.scripts.to_vec() });
        Ok(Plan { sources, scripts, world, ..plan })
    }

    /// The same, if its world has what its mission needs.
    pub(crate) fn suiting(self, script: &Script) -> Result<Self, PlanError> {
        let findings = self.misfits(script);
        let of = |severity| findings.iter().filter(move |finding| finding.severity == severity).cloned().collect();
        let errors: Vec<_> = of(Severity::Error);
        if errors.is_empty() {
            Ok(Plan { warnings: of(Severity::Warning), ..self })
        } else {
            Err(PlanError::script(errors, script))
        }
    }

    /// All that the mission misses in its world.
    pub(crate) fn misfits(&self, script: &Script) -> Vec<Diagnostic> {
        let mission = &self.program.mission;
        let (name, world) = (self.scenario_name.as_str(), &*self.scenario);
        compatibility::findings(
            script,
            &mission.name,
            &Held { name, world, places: &self.places, origin: mission.origin },
        )
    }

    /// Chooses the mission, for a vehicle at the end of a link. There is no world that we know of; its name is the link's.
    pub fn on_link(script: &Script, file: &str, mission: Option<&str>, link: &str) -> Result<Self, PlanError> {
        let (name, program) = chosen(script, file, mission)?;
        if program.mission.origin.is_none() {
            let message = format!("the mission `{name}` has no place on the globe, and a vehicle has no other");
            let help =
                "give a corner or the center of its area as latitude and longitude, such as `36°10.8'N 75°44.4'W`";
            return Err(PlanError::Asked(message, Some(help.into())));
        }
        if let Some(action) = program.asks.first() {
            let message = format!("the mission `{name}` asks `{action}` of a payload, and no link carries that");
            let help =
                "run it in a scenario, or leave the `ask` out: a dialect has messages for what drives a vehicle alone";
            return Err(PlanError::Asked(message, Some(help.into())));
        }
        let own = script.own_scenario(&name).map(str::to_string);
        let survey = match own {
            Some(own) => survey(&scenario::named(script, &own, program.mission.origin)?.1.world),
            None => None,
        };
        let (program, scenario) = (Arc::new(program), Arc::new(Scenario::default()));
        let (scenario_name, sources, scripts) = (link.to_string(), sources(script), kept::scripts(script));
        let (warnings, places, scenario_script) = (Vec::new(), Vec::new(), None);
        Ok(Plan {
            program,
            scenario,
            scenario_name,
            scenario_script,
            sources,
            scripts,
            world: Arc::new(World::Link),
            warnings,
            places,
            survey,
            deepest: Arc::default(),
        })
    }

    /// The same, of a mission that stands in a module of the script: a journal holds that module as the script, and the script as that of
    /// the world.
    pub(crate) fn of_module(self, module: &Path) -> Self {
        let script = self.sources.first().map_or("", |source| source.name.as_str());
        let folder = Path::new(script).parent().unwrap_or(Path::new(""));
        let name = seen_from(folder, &module.display().to_string());
        match self.scripts.iter().position(|script| script.name == name) {
            Some(at) if at > 0 => {
                let mut scripts = self.scripts.to_vec();
                scripts[..=at].rotate_right(1);
                let called = match &*self.world {
                    World::Scenario { called, .. } => called.clone(),
                    World::Link => String::new(),
                };
                let world = Arc::new(World::Scenario { called, scripts: self.scripts.to_vec() });
                Plan { scripts: scripts.into(), world, ..self }
            }
            _ => self,
        }
    }

    /// What is known of the water's depth beforehand, where it was surveyed. What a scenario makes up is no knowledge of a place.
    pub(crate) fn chart(&self) -> Option<Chart> {
        let survey = Arc::clone(self.survey.as_ref()?);
        let Ground::Grid(grid) = &survey.ground else { return None };
        let area = grid.area()?;
        Some(Arc::new(move |at, within| area.contains(at).then(|| survey.shallowest_within(within, at))))
    }

    /// A mission alone, to be fed with what was sensed elsewhere.
    pub(crate) fn without_world(script: &Script, file: &str, mission: Option<&str>) -> Result<Self, PlanError> {
        let (_, program) = chosen(script, file, mission)?;
        Ok(Plan {
            program: Arc::new(program),
            scenario: Arc::new(Scenario::default()),
            scenario_name: String::new(),
            scenario_script: None,
            sources: sources(script),
            scripts: kept::scripts(script),
            world: Arc::new(World::Link),
            warnings: Vec::new(),
            places: Vec::new(),
            survey: None,
            deepest: Arc::default(),
        })
    }

    /// The same with faults added to those of the scenario.
    pub fn with_faults(self, faults: &Faults) -> Result<Self, PlanError> {
        Ok(Plan { scenario: faults.in_scenario(self.scenario)?, ..self })
    }

    /// The faults of the scenario that do not begin in a run that lasts so long, s.
    pub fn faults_after(&self, lasting: f64) -> impl Iterator<Item = &Fault> {
        self.scenario.faults.iter().filter(move |fault| !fault.begins_within(lasting))
    }

    /// What the vehicle speaks that the mission's own scenario says it is for, if it says so.
    pub fn dialect(script: &Script, file: &str, mission: Option<&str>) -> Result<Option<&'static Dialect>, PlanError> {
        let (name, program) = chosen(script, file, mission)?;
        let Some(own) = script.own_scenario(&name) else {
            return Ok(None);
        };
        Ok(scenario::named(script, own, program.mission.origin)?.1.dialect)
    }

    /// The frame of the mission, if it lies on the globe.
    pub fn frame(&self) -> Option<TangentFrame> {
        self.program.mission.origin.map(|origin| TangentFrame { origin })
    }

    /// A mission that is lowered already, in a scenario of the script.
    pub(crate) fn with(script: &Script, program: Arc<Program>, wanted: &str) -> Result<Self, PlanError> {
        let (lowered, understood) = scenario::named(script, wanted, program.mission.origin)?;
        let survey = survey(&understood.world);
        let (scenario, scenario_name) = (Arc::new(understood.world), lowered.name);
        let sources = sources(script).into_iter().chain(understood.files).collect();
        let (scripts, places, warnings) = (kept::scripts(script), lowered.places, Vec::new());
        let scenario_script = Some(digest(script, lowered.span.file));
        Ok(Plan {
            program,
            scenario,
            scenario_name,
            scenario_script,
            sources,
            scripts,
            world: Arc::new(World::Scenario { called: wanted.to_string(), scripts: Vec::new() }),
            warnings,
            places,
            survey,
            deepest: Arc::default(),
        })
    }
}

/// A script whose scenario alone is wanted.
fn other_script(file: &str, scenario: &str, wanted: &Wanted) -> Result<Script, PlanError> {
    let set = wanted.parted().1;
    let wanted = Wanted { mission: None, scenario: Some(scenario), set: &set };
    let script = crate::load_for(Path::new(file), &wanted);
    let script = script.map_err(|error| PlanError::Asked(error.message, error.help))?;
    if script.is_sound() { Ok(script) } else { Err(PlanError::script(script.findings.clone(), &script)) }
}

/// The mission that is meant, by its name, and ready to run.
pub(crate) fn chosen(script: &Script, file: &str, mission: Option<&str>) -> Result<(String, Program), PlanError> {
    let names: Vec<&str> = script.missions().map(|m| m.name.as_str()).collect();
    let stem = Path::new(file).file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
    let name = match mission {
        Some(name) if names.contains(&name) => name.to_string(),
        Some(name) => {
            let message = format!("`{file}` has no mission `{name}`");
            return Err(PlanError::Asked(message, albacore_wording::help(name, names.iter().copied())));
        }
        None if names.contains(&stem.as_str()) => stem,
        None => match names.as_slice() {
            [only] => (*only).to_string(),
            [] => {
                return Err(PlanError::Asked(
                    format!("`{file}` has no mission"),
                    Some("write `mission NAME { … }`".into()),
                ));
            }
            several => {
                let message = format!("`{file}` has several missions");
                let help = format!("choose one with `--mission`: {}", several.join(", "));
                return Err(PlanError::Asked(message, Some(help)));
            }
        },
    };
    match script.mission(&name) {
        Some(Ok(program)) => Ok((name, program)),
        Some(Err(findings)) => Err(PlanError::script(findings, script)),
        None => Err(PlanError::Asked(format!("`{file}` has no mission `{name}`"), None)),
    }
}

/// What a file is called, seen from a folder: by its name alone where it lies elsewhere.
pub(crate) fn seen_from(folder: &Path, name: &str) -> String {
    let path = Path::new(name);
    let inside = path.strip_prefix(folder).ok().or(path.file_name().map(Path::new));
    inside.map_or_else(|| name.to_string(), |inside| inside.display().to_string())
}

/// The bottom of a scenario without its pits, if it was surveyed.
fn survey(world: &Scenario) -> Option<Arc<Bottom>> {
    let ground = world.environment.bottom.ground.clone();
    matches!(ground, Ground::Grid(_)).then(|| Arc::new(Bottom { ground, pits: Vec::new() }))
}

/// What a script was made from.
fn sources(script: &Script) -> Vec<SourceDigest> {
    script.sources.ids().map(|file| digest(script, file)).collect()
}

fn digest(script: &Script, file: FileId) -> SourceDigest {
    let of_text = |text: &str| {
        let mut digest = Digest::new();
        digest.text(text);
        digest.value()
    };
    SourceDigest { name: script.sources.get(file).name.to_string(), digest: script.sources.digest(file, of_text) }
}
