//! Scripts as a journal keeps them: what was run can be read again when its files have changed.

use crate::files::{Files, is_standard, stdlib};
use crate::plan::{Plan, PlanError, chosen, seen_from};
use crate::wanted::Wanted;
use albacore_lang::source::Source;
use albacore_lang::{FileFault, Library, Prelude, Script};
use albacore_trace::journal::{JournalHeader, KeptScript, World};
use std::path::Path;
use std::sync::Arc;

/// Of larger scripts no text is kept: a record of the journal has its bound.
const KEPT_BYTES_MAX: usize = 6 << 20;

/// The texts of a script and of what it imports of its project.
pub(crate) fn scripts(script: &Script) -> Arc<[KeptScript]> {
    let files = Files::of(script);
    let entry = script.sources.iter().next().map_or("", |source| &source.name);
    let folder = Path::new(entry).parent().unwrap_or(Path::new(""));
    let is_kept = |source: &&Source| !is_standard(source) && source.name.ends_with(".alb");
    let kept = script.sources.iter().filter(is_kept).map(|source| {
        let path = Path::new(&*source.name);
        let inside = path.strip_prefix(files.root()).unwrap_or(path).with_extension("");
        let parts: Vec<_> = inside.iter().map(|part| part.to_string_lossy()).collect();
        KeptScript { name: seen_from(folder, &source.name), module: parts.join("/"), text: source.text.to_string() }
    });
    let kept: Arc<[KeptScript]> = kept.collect();
    let bytes: usize = kept.iter().map(|script| script.text.len()).sum();
    if bytes > KEPT_BYTES_MAX { Arc::default() } else { kept }
}

/// The scripts of a journal, and beside them the files of data of a project, which no journal holds.
struct KeptFiles {
    scripts: Vec<KeptScript>,
    data: Files,
}

impl Library for KeptFiles {
    fn prelude(&self) -> &Prelude {
        self.data.prelude()
    }

    fn module(&self, importer: &Source, path: &[String]) -> Result<Source, String> {
        let standard = || path.first().filter(|_| path.len() == 1).and_then(|name| stdlib(name));
        if is_standard(importer)
            && let Some(source) = standard()
        {
            return Ok(source);
        }
        let module = path.join("/");
        match self.scripts.iter().find(|script| script.module == module) {
            Some(script) => Ok(self.source(script)),
            None => standard().ok_or_else(|| "the journal does not hold it".to_string()),
        }
    }

    fn data_file(&self, path: &str, bytes_max: u64) -> Result<Vec<u8>, FileFault> {
        self.data.data_file(path, bytes_max)
    }
}

impl KeptFiles {
    /// The script itself.
    fn first(&self) -> Result<Source, PlanError> {
        let help = "name the script with `--script`; texts of more than 6 MiB are not kept";
        let missing = || PlanError::Asked("the journal does not hold its script".into(), Some(help.into()));
        self.scripts.first().map(|script| self.source(script)).ok_or_else(missing)
    }

    /// A script under the name that it would have in the project, from which its files of data are looked for.
    fn source(&self, script: &KeptScript) -> Source {
        let file = format!("{}.alb", script.module);
        let root = Some(self.data.root()).filter(|root| *root != Path::new("."));
        let name = root.map_or_else(|| file.clone(), |root| root.join(&file).display().to_string());
        Source { name: name.into(), text: script.text.as_str().into() }
    }
}

/// What is changed for a replay.
#[derive(Clone, Copy, Debug, Default)]
pub struct Changes<'a> {
    /// Another script than the journal's, or the same as it is by now.
    pub script: Option<&'a Path>,
    /// Its mission; else that of the journal.
    pub mission: Option<&'a str>,
    /// Parameters, after those that were changed for the run.
    pub set: &'a [String],
    /// A file of the project, which need not be there: files of data that scripts read are looked for in its project.
    pub beside: Option<&'a Path>,
}

impl Changes<'_> {
    /// Whether nothing is changed.
    pub fn is_empty(&self) -> bool {
        self.script.is_none() && self.mission.is_none() && self.set.is_empty()
    }
}

impl Plan {
    /// The plan of a run by what its journal tells of it, with changes; and its script.
    pub fn of_journal(header: &JournalHeader, changes: &Changes) -> Result<(Script, Self), PlanError> {
        let mission = changes.mission.unwrap_or(&header.mission);
        let set = set_again(&header.set, changes.set, mission);
        let data = Files::around(changes.beside.unwrap_or(Path::new("")));
        let elsewhere;
        let scenario = match &header.world {
            World::Scenario { called, scripts } if scripts.is_empty() => Some(called.as_str()),
            World::Scenario { called, .. } => {
                elsewhere = format!("elsewhere#{called}");
                Some(elsewhere.as_str())
            }
            World::Link => None,
        };
        let wanted = Wanted { mission: Some(mission), scenario, set: &set };
        let (own, others) = wanted.parted();
        let script = match changes.script {
            Some(path) => {
                crate::load_for(path, &wanted).map_err(|error| PlanError::Asked(error.message, error.help))?
            }
            None => load_kept(&header.scripts, data.clone(), &wanted.of_script(&own))?,
        };
        let script = is_sound(script)?;
        let file = script.sources.iter().next().map_or_else(String::new, |source| source.name.to_string());
        let program = || Ok::<_, PlanError>(Arc::new(chosen(&script, &file, Some(mission))?.1));
        let plan = match &header.world {
            World::Link => Plan::on_link(&script, &file, Some(mission), &header.scenario)?,
            // Another script need not have the world: it is fed with what was sensed in it.
            World::Scenario { called, scripts }
                if scripts.is_empty()
                    && changes.script.is_some()
                    && script.scenarios().all(|known| known != called) =>
            {
                Plan::without_world(&script, &file, Some(mission))?
            }
            World::Scenario { called, scripts } if scripts.is_empty() => Plan::with(&script, program()?, called)?,
            World::Scenario { called, scripts } => {
                let world = Wanted { mission: None, scenario: Some(called), set: &others };
                let other = is_sound(load_kept(scripts, data, &world.of_script(&others))?)?;
                Plan::in_world_of(&other, &script, program()?, called)?
            }
        };
        Ok((script, plan))
    }
}

/// What is set in the end, of what was set for a run and what is set in its place or beside it.
pub(crate) fn set_again(before: &[String], later: &[String], mission: &str) -> Vec<String> {
    let mut set: Vec<String> = before.iter().filter(|text| !is_fault(text)).cloned().collect();
    for text in later {
        set.retain(|earlier| set_name(earlier, mission) != set_name(text, mission));
        set.push(text.clone());
    }
    set
}

/// What is set, without a parameter.
pub(crate) fn unset(before: &[String], name: &str, mission: &str) -> Vec<String> {
    before.iter().filter(|text| set_name(text, mission) != set_name(name, mission)).cloned().collect()
}

/// The name of a parameter that is set; the mission's own are known by their names alone, too.
fn set_name<'t>(text: &'t str, mission: &str) -> &'t str {
    let name = text.split('=').next().unwrap_or_default().trim();
    let own = name.strip_prefix(mission).and_then(|rest| rest.strip_prefix('.'));
    own.unwrap_or(name)
}

/// Reads and checks the first of some scripts.
fn load_kept(scripts: &[KeptScript], data: Files, wanted: &albacore_lang::Wanted) -> Result<Script, PlanError> {
    let files = KeptFiles { scripts: scripts.to_vec(), data };
    Ok(albacore_lang::load_for(files.first()?, &files, wanted))
}

/// The script of a journal for a prompt, and where it finds what it imports.
pub(crate) fn lines(
    header: &JournalHeader,
    changes: &Changes,
) -> Result<(Arc<dyn Library>, albacore_lang::prompt::Prompt, Script), PlanError> {
    let data = Files::around(changes.beside.unwrap_or(Path::new("")));
    let files = KeptFiles { scripts: header.scripts.clone(), data };
    let set = set_again(&header.set, changes.set, &header.mission);
    let wanted = Wanted { mission: Some(&header.mission), scenario: None, set: &set };
    let (own, _) = wanted.parted();
    let (lines, script) = albacore_lang::prompt::Prompt::open(files.first()?, &files, &wanted.of_script(&own));
    Ok((Arc::new(files), lines, is_sound(script)?))
}

/// Whether a text that was changed for a run lets something fail.
fn is_fault(text: &str) -> bool {
    text.starts_with("--fault ")
}

fn is_sound(script: Script) -> Result<Script, PlanError> {
    if script.is_sound() { Ok(script) } else { Err(PlanError::script(script.findings.clone(), &script)) }
}
