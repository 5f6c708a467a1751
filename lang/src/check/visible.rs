//! The names of variables that code can see, found without looking at all of them.

use crate::hir::VarId;
use std::collections::BTreeMap;

/// Names in the order in which they became known: a block forgets those that it has brought.
#[derive(Default)]
pub(super) struct Visible {
    names: Vec<(String, VarId)>,
    /// Where in `names` each name stands; nothing can be shadowed, and where something is, the last counts.
    places: BTreeMap<String, Vec<usize>>,
}

impl Visible {
    pub fn push(&mut self, name: String, id: VarId) {
        self.places.entry(name.clone()).or_default().push(self.names.len());
        self.names.push((name, id));
    }

    pub fn get(&self, name: &str) -> Option<VarId> {
        let place = self.places.get(name)?.last()?;
        self.names.get(*place).map(|&(_, id)| id)
    }

    pub fn len(&self) -> usize {
        self.names.len()
    }

    pub fn truncate(&mut self, length: usize) {
        for (name, _) in self.names.drain(length.min(self.names.len())..) {
            if let Some(places) = self.places.get_mut(&name) {
                places.pop();
            }
        }
    }

    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.names.iter().map(|(name, _)| name.as_str())
    }
}
