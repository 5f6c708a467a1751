//! What comes to its end by itself, through all that it calls: known when all bodies are.

use super::{Checker, flow};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{Action, ActivityId, Block, Body, Hir, Stmt, StmtKind, Target, Timed};
use crate::source::Span;
use std::collections::BTreeMap;

/// Whether a mission's statements never come to their end by themselves.
pub fn never_ends(hir: &Hir, mission: usize) -> bool {
    matches!(hir.activities[mission].body, Body::Sequence(_)) && !can_end(mission, hir, &mut Known::new())
}

/// The activities of which is known whether they can end, those that are being asked among them: recursion is an error of
/// its own.
pub(super) type Known = BTreeMap<ActivityId, bool>;

/// Whether an activity can end by itself: come to its last statement's end, or finish, by a rule if it is a table.
pub(super) fn can_end(id: ActivityId, hir: &Hir, known: &mut Known) -> bool {
    let block = match &hir.activities[id].body {
        Body::Sequence(block) => block,
        // One that is wrong in itself has no behaviors.
        Body::Table { behaviors, rules, .. } => {
            return behaviors.is_empty() || rules.iter().any(|rule| matches!(rule.target, Target::Finish(_)));
        }
        Body::Amend { .. } => return true,
    };
    if let Some(ends) = known.get(&id) {
        return *ends;
    }
    known.insert(id, true);
    let ends = completes(block, hir, known) || finishes(block, hir, known);
    known.insert(id, ends);
    ends
}

/// Whether a block can come to the end of its last statement.
fn completes(block: &Block, hir: &Hir, known: &mut Known) -> bool {
    block.stmts.iter().all(|stmt| goes_on(stmt, hir, known))
}

/// What stands after a call that never ends, behind that call.
fn after_endless_calls(block: &Block, hir: &Hir, known: &mut Known, unreached: &mut Vec<(Span, Span)>) {
    for (stmt, next) in block.stmts.iter().zip(block.stmts.iter().skip(1)) {
        // What the statement itself tells was told where it stands.
        let is_told = match &stmt.kind {
            StmtKind::Timed(timed) => !matches!(timed.action, Action::Call(..)),
            _ => flow::never_goes_on(stmt),
        };
        if !is_told && !goes_on(stmt, hir, known) {
            unreached.push((stmt.span, next.span));
        }
    }
    for block in block.stmts.iter().flat_map(Stmt::blocks) {
        after_endless_calls(block, hir, known, unreached);
    }
}

impl Checker<'_> {
    /// Nothing stands after a call that never ends.
    pub(super) fn calls_go_on(&mut self, hir: &Hir, known: &mut Known) {
        let mut unreached = Vec::new();
        for activity in &hir.activities {
            if let Body::Sequence(block) = &activity.body {
                after_endless_calls(block, hir, known, &mut unreached);
            }
        }
        for (call, next) in unreached {
            let finding = Diagnostic::error(Code::FlowUnreachable, next, "this is never reached")
                .label(call, "what this calls never ends by itself");
            self.report(finding.help("bound the call with `for T` or `until X`, or let what it calls end"));
        }
    }
}

fn goes_on(stmt: &Stmt, hir: &Hir, known: &mut Known) -> bool {
    match &stmt.kind {
        StmtKind::Finish(_) | StmtKind::Abort(_) | StmtKind::Loop(_) => false,
        // A statement that never ends by itself and is not bounded.
        StmtKind::Timed(timed) => !endless(timed, hir, known),
        StmtKind::With(_, body) => completes(body, hir, known),
        StmtKind::If(_, a, b) => completes(a, hir, known) || completes(b, hir, known),
        StmtKind::Match(_, arms, otherwise) => {
            let mut blocks = arms.iter().map(|(_, block)| block).chain(otherwise);
            arms.is_empty() || blocks.any(|block| completes(block, hir, known))
        }
        _ => true,
    }
}

/// Whether a `finish` can be reached in a block.
fn finishes(block: &Block, hir: &Hir, known: &mut Known) -> bool {
    for stmt in &block.stmts {
        let is_finish = matches!(stmt.kind, StmtKind::Finish(_));
        if is_finish || stmt.blocks().into_iter().any(|block| finishes(block, hir, known)) {
            return true;
        }
        if !goes_on(stmt, hir, known) {
            return false;
        }
    }
    false
}

fn endless(timed: &Timed, hir: &Hir, known: &mut Known) -> bool {
    match &timed.action {
        _ if timed.duration.is_some() || timed.until.is_some() || timed.within.is_some() => false,
        Action::Guide(..) | Action::Keep(..) | Action::Watch | Action::Override(_) | Action::Ask(..) => {
            flow::endless(timed)
        }
        Action::Call(id, _) => !can_end(*id, hir, known),
    }
}
