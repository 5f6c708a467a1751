//! Which activities are active, outermost first, and what they are doing, as the events of a run tell it.

use crate::names::runs_beside;
use albacore_machine::Event;
use albacore_program::{ActivityId, Program};
use std::collections::BTreeMap;

/// A statement that has begun: which, and how far the loops around it were.
type Begun = (u32, Vec<f64>);

/// The chain of active activities, and those that wait (`then back`).
#[derive(Clone, Debug, Default)]
pub struct Active {
    chain: Vec<ActivityId>,
    /// Each a behavior and all that was active in it.
    waiting: Vec<Vec<ActivityId>>,
    /// What each does now, and by which call in a loop each was entered.
    doing: BTreeMap<ActivityId, Begun>,
    called: BTreeMap<ActivityId, Begun>,
    /// A call that has begun, and has not entered anything yet.
    calls: Option<Begun>,
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

    /// The names of the chain, with how far the loops are in which each was called, and last the statement that the innermost does.
    pub fn under_way(&self, program: &Program) -> Vec<String> {
        let told = |begun: &Begun| Some(program.statements.get(begun.0 as usize)?.told(&begun.1));
        let name = |id: &ActivityId| {
            let name = program.activities.get(*id as usize).map_or("?", |activity| &activity.name);
            match self.called.get(id).and_then(told) {
                Some(rounds) => format!("{name} ({rounds})"),
                None => name.to_string(),
            }
        };
        let doing = self.chain.last().and_then(|id| self.doing.get(id)).and_then(told);
        self.chain.iter().map(name).chain(doing).collect()
    }

    /// Takes in what happened.
    pub fn follow(&mut self, event: &Event, program: &Program) {
        match event {
            Event::Entered(id) | Event::Left(id, _) | Event::Suspended(id) | Event::Resumed(id)
                if runs_beside(program, *id) => {}
            Event::Entered(id) => self.enter(*id),
            Event::Began(statement, words) => {
                let begun = (*statement, words.clone());
                if program.statements.get(*statement as usize).is_some_and(|statement| statement.is_call) {
                    self.calls = Some(begun);
                } else if let Some(inner) = self.chain.last() {
                    self.doing.insert(*inner, begun);
                }
            }
            // What is asked and answered takes the place of the statement before.
            Event::Asked(_) => _ = self.chain.last().map(|inner| self.doing.remove(inner)),
            Event::Left(id, _) => self.leave(*id),
            Event::Suspended(id) => self.suspend(*id),
            Event::Resumed(id) => self.resume(*id),
            _ => {}
        }
    }

    /// Innermost from now on.
    fn enter(&mut self, id: ActivityId) {
        // A call takes the place of what its caller did before.
        if let Some(caller) = self.chain.last() {
            self.doing.remove(caller);
        }
        self.doing.remove(&id);
        self.called.remove(&id);
        self.called.extend(self.calls.take().map(|begun| (id, begun)));
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
