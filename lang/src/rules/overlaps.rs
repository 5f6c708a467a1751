//! Rules of one behavior that can hold in the same tick: the order of the table decides, and its reader may want to know.

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{Body, Builtin, Expr, ExprKind, Hir, Interval, Rule, Target, leaving, same_condition};
use std::collections::BTreeMap;

/// The notes on a switching table: one for each rule that comes before others.
pub fn check(hir: &Hir, activity: usize) -> Vec<Diagnostic> {
    let Body::Table { behaviors, rules, .. } = &hir.activities[activity].body else { return Vec::new() };
    let pairs = pairs(rules, behaviors.len());
    let note = |(before, pairs): (usize, Vec<(usize, usize)>)| {
        let name = &hir.activities[behaviors[pairs[0].1]].name;
        let note = Diagnostic::note(
            Code::RulesOverlap,
            rules[before].on_span,
            format!("rules of `{name}` can hold in the same tick"),
        )
        .here("this one then decides")
        .help("nothing is wrong if that is meant; if not, put the other first or say `and not …` in it");
        pairs.iter().fold(note, |note, (after, _)| note.label(rules[*after].on_span, "this one is then not tried"))
    };
    pairs.into_iter().map(note).collect()
}

/// Each two rules of one behavior that can hold at once and differ: by the one that is tried first the others, each with the
/// behavior.
fn pairs(rules: &[Rule], behaviors: usize) -> BTreeMap<usize, Vec<(usize, usize)>> {
    let leaving = leaving(rules, behaviors);
    let mut pairs: BTreeMap<usize, Vec<(usize, usize)>> = BTreeMap::new();
    for (i, first) in rules.iter().enumerate() {
        // Of each other rule the first behavior that both leave.
        let mut beside: BTreeMap<usize, usize> = BTreeMap::new();
        for &source in &first.sources {
            for &other in leaving[source].iter().rev().take_while(|other| **other > i) {
                beside.entry(other).or_insert(source);
            }
        }
        for (j, source) in beside {
            let second = &rules[j];
            if same_outcome(first, second) || exclude(&first.on, &second.on) {
                continue;
            }
            // What can hold only when the body is done is tried after it, and all else before it, wherever it stands.
            let (before, after) = match (needs_done(&first.on), needs_done(&second.on)) {
                (true, false) => (j, i),
                _ => (i, j),
            };
            pairs.entry(before).or_default().push((after, source));
        }
    }
    pairs
}

/// Whether a guard holds only when the body has come to its end.
fn needs_done(guard: &Expr) -> bool {
    match &guard.kind {
        ExprKind::Done => true,
        ExprKind::Do(Builtin::And, operands) => operands.iter().any(needs_done),
        ExprKind::Do(Builtin::Or, operands) => operands.iter().all(needs_done),
        _ => false,
    }
}

/// Whether it makes no difference which of two rules fires.
fn same_outcome(a: &Rule, b: &Rule) -> bool {
    let same_target = match (&a.target, &b.target) {
        (Target::Behavior(x), Target::Behavior(y)) => x == y,
        (Target::Finish(None), Target::Finish(None)) => true,
        (Target::Finish(Some(x)), Target::Finish(Some(y))) => same_condition(x, y),
        _ => false,
    };
    same_target && a.back == b.back && a.effect.is_none() && b.effect.is_none()
}

/// Whether two guards surely never hold at once.
fn exclude(a: &Expr, b: &Expr) -> bool {
    let (parts, others) = (conjuncts(a), conjuncts(b));
    parts.iter().any(|x| others.iter().any(|y| contrary(x, y) || contrary(y, x) || apart(x, y)))
}

/// The conditions all of which hold when a guard does.
fn conjuncts(guard: &Expr) -> Vec<&Expr> {
    match &guard.kind {
        ExprKind::Do(Builtin::And, operands) => operands.iter().flat_map(conjuncts).collect(),
        ExprKind::HeldFor(inner, _) | ExprKind::Becomes(inner) => conjuncts(inner),
        _ => vec![guard],
    }
}

/// Whether one says that the other does not hold.
pub(super) fn contrary(a: &Expr, b: &Expr) -> bool {
    match (&a.kind, &b.kind) {
        (ExprKind::Do(Builtin::Not, inner), _) => inner.iter().any(|inner| same_condition(inner, b)),
        // `x < y` beside `y < x` or `y <= x`.
        (ExprKind::Do(Builtin::Lt, xs), ExprKind::Do(Builtin::Lt | Builtin::Le, ys)) => {
            same_condition(&xs[0], &ys[1]) && same_condition(&xs[1], &ys[0])
        }
        _ => false,
    }
}

/// Whether two comparisons of one thing with numbers leave it no number.
fn apart(a: &Expr, b: &Expr) -> bool {
    let (Some((x, p)), Some((y, q))) = (compared(a), compared(b)) else { return false };
    let (p, q) = (p.numbers(), q.numbers());
    same_condition(x, y) && (p.high < q.low || q.high < p.low)
}

/// On which side of a number something is.
#[derive(Clone, Copy)]
pub(super) enum Side {
    Below(f64),
    Above(f64),
}

impl Side {
    /// The numbers there, the end among them.
    pub fn numbers(self) -> Interval {
        match self {
            Side::Below(end) => Interval::at_most(end),
            Side::Above(end) => Interval::at_least(end),
        }
    }
}

/// What a comparison says of the side that is no constant.
pub(super) fn compared(e: &Expr) -> Option<(&Expr, Side)> {
    let ExprKind::Do(Builtin::Lt | Builtin::Le, operands) = &e.kind else { return None };
    let (low, high) = (&operands[0], &operands[1]);
    match (low.range.constant(), high.range.constant()) {
        (None, Some(bound)) => Some((low, Side::Below(bound))),
        (Some(bound), None) => Some((high, Side::Above(bound))),
        _ => None,
    }
}
