//! Values set from outside for what no mission calls: whoever set them believes that they count.

use crate::check::Override;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{Expr, Hir};
use crate::suggest;
use std::collections::BTreeSet;

/// Finds the overrides of behaviors, strategies and overlays to which none of the missions that are meant leads.
pub fn check(hir: &Hir, missions: &[usize], overrides: &[Override]) -> Vec<Diagnostic> {
    let called: Vec<_> = missions.iter().map(|&id| hir.called_from(id)).collect();
    let mut findings = Vec::new();
    for set in overrides {
        // What is no activity is a scenario, which another option chooses.
        let Some(id) = set.found.as_ref().and_then(|n| hir.activities.iter().position(|a| a.full_name == *n)) else {
            continue;
        };
        if called.is_empty() || called.iter().any(|ids| ids.contains(&id)) {
            findings.extend(given(hir, id, set, called.iter().flatten().copied().collect()));
            continue;
        }
        let names: Vec<&str> = missions.iter().map(|&id| hir.activities[id].name.as_str()).collect();
        let (declaration, missions) = (set.declarations.first().map_or("", String::as_str), suggest::listed(&names));
        findings.push(
            Diagnostic::error(
                Code::SetUnreached,
                set.value.span,
                format!("`{declaration}.{}` is set, and {missions} never calls `{declaration}`", set.param),
            )
            .help("set a parameter of what the mission calls, or leave it out: it would change nothing"),
        );
    }
    findings
}

/// The finding for a default that is set and that no call takes: each gives the argument itself.
fn given(hir: &Hir, id: usize, set: &Override, callers: BTreeSet<usize>) -> Option<Diagnostic> {
    let param = hir.activities[id].vars.iter().position(|var| var.name == set.param)?;
    let calls: Vec<&[Expr]> = callers.iter().flat_map(|&caller| hir.activities[caller].calls_of(id)).collect();
    // A default that is taken keeps the place where it was set.
    let given = calls.iter().map(|args| args.get(param)).collect::<Option<Vec<_>>>()?;
    let first = given.first()?;
    if given.iter().any(|arg| arg.span.file == set.value.span.file) {
        return None;
    }
    let name = &hir.activities[id].name;
    let message = format!("`{name}.{}` is set and changes nothing: each call of `{name}` gives it", set.param);
    Some(
        Diagnostic::warning(Code::SetGiven, set.value.span, message).label(first.span, "given here").help(
            "set what this is made of, such as a parameter of the mission, or leave the argument out of the call",
        ),
    )
}
