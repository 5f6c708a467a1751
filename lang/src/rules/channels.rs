//! One owner for each channel on every way that leads to a statement: speed and vertical are set, and set once.

use super::findings::Findings;
use super::limits::{self, Limit};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{Action, Block, Body, Decl, Expr, ExprKind, Hir, Interval, Kind, StmtKind, Timed, With};
use crate::source::Span;
use albacore_program::{Axis, Channel};
use std::collections::BTreeSet;

/// So many ways to activities are told apart by what the calls on them give.
const WAYS_MAX: usize = 10_000;

/// Who owns a channel here.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Owner {
    Nobody,
    /// A setpoint: an inner one takes its place.
    Setpoint,
    /// An overlay, put on here: nothing may take its place.
    Overlay(Span),
}

/// The owners of what guidance does not set itself, each at the place of its axis.
type Owners = [Owner; Axis::ALL.len()];

/// A way to an activity, as far as it makes a difference: who owns what there, and the bounds of what the call gives.
type Way = (usize, Owners, Vec<(u64, u64)>);

struct Walk<'a> {
    hir: &'a Hir,
    /// The mission's limits.
    limits: Vec<Limit>,
    seen: BTreeSet<Way>,
    /// Overlays and what they call, with the bounds of what the call gives.
    overlays_seen: BTreeSet<(usize, Vec<(u64, u64)>)>,
    /// What is known of the parameters of the activity that is walked, from the call that leads to it.
    given: Vec<Interval>,
    findings: Findings,
}

/// Walks all ways from a mission to its statements.
pub(super) fn check(hir: &Hir, mission: usize) -> Vec<Diagnostic> {
    let limits = limits::of(hir, mission);
    let mut walk = Walk {
        hir,
        limits,
        seen: BTreeSet::new(),
        overlays_seen: BTreeSet::new(),
        given: Vec::new(),
        findings: Findings::default(),
    };
    walk.activity(mission, [Owner::Nobody; Axis::ALL.len()]);
    walk.findings.into_vec()
}

impl Walk<'_> {
    pub(super) fn activity(&mut self, id: usize, mut owners: Owners) {
        // Past so many ways nothing new is to be learnt of what is given.
        if self.seen.len() > WAYS_MAX {
            self.given.clear();
        }
        let given = self.given.iter().map(|range| (range.low.to_bits(), range.high.to_bits())).collect();
        if !self.seen.insert((id, owners, given)) {
            return;
        }
        let activity = &self.hir.activities[id];
        for decl in &activity.decls {
            if let Decl::With(items) = decl {
                owners = self.with(items, owners);
            }
        }
        match &activity.body {
            Body::Sequence(block) => self.block(block, owners),
            Body::Table { behaviors, .. } => behaviors.iter().for_each(|&b| self.activity(b, owners)),
            Body::Amend { .. } => {}
        }
        if let Some((_, block)) = activity.mission.as_ref().and_then(|m| m.recovery.as_ref()) {
            self.block(block, owners);
        }
    }

    fn with(&mut self, items: &[With], mut owners: Owners) -> Owners {
        for item in items {
            match item {
                With::Setpoint(channel, e) => {
                    self.limited(*channel, e);
                    self.own(&mut owners, channel.row().axis, Owner::Setpoint, e.span);
                }
                With::Overlay(id, args, place) => {
                    if let Kind::Sets(axis) = self.hir.activities[*id].kind {
                        self.own(&mut owners, axis, Owner::Overlay(*place), *place);
                    }
                    self.findings.called(self.hir, *id, *place);
                    self.called(args, |walk| walk.overlay(*id));
                    self.findings.back();
                }
            }
        }
        owners
    }

    /// Gives a channel a new owner; one that an overlay owns cannot be given away.
    fn own(&mut self, owners: &mut Owners, axis: Axis, owner: Owner, span: Span) {
        let (slot, name) = (&mut owners[axis as usize], axis.title());
        if let Owner::Overlay(earlier) = *slot {
            let finding =
                Diagnostic::error(Code::ChannelsTwice, span, format!("the {name} belongs to an overlay here"))
                    .label(earlier, "put on here")
                    .help(match owner {
                        Owner::Overlay(_) => "take one of the two overlays off",
                        _ => "take the overlay off, or leave the setpoint out",
                    });
            self.findings.report(finding);
            return;
        }
        *slot = owner;
    }

    /// A setpoint that no limit lets through.
    fn limited(&mut self, channel: Channel, setpoint: &Expr) {
        let range = self.range(setpoint);
        if let Some(finding) = limits::beyond(&self.limits, channel, setpoint, range) {
            self.findings.report(finding);
        }
    }

    /// What is known of a value here: more than where it is written, when it is a parameter that the call gives.
    fn range(&self, e: &Expr) -> Interval {
        let given = match e.kind {
            ExprKind::Var(id) => self.given.get(id).copied().unwrap_or(Interval::ANY),
            _ => Interval::ANY,
        };
        given.and(e.range)
    }

    /// Walks what is called with some arguments.
    fn called(&mut self, args: &[Expr], walk: impl FnOnce(&mut Self)) {
        let given = args.iter().map(|arg| self.range(arg)).collect();
        let outer = std::mem::replace(&mut self.given, given);
        walk(self);
        self.given = outer;
    }

    /// What an overlay keeps is limited too, and what it calls; that nothing else is set in it is right.
    fn overlay(&mut self, id: usize) {
        let given = self.given.iter().map(|range| (range.low.to_bits(), range.high.to_bits())).collect();
        if !self.overlays_seen.insert((id, given)) {
            return;
        }
        match &self.hir.activities[id].body {
            Body::Sequence(block) => {
                let mut timed = Vec::new();
                block.each(&mut |stmt| {
                    if let StmtKind::Timed(inner) = &stmt.kind {
                        timed.push((&inner.action, stmt.span));
                    }
                });
                for (action, span) in timed {
                    match action {
                        Action::Keep(channel, e) => self.limited(*channel, e),
                        Action::Call(id, args) => {
                            self.findings.called(self.hir, *id, span);
                            self.called(args, |walk| walk.overlay(*id));
                            self.findings.back();
                        }
                        _ => {}
                    }
                }
            }
            Body::Table { behaviors, .. } => behaviors.iter().for_each(|&b| self.overlay(b)),
            Body::Amend { .. } => {}
        }
    }

    fn block(&mut self, block: &Block, owners: Owners) {
        for stmt in &block.stmts {
            match &stmt.kind {
                StmtKind::With(items, body) => {
                    let inner = self.with(items, owners);
                    self.block(body, inner);
                }
                StmtKind::Timed(timed) => self.timed(timed, owners, stmt.span),
                _ => stmt.blocks().into_iter().for_each(|block| self.block(block, owners)),
            }
        }
    }

    fn timed(&mut self, timed: &Timed, mut owners: Owners, span: Span) {
        for (channel, e) in &timed.at {
            self.limited(*channel, e);
            self.own(&mut owners, channel.row().axis, Owner::Setpoint, e.span);
        }
        let (vertical, speed) = match &timed.action {
            Action::Call(id, args) => {
                self.findings.called(self.hir, *id, span);
                self.called(args, |walk| walk.activity(*id, owners));
                self.findings.back();
                return;
            }
            Action::Override(inner) => return self.block(&inner.block, owners),
            Action::Watch | Action::Ask(..) => (false, false),
            Action::Guide(guide, _) => (guide.law().needs_vertical, guide.law().needs_speed),
            // What is kept is its own setpoint. In an overlay nothing else is needed.
            Action::Keep(channel, e) => {
                self.limited(*channel, e);
                self.own(&mut owners, channel.row().axis, Owner::Setpoint, e.span);
                (false, false)
            }
        };
        if vertical && owners[Axis::Vertical as usize] == Owner::Nobody {
            self.findings.report(
                Diagnostic::error(Code::ChannelsUnset, span, "how deep? neither depth nor altitude is set here")
                    .help("write `at depth 3 m` after it, or `with altitude 2 m` around it"),
            );
        }
        if speed && owners[Axis::Speed as usize] == Owner::Nobody {
            self.findings.report(
                Diagnostic::error(Code::ChannelsUnset, span, "how fast? no speed is set here")
                    .help("write `at speed 1.5 m/s` after it, or `with speed 1.5 m/s` around it"),
            );
        }
    }
}
