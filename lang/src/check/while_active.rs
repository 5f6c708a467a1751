//! `expect while BEHAVIOR: …`: which activity of the tested mission is meant, and what cannot be asked of it.

use super::Checker;
use crate::code::Code;
use crate::diagnostic::{Diagnostic, Severity};
use crate::hir::{ActivityId, Expr, ExprKind, Kind};
use crate::syntax::tree;
use albacore_wording::listed;
use std::collections::BTreeSet;

impl Checker<'_> {
    /// The behavior or strategy of the tested mission that a path names: `find`, or `cpt_2005.find` where several have the name.
    pub(super) fn behavior_of_the_tested(&mut self, path: &tree::Path) -> Option<ActivityId> {
        let mission = self.test.as_ref()?.mission;
        let reached = self.entered_by(mission);
        let meant: Vec<ActivityId> = reached.iter().copied().filter(|&id| self.is_named(id, path)).collect();
        // What the file itself declares by a name goes before what has that name in something else.
        let whole = meant.iter().copied().find(|&id| self.qualified(id) == path.text());
        match (whole, meant.as_slice()) {
            (Some(id), _) | (None, &[id]) => {
                self.refer_to_behavior(path, id);
                Some(id)
            }
            (None, []) => {
                self.no_behavior(mission, path, &reached);
                None
            }
            (None, several) => {
                let names: Vec<String> = several.iter().map(|&id| self.qualified(id)).collect();
                let message = format!("several behaviors of the mission are called `{}`", path.text());
                let finding = Diagnostic::error(Code::TestsBehavior, path.span, message);
                self.report(finding.help(format!("say which: there is {}", listed(&names))));
                None
            }
        }
    }

    /// The behaviors and strategies that a mission enters, itself or by what it calls; not those in its overlays, which run beside them.
    fn entered_by(&self, mission: ActivityId) -> Vec<ActivityId> {
        let mut entered = BTreeSet::new();
        let mut ahead = vec![mission];
        while let Some(id) = ahead.pop() {
            let activity = &self.hir.activities[id];
            let is_overlay = matches!(activity.kind, Kind::AmendsCourse | Kind::Beside | Kind::Sets(_));
            if !is_overlay && entered.insert(id) {
                ahead.extend(activity.calls());
            }
        }
        entered.remove(&mission);
        entered.into_iter().collect()
    }

    /// Its name with that of the strategy or mission that holds it, and of its module: `cpt.cpt_2005.find`.
    fn qualified(&self, id: ActivityId) -> String {
        let activity = &self.hir.activities[id];
        match activity.owner {
            Some(owner) => format!("{}.{}", self.hir.activities[owner].full_name, activity.name),
            None => activity.full_name.clone(),
        }
    }

    /// Whether a path is the end of its whole name.
    fn is_named(&self, id: ActivityId, path: &tree::Path) -> bool {
        let whole = self.qualified(id);
        let mut parts = whole.rsplit('.');
        path.parts.iter().rev().all(|part| parts.next() == Some(part.node.as_str()))
    }

    fn refer_to_behavior(&self, path: &tree::Path, id: ActivityId) {
        let activity = &self.hir.activities[id];
        let mut parts = path.parts.iter().rev();
        let owner = activity.owner.map(|owner| self.hir.activities[owner].span);
        for (declared, part) in std::iter::once(activity.span).chain(owner).zip(parts.by_ref()) {
            self.names_used.refer(part.span, declared);
        }
        if let Some(module) = parts.next() {
            self.import(self.scope.module, &module.node, module.span);
        }
    }

    /// Says that the mission has no such behavior, and what it has.
    fn no_behavior(&mut self, mission: ActivityId, path: &tree::Path, reached: &[ActivityId]) {
        let name = path.text();
        let of = self.hir.activities[mission].name.clone();
        let at = |message: String| Diagnostic::error(Code::TestsBehavior, path.span, message);
        let always = "write `expect always`, or name a behavior that the mission enters";
        let other = (0..self.hir.activities.len()).find(|&id| self.is_named(id, path));
        // What stands in an overlay is of it.
        let outer = other.map(|id| self.hir.activities[id].owner.unwrap_or(id));
        match outer.map(|id| self.hir.activities[id].kind) {
            Some(Kind::AmendsCourse | Kind::Beside | Kind::Sets(_)) => {
                let is = if outer == other { "is" } else { "stands in" };
                let message = format!("`{name}` {is} an overlay: that runs beside the behavior that is active");
                self.report(at(message).help(always));
            }
            Some(Kind::Mission) if other == Some(mission) => {
                self.report(at(format!("`{name}` is the mission: it is active at every tick")).help(always));
            }
            // What enters it may be what could not be understood.
            Some(_) if self.findings.iter().any(|finding| finding.severity == Severity::Error) => {}
            _ => {
                let short = |&id: &ActivityId| self.hir.activities[id].name.as_str();
                let is_alone = |id: &ActivityId| reached.iter().filter(|other| short(other) == short(id)).count() == 1;
                let named = |id: &ActivityId| if is_alone(id) { short(id).to_string() } else { self.qualified(*id) };
                let known: Vec<String> = reached.iter().map(named).collect();
                let message = match other {
                    Some(_) => format!("the mission `{of}` never enters `{name}`"),
                    None => format!("the mission `{of}` has no behavior `{name}`"),
                };
                let help = self.suggestion(&name, known.iter().map(String::as_str));
                self.report(match help {
                    Some(help) => at(message).help(help),
                    None => at(message).help(always),
                });
            }
        }
    }

    /// While a behavior is active the mission has not ended: what asks how it has, asks nothing.
    pub(super) fn asks_no_ending(&mut self, holds: &Expr) {
        let Some(test) = &self.test else { return };
        let reasons = test.names.reasons.iter().map(|(_, id)| *id);
        let outcomes: Vec<usize> = test.names.outcomes.into_iter().chain(reasons).collect();
        let mut asked = None;
        holds.visit(&mut |e| {
            if matches!(e.kind, ExprKind::Var(id) if outcomes.contains(&id)) {
                asked = asked.or(Some(e.span));
            }
            true
        });
        if let Some(span) = asked {
            let message = "while a behavior is active the mission has not ended: this is always `false`";
            let finding = Diagnostic::error(Code::TestsNothing, span, message);
            self.report(finding.help("write it in an expectation of its own, such as `expect completed`"));
        }
    }
}
