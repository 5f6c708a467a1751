//! From the words of a command line to a mission that can run; what stands in the way is said here.

use crate::exit::Exit;
use crate::message::{self, Said};
use crate::shell;
use albacore_session::{FileError, Plan, PlanError, Script, SourceDigest, Wanted};
use albacore_trace::Digest;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::path::Path;

/// A script that the verb only looks at, or a module of the standard library by its bare name.
pub fn script_or_module(path: &Path) -> Result<Script, Exit> {
    sound(albacore_session::load_or_module(path))
}

/// What was loaded, if it can be used; else what is wrong is said.
pub fn sound(loaded: Result<Script, FileError>) -> Result<Script, Exit> {
    sound_but_said(loaded, &mut Said::default())
}

/// The same, of a script that may have been read before.
fn sound_but_said(loaded: Result<Script, FileError>, said: &mut Said) -> Result<Script, Exit> {
    let script = loaded.map_err(|error| {
        message::error(&error.message, error.help.as_deref());
        Exit::Usage
    })?;
    let findings = said.news(&script.findings, &script.sources);
    message::findings(&findings, &script.sources);
    message::more(&findings);
    if script.is_sound() { Ok(script) } else { Err(Exit::Script) }
}

/// The script that holds a scenario, named as `NAME`, `FILE.alb` or `FILE.alb#NAME`; with the file and the name.
pub fn scenario_script<'a>(named: &'a str, set: &[String]) -> Result<(Script, &'a str, Option<&'a str>), Exit> {
    let (file, name) = match named.split_once('#') {
        Some((file, name)) => (Some(file), Some(name)),
        None if named.ends_with(".alb") => (Some(named), None),
        None => (None, Some(named)),
    };
    let script = match file {
        Some(file) => {
            sound(albacore_session::load_for(Path::new(file), &Wanted { mission: None, scenario: name, set }))?
        }
        None => sound(Ok(albacore_session::load_library(named, set)))?,
    };
    Ok((script, file.unwrap_or_default(), name))
}

/// A script and the digest of its text.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ScriptDigest {
    /// What it is called in messages.
    pub name: String,
    /// 16 hexadecimal digits.
    pub digest: String,
}

/// The scripts of a plan, the mission's own first. The texts of `--set` are read as scripts too, and are none of them.
pub fn scripts(plan: &Plan) -> Vec<ScriptDigest> {
    let mut scripts: Vec<ScriptDigest> = Vec::new();
    for script in plan.sources.iter().filter(|source| !is_option(source)).map(ScriptDigest::of) {
        // A file may be played for several inputs.
        if !scripts.contains(&script) {
            scripts.push(script);
        }
    }
    scripts
}

/// Whether a source is the text of a `--set`. A file of data may be called like one.
fn is_option(source: &SourceDigest) -> bool {
    source.name.strip_prefix("--set ").is_some_and(|text| {
        let mut digest = Digest::new();
        digest.text(text);
        digest.value() == source.digest
    })
}

/// The script that the world of a plan stands in, if it stands in one.
pub fn world_script(plan: &Plan) -> Option<ScriptDigest> {
    plan.scenario_script.as_ref().map(ScriptDigest::of)
}

impl ScriptDigest {
    fn of(source: &SourceDigest) -> Self {
        ScriptDigest { name: source.name.clone(), digest: format!("{:016x}", source.digest) }
    }
}

/// Which mission of a script, in which world, with what changed: what every verb that drives takes.
#[derive(Clone, Default, clap::Args)]
pub struct Choice {
    /// The mission; else the one named like the file, else the only one.
    #[arg(long)]
    pub mission: Option<String>,
    /// The scenario, by its name or as `FILE.alb#NAME`; else the one that the mission names.
    #[arg(long = "in", value_name = "SCENARIO")]
    pub scenario: Option<String>,
    /// Change a parameter: `lambda=6s`, `cpt_2005.beta=30deg`, `duck_2003.step=2s`.
    #[arg(long = "set", value_name = "NAME=VALUE")]
    pub set: Vec<String>,
}

impl Choice {
    /// Loads the script, or says what is wrong and how the program ends.
    pub fn script(&self, path: &Path) -> Result<Script, Exit> {
        sound(albacore_session::load_for(path, &self.wanted()))
    }

    /// Loads the script and plans the mission in a simulated world, or says what stands in the way. What was said before is not said again.
    pub fn planned(&self, path: &Path, said: &mut Said) -> Result<Plan, Exit> {
        let script = sound_but_said(albacore_session::load_for(path, &self.wanted()), said)?;
        let plan = Plan::wanted(&script, &path.display().to_string(), &self.wanted());
        let plan = plan.map_err(|error| refused(&error))?;
        message::findings(&said.news(&plan.warnings, &script.sources), &script.sources);
        Ok(plan)
    }

    /// The words of a command that chooses the same: `--in duck_2003 --set lambda=6s`.
    pub fn words(&self) -> Vec<String> {
        let mission = self.mission.iter().map(|mission| ("--mission", mission));
        let scenario = self.scenario.iter().map(|scenario| ("--in", scenario));
        let set = self.set.iter().map(|set| ("--set", set));
        let options = mission.chain(scenario).chain(set);
        options.flat_map(|(option, value)| [option.to_string(), shell::word(value.as_ref())]).collect()
    }

    fn wanted(&self) -> Wanted<'_> {
        Wanted { mission: self.mission.as_deref(), scenario: self.scenario.as_deref(), set: &self.set }
    }

    /// Plans the mission in a simulated world, or says what stands in the way.
    pub fn plan(&self, script: &Script, path: &Path) -> Result<Plan, Exit> {
        let file = path.display().to_string();
        let plan = Plan::wanted(script, &file, &self.wanted()).map_err(|error| refused(&error))?;
        message::findings(&plan.warnings, &script.sources);
        Ok(plan)
    }
}

/// What goes wrong in a simulated world, beside what its scenario says.
#[derive(clap::Args)]
pub struct Faults {
    /// Inject a fault, written as a scenario clause: `fault(position, off, from: 120 s, to: 180 s)`.
    #[arg(long = "fault", value_name = "CLAUSE")]
    pub texts: Vec<String>,
}

impl Faults {
    /// The words of a command that lets the same go wrong.
    pub fn words(&self) -> Vec<String> {
        self.texts.iter().flat_map(|text| ["--fault".to_string(), shell::word(text.as_ref())]).collect()
    }

    /// What they let go wrong, or tells what is wrong with them.
    pub fn read(&self) -> Result<albacore_session::Faults, Exit> {
        let script = sound(Ok(albacore_session::load_faults(&self.texts)))?;
        albacore_session::Faults::of(&script).map_err(|error| refused(&error))
    }
}

/// Warns of what was to go wrong and did not, since the run, or the longest of several, lasted only so long, s.
pub fn warn_of_faults_after<'a>(plans: impl Iterator<Item = &'a Plan>, lasted: f64) {
    let never = plans
        .flat_map(|plan| plan.faults_after(lasted))
        .map(|fault| format!("`{fault}` never began: from {} s, and the mission lasted {lasted:.1} s", fault.from));
    never
        .collect::<BTreeSet<String>>()
        .iter()
        .for_each(|what| message::warning(what, "let it begin earlier, with `from`"));
}

/// Says why a script cannot be run as asked.
pub fn refused(error: &PlanError) -> Exit {
    match error {
        PlanError::Script(findings, sources) => {
            message::findings(findings, sources);
            message::more(findings);
            Exit::Script
        }
        PlanError::Asked(what, help) => {
            message::error(what, help.as_deref());
            Exit::Usage
        }
    }
}
