//! One owner for each channel on every way that leads to a statement: speed and vertical are set, and set once.

use super::limits::{self, Limit};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{Action, Block, Body, Decl, Expr, Hir, Kind, StmtKind, Timed, With};
use crate::source::Span;
use albacore_program::{Channel, Guide};
use std::collections::BTreeSet;

/// A finding names this many places at most.
const PLACES_MAX: usize = 4;

/// Who owns a channel here.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Owner {
    Nobody,
    /// A setpoint: an inner one takes its place.
    Setpoint,
    /// An overlay, put on here: nothing may take its place.
    Overlay(Span),
}

/// The owners of the two channels that guidance does not set itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Owners {
    vertical: Owner,
    speed: Owner,
}

struct Walk<'a> {
    hir: &'a Hir,
    /// The mission's limits.
    limits: Vec<Limit>,
    /// The calls that lead here.
    path: Vec<(String, Span)>,
    seen: BTreeSet<(usize, Owners)>,
    findings: Vec<Diagnostic>,
}

/// Walks all ways from a mission to its statements.
pub(super) fn check(hir: &Hir, mission: usize) -> Vec<Diagnostic> {
    let limits = limits::of(hir, mission);
    let mut walk = Walk { hir, limits, path: Vec::new(), seen: BTreeSet::new(), findings: Vec::new() };
    walk.activity(mission, Owners { vertical: Owner::Nobody, speed: Owner::Nobody });
    walk.findings
}

impl Walk<'_> {
    pub(super) fn activity(&mut self, id: usize, mut owners: Owners) {
        if !self.seen.insert((id, owners)) {
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
                    self.own(&mut owners, *channel, Owner::Setpoint, e.span);
                }
                With::Overlay(id, _, place) => {
                    if let Kind::Sets(channel) = self.hir.activities[*id].kind {
                        self.own(&mut owners, channel, Owner::Overlay(*place), *place);
                    }
                    self.overlay(*id);
                }
            }
        }
        owners
    }

    /// Gives a channel a new owner; one that an overlay owns cannot be given away.
    fn own(&mut self, owners: &mut Owners, channel: Channel, owner: Owner, span: Span) {
        let (slot, name) = match channel {
            Channel::Speed => (&mut owners.speed, "speed"),
            _ => (&mut owners.vertical, "vertical channel"),
        };
        if let Owner::Overlay(earlier) = *slot {
            let finding =
                Diagnostic::error(Code::ChannelsTwice, span, format!("the {name} belongs to an overlay here"))
                    .label(earlier, "put on here")
                    .help(match owner {
                        Owner::Overlay(_) => "take one of the two overlays off",
                        _ => "take the overlay off, or leave the setpoint out",
                    });
            self.tell(finding);
            return;
        }
        *slot = owner;
    }

    /// A setpoint that no limit lets through.
    fn limited(&mut self, channel: Channel, setpoint: &Expr) {
        if let Some(finding) = limits::beyond(&self.limits, channel, setpoint) {
            self.tell(finding);
        }
    }

    /// What an overlay keeps is limited too; that nothing else is set in it is right.
    fn overlay(&mut self, id: usize) {
        let mut kept = Vec::new();
        if let Body::Sequence(block) = &self.hir.activities[id].body {
            block.each(&mut |stmt| {
                if let StmtKind::Timed(timed) = &stmt.kind
                    && let Action::Keep(channel, e) = &timed.action
                {
                    kept.push((*channel, e));
                }
            });
        }
        kept.into_iter().for_each(|(channel, e)| self.limited(channel, e));
    }

    fn tell(&mut self, mut finding: Diagnostic) {
        // One missing setpoint leaves many statements without: one mistake, shown where it first tells and in some more places.
        let span = finding.span();
        if let Some(told) = self.findings.iter_mut().find(|f| f.code == finding.code && f.message == finding.message) {
            if told.labels.len() < PLACES_MAX && !told.labels.iter().any(|(s, _)| *s == span) {
                told.labels.push((span, "and here".to_string()));
            }
            return;
        }
        for (name, span) in self.path.iter().rev() {
            finding = finding.label(*span, format!("`{name}` is called here"));
        }
        self.findings.push(finding);
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
            self.own(&mut owners, *channel, Owner::Setpoint, e.span);
        }
        let (vertical, speed) = match &timed.action {
            Action::Call(id, _) => {
                self.path.push((self.hir.activities[*id].full_name.clone(), span));
                self.activity(*id, owners);
                self.path.pop();
                return;
            }
            Action::Override(inner) => return self.block(&inner.block, owners),
            // A pause goes on as before; standing still needs no speed.
            Action::Guide(Guide::Wait, _) | Action::Watch => (false, false),
            Action::Guide(Guide::Hold, _) => (true, false),
            Action::Guide(..) => (true, true),
            // What is kept is its own setpoint. In an overlay nothing else is needed.
            Action::Keep(channel, e) => {
                self.limited(*channel, e);
                (false, false)
            }
        };
        if vertical && owners.vertical == Owner::Nobody {
            self.tell(
                Diagnostic::error(Code::ChannelsUnset, span, "how deep? neither depth nor altitude is set here")
                    .help("write `at depth 3 m` after it, or `with altitude 2 m` around it"),
            );
        }
        if speed && owners.speed == Owner::Nobody {
            self.tell(
                Diagnostic::error(Code::ChannelsUnset, span, "how fast? no speed is set here")
                    .help("write `at speed 1.5 m/s` after it, or `with speed 1.5 m/s` around it"),
            );
        }
    }
}
