//! `run.json`: what a run was of, when it was by the wall clock, and what became of it. The journal of the same run again has
//! the same bytes; all that differs from run to run is here.

use crate::clock::Utc;
use crate::made::{is_as_summed, summed};
use crate::output;
use crate::plan::{ScriptDigest, scripts, world_script};
use albacore_session::{Digest, Outcome, Plan, SOURCE_BYTES_MAX, Summary, read_file};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Display;
use std::path::Path;

/// The record of a run. It is written when the run begins and when it has ended: one that has no end was killed, or goes on.
#[derive(Serialize)]
pub struct Record {
    albacore: &'static str,
    mission: String,
    scenario: String,
    /// The script that the scenario stands in.
    scenario_script: Option<ScriptDigest>,
    seed: u64,
    /// The vehicle's, if one was driven; there is no scenario then.
    link: Option<String>,
    /// How many times faster than real time, if that was said.
    rate: Option<f64>,
    set: Vec<String>,
    fault: Vec<String>,
    scripts: Vec<ScriptDigest>,
    /// Coordinated Universal Time.
    started: Utc,
    /// When the mission's clock was at 0: on a link, when the vehicle was first heard.
    first_tick: Option<Utc>,
    ended: Option<Utc>,
    outcome: &'static str,
    reason: String,
    ticks: Option<u64>,
    digest: Option<String>,
    /// The digests of the files beside it: by them alone they are known to be of this run.
    files: BTreeMap<&'static str, String>,
    /// The files that are not whole, or not there, and why.
    lost: BTreeMap<&'static str, String>,
    /// The digest of all before it.
    sum: &'static str,
}

/// Whether a file is the record of a run, as that has left it.
pub fn is_record(path: &Path) -> bool {
    let Ok(bytes) = read_file(path, SOURCE_BYTES_MAX as u64) else { return false };
    // One that has just been created is empty.
    let blanks = bytes.iter().rev().take_while(|b| **b == b' ').count();
    bytes.is_empty() || is_as_summed(&bytes[..bytes.len() - blanks])
}

/// What the record at a path tells, whoever wrote it; null where there is none.
pub fn told(record: &Path) -> serde_json::Value {
    let text = read_file(record, SOURCE_BYTES_MAX as u64).ok();
    let told = text.and_then(|text| serde_json::from_slice::<serde_json::Value>(&text).ok());
    told.filter(serde_json::Value::is_object).unwrap_or_default()
}

/// The digests of a run's files, as its record tells them.
pub struct ToldDigests(serde_json::Value);

impl ToldDigests {
    /// Those of the record at a path. None where it tells none.
    pub fn read(record: &Path) -> Self {
        ToldDigests(told(record)["files"].take())
    }

    /// Whether a file with these bytes is the run's. One that has just been created is empty.
    pub fn is_of_the_run(&self, name: &str, bytes: &[u8]) -> bool {
        bytes.is_empty() || self.0[name] == digest(bytes)
    }

    /// Whether they tell that of a file.
    pub fn tells(&self, name: &str) -> bool {
        self.0[name].is_string()
    }
}

fn digest(bytes: &[u8]) -> String {
    let mut digest = Digest::new();
    digest.bytes(bytes);
    digest.to_string()
}

/// What the command line asked for.
pub struct RunRequest<'a> {
    /// The seed of all that is random.
    pub seed: u64,
    /// The link to a vehicle.
    pub link: Option<&'a str>,
    /// Times real time.
    pub rate: Option<f64>,
    /// The parameters that were changed.
    pub set: &'a [String],
    /// What was made to go wrong.
    pub fault: &'a [String],
}

impl Record {
    /// The record of a run that begins.
    pub fn new(plan: &Plan, asked: &RunRequest, started: Utc) -> Self {
        Record {
            albacore: env!("CARGO_PKG_VERSION"),
            mission: plan.program.mission.name.clone(),
            scenario: plan.scenario_name.clone(),
            scenario_script: world_script(plan),
            seed: asked.seed,
            link: asked.link.map(str::to_string),
            rate: asked.rate,
            set: asked.set.to_vec(),
            fault: asked.fault.to_vec(),
            scripts: scripts(plan),
            started,
            first_tick: None,
            ended: None,
            outcome: "running",
            reason: String::new(),
            ticks: None,
            digest: None,
            files: BTreeMap::new(),
            lost: BTreeMap::new(),
            sum: "",
        }
    }

    /// The mission's clock runs.
    pub fn ticks(&mut self) {
        self.first_tick.get_or_insert_with(Utc::now);
    }

    /// As JSON of so many bytes at most: of a reason that is too long only the beginning is kept. The trace has all of it.
    pub fn json(&mut self, room: usize) -> serde_json::Result<String> {
        loop {
            let text = summed(&output::json(self)?);
            let (kept, length) = (self.reason.chars().count() / 2, text.len());
            if length <= room || kept == 0 {
                return Ok(text);
            }
            self.reason = self.reason.chars().take(kept).chain(['…']).collect();
        }
    }

    /// The run has ended.
    pub fn ends(&mut self, summary: &Summary) {
        self.ended = Some(Utc::now());
        self.outcome = summary.outcome;
        self.reason.clone_from(&summary.reason);
        self.ticks = Some(summary.ticks);
        self.digest = Some(summary.digest.clone());
    }

    /// A file holds these bytes.
    pub fn holds(&mut self, name: &'static str, bytes: &[u8]) {
        self.files.insert(name, digest(bytes));
    }

    /// The run could not be begun.
    pub fn fails(&mut self, why: &str) {
        self.ended = Some(Utc::now());
        self.outcome = Outcome::Failed.name();
        self.reason = why.to_string();
    }

    /// A file is not whole, or not there.
    pub fn loses(&mut self, name: &'static str, why: impl Display) {
        self.files.remove(name);
        self.lost.insert(name, why.to_string());
    }

    /// The same, for one more reason than what is known already.
    pub fn also_loses(&mut self, name: &'static str, why: &str) {
        let before = self.lost.get(name).map(|before| format!("{before}; ")).unwrap_or_default();
        self.loses(name, before + why);
    }

    /// Whether a file is known not to be whole, and why.
    pub fn has_lost_by(&self, name: &str, why: &str) -> bool {
        self.lost.get(name).is_some_and(|known| known == why)
    }

    /// It is, after all.
    pub fn has(&mut self, name: &str) {
        self.lost.remove(name);
    }

    /// How the run ended, as a person reads it.
    pub fn end(&self) -> String {
        let outcome = self.outcome.replace('_', " ");
        if self.reason.is_empty() || self.reason == outcome { outcome } else { format!("{outcome} ({})", self.reason) }
    }
}

#[cfg(test)]
mod tests {
    use super::{BTreeMap, Record};
    use crate::clock::Utc;

    /// A record that is larger than its room would not fit on a full disk.
    #[test]
    fn a_record_fits_into_its_room() {
        let mut record = Record {
            albacore: "",
            mission: String::new(),
            scenario: String::new(),
            scenario_script: None,
            seed: 1,
            link: None,
            rate: None,
            set: Vec::new(),
            fault: Vec::new(),
            scripts: Vec::new(),
            started: Utc::now(),
            first_tick: None,
            ended: None,
            outcome: "aborted",
            reason: "\u{202e}why".repeat(10_000),
            ticks: None,
            digest: None,
            files: BTreeMap::new(),
            lost: BTreeMap::new(),
            sum: "",
        };
        let text = record.json(4096).unwrap();
        assert!(text.len() <= 4096 && text.contains("\\u202ewhy") && text.contains('…'), "{text}");
    }
}
