//! Which conditions decided in a tick, and what they were made of: for whoever asks why.

use crate::state::Run;
use albacore_program::{ActivityId, Body, Entry, Exit, Program, Slot, Terms, WatchedCode};

/// A condition of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Condition {
    /// That of a rule, as it applies to a behavior: one of its exits.
    Exit(ActivityId, u32),
    /// One of those that abort, of an activity.
    Abort(ActivityId, u32),
}

/// A condition that was tried in a tick.
#[derive(Clone, Debug, PartialEq)]
pub struct Tried {
    /// Which.
    pub condition: Condition,
    /// Whether the behavior had come to its end in this tick.
    pub done: bool,
    /// Whether it held.
    pub holds: bool,
    /// The words of its watched values, one after the other.
    pub values: Vec<f64>,
    /// A word for each of its terms, as [`Terms`] has them; empty where it is one itself.
    pub terms: Vec<f64>,
}

impl Condition {
    /// Where a program has it in a table, if it is a rule's.
    pub fn exit(self, p: &Program) -> Option<&Exit> {
        let Condition::Exit(behavior, at) = self else { return None };
        let is_of = |entry: &&Entry| entry.activity == behavior;
        let tables = p.activities.iter().filter_map(|activity| match &activity.body {
            Body::Table(table) => Some(table),
            _ => None,
        });
        tables.flat_map(|table| &table.behaviors).find(is_of)?.exits.get(at as usize)
    }

    /// The values that are told of it, and its terms.
    pub fn told(self, p: &Program, done: bool) -> (&[WatchedCode], Option<&Terms>) {
        match self {
            Condition::Exit(..) => match self.exit(p) {
                Some(exit) if done => (&exit.watched, exit.terms_done.as_ref()),
                Some(exit) => (&exit.watched, exit.terms.as_ref()),
                None => (&[], None),
            },
            Condition::Abort(id, at) => {
                let abort = p.activities.get(id as usize).and_then(|activity| activity.aborts.get(at as usize));
                abort.map_or((&[], None), |abort| (&abort.watched, abort.terms.as_ref()))
            }
        }
    }
}

impl Run {
    /// Takes down a condition that was tried.
    pub(crate) fn note_tried(&mut self, p: &Program, condition: Condition, done: bool, holds: bool, base: Slot) {
        let (watched, terms) = condition.told(p, done);
        let values = self.values(p, watched, base);
        let terms = terms.map_or_else(Vec::new, |terms| {
            self.execute(p, terms.code.entry, base);
            self.slice(base + terms.code.value, terms.texts.len() as u32).to_vec()
        });
        self.tried.get_or_insert_default().push(Tried { condition, done, holds, values, terms });
    }

    /// The words of some values, one after the other.
    pub(crate) fn values(&mut self, p: &Program, watched: &[WatchedCode], base: Slot) -> Vec<f64> {
        let mut values = Vec::new();
        for watched in watched {
            self.execute(p, watched.code.entry, base);
            values.extend_from_slice(self.slice(base + watched.code.value, watched.shape.words()));
        }
        values
    }
}
