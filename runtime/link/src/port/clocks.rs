//! The vehicle's clock beside the host's: one that runs slow lets a mission last too long, one that runs fast cuts it short.

use albacore_vehicle::TICK_S;

/// Told is what is further off than this share of the other clock's time, and this many ticks.
const SHARE: f64 = 1.05;
const TICKS: f64 = 300.0;

/// Compares the two, tick by tick.
#[derive(Clone, Debug)]
pub struct Clocks {
    /// How many times faster than real time the vehicle may run.
    rate: f64,
    ticks: u64,
    told: bool,
}

impl Clocks {
    /// Of a vehicle that runs so many times faster than real time, or as fast as it can up to that.
    pub fn new(rate: f64) -> Self {
        Clocks { rate: rate.max(1.0), ticks: 0, told: false }
    }

    /// A tick of the vehicle's time, after so many ticks by the host's clock; what to tell, once. So many further ones were heard and
    /// wait for us: that we are late is not the vehicle's clock.
    pub fn tick(&mut self, host: u64, waiting: u64) -> Option<String> {
        let (vehicle, host) = (self.ticks.saturating_add(waiting) as f64, host as f64);
        self.ticks += 1;
        let how = if host > vehicle * SHARE + TICKS {
            "slow, or was not heard for a while"
        } else if vehicle > (host * SHARE + TICKS) * self.rate {
            "fast"
        } else {
            return None;
        };
        if std::mem::replace(&mut self.told, true) {
            return None;
        }
        let (vehicle, host) = (vehicle * TICK_S, host * TICK_S);
        Some(format!(
            "the vehicle's clock runs {how}: {vehicle:.0} s of it have passed in {host:.0} s of the host's; the mission's times \
             are the vehicle's"
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The tick in which it was told, of a vehicle that makes so many ticks in one of the host's.
    fn told(speed: f64, rate: f64) -> Option<(u64, String)> {
        let mut clocks = Clocks::new(rate);
        let all: Vec<_> =
            (0..36_000).filter_map(|tick| Some((tick, clocks.tick((tick as f64 / speed) as u64, 0)?))).collect();
        assert!(all.len() < 2, "{all:?}");
        all.into_iter().next()
    }

    #[test]
    fn a_clock_that_is_off_is_told_once() {
        assert_eq!(told(1.0, 1.0), None);
        assert_eq!(told(1.04, 1.0), None);
        assert_eq!(told(0.96, 1.0), None);
        let (tick, slow) = told(0.5, 1.0).unwrap();
        assert_eq!(tick, 316);
        assert!(
            slow.starts_with(
                "the vehicle's clock runs slow, or was not heard for a while: 32 s of it have passed in 63 s"
            ),
            "{slow}"
        );
        let (_, fast) = told(2.0, 1.0).unwrap();
        assert!(fast.starts_with("the vehicle's clock runs fast: 63 s of it have passed in 32 s"), "{fast}");
    }

    #[test]
    fn one_that_is_let_run_faster_may_and_need_not() {
        assert_eq!(told(20.0, 20.0), None);
        assert_eq!(told(3.0, 20.0), None, "the computer is busy");
        assert!(told(0.5, 20.0).unwrap().1.contains("slow"));
        assert!(told(40.0, 20.0).unwrap().1.contains("fast"));
    }
}
