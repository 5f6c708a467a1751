//! The digest of the full-rate run: every sample, every command, every event. Notices are no part of it, for when they come is no
//! matter of the run.

use super::Recorder;

use albacore_trace::{Digest, Step, TickRecord};
use albacore_vehicle::{Command, Lag, Vertical};

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
        let digest = &mut self.digest;
        digest.word(record.tick);
        let Lag { round_trip, host } = record.snapshot.lag;
        if record.snapshot.lag != Lag::default() {
            digest.word(round_trip);
            digest.word(host.unwrap_or(0));
        }
        for sample in &record.snapshot.samples {
            digest.word(u64::from(sample.channel));
            digest.numbers(&sample.reading);
        }
        if let Some(command) = self.command {
            digest.number(command.heading.radians());
            digest.number(command.speed);
            match command.vertical {
                Vertical::Depth(metres) => digest.number(metres),
                Vertical::Altitude(metres) => digest.number(-metres),
            }
        }
        for event in &record.events {
            digest.text(&format!("{event:?}"));
        }
    }
}
