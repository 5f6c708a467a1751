//! Faults from the command line: clauses as in a scenario, read and checked as one.

use crate::files;
use crate::plan::{Plan, PlanError};
use crate::world;
use albacore_lang::Script;
use albacore_lang::code::Code;
use albacore_lang::diagnostic::Diagnostic;
use albacore_lang::source::Source;
use albacore_sim::Fault;
use std::sync::Arc;

/// The scenario that the clauses of a command line make.
const SCENARIO: &str = "command_line";

/// The script that the texts of `--fault` make: its findings tell what is wrong with them. A text is a clause,
/// `fault(position, off, from: 120 s, to: 180 s)`, or what stands between its parentheses.
pub fn load_faults(texts: &[String]) -> Script {
    let clause = |text: &String| {
        let text = text.trim();
        if text.starts_with("fault(") { format!("    {text}\n") } else { format!("    fault({text})\n") }
    };
    let clauses: String = texts.iter().map(clause).collect();
    let text = format!("scenario {SCENARIO} {{\n{clauses}}}\n");
    files::load_text(Source { name: "--fault".into(), text: text.into() })
}

/// What the script of [`load_faults`] lets go wrong.
pub(crate) fn faults(script: &Script) -> Result<Vec<Fault>, PlanError> {
    let lowered = match script.scenario(SCENARIO, None) {
        Some(Ok(lowered)) => lowered,
        Some(Err(findings)) => return Err(PlanError::script(findings, script)),
        None => return Ok(Vec::new()),
    };
    if let Some(other) = lowered.clauses.iter().find(|clause| clause.name != "fault") {
        let message = format!("`--fault` takes `fault(…)`, not `{}`", other.name);
        let finding = Diagnostic::error(Code::ScenariosClause, other.span, message);
        let finding = finding.help("say it in the scenario");
        return Err(PlanError::script(vec![finding], script));
    }
    Ok(world::sound(&lowered, script)?.world.faults)
}

impl Plan {
    /// The same with the faults of a script of [`load_faults`] added to those of the scenario.
    pub fn with_faults(self, script: &Script) -> Result<Plan, PlanError> {
        let faults = faults(script)?;
        if faults.is_empty() {
            return Ok(self);
        }
        let mut scenario = (*self.scenario).clone();
        scenario.faults.extend(faults);
        Ok(Plan { scenario: Arc::new(scenario), ..self })
    }
}
