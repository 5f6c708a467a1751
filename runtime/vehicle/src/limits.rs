//! The vehicle's own limits: what the computer in the front seat makes of a command that goes beyond them, whoever gave it.

use crate::{Command, TICK_S, Vertical};
use serde::{Deserialize, Serialize};
use std::fmt;

/// What goes beyond a limit and has not come up for so long has ceased, s: the next is told again.
const CEASED_S: f64 = 5.0;
/// Commands within this of a limit are within it, m or m/s: they may have been computed from it.
const SLACK: f64 = 1e-6;

/// The vehicle's own limits, whoever commands it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Limits {
    /// It goes no deeper than this, m. Default none.
    pub depth: Option<f64>,
    /// It comes no nearer to the bottom than this, m. Default 0: it may.
    pub altitude: f64,
    /// It goes no faster through the water than this, m/s. Default none.
    pub speed: Option<f64>,
}

/// A limit that a command goes beyond: m, m, m/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Beyond {
    /// Deeper than the greatest depth.
    Deep(f64),
    /// Nearer to the bottom than the least altitude.
    Low(f64),
    /// Faster than the greatest speed.
    Fast(f64),
    /// Above the surface: no vehicle has a limit there, and none gets beyond it.
    High,
    /// Slower than not at all.
    Astern,
}

impl fmt::Display for Beyond {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Beyond::Deep(depth) => write!(f, "is asked to go deeper than {depth:.2} m: it stays there"),
            Beyond::Low(altitude) => {
                write!(f, "is asked to come nearer to the bottom than {altitude:.2} m: it keeps that altitude")
            }
            Beyond::Fast(speed) => write!(f, "is asked to go faster than {speed:.2} m/s: it goes no faster"),
            Beyond::High => f.write_str("is asked to rise above the surface: it stays there"),
            Beyond::Astern => f.write_str("is asked to go astern: it stops"),
        }
    }
}

impl Limits {
    /// A command as far as the vehicle follows it, where the water is so deep (m) if that is known; `tell` hears of each limit
    /// that it goes beyond. The least altitude rules over all else: it lifts the vehicle whatever it was told.
    pub fn clamp_command(&self, asked: &Command, water_depth: Option<f64>, report: &mut dyn FnMut(Beyond)) -> Command {
        let vertical = self.within(asked.vertical, water_depth, report);
        let speed = match self.speed {
            Some(most) if asked.speed > most + SLACK => {
                report(Beyond::Fast(most));
                most
            }
            _ if asked.speed < -SLACK => {
                report(Beyond::Astern);
                0.0
            }
            _ => asked.speed.max(0.0),
        };
        Command { speed, vertical, ..*asked }
    }

    fn within(&self, asked: Vertical, water_depth: Option<f64>, report: &mut dyn FnMut(Beyond)) -> Vertical {
        let mut vertical = asked;
        if let Vertical::Depth(depth) = asked
            && depth < 0.0
        {
            if depth < -SLACK {
                report(Beyond::High);
            }
            vertical = Vertical::Depth(0.0);
        }
        let depth = match vertical {
            Vertical::Depth(depth) => Some(depth),
            Vertical::Altitude(altitude) => water_depth.map(|water| water - altitude),
        };
        if let (Some(depth), Some(most)) = (depth, self.depth)
            && depth > most + SLACK
        {
            report(Beyond::Deep(most));
            vertical = Vertical::Depth(most);
        }
        let altitude = match vertical {
            Vertical::Depth(depth) => water_depth.map(|water| water - depth),
            Vertical::Altitude(altitude) => Some(altitude),
        };
        if let Some(altitude) = altitude
            && self.altitude > 0.0
            && altitude < self.altitude - SLACK
        {
            report(Beyond::Low(self.altitude));
            vertical = Vertical::Altitude(self.altitude);
        }
        vertical
    }
}

/// The watch over a vehicle's limits: commands come out within them, and each limit is told once until it is heeded again.
#[derive(Clone, Debug)]
pub struct LimitWatch {
    limits: Limits,
    /// When each limit was gone beyond last.
    last: [Option<u64>; 5],
    notices: Vec<String>,
}

impl LimitWatch {
    /// A watch over limits.
    pub fn new(limits: Limits) -> Self {
        LimitWatch { limits, last: [None; 5], notices: Vec::new() }
    }

    /// What it watches over.
    pub fn limits(&self) -> &Limits {
        &self.limits
    }

    /// A command as far as the vehicle follows it, where the water is so deep (m).
    pub fn clamp_command(&mut self, tick: u64, asked: &Command, water_depth: f64) -> Command {
        let LimitWatch { limits, last, notices } = self;
        limits.clamp_command(asked, Some(water_depth), &mut |beyond| {
            let kind = match beyond {
                Beyond::Deep(_) => 0,
                Beyond::Low(_) => 1,
                Beyond::Fast(_) => 2,
                Beyond::High => 3,
                Beyond::Astern => 4,
            };
            let before = last[kind].replace(tick);
            if before.is_none_or(|before| tick.saturating_sub(before) as f64 * TICK_S > CEASED_S) {
                notices.push(beyond.to_string());
            }
        })
    }

    /// What has been told since the last time; taken once.
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
        Command::new(Heading::NORTH, speed, vertical)
    }

    /// What comes out, and how much was told.
    fn heeded(speed: f64, vertical: Vertical, water: Option<f64>) -> (f64, Vertical, usize) {
        let mut told = 0;
        let out = limits().clamp_command(&command(speed, vertical), water, &mut |_| told += 1);
        (out.speed, out.vertical, told)
    }

    #[test]
    fn what_is_within_the_limits_is_left_alone() {
        for vertical in [Vertical::Depth(10.0), Vertical::Altitude(1.5), Vertical::Depth(0.0)] {
            assert_eq!(heeded(2.0, vertical, Some(11.5)), (2.0, vertical, 0));
            assert_eq!(heeded(2.0, vertical, None), (2.0, vertical, 0));
        }
    }

    #[test]
    fn too_deep_too_low_and_too_fast_are_clipped_and_told() {
        use Vertical::{Altitude, Depth};
        for (speed, asked, water, held) in [
            (1.0, Depth(12.0), Some(50.0), (1.0, Depth(10.0), 1)),
            (1.0, Depth(12.0), None, (1.0, Depth(10.0), 1)),
            (1.0, Altitude(2.0), Some(50.0), (1.0, Depth(10.0), 1)),
            (1.0, Altitude(0.5), Some(8.0), (1.0, Altitude(1.5), 1)),
            (1.0, Altitude(0.5), None, (1.0, Altitude(1.5), 1)),
            (1.0, Depth(7.0), Some(8.0), (1.0, Altitude(1.5), 1)),
            (3.0, Depth(12.0), Some(11.0), (2.0, Altitude(1.5), 3)),
        ] {
            assert_eq!(heeded(speed, asked, water), held, "{speed} {asked:?} in {water:?}");
        }
    }

    #[test]
    fn nothing_goes_astern_or_out_of_the_water() {
        assert_eq!(heeded(-1.0, Vertical::Depth(-0.1), None), (0.0, Vertical::Depth(0.0), 2));
        assert_eq!(heeded(-0.0, Vertical::Altitude(-3.0), None), (0.0, Vertical::Altitude(1.5), 1));
    }

    #[test]
    fn a_limit_is_told_once_until_it_is_heeded_again() {
        let mut watch = LimitWatch::new(limits());
        let (deep, fine) = (command(1.0, Vertical::Depth(12.0)), command(1.0, Vertical::Depth(5.0)));
        let mut told = Vec::new();
        for tick in 0..400 {
            let asked = if (100..200).contains(&tick) || tick == 220 { fine } else { deep };
            watch.clamp_command(tick, &asked, 50.0);
            told.extend(watch.take_notices().into_iter().map(|notice| (tick, notice)));
        }
        let ticks: Vec<u64> = told.iter().map(|(tick, _)| *tick).collect();
        assert_eq!(ticks, [0, 200], "a moment's obedience is no end of it: {told:?}");
        assert_eq!(told[0].1, "is asked to go deeper than 10.00 m: it stays there");
    }
}
