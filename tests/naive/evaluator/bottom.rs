//! Section 8: what is known of the bottom, and how far down the limits of depth and altitude allow.

use super::mission::Evaluator;
use super::world::World;
use albacore_program::Channel;
use albacore_vehicle::{Command, TICK_S, Vertical};

/// So long a vertical limit goes by what was sensed: 5 s.
const FRESH_TICKS: u64 = 50;
/// An echo that no other has confirmed counts for so long: 1 s.
const LONE_TICKS: u64 = 10;

/// What was heard of the bottom, m.
#[derive(Clone, Copy)]
struct Echo {
    tick: u64,
    altitude: f64,
    depth: f64,
    water: f64,
    sum: f64,
    confirmed: bool,
}

#[derive(Default)]
pub(super) struct Bottom {
    echo: Option<Echo>,
    lost: bool,
    begun: Option<u64>,
    pub commanded: Option<Command>,
    /// The way that was commanded since the echo, m.
    way: f64,
}

impl Evaluator<'_> {
    /// Section 8: the limits of depth and altitude both hold; without an echo of the bottom the vehicle goes no deeper than where
    /// the least altitude was last known to hold, and where there never was one, to the surface.
    pub(super) fn vertical(&mut self, asked: Vertical) -> Vertical {
        let (low, high) = self.limits[Channel::Depth as usize];
        let (lowest, highest) = self.limits[Channel::Altitude as usize];
        let names = ["altitude", "water_depth"];
        let own = self.required.iter().filter(|r| names.contains(&&*self.w.hir.inputs[r.input].name)).map(|r| r.fresh);
        let fresh = own.min().unwrap_or(FRESH_TICKS);
        let young = self.w.tick - *self.bottom.begun.get_or_insert(self.w.tick) <= FRESH_TICKS;
        let echo = self.bottom.echo;
        let lone = fresh.min(LONE_TICKS);
        let known = echo.filter(|echo| self.w.tick - echo.tick <= if echo.confirmed { fresh } else { lone });
        let floor = match (known, echo) {
            (Some(echo), _) => Some(echo.water - lowest),
            (None, _) if lowest == 0.0 && matches!(asked, Vertical::Depth(_)) => None,
            (None, Some(echo)) => Some(echo.depth.min(echo.water - lowest - 0.25 * self.bottom.way)),
            (None, None) if young => Some(self.w.depth().unwrap_or(0.0)),
            (None, None) => Some(0.0),
        };
        let high = self.shoal().map_or(high, |shoal| high.min(shoal));
        let deepest = floor.map_or(high, |floor| floor.max(0.0).min(high));
        let lost = known.is_none() && lowest > 0.0 && !(echo.is_none() && young);
        if lost != std::mem::replace(&mut self.bottom.lost, lost) {
            self.w.say(if lost { format!("bottom lost {:?}", deepest + 0.0) } else { "bottom found".into() });
        }
        // What is measured too low leads up, whatever the depth is told to be.
        let low_by = (0.25 * lowest).min(0.5);
        match asked {
            Vertical::Depth(asked) if known.is_some_and(|echo| echo.altitude < lowest - low_by) => {
                self.limit(Channel::Depth, asked);
                Vertical::Depth(low)
            }
            Vertical::Altitude(asked) => {
                let given = self.limit(Channel::Altitude, asked);
                match known {
                    Some(echo) => {
                        let most = if low > 0.0 { (echo.sum - low).max(lowest) } else { f64::MAX };
                        Vertical::Altitude(given.min(most).max(echo.sum - high).max(0.0))
                    }
                    None if lowest > 0.0 || high < f64::MAX => Vertical::Depth(deepest),
                    None => Vertical::Altitude(given),
                }
            }
            Vertical::Depth(asked) => {
                let given = self.limit(Channel::Depth, asked);
                let least = known.map_or(0.0, |echo| echo.water - highest);
                Vertical::Depth(given.max(least).min(deepest).max(0.0))
            }
        }
    }
}

impl Bottom {
    pub fn hear(&mut self, w: &World) {
        self.way += self.commanded.map_or(0.0, |command| command.speed) * TICK_S;
        let (Some(altitude), Some(depth)) = (w.lately("altitude", 0), w.lately("depth", FRESH_TICKS)) else { return };
        self.way = 0.0;
        let sum = depth + altitude;
        let goal = self.commanded.map(|command| command.vertical);
        let held = matches!(goal, Some(Vertical::Altitude(goal)) if (altitude - goal).abs() < 0.5);
        let confirmed = self.echo.is_some_and(|old| w.tick - old.tick <= FRESH_TICKS);
        let new = Echo { tick: w.tick, altitude, depth, water: sum, sum, confirmed };
        self.echo = Some(match self.echo {
            // It may be an old one.
            Some(old) if old.altitude == altitude && !held => {
                Echo { depth: old.depth.min(depth), water: old.water.min(sum), ..new }
            }
            _ => new,
        });
    }
}
