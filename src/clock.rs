//! The wall clock, which only the command line may read, and keeping time by it.

use serde::{Serialize, Serializer};
use std::sync::LazyLock;
use std::time::{Duration, Instant, SystemTime};

/// Seconds of a vehicle's time in a tick.
pub const TICK: Duration = Duration::from_millis(100);

/// Now, since any moment: the host's one clock, by which silence, pauses and the end of a mission are told. It goes on while the machine
/// sleeps, as the vehicle does; `Instant` does not on Linux, and serves where there is no other.
pub fn now() -> Duration {
    with_sleep().unwrap_or_else(|| awake().duration_since(*BEGUN))
}

#[cfg(target_os = "linux")]
fn with_sleep() -> Option<Duration> {
    nix::time::clock_gettime(nix::time::ClockId::CLOCK_BOOTTIME).ok().map(Duration::from)
}

#[cfg(not(target_os = "linux"))]
fn with_sleep() -> Option<Duration> {
    None
}

static BEGUN: LazyLock<Instant> = LazyLock::new(awake);

#[expect(clippy::disallowed_methods, reason = "how long something took on the wall is no part of any result")]
fn awake() -> Instant {
    Instant::now()
}

/// The last second that is written with four digits of a year, since 1970.
const LAST_S: u64 = 253_402_300_799;

/// A moment of Coordinated Universal Time.
#[derive(Clone, Copy)]
pub struct Utc(SystemTime);

impl Utc {
    /// Now.
    #[expect(clippy::disallowed_methods, reason = "when a run was by the wall clock is no part of what it does")]
    pub fn now() -> Self {
        Utc::of(SystemTime::now())
    }

    /// A moment that can be written. A clock that nobody has set may stand before 1970.
    fn of(moment: SystemTime) -> Self {
        let last = SystemTime::UNIX_EPOCH + Duration::from_secs(LAST_S);
        Utc(moment.clamp(SystemTime::UNIX_EPOCH, last))
    }

    /// The moment that a text tells: `2026-11-22T10:31:05Z`.
    pub fn read(text: &str) -> Option<Self> {
        humantime::parse_rfc3339_weak(text).ok().map(Utc::of)
    }

    /// Milliseconds since the beginning of 1970.
    pub fn unix_ms(self) -> i64 {
        let since = self.0.duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
        i64::try_from(since.as_millis()).unwrap_or(i64::MAX)
    }

    /// So many seconds later.
    pub fn after(self, seconds: f64) -> Self {
        let later = Duration::try_from_secs_f64(seconds).ok().and_then(|later| self.0.checked_add(later));
        Utc::of(later.unwrap_or(self.0))
    }

    /// Seconds since midnight.
    pub fn second_of_day(self) -> f64 {
        const DAY_S: u64 = 86_400;
        let since = self.0.duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
        (since.as_secs() % DAY_S) as f64 + f64::from(since.subsec_millis()) / 1000.0
    }

    /// `14:31:05Z`.
    pub fn time_of_day(self) -> String {
        let text = humantime::format_rfc3339_seconds(self.0).to_string();
        text.split_once('T').map_or(text.clone(), |(_, time)| time.to_string())
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
    next: Duration,
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
        (self.next + slack).saturating_sub(now())
    }

    /// A tick begins. One that is late does not make the others hurry.
    pub fn begin(&mut self) {
        self.next = now().max(self.next) + self.period;
    }
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    #[test]
    fn a_clock_that_was_never_set_is_written() {
        let day = Duration::from_secs(86_400);
        assert_eq!(Utc::of(SystemTime::UNIX_EPOCH - day).file_name(), "1970-01-01T00-00-00Z");
        assert_eq!(Utc::of(SystemTime::UNIX_EPOCH + day * 4_000_000).file_name(), "9999-12-31T23-59-59Z");
    }

    /// The time since the machine began, in which it may have slept, as the system itself tells it.
    #[test]
    fn the_hosts_clock_counts_its_sleep() {
        let uptime = std::fs::read_to_string("/proc/uptime").unwrap();
        let uptime: f64 = uptime.split_whitespace().next().unwrap().parse().unwrap();
        assert!((now().as_secs_f64() - uptime).abs() < 2.0, "{:?} {uptime}", now());
    }
}
