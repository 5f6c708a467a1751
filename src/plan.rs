//! From the words of a command line to a mission that can run; what stands in the way is said here.

use crate::exit::Exit;
use crate::message;
use albacore_session::{Plan, PlanError, Script};
use std::path::Path;

/// Loads a script and plans a mission of it, or says what is wrong and how the program ends.
pub fn plan(
    path: &Path,
    mission: Option<&str>,
    scenario: Option<&str>,
    set: &[String],
) -> Result<(Script, Plan), Exit> {
    let script = match albacore_session::load(path, mission, set) {
        Ok(script) => script,
        Err(error) => {
            message::error(&error.message, error.help.as_deref());
            return Err(Exit::Usage);
        }
    };
    message::findings(&script.findings, &script.sources);
    if !script.is_sound() {
        return Err(Exit::Script);
    }
    match Plan::new(&script, &path.display().to_string(), mission, scenario) {
        Ok(plan) => Ok((script, plan)),
        Err(error) => Err(refused(&error, &script)),
    }
}

/// Says why a script cannot be run as asked.
pub fn refused(error: &PlanError, script: &Script) -> Exit {
    match error {
        PlanError::Script(findings) => {
            message::findings(findings, &script.sources);
            Exit::Script
        }
        PlanError::Asked(what, help) => {
            message::error(what, help.as_deref());
            Exit::Usage
        }
    }
}
