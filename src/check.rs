//! `albacore check`: every error and warning of all files.

mod cost;

use crate::exit::Exit;
use crate::message;
use albacore_session::Script;
use std::path::{Path, PathBuf};

/// Check scripts: every error and warning of all files.
#[derive(clap::Args)]
pub struct Check {
    /// Scripts.
    #[arg(required = true, value_name = "SCRIPT.alb")]
    scripts: Vec<PathBuf>,
    /// Change a parameter first: `lambda=6s`, `cpt_2005.beta=30deg`.
    #[arg(long = "set", value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// Tell also what is worth knowing and nothing wrong: rules of one behavior that can hold in the same tick, an area that
    /// reaches beyond a recorded plume.
    #[arg(long)]
    notes: bool,
    /// Tell what each mission costs: the most work of one tick and the memory, and where they come from.
    #[arg(long)]
    cost: bool,
}

impl Check {
    /// Checks each script; the worst of them decides.
    pub fn run(&self) -> Exit {
        let mut exit = Exit::Well;
        let mut wrong = Vec::new();
        for path in &self.scripts {
            match albacore_session::load(path, None, &self.set) {
                Ok(script) => {
                    let mut findings = script.findings.clone();
                    findings.extend(albacore_session::findings(&script));
                    if self.notes {
                        findings.extend(script.notes());
                    } else {
                        findings.retain(|finding| finding.severity != albacore_session::Severity::Note);
                    }
                    albacore_session::settle(&mut findings);
                    message::findings(&findings, &script.sources);
                    if findings.is_empty() && !self.cost {
                        message::write(&format!("{}\n", nothing_wrong(path, &script)));
                    }
                    if findings.iter().any(|f| f.severity == albacore_session::Severity::Error) {
                        exit = Exit::Script;
                        wrong.extend(findings);
                    }
                    // A mission that costs too much is an error, and the one whose bill is wanted.
                    if self.cost {
                        cost::tell(&script);
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

/// What is said of a script in which nothing was found: on standard error, as all findings are.
fn nothing_wrong(path: &Path, script: &Script) -> String {
    let missions: Vec<String> = script.missions().map(|mission| format!("mission {}", mission.name)).collect();
    let held = if missions.is_empty() { String::new() } else { format!(" ({})", missions.join(", ")) };
    format!("{}: no errors{held}", path.display())
}
