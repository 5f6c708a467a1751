//! A sum of steps, and whose they are.

use crate::hir::ActivityId;
use std::collections::BTreeMap;

/// Steps by the activity that takes them.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Bill(BTreeMap<ActivityId, u64>);

impl Bill {
    /// So many steps of one activity.
    pub fn of(who: ActivityId, steps: u64) -> Self {
        Bill(BTreeMap::from([(who, steps)]))
    }

    /// All of it.
    pub fn total(&self) -> u64 {
        self.0.values().fold(0, |sum, steps| sum.saturating_add(*steps))
    }

    /// Who takes how much.
    pub fn shares(&self) -> impl Iterator<Item = (ActivityId, u64)> {
        self.0.iter().filter(|(_, steps)| **steps > 0).map(|(who, steps)| (*who, *steps))
    }

    /// Both.
    pub fn and(mut self, other: &Bill) -> Bill {
        for (who, steps) in &other.0 {
            let sum = self.0.entry(*who).or_default();
            *sum = sum.saturating_add(*steps);
        }
        self
    }

    /// The dearer of the two.
    pub fn or(self, other: Bill) -> Bill {
        if other.total() > self.total() { other } else { self }
    }
}
