//! What a checked block does to time and to what follows it.

use super::timed::guidance_ends;
use crate::hir::{Action, Block, Expr, ExprKind, Stmt, StmtKind, Timed};
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

/// How long a block takes at least, s, by the times that its statements name. Calls are not asked.
pub(crate) fn least_time(block: &Block) -> f64 {
    let of = |stmt: &Stmt| match &stmt.kind {
        StmtKind::Timed(timed) => least_time_of(timed),
        StmtKind::With(_, body) => least_time(body),
        StmtKind::If(_, a, b) => least_time(a).min(least_time(b)),
        _ => first_round(stmt).map_or(0.0, least_time),
    };
    block.stmts.iter().map(of).sum()
}

fn least_time_of(timed: &Timed) -> f64 {
    let ends_by_itself = match &timed.action {
        Action::Guide(guide, args) => guidance_ends(*guide, args),
        Action::Keep(..) | Action::Watch => false,
        Action::Call(..) | Action::Override(_) | Action::Ask(..) => true,
    };
    if ends_by_itself || timed.until.is_some() {
        return 0.0;
    }
    [&timed.duration, &timed.within].into_iter().flatten().map(|time| time.range.low).reduce(f64::min).unwrap_or(0.0)
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
