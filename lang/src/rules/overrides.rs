//! Values set from outside for what no mission calls: whoever set them believes that they count.

use crate::check::Override;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{Activity, ClauseArg, ClauseUse, Expr, ExprKind, Hir, Scenario};
use albacore_wording::listed;
use std::collections::BTreeSet;

/// The scenario in which a script is run.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum RunIn {
    /// One that it knows.
    One(usize),
    /// One of another script.
    Elsewhere,
}

/// Finds the overrides of behaviors, strategies and overlays to which none of the missions that are meant leads, and those of scenarios
/// in which nothing is run, as far as that is known.
pub fn check(hir: &Hir, missions: &[usize], run_in: Option<RunIn>, overrides: &[Override]) -> Vec<Diagnostic> {
    let called: Vec<_> = missions.iter().map(|&id| hir.called_from(id)).collect();
    let mut findings = Vec::new();
    for set in overrides {
        let Some(name) = &set.found else { continue };
        // A behavior of a table may have the name of a scenario, and has no parameters.
        let has_it = |a: &Activity| a.full_name == *name && a.vars[..a.params].iter().any(|var| var.name == set.param);
        let Some(id) = hir.activities.iter().position(has_it) else {
            findings.extend(run_in.and_then(|run_in| elsewhere(hir, name, run_in, set)));
            continue;
        };
        if called.is_empty() || called.iter().any(|ids| ids.contains(&id)) {
            findings.extend(given(hir, id, set, called.iter().flatten().copied().collect()));
            continue;
        }
        let names: Vec<&str> = missions.iter().map(|&id| hir.activities[id].name.as_str()).collect();
        let (declaration, missions) = (set.declarations.first().map_or("", String::as_str), listed(&names));
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

/// The finding for a parameter of a scenario in which nothing is run.
fn elsewhere(hir: &Hir, name: &str, run_in: RunIn, set: &Override) -> Option<Diagnostic> {
    let id = hir.scenarios.iter().position(|scenario| scenario.full_name == name)?;
    let run_in = match run_in {
        RunIn::One(other) if other == id => return unread(&hir.scenarios[id], set),
        RunIn::One(other) => format!("`{}`", hir.scenarios[other].path),
        RunIn::Elsewhere => "a scenario of another file".to_string(),
    };
    let path = &hir.scenarios[id].path;
    let message = format!("`{path}.{}` is set, and what runs is {run_in}", set.param);
    let help = format!("choose that scenario with `--in {path}`, or leave this out: it would change nothing");
    Some(Diagnostic::error(Code::SetUnreached, set.value.span, message).help(help))
}

/// The finding for a parameter that no clause of its scenario reads: what reads it in the scenario of which that is derived was replaced.
fn unread(scenario: &Scenario, set: &Override) -> Option<Diagnostic> {
    let param = scenario.vars.iter().position(|var| var.name == set.param)?;
    if scenario.clauses.iter().any(|clause| reads(clause, param)) {
        return None;
    }
    let message = format!("`{}.{}` is set, and no clause of `{}` reads it", scenario.path, set.param, scenario.path);
    let help = "look at its clauses with `albacore scenario show`, or leave this out: it would change nothing";
    Some(Diagnostic::error(Code::SetUnreached, set.value.span, message).help(help))
}

fn reads(clause: &ClauseUse, param: usize) -> bool {
    clause.args.iter().any(|(_, arg)| match arg {
        ClauseArg::Value(e) => e.contains(|e| matches!(e.kind, ExprKind::Var(id) if id == param)),
        ClauseArg::Nested(clause) => reads(clause, param),
    })
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
