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
    fault: Vec<String>,
    /// The scripts of all cases, and what they read.
    sources: Vec<ScriptDigest>,
    cases: Vec<CaseOrigin>,
    /// The first seed; the rows of the others follow.
    first_seed: u64,
    /// The digest of all before it.
    sum: String,
}

/// What a case was made from: a campaign without a sweep has one.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct CaseOrigin {
    mission: String,
    scenario: String,
    /// The script that the scenario stands in: others may have one of that name.
    scenario_script: Option<ScriptDigest>,
    /// The parameters that were changed.
    set: Vec<String>,
    /// The digest of the scripts, and of what they read.
    scripts: String,
    /// The digest of the scenario's water, bottom and plume.
    world: String,
}

impl CaseOrigin {
    /// That of what a plan gives. `set` are the texts of the parameters that were changed.
    pub fn new(plan: &Plan, set: &[String]) -> Self {
        let mut digest = Digest::new();
        scripts(plan).iter().for_each(|script| digest.text(&script.digest));
        CaseOrigin {
            mission: plan.program.mission.name.clone(),
            scenario: plan.scenario_name.clone(),
            scenario_script: world_script(plan),
            set: set.to_vec(),
            scripts: digest.to_string(),
            world: format!("{:016x}", plan.world_digest()),
        }
    }

    /// The mission and the scenario: `duck_single in duck_2003`.
    pub fn mission_and_scenario(&self) -> String {
        format!("{} in {}", self.mission, self.scenario)
    }

    /// The parameters that were changed, with their values.
    pub fn set(&self) -> &[String] {
        &self.set
    }

    /// The mission, the scenario, and what was changed of them, in the words of a command: `duck_single in duck_2003 --set lambda=6s`.
    pub fn told(&self) -> String {
        let set = self.set.iter().map(|text| format!(" --set {text}"));
        self.mission_and_scenario() + &set.collect::<String>()
    }

    /// Why runs of one seed are not of one water, if they are not.
    pub fn other_world(&self, other: &CaseOrigin) -> Option<String> {
        (self.world != other.world).then(|| match self.scenario == other.scenario {
            true => {
                format!(
                    "the water, the bottom or the plume of `{}` is another in the one than in the other",
                    self.scenario
                )
            }
            false => format!(
                "one is of the scenario `{}`, the other of `{}`, and their worlds differ",
                self.scenario, other.scenario
            ),
        })
    }

    /// Whether the scripts that it is of, or the files that these read, are others.
    pub fn scripts_differ(&self, other: &CaseOrigin) -> bool {
        self.scripts != other.scripts
    }

    /// What of this is otherwise now, if anything is but a script.
    fn difference(&self, now: &CaseOrigin) -> Option<String> {
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
        None
    }

    /// Whether its scenario stands in a script that was changed, or in another.
    fn other_scenario_script(&self, now: &CaseOrigin) -> Option<String> {
        let (then, now) = (self.scenario_script.as_ref()?, now.scenario_script.as_ref()?);
        (then.digest != now.digest)
            .then(|| format!("was begun with the scenario `{}` of `{}`, not `{}`", self.scenario, then.name, now.name))
    }
}

impl Provenance {
    /// The origin of a table with these cases. `fault` are the texts of what was made to go wrong.
    pub fn new<'a>(
        cases: Vec<CaseOrigin>,
        plans: impl Iterator<Item = &'a Plan>,
        fault: &[String],
        first_seed: u64,
    ) -> Self {
        let mut sources: Vec<ScriptDigest> = Vec::new();
        for source in plans.flat_map(scripts) {
            if !sources.contains(&source) {
                sources.push(source);
            }
        }
        let (albacore, fault) = (env!("CARGO_PKG_VERSION").to_string(), fault.to_vec());
        Provenance { albacore, fault, sources, cases, first_seed, sum: String::new() }
    }

    /// The origin of a table, as a file beside it holds it.
    pub fn of(bytes: &[u8]) -> Result<Self, Unread> {
        serde_json::from_slice(bytes).map_err(|error| Unread::Wrong(error.to_string()))
    }

    /// All of it that [`Provenance::difference`] compares, in short: no row of another campaign has a checksum that fits.
    pub fn key(&self) -> OriginKey {
        let digests = |scripts: &[ScriptDigest]| scripts.iter().map(|script| script.digest.clone()).collect::<Vec<_>>();
        let Provenance { albacore, fault, sources, cases, first_seed, sum: _ } = self;
        let case = |case: &CaseOrigin| {
            let CaseOrigin { mission, scenario, scenario_script, set, scripts, world: _ } = case;
            serde_json::json!([mission, scenario, set, scripts, digests(scenario_script.as_slice())])
        };
        let cases: Vec<_> = cases.iter().map(case).collect();
        let told = serde_json::json!([albacore, first_seed, fault, digests(sources), cases]);
        let mut key = Digest::new();
        key.bytes(told.to_string().as_bytes());
        OriginKey(key.to_string())
    }

    /// An error if it would be larger than what is read again: message and help.
    pub fn is_small_enough(&self) -> Result<(), (String, String)> {
        let bytes = output::json(self).map_or(0, |text| text.len());
        match bytes < SOURCE_BYTES_MAX / 2 {
            true => Ok(()),
            false => {
                let message = format!(
                    "what the cases are made from takes {bytes} bytes, of which {} are read",
                    SOURCE_BYTES_MAX / 2
                );
                Err((message, "run fewer cases at once, or put long values into the script".to_string()))
            }
        }
    }

    /// Writes it beside a table, whole or not at all.
    pub fn write(&self, table: &Path) -> io::Result<()> {
        disk::whole(&beside(table, ".origin"), &summed(&output::json(self)?))
    }

    /// The seed of the first row.
    pub fn first_seed(&self) -> u64 {
        self.first_seed
    }

    /// What the cases were made from, in the order of their numbers.
    pub fn cases(&self) -> &[CaseOrigin] {
        &self.cases
    }

    /// What was made to go wrong, in the words of a command: ` --fault …`.
    pub fn faults(&self) -> String {
        self.fault.iter().map(|text| format!(" --fault {text}")).collect()
    }

    /// Why no runs of these two can be compared, if so.
    pub fn other_version(&self, other: &Provenance) -> Option<String> {
        (self.albacore != other.albacore)
            .then(|| format!("one is of albacore {}, the other of {}", self.albacore, other.albacore))
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
        let count = |cases: &[CaseOrigin]| {
            if cases.len() == 1 { "1 case".to_string() } else { format!("{} cases", cases.len()) }
        };
        if self.cases.len() != now.cases.len() {
            return Some(format!("was begun with {}, not {}", count(&self.cases), count(&now.cases)));
        }
        let in_case = |number: usize, what: String| {
            if self.cases.len() == 1 { what } else { format!("{what}, in case {number}") }
        };
        let mut cases = (1..).zip(self.cases.iter().zip(&now.cases));
        let case = cases.clone().find_map(|(number, (then, now))| Some(in_case(number, then.difference(now)?)));
        if case.is_some() {
            return case;
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
        let scenario =
            cases.clone().find_map(|(number, (then, now))| Some(in_case(number, then.other_scenario_script(now)?)));
        if scenario.is_some() {
            return scenario;
        }
        let are_others = cases.any(|(_, (then, now))| then.scripts_differ(now));
        (are_others || self.sources.len() != now.sources.len()).then(|| "was begun with other imports".to_string())
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
