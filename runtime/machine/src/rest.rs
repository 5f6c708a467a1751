//! Switching without rest: rules that undo each other, or that are due again whenever what they led to is done, keep a vehicle busy and get it
//! nowhere. What no check foresees is told here, while it happens.

use crate::Event;
use albacore_program::ActivityId;
use serde::{Deserialize, Serialize};

/// A tick in which a rule fires adds so much, one in which none does takes one away: more than every fourth tick is too often.
const SWITCH: u32 = 3;
/// As much as makes a mission restless: 2 s of switches on every tick, 6 s on every other.
const RESTLESS: u32 = 60;
/// A behavior that goes on and is left in the next tick by the rule that had it wait, so often in a row, gets nowhere.
const STARVED: u32 = 5;

/// How often rules have fired of late.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Rest {
    level: u32,
    is_restless: bool,
    /// The rule that fired last, and which behavior it left.
    last: Option<(u32, ActivityId)>,
    /// The behavior that went on in the last tick.
    resumed: Option<ActivityId>,
    starved: u32,
    is_starved: bool,
}

impl Rest {
    /// A tick with these events is over. Tells when switching without rest begins, and when it has ended.
    pub fn tick(&mut self, events: &[Event]) -> Option<Event> {
        let switched = events.iter().rev().find_map(|event| match event {
            Event::Switched { rule, from, .. } => Some((*rule, *from)),
            _ => None,
        });
        self.level = match switched {
            Some(_) => (self.level + SWITCH).min(RESTLESS),
            None => self.level.saturating_sub(1),
        };
        self.count_starved(events);
        let was_told = self.is_restless || self.is_starved;
        self.is_restless = if self.is_restless { self.level > 0 || switched.is_some() } else { self.level == RESTLESS };
        self.is_starved = if self.is_starved { self.starved > 0 } else { self.starved == STARVED };
        match (was_told, self.is_restless || self.is_starved) {
            (false, true) => switched.map(|(rule, _)| Event::Restless(rule)),
            (true, false) => Some(Event::Settled),
            _ => None,
        }
    }

    /// Counts how often in a row a behavior that goes on is left at once, by the rule that had it wait.
    fn count_starved(&mut self, events: &[Event]) {
        let mut went_on = self.resumed.take();
        for event in events {
            match event {
                Event::Resumed(behavior) => self.resumed = Some(*behavior),
                Event::Switched { rule, from, .. } => {
                    let is_at_once = self.resumed.take().or(went_on.take()) == Some(*from);
                    let is_again = is_at_once && self.last == Some((*rule, *from));
                    self.starved = if is_again { (self.starved + 1).min(STARVED) } else { 0 };
                    self.last = Some((*rule, *from));
                }
                _ => {}
            }
        }
        if went_on.is_some() {
            self.starved = 0;
        }
    }
}
