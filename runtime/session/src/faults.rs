//! Faults from the command line: clauses as in a scenario, read and checked as one.

use crate::files::{self, Files};
use crate::plan::PlanError;
use crate::scenario;
use albacore_lang::code::Code;
use albacore_lang::diagnostic::Diagnostic;
use albacore_lang::source::{Source, Sources};
use albacore_lang::{ScenarioProgram, Script};
use albacore_sim::{Fault, Scenario, ScenarioIssue};
use std::sync::Arc;

/// The scenario that the clauses of a command line make.
const SCENARIO: &str = "command_line";

/// The script that the texts of `--fault` make: its findings tell what is wrong with them. A text is a clause,
/// `fault(position, off, from: 120 s, to: 180 s)`, or what stands between its parentheses.
pub fn load_faults(texts: &[String]) -> Script {
    let clauses: String = texts.iter().map(|text| format!("    {}\n", as_clause("fault", text))).collect();
    let text = format!("scenario {SCENARIO} {{\n{clauses}}}\n");
    files::load_text(Source { name: "--fault".into(), text: text.into() })
}

/// A clause of the command line, written whole or as what stands between its parentheses.
pub(crate) fn as_clause(name: &str, text: &str) -> String {
    let text = text.trim();
    let is_whole = text.strip_prefix(name).is_some_and(|rest| rest.trim_start().starts_with('('));
    // A comment ends where the line does.
    let rest = if text.contains("//") { "\n    " } else { "" };
    if is_whole { text.to_string() } else { format!("{name}({text}{rest})") }
}

/// What goes wrong in a run beside what its scenario says.
#[derive(Clone, Debug, Default)]
pub struct Faults {
    faults: Vec<Fault>,
    /// The clauses that say so, and the sources that they stand in.
    said: Option<(ScenarioProgram, Sources)>,
}

impl Faults {
    /// What the script of [`load_faults`] lets go wrong.
    pub fn of(script: &Script) -> Result<Self, PlanError> {
        let wrong = |findings| PlanError::script(findings, script);
        let lowered = match script.scenario(SCENARIO, None) {
            Some(lowered) => lowered.map_err(wrong)?,
            None => return Ok(Faults::default()),
        };
        if let Some(other) = lowered.clauses.iter().find(|clause| clause.name != "fault") {
            let message = format!("`--fault` takes `fault(…)`, not `{}`", other.name);
            let finding = Diagnostic::error(Code::ScenariosClause, other.span, message);
            return Err(wrong(vec![finding.help("say it in the scenario")]));
        }
        let faults = scenario::scenario(&lowered, &Files::of(script)).map_err(wrong)?.world.faults;
        Ok(Faults { faults, said: Some((lowered, script.sources.clone())) })
    }

    /// Whether nothing goes wrong.
    pub fn is_empty(&self) -> bool {
        self.faults.is_empty()
    }

    /// Whether any of them begins in a run that lasts so long, s.
    pub(crate) fn begin_within(&self, lasting: f64) -> bool {
        self.faults.iter().any(|fault| fault.begins_within(lasting))
    }

    /// A scenario with these faults added to its own, if they can be in it.
    pub(crate) fn in_scenario(&self, scenario: Arc<Scenario>) -> Result<Arc<Scenario>, PlanError> {
        let Some((said, sources)) = self.said.as_ref().filter(|_| !self.is_empty()) else { return Ok(scenario) };
        let mut scenario = Arc::unwrap_or_clone(scenario);
        let own = scenario.faults.len();
        scenario.faults.extend(&self.faults);
        let objections = scenario.validate().err().map_or_else(Vec::new, |error| error.faults);
        if objections.is_empty() {
            return Ok(Arc::new(scenario));
        }
        // The scenario's own can be, or it would not have come so far.
        let ours = objections
            .into_iter()
            .map(|objection| ScenarioIssue { nth: objection.nth.saturating_sub(own), ..objection });
        Err(PlanError::Script(ours.map(|objection| scenario::objected(said, &objection)).collect(), sources.clone()))
    }
}
