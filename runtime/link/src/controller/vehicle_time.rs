//! The vehicle's time stamps, as a count of ticks.

/// A day, in the milliseconds that stamps are counted in.
pub(crate) const DAY_MS: u32 = 86_400_000;

/// Milliseconds in a tick.
const TICK_MS: u64 = 100;
/// A stamp that is further from the last one is doubted: states come some times a second.
const FOLLOWS_MS: u32 = 2_000;
/// A stamp that is further still is a clock that was set, and not time that has passed: in this time, 5 s, whoever is not
/// heard has been left.
const PASSED_MS: u32 = 5_000;
/// A stamp that is older by no more than this may be of a message that comes late.
const LATE_MS: u32 = 60_000;
/// A doubted stamp is believed when it is the last of so many that follow each other: one wrong line in 256 passes the sum.
const AGREE: u32 = 3;
/// ... and of so many, if they may be messages that come late.
const AGREE_LATE: u32 = 10;

/// Counts ticks by stamps of the day. The first stamp is tick 0.
#[derive(Clone, Copy, Debug, Default)]
pub struct VehicleTime {
    last_ms: Option<u32>,
    passed_ms: u64,
    doubt: Option<Doubt>,
}

/// Stamps that do not follow the last one that was believed, but each other.
#[derive(Clone, Copy, Debug)]
struct Doubt {
    first_ms: u32,
    last_ms: u32,
    count: u32,
}

/// What a stamp says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stamp {
    /// It is of this tick.
    Tick(u64),
    /// It is no time: of a message that comes late or twice, or not to be believed yet.
    Doubtful,
    /// The vehicle's clock was set; it is of this tick.
    ClockSet(u64),
}

impl VehicleTime {
    /// The tick of the last stamp that was believed.
    pub fn tick(&self) -> u64 {
        (self.passed_ms + TICK_MS / 2) / TICK_MS
    }

    /// Takes in a stamp, in milliseconds of the day.
    pub fn hear(&mut self, ms: u32) -> Stamp {
        let Some(last) = self.last_ms else {
            self.last_ms = Some(ms);
            return Stamp::Tick(0);
        };
        if !follows(last, ms) && !self.agreed(last, ms) {
            return Stamp::Doubtful;
        }
        // How far it leapt is told by the first that was doubted, not by the one that had it believed.
        let leapt = self.doubt.take().filter(|_| !follows(last, ms)).map_or(ms, |doubt| doubt.first_ms);
        self.last_ms = Some(ms);
        let ahead = since(last, ms);
        let set = since(last, leapt) > PASSED_MS;
        self.passed_ms += if set { TICK_MS } else { u64::from(ahead) };
        let tick = self.tick();
        if set { Stamp::ClockSet(tick) } else { Stamp::Tick(tick) }
    }

    /// Whether a stamp that does not follow the last is to be believed all the same.
    fn agreed(&mut self, last: u32, ms: u32) -> bool {
        let doubt = match self.doubt {
            Some(doubt) if follows(doubt.last_ms, ms) => Doubt { last_ms: ms, count: doubt.count + 1, ..doubt },
            _ => Doubt { first_ms: ms, last_ms: ms, count: 1 },
        };
        self.doubt = Some(doubt);
        doubt.count >= if since(ms, last) <= LATE_MS { AGREE_LATE } else { AGREE }
    }
}

/// The milliseconds from one stamp to another, over midnight too.
fn since(from: u32, to: u32) -> u32 {
    (to + DAY_MS - from) % DAY_MS
}

/// Whether a stamp is soon after another.
fn follows(before: u32, ms: u32) -> bool {
    (1..=FOLLOWS_MS).contains(&since(before, ms))
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
        let gap = [0, 4_000, 4_100, 4_200, 4_300];
        assert_eq!(heard(&gap)[3..], [Tick(42), Tick(43)], "a gap is time that has passed");
        let long = [0, 4_800, 4_900, 5_010, 5_110];
        assert_eq!(heard(&long)[3..], [Tick(50), Tick(51)], "believed when it is longer ago than what passes");
        let slow = [0, 4_000, 5_000, 6_000, 7_000];
        assert_eq!(heard(&slow)[3..], [Tick(60), Tick(70)], "one state a second");
    }

    #[test]
    fn a_single_stamp_that_leaps_is_not_believed() {
        use Stamp::{Doubtful, Tick};
        for wrong in [4_000, 40_000, 7_200_000, DAY_MS - 4_000, DAY_MS - 7_200_000] {
            assert_eq!(heard(&[0, 100, wrong, 200, 300]), [Tick(0), Tick(1), Doubtful, Tick(2), Tick(3)], "{wrong}");
            let twice = [0, wrong, 100, wrong + 100, 200, wrong + 200];
            assert!(!heard(&twice).iter().any(|s| matches!(s, Stamp::ClockSet(_))), "{wrong}");
        }
    }

    #[test]
    fn late_and_repeated_messages_are_no_time() {
        use Stamp::{Doubtful, Tick};
        assert_eq!(heard(&[1000, 1200, 1100, 1200, 1300]), [Tick(0), Tick(2), Doubtful, Doubtful, Tick(3)]);
        assert!(heard(&[1000; 50])[1..].iter().all(|s| *s == Doubtful), "a clock that stands still");
    }

    #[test]
    fn a_clock_that_is_set_costs_one_tick() {
        use Stamp::{ClockSet, Doubtful, Tick};
        for set in [40_000, 3_600_000, DAY_MS - 3_600_000] {
            let stamps = [0, set, set + 100, set + 200, set + 300];
            assert_eq!(heard(&stamps), [Tick(0), Doubtful, Doubtful, ClockSet(1), Tick(2)], "{set}");
        }
        let mut back = vec![50_000];
        back.extend((0..11).map(|i| 20_000 + 100 * i));
        assert_eq!(heard(&back)[9..], [Doubtful, ClockSet(1), Tick(2)]);
    }
}
