//! Which activities are active, outermost first, as the events of a run tell it.

use crate::names::runs_beside;
use albacore_machine::Event;
use albacore_program::{ActivityId, Program};

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

    /// Takes in what happened.
    pub fn follow(&mut self, event: &Event, program: &Program) {
        match event {
            Event::Entered(id) | Event::Left(id, _) | Event::Suspended(id) | Event::Resumed(id)
                if runs_beside(program, *id) => {}
            Event::Entered(id) => self.enter(*id),
            Event::Left(id, _) => self.leave(*id),
            Event::Suspended(id) => self.suspend(*id),
            Event::Resumed(id) => self.resume(*id),
            _ => {}
        }
    }

    /// Innermost from now on.
    fn enter(&mut self, id: ActivityId) {
        self.chain.push(id);
    }

    /// Gone, whether it was active or waiting. Only itself: what was inside has its own leaving, before or after.
    fn leave(&mut self, id: ActivityId) {
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
    fn suspend(&mut self, id: ActivityId) {
        if let Some(at) = self.chain.iter().rposition(|&active| active == id) {
            self.waiting.push(self.chain.split_off(at));
        }
    }

    /// Taken up again, with all that was active in it.
    fn resume(&mut self, id: ActivityId) {
        if let Some(at) = self.waiting.iter().rposition(|group| group.first() == Some(&id)) {
            self.chain.extend(self.waiting.remove(at));
        }
    }
}
