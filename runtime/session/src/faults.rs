//! Faults from the command line: clauses as in a scenario, read and checked as one.

use crate::files::{self, Files};
use crate::plan::PlanError;
use crate::scenario;
use albacore_lang::Script;
use albacore_lang::code::Code;
use albacore_lang::diagnostic::Diagnostic;
use albacore_lang::source::Source;
use albacore_sim::{Fault, Scenario};
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

/// What goes wrong in a run beside what its scenario says.
#[derive(Clone, Debug, Default)]
pub struct Faults(Vec<Fault>);

impl Faults {
    /// What the script of [`load_faults`] lets go wrong.
    pub fn of(script: &Script) -> Result<Self, PlanError> {
        let lowered = match script.scenario(SCENARIO, None) {
            Some(Ok(lowered)) => lowered,
            Some(Err(findings)) => return Err(PlanError::Script(findings)),
            None => return Ok(Faults::default()),
        };
        if let Some(other) = lowered.clauses.iter().find(|clause| clause.name != "fault") {
            let message = format!("`--fault` takes `fault(…)`, not `{}`", other.name);
            return Err(PlanError::Script(vec![Diagnostic::error(Code::ScenariosClause, other.span, message)]));
        }
        let understood = scenario::scenario(&lowered, &Files::of(script)).map_err(PlanError::Script)?;
        Ok(Faults(understood.world.faults))
    }

    /// Whether nothing goes wrong.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// A scenario with these faults added to its own, if they can be in it.
    pub(crate) fn in_scenario(&self, scenario: Arc<Scenario>) -> Result<Arc<Scenario>, PlanError> {
        if self.is_empty() {
            return Ok(scenario);
        }
        let mut scenario = Arc::unwrap_or_clone(scenario);
        scenario.faults.extend(&self.0);
        match scenario.validate() {
            Ok(()) => Ok(Arc::new(scenario)),
            Err(error) => {
                let help = Some(error.faults.join("; "));
                Err(PlanError::Asked("the faults of the command line cannot be".into(), help))
            }
        }
    }
}
