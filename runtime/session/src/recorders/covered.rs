//! Which behaviors a run enters, and which of their transitions fire.

use super::Recorder;
use albacore_machine::Event;
use albacore_program::ActivityId;
use albacore_trace::TickRecord;
use std::collections::BTreeSet;

/// What of a program runs have come to.
#[derive(Clone, Debug, Default)]
pub(crate) struct Covered {
    /// The activities that were entered.
    pub entered: BTreeSet<ActivityId>,
    /// The exits that fired: the behavior that was active, and which of its exits.
    pub fired: BTreeSet<(ActivityId, u32)>,
}

impl Covered {
    /// Adds what other runs have come to: in which order does not matter.
    pub fn add(&mut self, other: Covered) {
        self.entered.extend(other.entered);
        self.fired.extend(other.fired);
    }
}

impl Recorder for Covered {
    fn take(&mut self, record: &TickRecord) {
        for event in &record.events {
            match event {
                Event::Entered(id) => _ = self.entered.insert(*id),
                Event::Switched { from, exit, .. } => _ = self.fired.insert((*from, *exit)),
                _ => {}
            }
        }
    }
}
