//! Commands only under control (rule 18): a mission that watches or overrides drives its vehicle in its overrides alone.

use super::findings::Findings;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{Action, ActivityId, Block, Body, Hir, StmtKind};
use crate::source::Span;
use albacore_program::Steering;
use std::collections::BTreeSet;

struct Walk<'a> {
    hir: &'a Hir,
    /// Why the mission drives only in its overrides.
    guest: Span,
    seen: BTreeSet<(ActivityId, bool)>,
    findings: Findings,
}

/// The statements of a guest that command outside of an override, and the overrides inside another.
pub(super) fn check(hir: &Hir, mission: ActivityId) -> Vec<Diagnostic> {
    let Some(guest) = hir.first_watch(mission) else { return Vec::new() };
    let mut walk = Walk { hir, guest, seen: BTreeSet::new(), findings: Findings::default() };
    walk.activity(mission, false);
    if let Some((_, recovery)) = hir.activities[mission].mission.as_ref().and_then(|m| m.recovery.as_ref()) {
        walk.block(recovery, true);
    }
    walk.findings.into_vec()
}

impl Walk<'_> {
    fn activity(&mut self, id: ActivityId, driving: bool) {
        if !self.seen.insert((id, driving)) {
            return;
        }
        match &self.hir.activities[id].body {
            Body::Sequence(block) => self.block(block, driving),
            Body::Table { behaviors, .. } => behaviors.iter().for_each(|&b| self.activity(b, driving)),
            Body::Amend { .. } => {}
        }
    }

    fn block(&mut self, block: &Block, driving: bool) {
        for stmt in &block.stmts {
            let StmtKind::Timed(timed) = &stmt.kind else {
                stmt.blocks().into_iter().for_each(|block| self.block(block, driving));
                continue;
            };
            match &timed.action {
                Action::Call(id, _) => {
                    self.findings.called(self.hir, *id, stmt.span);
                    self.activity(*id, driving);
                    self.findings.back();
                }
                Action::Override(_) | Action::Watch if driving => self.findings.report(
                    Diagnostic::error(Code::TimeControl, stmt.span, "the vehicle is ours here: nothing to take over")
                        .help("this is called from an `override` or a recovery: call it outside, or leave this out"),
                ),
                Action::Override(inner) => self.block(&inner.block, true),
                Action::Watch => {}
                // A pause sends nothing that was not sent before.
                Action::Guide(guide, _) if matches!(guide.law().steering, Steering::Nothing) => {}
                Action::Guide(..) | Action::Keep(..) if driving => {}
                Action::Guide(..) | Action::Keep(..) => self.findings.report(
                    Diagnostic::error(Code::TimeControl, stmt.span, "the vehicle drives itself here")
                        .label(self.guest, "this makes the mission a guest, which drives in `override { … }` alone")
                        .help("put it into an `override { … }`"),
                ),
            }
        }
    }
}
