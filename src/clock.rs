//! The wall clock, which only the command line may read, and keeping time by it.

use serde::{Serialize, Serializer};
use std::time::{Duration, Instant, SystemTime};

/// Seconds of a vehicle's time in a tick.
pub const TICK: Duration = Duration::from_millis(100);

/// Now.
#[expect(clippy::disallowed_methods, reason = "how long something took on the wall is no part of any result")]
pub fn now() -> Instant {
    Instant::now()
}

/// A moment of Coordinated Universal Time.
#[derive(Clone, Copy)]
pub struct Utc(SystemTime);

impl Utc {
    /// Now.
    #[expect(clippy::disallowed_methods, reason = "when a run was by the wall clock is no part of what it does")]
    pub fn now() -> Self {
        Utc(SystemTime::now())
    }

    /// `2026-11-22T10-31-05Z`: no file system minds it, and names are in the order of time.
    pub fn file_name(self) -> String {
        humantime::format_rfc3339_seconds(self.0).to_string().replace(':', "-")
    }
}

impl Serialize for Utc {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(&humantime::format_rfc3339_millis(self.0))
    }
}

/// How many times faster than real time, as `--rate` has it.
pub fn rate(text: &str) -> Result<f64, String> {
    let rate = text.parse::<f64>().ok().filter(|rate| (0.1..=1000.0).contains(rate));
    rate.ok_or_else(|| "write a number from 0.1 to 1000: `1` is real time, `50` fifty times faster".to_string())
}

/// The moments at which ticks are due.
pub struct Pace {
    next: Instant,
    period: Duration,
}

impl Pace {
    /// So many times faster than real time, from now on.
    pub fn new(rate: f64) -> Self {
        Pace { next: now(), period: TICK.div_f64(rate) }
    }

    /// How long until the next tick is due, when it should come no faster than real time or as fast as was said.
    pub fn left(&self, in_real_time: bool) -> Duration {
        let slack = if in_real_time { TICK.saturating_sub(self.period) } else { Duration::ZERO };
        (self.next + slack).saturating_duration_since(now())
    }

    /// A tick begins. One that is late does not make the others hurry.
    pub fn begin(&mut self) {
        self.next = now().max(self.next) + self.period;
    }
}
