//! What a checked block does to time and to what follows it.

use super::timed::guidance_ends;
use crate::hir::{Action, ActivityId, Block, Body, Expr, ExprKind, Hir, Stmt, StmtKind, Timed};
use crate::source::Span;

/// Whether every path through a block takes time, or leaves it for good.
pub(crate) fn takes_time(block: &Block) -> bool {
    block.stmts.iter().any(|stmt| match &stmt.kind {
        StmtKind::Timed(_) | StmtKind::Loop(_) | StmtKind::Finish(_) | StmtKind::Abort(_) => true,
        StmtKind::If(_, a, b) => takes_time(a) && takes_time(b),
        StmtKind::Match(_, arms, otherwise) => {
            arms.iter().all(|(_, b)| takes_time(b)) && otherwise.as_ref().is_none_or(takes_time) && !arms.is_empty()
        }
        StmtKind::With(_, body) => takes_time(body),
        _ => first_round(stmt).is_some_and(takes_time),
    })
}

/// How long an activity takes at least, s, by the times that its statements name; so deep in calls at most.
pub(crate) fn least_time(hir: &Hir, activity: ActivityId, depth: usize) -> f64 {
    match &hir.activities[activity].body {
        Body::Sequence(block) => least_time_of_block(hir, block, depth),
        Body::Table { .. } | Body::Amend { .. } => 0.0,
    }
}

fn least_time_of_block(hir: &Hir, block: &Block, depth: usize) -> f64 {
    let of = |block: &Block| least_time_of_block(hir, block, depth);
    let of_stmt = |stmt: &Stmt| match &stmt.kind {
        StmtKind::Timed(timed) => least_time_of(hir, timed, depth),
        StmtKind::With(_, body) | StmtKind::Loop(body) => of(body),
        StmtKind::If(_, a, b) => of(a).min(of(b)),
        StmtKind::ForRange { first, last, inclusive, body, .. } => {
            let rounds = last.range.low - first.range.high + if *inclusive { 1.0 } else { 0.0 };
            rounds.max(0.0).floor() * of(body)
        }
        StmtKind::ForList { list, body, .. } => match &list.kind {
            ExprKind::List(elements) => elements.len() as f64 * of(body),
            _ => 0.0,
        },
        _ => first_round(stmt).map_or(0.0, of),
    };
    // What may finish on the way may take no longer.
    let last = block.stmts.iter().position(may_finish).map_or(block.stmts.len(), |at| at + 1);
    block.stmts[..last].iter().map(of_stmt).sum()
}

fn may_finish(stmt: &Stmt) -> bool {
    matches!(stmt.kind, StmtKind::Finish(_))
        || stmt.blocks().into_iter().any(|block| block.stmts.iter().any(may_finish))
}

fn least_time_of(hir: &Hir, timed: &Timed, depth: usize) -> f64 {
    let own = match &timed.action {
        Action::Guide(guide, args) if guidance_ends(*guide, args) => 0.0,
        Action::Guide(..) | Action::Keep(..) | Action::Watch => f64::INFINITY,
        Action::Call(id, _) => depth.checked_sub(1).map_or(0.0, |depth| least_time(hir, *id, depth)),
        Action::Override(_) | Action::Ask(..) => 0.0,
    };
    if timed.until.is_some() {
        return 0.0;
    }
    let bounds = [&timed.duration, &timed.within].into_iter().flatten().map(|time| time.range.low);
    let bound = bounds.reduce(f64::min).unwrap_or(f64::INFINITY);
    own.min(bound)
}

/// What a loop does that goes round at least once: over the edges of an area, a range that holds a number, a list that is written out.
fn first_round(stmt: &Stmt) -> Option<&Block> {
    match &stmt.kind {
        StmtKind::ForRange { first, last, inclusive, body, .. } => goes_round(first, last, *inclusive).then_some(body),
        StmtKind::ForEdges { body, .. } => Some(body),
        StmtKind::ForList { list, body, .. } => {
            matches!(&list.kind, ExprKind::List(elements) if !elements.is_empty()).then_some(body)
        }
        _ => None,
    }
}

/// Whether a range is known to hold at least one number.
pub(crate) fn goes_round(first: &Expr, last: &Expr, inclusive: bool) -> bool {
    last.range.low - first.range.high >= if inclusive { 0.0 } else { 1.0 }
}

/// Whether some path through a block takes time.
pub(super) fn may_take_time(block: &Block) -> bool {
    block.stmts.iter().any(|stmt| {
        matches!(stmt.kind, StmtKind::Timed(_) | StmtKind::Loop(_)) || stmt.blocks().into_iter().any(may_take_time)
    })
}

/// The first `abort` in a block.
pub(super) fn aborts(block: &Block) -> Option<Span> {
    block.stmts.iter().find_map(|stmt| match &stmt.kind {
        StmtKind::Abort(_) => Some(stmt.span),
        _ => stmt.blocks().into_iter().find_map(aborts),
    })
}

/// Whether a block never comes to its end.
pub(super) fn leaves(block: &Block) -> bool {
    block.stmts.last().is_some_and(never_goes_on)
}

/// Whether what stands after a statement is never reached, as far as the statement itself tells.
pub(super) fn never_goes_on(stmt: &Stmt) -> bool {
    match &stmt.kind {
        StmtKind::Finish(_) | StmtKind::Abort(_) | StmtKind::Loop(_) => true,
        // That its outcome is never known is told where it is bound.
        StmtKind::Timed(timed) => timed.result.is_none() && endless(timed),
        StmtKind::If(_, a, b) => leaves(a) && leaves(b),
        StmtKind::With(_, body) => leaves(body),
        StmtKind::Match(_, arms, otherwise) => {
            !arms.is_empty() && arms.iter().all(|(_, b)| leaves(b)) && otherwise.as_ref().is_none_or(leaves)
        }
        // No word leads out of a loop but `finish` and `abort`.
        StmtKind::While { condition, .. } => matches!(condition.kind, ExprKind::Number(x) if x != 0.0),
        _ => first_round(stmt).is_some_and(leaves),
    }
}

/// Whether guidance, a setpoint or an override never ends by itself, and nothing ends it. Calls are not asked.
pub(super) fn endless(timed: &Timed) -> bool {
    if timed.duration.is_some() || timed.until.is_some() || timed.within.is_some() {
        return false;
    }
    match &timed.action {
        Action::Guide(guide, args) => !guidance_ends(*guide, args),
        Action::Call(..) | Action::Ask(..) => false,
        Action::Keep(..) | Action::Watch => true,
        // Whoever reads its end hears that control was taken back, and goes on.
        Action::Override(o) => timed.result.is_none() && leaves(&o.block),
    }
}
