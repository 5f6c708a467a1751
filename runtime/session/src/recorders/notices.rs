//! What a person should hear of the vehicle and the link while a run goes on.

use super::{Recorder, missed};
use albacore_trace::{Step, TickRecord};

/// Notices that wait to be taken; the oldest are dropped.
const NOTICES_MAX: usize = 64;

/// The notices that nobody has taken yet.
#[derive(Default)]
pub(crate) struct Notices(Vec<String>);

impl Notices {
    /// Taken once.
    pub fn take_all(&mut self) -> Vec<String> {
        std::mem::take(&mut self.0)
    }
}

impl Recorder for Notices {
    fn take(&mut self, record: &TickRecord) {
        self.0.extend_from_slice(&record.notices);
        let surplus = self.0.len().saturating_sub(NOTICES_MAX);
        self.0.drain(..surplus);
        if let Step::End(ending) = &record.step {
            self.0.extend(ending.trouble.clone());
        }
    }

    fn miss(&mut self, steps: u64, _: u64) {
        self.0.push(missed(steps));
    }
}
