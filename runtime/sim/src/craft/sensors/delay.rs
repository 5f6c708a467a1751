//! The way from a sensor to who reads it.

use albacore_vehicle::TICK_S;
use std::collections::VecDeque;

/// What was taken and has not come yet; all of it is under way for the same time.
#[derive(Clone, Debug)]
pub struct Delay<T> {
    ticks: u64,
    /// Each with the tick on which it comes.
    on_the_way: VecDeque<(u64, T)>,
}

impl<T> Delay<T> {
    /// One of so many seconds, to the nearest tick.
    pub fn new(seconds: f64) -> Self {
        Delay { ticks: (seconds / TICK_S).round() as u64, on_the_way: VecDeque::new() }
    }

    /// Takes what was measured at a tick.
    pub fn send(&mut self, tick: u64, reading: T) {
        self.on_the_way.push_back((tick + self.ticks, reading));
    }

    /// The next that has come by a tick.
    pub fn sample(&mut self, tick: u64) -> Option<T> {
        let has_come = self.on_the_way.front().is_some_and(|(comes, _)| *comes <= tick);
        if has_come { self.on_the_way.pop_front().map(|(_, reading)| reading) } else { None }
    }

    /// For a sensor that measures once a tick at most: takes what it measured, and gives what comes.
    pub fn pass(&mut self, tick: u64, reading: Option<T>) -> Option<T> {
        if let Some(reading) = reading {
            self.send(tick, reading);
        }
        self.sample(tick)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn readings_come_as_late_as_told_and_in_order() {
        for (seconds, late) in [(0.0, 0), (3.0, 30)] {
            let mut delay = Delay::new(seconds);
            let passed: Vec<(u64, u64)> = (0..100)
                .filter_map(|tick| Some((tick, delay.pass(tick, tick.is_multiple_of(2).then_some(tick))?)))
                .collect();
            assert!(
                passed.len() as u64 == (100 - late) / 2 && passed.iter().all(|(tick, taken)| *tick == taken + late)
            );
        }
    }
}
