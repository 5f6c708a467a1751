//! `albacore check`: every error and warning of all files.

mod cost;

use crate::exit::Exit;
use crate::message;
use crate::plan::refused;
use albacore_session::{Diagnostic, Script, Wanted};
use std::path::{Path, PathBuf};

/// Check scripts: every error and warning of all files.
#[derive(clap::Args)]
pub struct Check {
    /// Scripts.
    #[arg(required = true, value_name = "SCRIPT.alb")]
    scripts: Vec<PathBuf>,
    /// Hold the missions against this scenario, by its name or as `FILE.alb#NAME`, as `run --in` does; else against the one that
    /// each names.
    #[arg(long = "in", value_name = "SCENARIO")]
    scenario: Option<String>,
    /// Change a parameter first: `lambda=6s`, `cpt_2005.beta=30deg`.
    #[arg(long = "set", value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// Print notes too, which are no mistakes: rules of one behavior that can hold in the same tick, an area that
    /// reaches beyond a recorded plume.
    #[arg(long)]
    notes: bool,
    /// Print what each mission costs: the most work of one tick and the memory, and where they come from.
    #[arg(long)]
    cost: bool,
}

impl Check {
    /// Checks each script; the worst of them decides.
    pub fn run(&self) -> Exit {
        let mut exit = Exit::Well;
        let mut wrong = Vec::new();
        for path in &self.scripts {
            match albacore_session::load_for(path, &self.wanted()) {
                Ok(script) => {
                    let mut findings = script.findings.clone();
                    let held = self.held(&script);
                    match &held {
                        Ok(found) => findings.extend(found.iter().cloned()),
                        Err(refused) => exit = *refused,
                    }
                    if self.notes {
                        findings.extend(script.notes());
                    } else {
                        findings.retain(|finding| finding.severity != albacore_session::Severity::Note);
                    }
                    albacore_session::settle(&mut findings);
                    message::findings(&findings, &script.sources);
                    if findings.is_empty() && !self.cost && held.is_ok() {
                        message::write(&message::line(&nothing_wrong(path, &script)));
                    }
                    if findings.iter().any(|f| f.severity == albacore_session::Severity::Error) {
                        exit = Exit::Script;
                        wrong.extend(findings);
                    }
                    // A mission that costs too much is an error, and the one whose bill is wanted.
                    if self.cost {
                        cost::print(&script);
                    }
                }
                Err(error) => {
                    message::error(&error.message, error.help.as_deref());
                    if exit == Exit::Well {
                        exit = Exit::Usage;
                    }
                }
            }
        }
        message::more(&wrong);
        exit
    }
}

impl Check {
    fn wanted(&self) -> Wanted<'_> {
        Wanted { mission: None, scenario: self.scenario.as_deref(), set: &self.set }
    }

    /// What is wrong beyond the script itself; a scenario that cannot be had is told of.
    fn held(&self, script: &Script) -> Result<Vec<Diagnostic>, Exit> {
        match &self.scenario {
            None => Ok(albacore_session::findings(script)),
            Some(_) => albacore_session::findings_in(script, &self.wanted()).map_err(|error| refused(&error)),
        }
    }
}

/// Of the missions of a script so many are named.
const NAMED_MAX: usize = 20;

/// What is said of a script in which nothing was found: on standard error, as all findings are.
fn nothing_wrong(path: &Path, script: &Script) -> String {
    let missions: Vec<String> = script.missions().map(|mission| format!("mission {}", mission.name)).collect();
    let held = match missions.get(..NAMED_MAX) {
        _ if missions.is_empty() => String::new(),
        Some(first) if missions.len() > first.len() => {
            format!(" ({} and {} more)", first.join(", "), missions.len() - first.len())
        }
        _ => format!(" ({})", missions.join(", ")),
    };
    format!("{}: no errors{held}", path.display())
}
