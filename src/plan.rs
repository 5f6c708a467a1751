//! From the words of a command line to a mission that can run; what stands in the way is said here.

use crate::exit::Exit;
use crate::message;
use albacore_session::{FileError, Plan, PlanError, Script};
use std::path::Path;

/// Loads a script, or says what is wrong and how the program ends.
pub fn script(path: &Path, mission: Option<&str>, set: &[String]) -> Result<Script, Exit> {
    sound(albacore_session::load(path, mission, set))
}

/// Loads a script, or a module of the standard library by its bare name.
pub fn script_or_module(path: &Path) -> Result<Script, Exit> {
    sound(albacore_session::load_or_module(path))
}

/// What was loaded, if it can be used; else what is wrong is said.
fn sound(loaded: Result<Script, FileError>) -> Result<Script, Exit> {
    let script = loaded.map_err(|error| {
        message::error(&error.message, error.help.as_deref());
        Exit::Usage
    })?;
    message::findings(&script.findings, &script.sources);
    if script.is_sound() { Ok(script) } else { Err(Exit::Script) }
}

/// Loads a script and plans a mission of it, or says what is wrong and how the program ends.
pub fn plan(
    path: &Path,
    mission: Option<&str>,
    scenario: Option<&str>,
    set: &[String],
) -> Result<(Script, Plan), Exit> {
    let script = script(path, mission, set)?;
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
