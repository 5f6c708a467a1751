//! Rule 14: conditions over time, each watched from the start of the activation or statement that it is written in.

use super::expr::{Frame, Scope, holds, number};
use super::world::{World, ticks};
use albacore_lang::hir::{Expr, ExprKind, children};
use std::collections::BTreeMap;

/// The conditions over time in some expressions, inner ones first.
#[derive(Clone, Default)]
pub struct Watch<'p> {
    watched: Vec<Watched<'p>>,
    /// The age of the activation when the watch began.
    from: u64,
}

#[derive(Clone)]
struct Watched<'p> {
    node: &'p Expr,
    /// `X for T`: the age since which X has held.
    since: Option<u64>,
    /// `becomes X`: whether X held on the tick before. At entry it has not just become true.
    before: bool,
    says: bool,
}

impl<'p> Watch<'p> {
    pub fn begin(w: &mut World<'p>, frame: &Frame<'p>, conditions: &[&'p Expr], age: u64) -> Self {
        let mut nodes = Vec::new();
        conditions.iter().for_each(|condition| over_time(condition, &mut nodes));
        let watched = |node| Watched { node, since: None, before: true, says: false };
        let mut watch = Watch { watched: nodes.into_iter().map(watched).collect(), from: age };
        watch.update(w, frame, age);
        watch
    }

    /// Once a tick, even behind a false `and`.
    pub fn update(&mut self, w: &mut World<'p>, frame: &Frame<'p>, age: u64) {
        for i in 0..self.watched.len() {
            let scope = Scope { frame, watch: Some(&*self), done: false };
            let mut watched = self.watched[i].clone();
            match &watched.node.kind {
                ExprKind::HeldFor(x, time) => {
                    let held = holds(w, scope, x);
                    watched.since = if held { watched.since.or(Some(age)) } else { None };
                    let time = ticks(number(w, scope, time));
                    watched.says = watched.since.is_some_and(|since| age - since >= time);
                }
                ExprKind::Becomes(x) => {
                    let held = holds(w, scope, x);
                    watched.says = held && !watched.before;
                    watched.before = held;
                }
                ExprKind::After(time) => watched.says = age - self.from >= ticks(number(w, scope, time)),
                _ => {}
            }
            self.watched[i] = watched;
        }
    }

    /// The same for each `every`, whose clock is that of the activation which has the rule or the reaction.
    pub fn update_rhythms(&mut self, w: &mut World<'p>, frame: &Frame<'p>, rhythms: &Rhythms, age: u64) {
        for i in 0..self.watched.len() {
            if let ExprKind::Every(time) = &self.watched[i].node.kind {
                let time = ticks(number(w, Scope { frame, watch: Some(&*self), done: false }, time));
                self.watched[i].says = age - rhythms.last(self.watched[i].node) >= time;
            }
        }
    }

    /// What a condition over time said when it was updated last.
    pub fn says(&self, node: &Expr) -> bool {
        self.watched.iter().any(|watched| std::ptr::eq(watched.node, node) && watched.says)
    }
}

/// The age at which what an `every` stands in fired last, by its node. None: not since entry.
#[derive(Default)]
pub struct Rhythms(BTreeMap<*const Expr, u64>);

impl Rhythms {
    fn last(&self, node: &Expr) -> u64 {
        self.0.get(&std::ptr::from_ref(node)).copied().unwrap_or(0)
    }

    /// What has this condition fires at an age: each `every` in it counts anew.
    pub fn fire(&mut self, condition: &Expr, age: u64) {
        children(condition, &mut |child| self.fire(child, age));
        if matches!(condition.kind, ExprKind::Every(_)) {
            self.0.insert(std::ptr::from_ref(condition), age);
        }
    }
}

fn over_time<'p>(e: &'p Expr, found: &mut Vec<&'p Expr>) {
    children(e, &mut |child| over_time(child, found));
    if matches!(e.kind, ExprKind::HeldFor(..) | ExprKind::Becomes(_) | ExprKind::After(_) | ExprKind::Every(_)) {
        found.push(e);
    }
}
