//! Where something first stands in an activity and all that it calls.

use super::{Action, Activity, ActivityId, Body, Hir, Stmt, StmtKind};
use crate::source::Span;
use std::collections::BTreeMap;

/// Finds the first place of something, by a function that finds it in an activity's own text. Each activity is looked at once, however many
/// are asked for that call it.
pub struct First<'h, F> {
    hir: &'h Hir,
    own: F,
    known: BTreeMap<ActivityId, Option<Span>>,
}

impl<'h, F: Fn(&Activity) -> Option<Span>> First<'h, F> {
    /// Nothing is found yet.
    pub fn new(hir: &'h Hir, own: F) -> Self {
        First { hir, own, known: BTreeMap::new() }
    }

    /// The first place in an activity: its own come before those of what it calls.
    pub fn of(&mut self, id: ActivityId) -> Option<Span> {
        if let Some(known) = self.known.get(&id) {
            return *known;
        }
        // What calls itself, which is an error of its own, finds nothing there.
        self.known.insert(id, None);
        let activity = &self.hir.activities[id];
        let first = (self.own)(activity).or_else(|| activity.calls().into_iter().find_map(|called| self.of(called)));
        self.known.insert(id, first);
        first
    }
}

impl Hir {
    /// Where a mission watches or overrides, if it does: then it is a guest of its vehicle.
    pub fn first_watch(&self, mission: ActivityId) -> Option<Span> {
        First::new(self, |activity| activity.first_action(is_control)).of(mission)
    }
}

/// Whether an action is a guest's: it leaves the vehicle to itself, or takes it over.
pub fn is_control(action: &Action) -> bool {
    matches!(action, Action::Watch | Action::Override(_))
}

impl Activity {
    /// The first statement of its own that does such a thing.
    pub fn first_action(&self, is_such: impl Fn(&Action) -> bool) -> Option<Span> {
        self.body.first(|stmt| matches!(&stmt.kind, StmtKind::Timed(timed) if is_such(&timed.action)))
    }
}

impl Body {
    /// Calls `f` on every statement, each before those of the blocks inside it. A table has none: its behaviors have.
    pub fn each<'b>(&'b self, f: &mut dyn FnMut(&'b Stmt)) {
        if let Body::Sequence(block) = self {
            block.each(f);
        }
    }

    /// Where the first such statement stands.
    pub fn first(&self, is_such: impl Fn(&Stmt) -> bool) -> Option<Span> {
        let mut found = None;
        self.each(&mut |stmt| {
            if found.is_none() && is_such(stmt) {
                found = Some(stmt.span);
            }
        });
        found
    }
}
