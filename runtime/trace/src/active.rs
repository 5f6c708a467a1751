//! Which activities are active, outermost first, as the events of a run tell it.

use albacore_program::ActivityId;

/// The chain of active activities, and those that wait (`then back`).
#[derive(Clone, Debug, Default)]
pub struct Active {
    chain: Vec<ActivityId>,
    /// Each a behavior and all that was active in it.
    waiting: Vec<Vec<ActivityId>>,
}

impl Active {
    /// From outside in.
    pub fn chain(&self) -> &[ActivityId] {
        &self.chain
    }

    /// How deep an activity is; as deep as the next would be when it is not active.
    pub fn depth(&self, id: ActivityId) -> usize {
        self.chain.iter().rposition(|&active| active == id).unwrap_or(self.chain.len())
    }

    /// Innermost from now on.
    pub fn enter(&mut self, id: ActivityId) {
        self.chain.push(id);
    }

    /// Gone, whether it was active or waiting. Only itself: what was inside has its own leaving, before or after.
    pub fn leave(&mut self, id: ActivityId) {
        if let Some(at) = self.chain.iter().rposition(|&active| active == id) {
            self.chain.remove(at);
            return;
        }
        for group in &mut self.waiting {
            group.retain(|&waits| waits != id);
        }
        self.waiting.retain(|group| !group.is_empty());
    }

    /// Set aside, with all that is active in it.
    pub fn suspend(&mut self, id: ActivityId) {
        if let Some(at) = self.chain.iter().rposition(|&active| active == id) {
            self.waiting.push(self.chain.split_off(at));
        }
    }

    /// Taken up again, with all that was active in it.
    pub fn resume(&mut self, id: ActivityId) {
        if let Some(at) = self.waiting.iter().rposition(|group| group.first() == Some(&id)) {
            self.chain.extend(self.waiting.remove(at));
        }
    }
}
