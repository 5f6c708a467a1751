//! Switching without rest: rules that undo each other keep a vehicle busy and get it nowhere. What no check foresees is told
//! here, while it happens.

use crate::Event;
use serde::{Deserialize, Serialize};

/// A tick in which a rule fires adds so much, one in which none does takes one away: more than every fourth tick is too often.
const SWITCH: u32 = 3;
/// As much as makes a mission restless: 2 s of switches on every tick, 6 s on every other.
const RESTLESS: u32 = 60;

/// How often rules have fired of late.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Rest {
    level: u32,
    is_restless: bool,
}

impl Rest {
    /// A tick with these events is over. Tells when switching without rest begins, and when it has ended.
    pub fn tick(&mut self, events: &[Event]) -> Option<Event> {
        let switched = events.iter().rev().find_map(|event| match event {
            Event::Switched { rule, .. } => Some(*rule),
            _ => None,
        });
        self.level = match switched {
            Some(_) => (self.level + SWITCH).min(RESTLESS),
            None => self.level.saturating_sub(1),
        };
        match switched {
            Some(rule) if self.level == RESTLESS && !self.is_restless => {
                self.is_restless = true;
                Some(Event::Restless(rule))
            }
            None if self.level == 0 && self.is_restless => {
                self.is_restless = false;
                Some(Event::Settled)
            }
            _ => None,
        }
    }
}
