//! What a test asks of a mission's reports: a name that nothing reports is misspelt, and what is expected of it means nothing.

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{Hir, Test};
use albacore_wording::nearest;
use std::collections::BTreeMap;

/// The names that a test asks for and its mission never reports.
pub fn check(hir: &Hir, test: &Test) -> Vec<Diagnostic> {
    let mut names: Vec<&str> = Vec::new();
    hir.each_report(test.mission, &mut |name, _| names.push(name));
    let mission = &hir.activities[test.mission].full_name;
    let mut asked: BTreeMap<&str, usize> = BTreeMap::new();
    for (_, name, var) in test.known.reports.iter().filter(|(_, name, _)| !names.contains(&name.as_str())) {
        asked.entry(name).or_insert(*var);
    }
    let unknown = |(name, var): (&str, usize)| {
        let what = format!("nothing in `{mission}` reports \"{name}\"");
        let finding = Diagnostic::error(Code::TestsReport, test.vars[var].span, what);
        match nearest(name, names.iter().copied()) {
            Some(near) => finding.help(format!("did you mean \"{near}\"?")),
            None if names.is_empty() => finding.help("it reports nothing, nor does what it calls"),
            None => finding.help(format!("it reports {}", listed(&names))),
        }
    };
    asked.into_iter().map(unknown).collect()
}

/// Names in quotes, each once.
fn listed(names: &[&str]) -> String {
    let mut quoted: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
    quoted.sort();
    quoted.dedup();
    quoted.join(", ")
}
