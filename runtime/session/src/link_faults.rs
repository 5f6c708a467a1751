//! What goes wrong on a link, from the command line: clauses of the module `links`, read and checked as those of a scenario.

use crate::faults::as_clause;
use crate::files;
use crate::plan::PlanError;
use crate::scenario::{Clause, words};
use albacore_lang::Script;
use albacore_lang::code::Code;
use albacore_lang::diagnostic::Diagnostic;
use albacore_lang::source::Source;
use albacore_link::LinkFault;

/// The scenario that the clauses make.
const SCENARIO: &str = "command_line";
/// The clause, and the module that declares it.
const CLAUSE: &str = "link_fault";
const MODULE: &str = "links";

/// The script that the texts of `--link-faults` make: its findings tell what is wrong with them. A text is a clause,
/// `link_fault(loss: 5 %, delay: 200 ms)`, or what stands between its parentheses.
pub fn load_link_faults(texts: &[String]) -> Script {
    let clauses: String = texts.iter().map(|text| format!("    {MODULE}.{}\n", as_clause(CLAUSE, text))).collect();
    let unused = if texts.is_empty() { String::new() } else { format!("use {MODULE}\n") };
    let text = format!("{unused}scenario {SCENARIO} {{\n{clauses}}}\n");
    files::load_text(Source { name: "--link-faults".into(), text: text.into() })
}

/// What the script of [`load_link_faults`] lets go wrong.
pub fn link_faults(script: &Script) -> Result<Vec<LinkFault>, PlanError> {
    let wrong = |findings| PlanError::script(findings, script);
    let Some(lowered) = script.scenario(SCENARIO, None) else { return Ok(Vec::new()) };
    let lowered = lowered.map_err(wrong)?;
    let words = words(&lowered);
    let read = |clause| {
        let c = Clause { clause, words: &words };
        if clause.name != CLAUSE {
            let message = format!("`--link-faults` takes what a link suffers from, not `{}`", clause.name);
            let finding = Diagnostic::error(Code::ScenariosClause, clause.span, message);
            return Err(vec![finding.help("write `loss: 5 %, delay: 200 ms`, for example")]);
        }
        let fault: LinkFault = c.read().map_err(|unread| unread.of(clause).collect::<Vec<_>>())?;
        if fault == (LinkFault { from: fault.from, to: fault.to, ..LinkFault::default() }) {
            let finding = Diagnostic::error(Code::ScenariosWorld, clause.span, "nothing goes wrong here");
            return Err(vec![finding.help("write what does: `loss: 5 %, delay: 200 ms`, for example")]);
        }
        if fault.to.is_some_and(|to| to <= fault.from) {
            let finding = Diagnostic::error(Code::ScenariosWorld, clause.span, "this is over before it begins");
            return Err(vec![finding.help("make `to` later than `from`, or leave it out for a fault that lasts")]);
        }
        Ok(fault)
    };
    lowered.clauses.iter().map(read).collect::<Result<_, _>>().map_err(wrong)
}
