//! What a table was made from, in a small file beside it: a campaign that is taken up again must be the same one.

use crate::made::summed;
use crate::plan::{ScriptDigest, scripts, world_script};
use crate::{disk, output};
use albacore_session::{Digest, Plan, SOURCE_BYTES_MAX, read_file};
use serde::{Deserialize, Serialize};
use std::ffi::OsString;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// All that decides a row beside its seed, and the seed of the first.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Provenance {
    albacore: String,
    mission: String,
    scenario: String,
    /// The script that the scenario stands in: others may have one of that name.
    scenario_script: Option<ScriptDigest>,
    set: Vec<String>,
    fault: Vec<String>,
    sources: Vec<ScriptDigest>,
    /// The digest of the scenario's water, bottom and plume.
    world: String,
    /// The first seed; the rows of the others follow.
    first_seed: u64,
    /// The digest of all before it.
    sum: String,
}

impl Provenance {
    /// The origin of what a plan gives. `set` are the texts of the parameters that were changed, `fault`
    /// those of what was made to go wrong.
    pub fn new(plan: &Plan, set: &[String], fault: &[String], first_seed: u64) -> Self {
        Provenance {
            albacore: env!("CARGO_PKG_VERSION").to_string(),
            mission: plan.program.mission.name.clone(),
            scenario: plan.scenario_name.clone(),
            scenario_script: world_script(plan),
            set: set.to_vec(),
            fault: fault.to_vec(),
            sources: scripts(plan),
            world: format!("{:016x}", plan.world_digest()),
            first_seed,
            sum: String::new(),
        }
    }

    /// The origin of a table, as a file beside it holds it.
    pub fn of(bytes: &[u8]) -> Result<Self, Unread> {
        serde_json::from_slice(bytes).map_err(|error| Unread::Wrong(error.to_string()))
    }

    /// All of it that [`Provenance::difference`] compares, in short: no row of another campaign has a checksum that fits.
    pub fn key(&self) -> OriginKey {
        let digests = |scripts: &[ScriptDigest]| scripts.iter().map(|script| script.digest.clone()).collect::<Vec<_>>();
        let Provenance {
            albacore,
            mission,
            scenario,
            scenario_script,
            set,
            fault,
            sources,
            world: _,
            first_seed,
            sum: _,
        } = self;
        let (own, of_scenario) = (digests(sources), digests(scenario_script.as_slice()));
        let told = serde_json::json!([albacore, mission, scenario, first_seed, set, fault, own, of_scenario]);
        let mut key = Digest::new();
        key.bytes(told.to_string().as_bytes());
        OriginKey(key.to_string())
    }

    /// Writes it beside a table, whole or not at all.
    pub fn write(&self, table: &Path) -> io::Result<()> {
        disk::whole(&beside(table, ".origin"), &summed(&output::json(self)?))
    }

    /// The seed of the first row.
    pub fn first_seed(&self) -> u64 {
        self.first_seed
    }

    /// The mission, the scenario, and what was changed of them, in the words of a command: `duck_single in duck_2003 --set lambda=6s`.
    pub fn told(&self) -> String {
        let set = self.set.iter().map(|text| format!(" --set {text}"));
        let fault = self.fault.iter().map(|text| format!(" --fault {text}"));
        format!("{} in {}{}", self.mission, self.scenario, set.chain(fault).collect::<String>())
    }

    /// Why runs of one seed are not of one water, if they are not.
    pub fn other_world(&self, other: &Provenance) -> Option<String> {
        if self.world != other.world {
            return Some(match self.scenario == other.scenario {
                true => format!(
                    "the water, the bottom or the plume of `{}` is another in the one than in the other",
                    self.scenario
                ),
                false => format!(
                    "one is of the scenario `{}`, the other of `{}`, and their worlds differ",
                    self.scenario, other.scenario
                ),
            });
        }
        (self.albacore != other.albacore)
            .then(|| format!("one is of albacore {}, the other of {}", self.albacore, other.albacore))
    }

    /// Whether the scripts that it is of, or the files that these read, are others.
    pub fn scripts_differ(&self, other: &Provenance) -> bool {
        let digests = |of: &Provenance| of.sources.iter().map(|source| source.digest.clone()).collect::<Vec<_>>();
        digests(self) != digests(other)
    }

    /// What of this is otherwise now, if anything is.
    pub fn difference(&self, now: &Provenance) -> Option<String> {
        let first = (self.first_seed != now.first_seed)
            .then(|| format!("was begun with the first seed `{}`, not `{}`", self.first_seed, now.first_seed));
        self.other_campaign(now).or(first)
    }

    /// The same whatever the seeds are.
    pub fn other_campaign(&self, now: &Provenance) -> Option<String> {
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
        if let (Some(then), Some(now)) = (&self.scenario_script, &now.scenario_script)
            && then.digest != now.digest
        {
            return changed(&format!("the scenario `{}` of ", self.scenario), &then.name, &now.name);
        }
        (self.sources.len() != now.sources.len()).then(|| "was begun with other imports".to_string())
    }
}

/// What a table's checksums are made with, beside its lines.
#[derive(Clone, Debug)]
pub struct OriginKey(String);

impl OriginKey {
    #[cfg(test)]
    pub fn of(text: &str) -> Self {
        OriginKey(text.to_string())
    }

    /// Its bytes.
    pub fn bytes(&self) -> &[u8] {
        self.0.as_bytes()
    }
}

fn options(name: &str, texts: &[String]) -> String {
    let options: Vec<String> = texts.iter().map(|text| format!("{name} {text}")).collect();
    if options.is_empty() { format!("no {name}") } else { options.join(" ") }
}

/// The bytes of the file that tells a table's origin.
pub fn read(table: &Path) -> Result<Vec<u8>, Unread> {
    read_beside(table, ".origin", SOURCE_BYTES_MAX as u64)
}

/// Why a file beside a table tells nothing.
#[derive(Debug)]
pub enum Unread {
    /// There is none.
    Missing,
    /// What is wrong with it.
    Wrong(String),
}

/// The bytes of a file beside a table, so many at most.
pub fn read_beside(table: &Path, suffix: &str, bytes_max: u64) -> Result<Vec<u8>, Unread> {
    read_file(&beside(table, suffix), bytes_max).map_err(|unread| match unread {
        albacore_session::Unread::System(error) if error.kind() == ErrorKind::NotFound => Unread::Missing,
        unread => Unread::Wrong(unread.to_string()),
    })
}

/// `duck.csv` and `.origin` is `duck.csv.origin`.
pub fn beside(table: &Path, suffix: &str) -> PathBuf {
    let mut name = OsString::from(table);
    name.push(suffix);
    PathBuf::from(name)
}
