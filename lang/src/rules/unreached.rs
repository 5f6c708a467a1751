//! Values set from outside for what no mission calls: whoever set them believes that they count.

use crate::check::Override;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::Hir;
use crate::suggest;

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
