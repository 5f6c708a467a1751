//! Inputs that are read and not required: nobody has said how old they may be.

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{Action, Block, Body, Decl, Expr, ExprKind, Hir, StmtKind, With, activity_children, children};
use crate::source::Span;
use albacore_program::Guide;
use std::collections::{BTreeMap, BTreeSet};

/// Inputs that are never too old: they tell how things stand with the vehicle, and that of one not heard from as well.
const OF_THE_LINK: [&str; 2] = ["control", "vehicle_mode"];

struct Walk<'a> {
    hir: &'a Hir,
    seen: BTreeSet<usize>,
    /// For each input that is read the first place where it is.
    read: BTreeMap<usize, Span>,
}

/// Finds the inputs that a mission reads, with all that it calls, and does not require.
pub(super) fn check(hir: &Hir, mission: usize) -> Vec<Diagnostic> {
    let activity = &hir.activities[mission];
    let Some(parts) = &activity.mission else { return Vec::new() };
    let mut findings = Vec::new();
    for (input, span) in read(hir, mission) {
        let name = &hir.inputs[input].name;
        if parts.requires.iter().any(|r| r.input == input) || OF_THE_LINK.contains(&name.as_str()) {
            continue;
        }
        findings.push(
            Diagnostic::warning(
                Code::MissionsUnrequired,
                activity.span,
                format!("the mission `{}` reads `{name}` and does not say how old it may be", activity.name),
            )
            .label(span, "read here")
            .help(format!("add `{name} fresh 5 s, else abort` to its `requires {{ … }}`")),
        );
    }
    findings
}

/// The inputs that a mission reads, with all that it calls, and for each the first place where it does.
pub fn read(hir: &Hir, mission: usize) -> BTreeMap<usize, Span> {
    let mut walk = Walk { hir, seen: BTreeSet::new(), read: BTreeMap::new() };
    walk.activity(mission);
    walk.read
}

impl Walk<'_> {
    fn note(&mut self, name: &str, span: Span) {
        if let Some(id) = self.hir.inputs.iter().position(|i| i.name == name) {
            self.read.entry(id).or_insert(span);
        }
    }

    pub(super) fn activity(&mut self, id: usize) {
        if !self.seen.insert(id) {
            return;
        }
        let activity = &self.hir.activities[id];
        activity_children(activity, &mut |e| self.expr(e));
        for decl in &activity.decls {
            if let Decl::With(items) = decl {
                self.with(items);
            }
        }
        match &activity.body {
            Body::Sequence(block) => self.block(block),
            Body::Table { behaviors, .. } => behaviors.iter().for_each(|&b| self.activity(b)),
            Body::Amend { .. } => {}
        }
        if let Some((_, block)) = activity.mission.as_ref().and_then(|m| m.recovery.as_ref()) {
            self.block(block);
        }
    }

    fn with(&mut self, items: &[With]) {
        for item in items {
            if let With::Overlay(id, ..) = item {
                self.activity(*id);
            }
        }
    }

    fn expr(&mut self, e: &Expr) {
        if let ExprKind::Input(id, _) = &e.kind {
            self.read.entry(*id).or_insert(e.span);
        }
        // Functions read no inputs, and signals of a module are written out where they are used.
        children(e, &mut |child| self.expr(child));
    }

    /// Guidance reads inputs of its own, and calls lead on.
    fn block(&mut self, block: &Block) {
        block.each(&mut |stmt| match &stmt.kind {
            StmtKind::With(items, _) => self.with(items),
            StmtKind::Timed(timed) => match &timed.action {
                Action::Call(id, _) => self.activity(*id),
                Action::Guide(Guide::Goto | Guide::Follow | Guide::Dubins | Guide::Loiter, _) => {
                    self.note("position", stmt.span);
                    self.note("course", stmt.span);
                    self.note("heading", stmt.span);
                }
                Action::Guide(Guide::Wait, _) | Action::Watch | Action::Override(_) => {}
                _ => self.note("heading", stmt.span),
            },
            _ => {}
        });
    }
}
