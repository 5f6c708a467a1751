//! Temporal operators: each has a place in the frame, is set back when its watch begins and updated at every tick.

use super::Lowering;
use crate::hir::{Activity, Expr, ExprKind, InputPart, children};
use albacore_arithmetic::Operator;
use albacore_program::{Compute, Slot};

/// A temporal operator in place.
pub(super) enum Timer<'e> {
    HeldFor { node: &'e Expr, since: Slot, value: Slot },
    Becomes { node: &'e Expr, before: Slot, value: Slot },
    After { node: &'e Expr, value: Slot },
    Every { node: &'e Expr, last: Slot, value: Slot },
}

impl<'a> Lowering<'a> {
    /// Gives every temporal operator of some expressions its place. Inner ones come first.
    pub(super) fn place_timers<'e>(&mut self, conditions: impl IntoIterator<Item = &'e Expr>) -> Vec<Timer<'e>> {
        let mut nodes = Vec::new();
        for condition in conditions {
            temporal_nodes(condition, &mut nodes);
        }
        let mut timers = Vec::new();
        for node in nodes {
            let value = self.lasting(1);
            self.frame.timers.insert(std::ptr::from_ref(node) as usize, value);
            timers.push(match &node.kind {
                ExprKind::HeldFor(..) => Timer::HeldFor { node, since: self.lasting(1), value },
                ExprKind::Becomes(_) => Timer::Becomes { node, before: self.lasting(1), value },
                ExprKind::Every(_) => Timer::Every { node, last: self.last_fired(node), value },
                _ => Timer::After { node, value },
            });
        }
        timers
    }

    /// Code that sets timers back: nothing has held yet, and nothing has just become true.
    pub(super) fn reset_timers(&mut self, timers: &[Timer]) {
        for timer in timers {
            match timer {
                Timer::HeldFor { since, .. } => _ = self.emit(Compute::Const { to: *since, value: -1.0 }),
                Timer::Becomes { before, .. } => _ = self.emit(Compute::Const { to: *before, value: 1.0 }),
                Timer::After { .. } | Timer::Every { .. } => {}
            }
        }
    }

    /// Gives each `every` of an activity's rules and reactions its place.
    pub(super) fn place_rhythms(&mut self, activity: &Activity) -> Vec<Slot> {
        let nodes = activity.conditions_that_fire().flat_map(rhythms);
        nodes
            .map(|node| {
                let last = self.lasting(1);
                self.frame.rhythms.insert(std::ptr::from_ref(node) as usize, last);
                last
            })
            .collect()
    }

    /// Code for when a rule or a reaction of the activity fires: each `every` of its condition counts anew.
    pub(super) fn renew_rhythms(&mut self, on: &Expr) {
        for node in rhythms(on) {
            let (to, owner) = (self.last_fired(node), self.frame.header);
            self.emit(Compute::Now { to, owner });
        }
    }

    /// Where the age of the activity is at which what an `every` stands in fired last.
    fn last_fired(&mut self, node: &Expr) -> Slot {
        self.frame.rhythms.get(&(std::ptr::from_ref(node) as usize)).copied().unwrap_or_default()
    }

    /// Code that updates timers. They count by the age of the activity whose header is `owner`; `after` counts from
    /// `from`, or from entry.
    pub(super) fn update_timers(&mut self, timers: &[Timer], owner: Slot, from: Option<Slot>) {
        for timer in timers {
            self.scratch(|l| match timer {
                Timer::HeldFor { node, since, value } => {
                    let ExprKind::HeldFor(holds, duration) = &node.kind else { return };
                    let x = l.expr(holds);
                    let ticks = l.ticks(duration);
                    l.emit(Compute::HeldFor { to: *value, x, since: *since, ticks, owner });
                }
                Timer::Becomes { node, before, value } => {
                    let ExprKind::Becomes(holds) = &node.kind else { return };
                    let x = l.expr(holds);
                    l.emit(Compute::Becomes { to: *value, x, before: *before });
                }
                Timer::After { node, value } => {
                    let ExprKind::After(duration) = &node.kind else { return };
                    let ticks = l.ticks(duration);
                    let from = from.unwrap_or_else(|| l.number(0.0));
                    l.emit(Compute::Elapsed { to: *value, from, ticks, owner });
                }
                Timer::Every { node, last, value } => {
                    let ExprKind::Every(duration) = &node.kind else { return };
                    let ticks = l.ticks(duration);
                    // It is the activity's that has the rule, whichever behavior the rule would leave.
                    let owner = l.frame.header;
                    l.emit(Compute::Elapsed { to: *value, from: *last, ticks, owner });
                }
            });
        }
    }

    /// A duration in whole ticks.
    pub(super) fn ticks(&mut self, duration: &Expr) -> Slot {
        let seconds = self.expr(duration);
        let ticks = self.temp(1);
        self.emit(Compute::One { operator: Operator::Ticks, to: ticks, a: seconds });
        ticks
    }
}

/// The temporal operators of an expression, inner ones first.
fn temporal_nodes<'e>(e: &'e Expr, out: &mut Vec<&'e Expr>) {
    children(e, &mut |child| temporal_nodes(child, out));
    if matches!(e.kind, ExprKind::HeldFor(..) | ExprKind::Becomes(_) | ExprKind::After(_) | ExprKind::Every(_)) {
        out.push(e);
    }
}

/// Each `every` of a condition.
pub(super) fn rhythms(on: &Expr) -> Vec<&Expr> {
    let mut nodes = Vec::new();
    temporal_nodes(on, &mut nodes);
    nodes.retain(|node| matches!(node.kind, ExprKind::Every(_)));
    nodes
}

/// For each input the most samples that any `hits` of an activity counts back.
pub(super) fn samples_counted(activity: &Activity, kept: &mut [u32]) {
    activity.visit(&mut |e| {
        if let ExprKind::Input(id, InputPart::Hits(_, of)) = &e.kind {
            kept[*id] = kept[*id].max(*of);
        }
        true
    });
}
