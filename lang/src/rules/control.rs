//! Commands only under control (rule 18): a mission that watches or overrides drives its vehicle in its overrides alone.

use super::findings::Findings;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{Action, Activity, ActivityId, Block, Body, First, Hir, Rule, StmtKind, Target, is_control, leaving};
use crate::source::Span;
use albacore_program::Steering;
use std::collections::BTreeSet;

struct Walk<'a> {
    hir: &'a Hir,
    /// Why the mission drives only in its overrides.
    guest: Span,
    seen: BTreeSet<(ActivityId, bool)>,
    /// The first `override` of each activity and all that it calls, and the first `override` or `watch`.
    overrides: FirstAction<'a>,
    controls: FirstAction<'a>,
    findings: Findings,
}

type FirstAction<'a> = First<'a, fn(&Activity) -> Option<Span>>;

/// The statements of a guest that command outside of an override, and the overrides inside another.
pub(super) fn check(hir: &Hir, mission: ActivityId) -> Vec<Diagnostic> {
    let Some(guest) = hir.first_watch(mission) else { return Vec::new() };
    let mut walk = Walk {
        hir,
        guest,
        seen: BTreeSet::new(),
        overrides: First::new(hir, |activity| activity.first_action(|action| matches!(action, Action::Override(_)))),
        controls: First::new(hir, |activity| activity.first_action(is_control)),
        findings: Findings::default(),
    };
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
        let leaving = leaving(rules, behaviors.len());
        // Where each behavior that may wait still drives, or what waits for it does: the first that is found is as good as any.
        let mut driven: Vec<Option<Span>> = behaviors.iter().map(|id| self.overrides.of(*id)).collect();
        let mut ahead: Vec<usize> = (0..behaviors.len()).filter(|&behavior| driven[behavior].is_some()).collect();
        while let Some(at) = ahead.pop() {
            let Some(taken) = driven[at] else { continue };
            for rule in leaving[at].iter().map(|&rule| &rules[rule]).filter(|rule| rule.back) {
                let Target::Behavior(to) = rule.target else { continue };
                if let Some(place) = self.controls.of(behaviors[to]) {
                    self.findings.report(driven_already(place, taken, rule.on_span));
                } else if driven[to].is_none() {
                    driven[to] = Some(taken);
                    ahead.push(to);
                }
            }
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
                Action::Watch | Action::Ask(..) => {}
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
