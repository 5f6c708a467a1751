//! The digest of the full-rate run: of each tick its number, how the link lags, every sample, what the vehicle was told last, every
//! event but the beginnings of statements and the results of activities, and every answer of its payload, in the form that `Digest::value_of` states. Notices are no part of it, for when they come is no matter of the run.

use super::Recorder;
use albacore_machine::Event;
use albacore_trace::Digest;
use albacore_trace::{Step, TickRecord};
use albacore_vehicle::Command;

/// Folds the digest.
#[derive(Default)]
pub(crate) struct RunDigest {
    digest: Digest,
    /// The vehicle goes on with what it was told last.
    command: Option<Command>,
}

impl RunDigest {
    /// Of all that was taken in so far.
    pub fn value(&self) -> u64 {
        self.digest.value()
    }
}

impl Recorder for RunDigest {
    fn take(&mut self, record: &TickRecord) {
        match record.step {
            Step::Tick => {}
            Step::End(_) if !record.events.is_empty() => {}
            _ => return,
        }
        self.command = record.command.or(self.command);
        let TickRecord { tick, snapshot, events, .. } = record;
        // Beginnings and results are told, and follow from all else.
        let follows = |event: &Event| matches!(event, Event::Began(..) | Event::Finished(..));
        let events: Vec<&Event> = events.iter().filter(|event| !follows(event)).collect();
        let known = self.digest.value_of(&(tick, snapshot.lag, &snapshot.samples, self.command, events));
        debug_assert!(known.is_ok(), "all of it has a length");
        // A run whose payload says nothing is the run that it is without one.
        if !snapshot.answers.is_empty() {
            let known = self.digest.value_of(&snapshot.answers);
            debug_assert!(known.is_ok(), "all of it has a length");
        }
    }
}
