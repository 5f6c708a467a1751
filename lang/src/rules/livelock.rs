//! Rules that undo each other: a table that switches to and fro on one condition gets nowhere.

use super::overlaps::exclude;
use crate::check::never_ends;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{Action, Activity, Body, Decl, Expr, ExprKind, Hir, Rule, StmtKind, Target, VarId, children};
use crate::hir::{Builtin, same_condition};
use std::collections::{BTreeMap, BTreeSet};

/// The warnings on a switching table.
pub fn check(hir: &Hir, activity: usize) -> Vec<Diagnostic> {
    let strategy = &hir.activities[activity];
    let Body::Table { behaviors, rules, .. } = &strategy.body else { return Vec::new() };
    let table = Table { strategy, assigned: assigned(hir, strategy, behaviors) };
    let mut findings = Vec::new();
    for (i, rule) in rules.iter().enumerate() {
        let Target::Behavior(to) = rule.target else { continue };
        if rule.back && !never_ends(hir, behaviors[to]) && table.lasts(&rule.on, until(hir, behaviors[to])) {
            findings.push(comes_again(rule, &hir.activities[behaviors[to]].name));
        }
        let undone = rules[i + 1..].iter().find(|other| {
            let is_undone = |to: usize, from: &Rule| {
                matches!(from.target, Target::Behavior(x) if rule.sources.contains(&x)) && from.sources.contains(&to)
            };
            let same = same_condition(&rule.on, &other.on) || same_condition(&other.on, &rule.on);
            !rule.back && !other.back && is_undone(to, other) && same
        });
        if let Some(other) = undone
            && table.holds_at_entry(&rule.on)
            && table.holds_at_entry(&other.on)
        {
            let finding = Diagnostic::warning(Code::RulesLivelock, other.on_span, "this rule undoes another at once")
                .label(rule.on_span, "which holds whenever it does, or the other way about")
                .help("write `becomes …` in both, or two conditions that exclude each other");
            findings.push(finding);
        }
    }
    findings
}

/// A condition that may still hold when the behavior it leads to is done.
fn comes_again(rule: &Rule, name: &str) -> Diagnostic {
    let message = format!("this may hold again as soon as `{name}` is done, and switch on every other tick");
    let finding = Diagnostic::warning(Code::RulesLivelock, rule.on_span, message);
    finding.help(if mentions_after(&rule.on) {
        "time goes on counting from the entry: write `becomes after T` for once in each stay. To begin anew each time, leave out \
         `then back` and come back with a rule `on done`"
    } else {
        "write `becomes …`, or let the behavior end only when the condition no longer holds: `… until not …`"
    })
}

/// What a sequence surely ends with: the condition after the `until` of its last statement.
fn until(hir: &Hir, behavior: usize) -> Option<&Expr> {
    let Body::Sequence(block) = &hir.activities[behavior].body else { return None };
    let mut last = block.stmts.last()?;
    while let StmtKind::With(_, inner) = &last.kind {
        last = inner.stmts.last()?;
    }
    match &last.kind {
        StmtKind::Timed(timed) if timed.within.is_none() && !matches!(timed.action, Action::Call(..)) => {
            timed.until.as_ref()
        }
        _ => None,
    }
}

/// The variables that anything in a table assigns: what they say may be over when it is asked again.
fn assigned(hir: &Hir, strategy: &Activity, behaviors: &[usize]) -> BTreeSet<VarId> {
    let parts = std::iter::once(strategy).chain(behaviors.iter().map(|&b| &hir.activities[b]));
    parts.flat_map(Activity::blocks).flat_map(|block| block.assigned()).collect()
}

struct Table<'h> {
    strategy: &'h Activity,
    assigned: BTreeSet<VarId>,
}

impl Table<'_> {
    /// Whether a guard may still hold when what it led to is done: no part of it is an edge or is assigned by the table.
    fn lasts(&self, guard: &Expr, end: Option<&Expr>) -> bool {
        let is_over = |end| alternatives(end).into_iter().all(|end| exclude(guard, end));
        !end.is_some_and(is_over) && self.goes_on(guard, true, &mut BTreeMap::new())
    }

    /// Whether a guard holds again at once after each of two switches: its times too begin anew then.
    fn holds_at_entry(&self, guard: &Expr) -> bool {
        self.goes_on(guard, false, &mut BTreeMap::new())
    }

    /// `known` are the variables that were looked through, so that each signal is looked at once.
    fn goes_on(&self, e: &Expr, keeps_time: bool, known: &mut BTreeMap<VarId, bool>) -> bool {
        match &e.kind {
            ExprKind::Becomes(_) | ExprKind::Done => return false,
            ExprKind::After(_) | ExprKind::HeldFor(..) if !keeps_time => return false,
            ExprKind::Do(Builtin::Or, operands) => return operands.iter().any(|e| self.goes_on(e, keeps_time, known)),
            ExprKind::Var(id) => {
                if let Some(known) = known.get(id) {
                    return *known;
                }
                let signal = self.strategy.decls.iter().find_map(|decl| match decl {
                    Decl::Signal(var, e) if var == id => Some(e),
                    _ => None,
                });
                let goes_on = !self.assigned.contains(id) && signal.is_none_or(|e| self.goes_on(e, keeps_time, known));
                known.insert(*id, goes_on);
                return goes_on;
            }
            _ => {}
        }
        let mut all = true;
        children(e, &mut |child| all = all && self.goes_on(child, keeps_time, known));
        all
    }
}

/// What `or` joins.
fn alternatives(e: &Expr) -> Vec<&Expr> {
    match &e.kind {
        ExprKind::Do(Builtin::Or, operands) => operands.iter().flat_map(alternatives).collect(),
        _ => vec![e],
    }
}

fn mentions_after(e: &Expr) -> bool {
    let mut found = matches!(e.kind, ExprKind::After(_));
    children(e, &mut |child| found |= mentions_after(child));
    found
}
