//! Commands only under control (rule 18): a mission that watches or overrides drives its vehicle in its overrides alone.

use super::findings::Findings;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{Action, ActivityId, Block, Body, Hir, Rule, StmtKind, Target};
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
            Body::Table { behaviors, rules, .. } => {
                if !driving {
                    self.drives_on_while_suspended(behaviors, rules);
                }
                behaviors.iter().for_each(|&b| self.activity(b, driving));
            }
            Body::Amend { .. } => {}
        }
    }

    /// A behavior that is suspended in its override still drives: what it waits for can neither watch nor take over, nor can what
    /// that waits for.
    fn drives_on_while_suspended(&mut self, behaviors: &[ActivityId], rules: &[Rule]) {
        let is_override = |action: &Action| matches!(action, Action::Override(_));
        let is_control = |action: &Action| matches!(action, Action::Override(_) | Action::Watch);
        let taken: Vec<Option<Span>> = behaviors.iter().map(|id| self.first(*id, is_override)).collect();
        let controls: Vec<Option<Span>> = behaviors.iter().map(|id| self.first(*id, is_control)).collect();
        for (from, taken) in taken.into_iter().enumerate().filter_map(|(from, taken)| Some((from, taken?))) {
            let mut waits = BTreeSet::from([from]);
            let mut ahead = vec![from];
            while let Some(at) = ahead.pop() {
                for rule in rules.iter().filter(|rule| rule.back && rule.sources.contains(&at)) {
                    let Target::Behavior(to) = rule.target else { continue };
                    if let Some(place) = controls[to] {
                        self.findings.report(driven_already(place, taken, rule.on_span));
                    } else if waits.insert(to) {
                        ahead.push(to);
                    }
                }
            }
        }
    }

    /// The first statement of an activity, and of what it calls, that does something.
    fn first(&self, activity: ActivityId, does: impl Fn(&Action) -> bool) -> Option<Span> {
        self.hir.called_from(activity).into_iter().find_map(|id| {
            let mut found = None;
            if let Body::Sequence(block) = &self.hir.activities[id].body {
                block.each(&mut |stmt| match &stmt.kind {
                    StmtKind::Timed(timed) if does(&timed.action) => _ = found.get_or_insert(stmt.span),
                    _ => {}
                });
            }
            found
        })
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

fn driven_already(place: Span, taken: Span, on: Span) -> Diagnostic {
    Diagnostic::error(Code::TimeControl, place, "the vehicle may be ours here already")
        .label(taken, "a behavior that is suspended in this `override` still drives it")
        .label(on, "and waits since this held")
        .help("leave that behavior instead: without `then back`, with a rule `on done` that leads there again")
}
