//! The vehicle's own limits: what the computer in the front seat makes of a command that goes beyond them, whoever gave it.

use crate::scenario::Limits;
use albacore_vehicle::{Command, TICK_S, Vertical};

/// A refusal that has not come up for so long has ceased, s: the next is told again.
const CEASED_S: f64 = 5.0;
/// Commands within this of a limit are within it, m or m/s: they may have been computed from it.
const SLACK: f64 = 1e-6;

/// What is refused.
#[derive(Clone, Copy, Debug)]
enum Kind {
    Deep,
    Low,
    Fast,
}

/// The watch over the limits: commands come out within them, and each kind of refusal is told once until it ceases.
#[derive(Clone, Debug)]
pub(crate) struct Watch {
    limits: Option<Limits>,
    /// As fast as its hull can go, m/s.
    speed_max: f64,
    /// When each kind of refusal came up last.
    last: [Option<u64>; 3],
    notices: Vec<String>,
}

impl Watch {
    /// A watch over a vehicle's limits, if it has any besides its hull's speed in m/s.
    pub fn new(limits: Option<&Limits>, speed_max: f64) -> Self {
        Watch { limits: limits.cloned(), speed_max, last: [None; 3], notices: Vec::new() }
    }

    /// A command as far as the vehicle follows it, where the water is so deep (m).
    pub fn heed(&mut self, tick: u64, command: &Command, water_depth: f64) -> Command {
        let Some(limits) = self.limits.clone() else { return *command };
        let vertical = self.within(tick, &limits, command.vertical, water_depth);
        let speed_max = limits.speed.map_or(self.speed_max, |speed| speed.min(self.speed_max));
        let speed = command.speed;
        if speed > speed_max + SLACK {
            self.refuse(tick, Kind::Fast, || {
                format!("is asked to go faster than {speed_max:.2} m/s: it goes no faster")
            });
        }
        Command { speed: speed.min(speed_max), vertical, ..*command }
    }

    /// The least altitude rules over all else: it lifts the vehicle whatever it was told.
    fn within(&mut self, tick: u64, limits: &Limits, asked: Vertical, water_depth: f64) -> Vertical {
        let mut vertical = asked;
        let depth = match asked {
            Vertical::Depth(depth) => depth,
            Vertical::Altitude(altitude) => water_depth - altitude,
        };
        if let Some(depth_max) = limits.depth
            && depth > depth_max + SLACK
        {
            self.refuse(tick, Kind::Deep, || format!("is asked to go deeper than {depth_max:.2} m: it stays there"));
            vertical = Vertical::Depth(depth_max);
        }
        let altitude = match vertical {
            Vertical::Depth(depth) => water_depth - depth,
            Vertical::Altitude(altitude) => altitude,
        };
        let least = limits.altitude;
        if least > 0.0 && altitude < least - SLACK {
            self.refuse(tick, Kind::Low, || {
                format!("is asked to come nearer to the bottom than {least:.2} m: it keeps that altitude")
            });
            vertical = Vertical::Altitude(least);
        }
        vertical
    }

    fn refuse(&mut self, tick: u64, kind: Kind, say: impl FnOnce() -> String) {
        let last = self.last[kind as usize].replace(tick);
        if last.is_none_or(|last| tick.saturating_sub(last) as f64 * TICK_S > CEASED_S) {
            self.notices.push(say());
        }
    }

    /// What has been refused since the last time; taken once.
    pub fn take_notices(&mut self) -> Vec<String> {
        std::mem::take(&mut self.notices)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use albacore_geometry::Heading;

    fn limits() -> Limits {
        Limits { depth: Some(10.0), altitude: 1.5, speed: Some(2.0) }
    }

    fn command(speed: f64, vertical: Vertical) -> Command {
        Command { heading: Heading::NORTH, speed, vertical }
    }

    /// What comes out, and how much was told.
    fn heeded(speed: f64, vertical: Vertical, water: f64) -> (f64, Vertical, usize) {
        let mut watch = Watch::new(Some(&limits()), 2.6);
        let out = watch.heed(1, &command(speed, vertical), water);
        (out.speed, out.vertical, watch.take_notices().len())
    }

    #[test]
    fn what_is_within_the_limits_is_left_alone() {
        for vertical in [Vertical::Depth(10.0), Vertical::Altitude(1.5), Vertical::Depth(0.0)] {
            assert_eq!(heeded(2.0, vertical, 11.5), (2.0, vertical, 0));
        }
    }

    #[test]
    fn too_deep_too_low_and_too_fast_are_clipped_and_told() {
        assert_eq!(heeded(1.0, Vertical::Depth(12.0), 50.0), (1.0, Vertical::Depth(10.0), 1));
        assert_eq!(heeded(1.0, Vertical::Altitude(2.0), 50.0), (1.0, Vertical::Depth(10.0), 1));
        assert_eq!(heeded(1.0, Vertical::Altitude(0.5), 8.0), (1.0, Vertical::Altitude(1.5), 1));
        assert_eq!(heeded(1.0, Vertical::Depth(7.0), 8.0), (1.0, Vertical::Altitude(1.5), 1));
        assert_eq!(heeded(3.0, Vertical::Depth(12.0), 11.0), (2.0, Vertical::Altitude(1.5), 3), "all three");
    }

    #[test]
    fn without_limits_of_its_own_every_command_stands() {
        let wild = command(9.0, Vertical::Depth(1e3));
        let mut watch = Watch::new(None, 2.6);
        assert_eq!(watch.heed(1, &wild, 10.0), wild);
        assert!(watch.take_notices().is_empty());
    }

    #[test]
    fn a_refusal_is_told_once_until_it_ceases() {
        let mut watch = Watch::new(Some(&limits()), 2.6);
        let (deep, fine) = (command(1.0, Vertical::Depth(12.0)), command(1.0, Vertical::Depth(5.0)));
        let mut told = Vec::new();
        for tick in 0..400 {
            let asked = if (100..200).contains(&tick) || tick == 220 { fine } else { deep };
            watch.heed(tick, &asked, 50.0);
            told.extend(watch.take_notices().into_iter().map(|notice| (tick, notice)));
        }
        let ticks: Vec<u64> = told.iter().map(|(tick, _)| *tick).collect();
        assert_eq!(ticks, [0, 200], "a moment's obedience is no end of it: {told:?}");
        assert_eq!(told[0].1, "is asked to go deeper than 10.00 m: it stays there");
    }
}
