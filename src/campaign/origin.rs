//! What a table was made from, in a small file beside it: a campaign that is taken up again must be the same one.

use crate::plan::{ScriptDigest, scripts};
use crate::{disk, output};
use albacore_session::Plan;
use serde::{Deserialize, Serialize};
use std::ffi::OsString;
use std::io;
use std::path::{Path, PathBuf};

/// All that decides a row beside its seed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Origin {
    albacore: String,
    mission: String,
    scenario: String,
    set: Vec<String>,
    /// None in tables from before there were faults.
    #[serde(default)]
    fault: Vec<String>,
    sources: Vec<ScriptDigest>,
}

impl Origin {
    /// The origin of what a plan gives. `set` are the texts of the parameters that were changed, `fault`
    /// those of what was made to go wrong.
    pub fn new(plan: &Plan, set: &[String], fault: &[String]) -> Self {
        Origin {
            albacore: env!("CARGO_PKG_VERSION").to_string(),
            mission: plan.program.mission.name.clone(),
            scenario: plan.scenario_name.clone(),
            set: set.to_vec(),
            fault: fault.to_vec(),
            sources: scripts(plan),
        }
    }

    /// The origin of a table; `None` if nothing readable lies beside it.
    pub fn read(table: &Path) -> Option<Self> {
        serde_json::from_slice(&std::fs::read(beside(table, ".origin")).ok()?).ok()
    }

    /// Writes it beside a table, whole or not at all.
    pub fn write(&self, table: &Path) -> io::Result<()> {
        disk::whole(&beside(table, ".origin"), &output::json(self)?)
    }

    /// What of this is otherwise now, if anything is.
    pub fn difference(&self, now: &Origin) -> Option<String> {
        let changed = |what: &str, then: &str, now: &str| Some(format!("was begun with {what}`{then}`, not `{now}`"));
        if self.mission != now.mission {
            return changed("the mission ", &self.mission, &now.mission);
        }
        if self.scenario != now.scenario {
            return changed("the scenario ", &self.scenario, &now.scenario);
        }
        if self.set != now.set {
            return changed("", &options("--set", &self.set), &options("--set", &now.set));
        }
        if self.fault != now.fault {
            return changed("", &options("--fault", &self.fault), &options("--fault", &now.fault));
        }
        if self.albacore != now.albacore {
            return changed("albacore ", &self.albacore, &now.albacore);
        }
        // A script may be named from another folder today: its text is what counts.
        let otherwise = self.sources.iter().zip(&now.sources).find(|(then, now)| then.digest != now.digest);
        if let Some((_, now)) = otherwise {
            return Some(format!("was begun before `{}` was changed", now.name));
        }
        (self.sources.len() != now.sources.len()).then(|| "was begun with other imports".to_string())
    }
}

fn options(name: &str, texts: &[String]) -> String {
    let options: Vec<String> = texts.iter().map(|text| format!("{name} {text}")).collect();
    if options.is_empty() { format!("no {name}") } else { options.join(" ") }
}

/// `duck.csv` and `.origin` is `duck.csv.origin`.
pub fn beside(table: &Path, suffix: &str) -> PathBuf {
    let mut name = OsString::from(table);
    name.push(suffix);
    PathBuf::from(name)
}
