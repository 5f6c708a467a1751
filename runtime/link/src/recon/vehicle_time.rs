//! The vehicle's time stamps, as a count of ticks.

use super::fields::DAY_MS;

/// Milliseconds in a tick.
const TICK_MS: u64 = 100;
/// A stamp that is further from the last one is a clock that was set, and not time that has passed: a minute.
const JUMP_MS: u32 = 60_000;
/// So many stamps in a row from before the last one are a clock that was set back, and no messages that come late.
const LATE_MAX: u32 = 10;

/// Counts ticks by stamps of the day. The first stamp is tick 0.
#[derive(Clone, Copy, Debug, Default)]
pub struct VehicleTime {
    last_ms: Option<u32>,
    passed_ms: u64,
    late: u32,
}

/// What a stamp says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stamp {
    /// It is of this tick.
    Tick(u64),
    /// It is older than what was heard before: a message that comes late or twice.
    Late,
    /// The vehicle's clock was set; it is of this tick.
    ClockSet(u64),
}

impl VehicleTime {
    /// Takes in a stamp, in milliseconds of the day.
    pub fn hear(&mut self, ms: u32) -> Stamp {
        let Some(last) = self.last_ms else {
            self.last_ms = Some(ms);
            return Stamp::Tick(0);
        };
        let ahead = (ms + DAY_MS - last) % DAY_MS;
        let behind = (DAY_MS - ahead) % DAY_MS;
        if behind <= JUMP_MS && self.late < LATE_MAX {
            self.late += 1;
            return Stamp::Late;
        }
        self.late = 0;
        self.last_ms = Some(ms);
        let set = ahead > JUMP_MS;
        self.passed_ms += if set { TICK_MS } else { u64::from(ahead) };
        let tick = (self.passed_ms + TICK_MS / 2) / TICK_MS;
        if set { Stamp::ClockSet(tick) } else { Stamp::Tick(tick) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn heard(stamps: &[u32]) -> Vec<Stamp> {
        let mut time = VehicleTime::default();
        stamps.iter().map(|ms| time.hear(*ms)).collect()
    }

    #[test]
    fn ticks_follow_the_stamps_over_midnight() {
        use Stamp::Tick;
        let nine_hertz = [DAY_MS - 111, 0, 111, 222, 333];
        assert_eq!(heard(&nine_hertz), [Tick(0), Tick(1), Tick(2), Tick(3), Tick(4)]);
        assert_eq!(heard(&[0, 30_000]), [Tick(0), Tick(300)], "a gap is time that has passed");
    }

    #[test]
    fn late_and_repeated_messages_are_no_time() {
        use Stamp::{Late, Tick};
        assert_eq!(heard(&[1000, 1200, 1100, 1200, 1300]), [Tick(0), Tick(2), Late, Late, Tick(3)]);
    }

    #[test]
    fn a_clock_that_is_set_costs_one_tick() {
        use Stamp::{ClockSet, Tick};
        assert_eq!(heard(&[0, 3_600_000, 3_600_100]), [Tick(0), ClockSet(1), Tick(2)]);
        let mut back = vec![50_000];
        back.extend((0..12).map(|i| 20_000 + 100 * i));
        assert_eq!(heard(&back)[11..], [ClockSet(1), Tick(2)]);
    }
}
