//! Section 8: what is known of the bottom, and how far down the limits of depth and altitude allow.

use super::mission::Evaluator;
use super::rise::Rise;
use super::world::World;
use albacore_geometry::Point;
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
    depth: f64,
    water: f64,
    sum: f64,
    confirmed: bool,
    agrees: bool,
    place: Option<Point>,
}

#[derive(Default)]
pub(super) struct Bottom {
    echo: Option<Echo>,
    /// One that does not agree with that, and the way since.
    other: Option<(Echo, f64)>,
    /// The latest altitude, when it came, and the depth then.
    altitude: Option<(u64, f64, f64)>,
    /// The water that was sounded on the last 2 m and on the last 12 m of way, m.
    lately: Option<[f64; 2]>,
    lost: bool,
    /// The deepest water, m.
    deep: f64,
    /// An altitude has led deeper than it may, by so much more than it was told to, m.
    below: f64,
    begun: Option<u64>,
    pub commanded: Option<Command>,
    /// The way that was commanded since the echo, m.
    way: f64,
    /// The depth, the way that was commanded since it changed, and where that was.
    still: Option<(f64, f64, Option<Point>)>,
    /// For how many ticks another depth was commanded all the same, and the least sum of depth and altitude since, m.
    least: (u64, Option<f64>),
    rise: Rise,
}

impl Evaluator<'_> {
    /// Section 8: the limits of depth and altitude both hold; without an echo of the bottom the vehicle goes no deeper than where
    /// the least altitude was last known to hold, and where there never was one, to the surface.
    pub(super) fn vertical(&mut self, asked: Vertical) -> Vertical {
        let (low, high) = self.limits[Channel::Depth as usize];
        let (lowest, highest) = self.limits[Channel::Altitude as usize];
        self.bottom.begun.get_or_insert(self.w.tick);
        let (known, young) = (self.known(), self.is_young());
        let echo = self.bottom.echo.filter(|echo| echo.agrees);
        let floor = match (known, echo) {
            (Some(echo), _) => {
                let (elsewhere, least) = self.bottom.least;
                let least = least.filter(|_| elsewhere > FRESH_TICKS);
                Some(least.map_or(echo.water, |least| echo.water.min(least)) - self.ahead(lowest))
            }
            (None, _) if lowest == 0.0 && matches!(asked, Vertical::Depth(_)) => None,
            (None, Some(echo)) => {
                Some(echo.depth.min(echo.water - self.ahead(lowest) - 0.25 * self.bottom.gone(&self.w)))
            }
            (None, None) if young => Some(self.w.depth().unwrap_or(0.0)),
            (None, None) => Some(0.0),
        };
        let high = self.shoal().map_or(high, |shoal| high.min(shoal));
        let deepest = floor.map_or(high, |floor| floor.max(0.0).min(high));
        let lost = known.is_none() && lowest > 0.0 && !(self.bottom.echo.is_none() && young);
        if lost != std::mem::replace(&mut self.bottom.lost, lost) {
            self.w.say(if lost { format!("bottom lost {:?}", deepest + 0.0) } else { "bottom found".into() });
        }
        // What the vehicle does not keep to leads up.
        let depth = self.w.depth().unwrap_or(0.0);
        let is_lost = known.is_none() && lowest > 0.0;
        let is_low = self.is_low() || (deepest < high || is_lost) && depth > deepest + 1.0;
        let up = if self.lift.leads_to_the_surface() { 0.0 } else { low.min(deepest) };
        let least = self.bottom.rise.least(self.w.tick).filter(|_| known.is_some());
        let deepest = least.map_or(deepest, |least| deepest.min((least - self.ahead(lowest)).max(0.0)));
        let given = match asked {
            Vertical::Depth(_) if is_low => Vertical::Depth(up),
            Vertical::Altitude(asked) => {
                let given = self.clamped(Channel::Altitude, asked);
                match known {
                    Some(echo) => {
                        let most = if low > 0.0 { (echo.sum - low).max(lowest) } else { f64::MAX };
                        let given = given.max(self.ahead(lowest)).min(most);
                        let goal = echo.sum - given;
                        if let Some(depth) = self.w.depth().filter(|depth| *depth > high + 0.5) {
                            self.bottom.below = self.bottom.below.max(depth - goal);
                        }
                        if self.bottom.deep.max(echo.sum) + self.bottom.hidden(&self.w) - given + self.bottom.below
                            > high
                        {
                            Vertical::Depth(if is_low { up } else { goal.min(deepest).max(0.0) })
                        } else {
                            self.bottom.below = 0.0;
                            Vertical::Altitude(given)
                        }
                    }
                    None if lowest > 0.0 || high < f64::MAX => Vertical::Depth(if is_low { up } else { deepest }),
                    None => Vertical::Altitude(given),
                }
            }
            Vertical::Depth(asked) => {
                let given = self.clamped(Channel::Depth, asked);
                let least = known.map_or(0.0, |echo| echo.water - highest);
                Vertical::Depth(given.max(least).min(deepest).max(0.0))
            }
        };
        self.say_held(asked, given, known.map(|echo| echo.sum));
        given
    }

    /// For 5 s an echo may be on its way.
    fn is_young(&self) -> bool {
        self.w.tick - self.bottom.begun.unwrap_or(self.w.tick) <= FRESH_TICKS
    }

    /// The echo that both limits are held by, if there is one.
    fn known(&self) -> Option<Echo> {
        let names = ["altitude", "water_depth"];
        let own = self.required.iter().filter(|r| names.contains(&&*self.w.hir.inputs[r.input].name)).map(|r| r.fresh);
        let fresh = own.fold(FRESH_TICKS, u64::min);
        let lone = fresh.min(LONE_TICKS);
        let age = |echo: &Echo| self.w.tick - echo.tick;
        let counts =
            |echo: &Echo| (echo.agrees || self.is_young()) && age(echo) <= if echo.confirmed { fresh } else { lone };
        let echo = self.bottom.echo.filter(counts)?;
        let other = self.bottom.other.map(|(other, _)| other);
        Some(match other.filter(|other| age(other) <= LONE_TICKS && other.water < echo.water) {
            Some(other) => Echo { water: other.water, sum: other.sum.min(echo.sum), ..echo },
            None => echo,
        })
    }

    /// By how much the vehicle is deeper than its limits allow, m: by an altitude, by `depth <= D`, and where the altitude is lost by the
    /// way since. Where the depth is lost it is as deep as it last was, and the altitude tells the rest.
    pub(super) fn too_deep(&self) -> Option<f64> {
        let lowest = self.limits[Channel::Altitude as usize].0;
        let high = self.limits[Channel::Depth as usize].1;
        let high = self.shoal().map_or(high, |shoal| high.min(shoal));
        let is_fresh = self.w.lately("depth", FRESH_TICKS).is_some();
        let depth = match (self.w.depth(), self.bottom.told(&self.w)) {
            (None, altitude) => return altitude.map(|altitude| lowest - altitude),
            (Some(depth), Some(altitude)) if !is_fresh => return Some((lowest - altitude).max(depth - high)),
            (Some(depth), _) => depth,
        };
        let allowed = match (self.known(), self.bottom.echo.filter(|echo| echo.agrees)) {
            (Some(echo), _) => echo.water - self.ahead(lowest),
            (None, _) if lowest == 0.0 => high,
            (None, Some(echo)) => echo.water - self.ahead(lowest) - 0.25 * self.bottom.gone(&self.w),
            (None, None) if self.is_young() => depth,
            (None, None) => 0.0,
        };
        let by = depth - allowed.min(high).max(0.0);
        let low = self.bottom.altitude(&self.w).filter(|_| self.is_low()).map(|altitude| lowest - altitude);
        Some(low.map_or(by, |low| by.max(low)))
    }

    /// What is measured too low leads up, whatever the depth is told to be.
    pub(super) fn is_low(&self) -> bool {
        let lowest = self.limits[Channel::Altitude as usize].0;
        let low_by = (0.25 * lowest).min(0.5);
        self.bottom.altitude(&self.w).is_some_and(|altitude| altitude < lowest - low_by)
    }

    /// Says what became of the depth or the altitude that is asked for. That one is told otherwise for the sake of the other begins with 50 cm.
    fn say_held(&mut self, asked: Vertical, given: Vertical, sum: Option<f64>) {
        let (channel, other, wanted) = match asked {
            Vertical::Depth(wanted) => (Channel::Depth, Channel::Altitude, wanted),
            Vertical::Altitude(wanted) => (Channel::Altitude, Channel::Depth, wanted),
        };
        self.say_limited(other, None);
        let clamped = self.clamped(channel, wanted);
        let got = match (asked, given) {
            (Vertical::Depth(_), Vertical::Depth(got)) | (Vertical::Altitude(_), Vertical::Altitude(got)) => got,
            (_, Vertical::Depth(depth)) => sum.map_or(clamped, |sum| sum - depth),
            (_, Vertical::Altitude(_)) => wanted,
        };
        let slack = if self.w.limited[channel as usize] { 0.0 } else { 0.5 };
        let held = clamped != wanted || (got - wanted).abs() > slack;
        self.say_limited(channel, held.then_some((wanted, got)));
    }

    /// The altitude by which a least one holds for the next 15 m of way, m.
    fn ahead(&self, lowest: f64) -> f64 {
        let [near, far] = self.bottom.lately.unwrap_or_default();
        if lowest > 0.0 { lowest + 15.0 * ((far - near) / 10.0).clamp(0.0, 0.25) } else { lowest }
    }
}

impl Bottom {
    /// The way since the echo, m: as commanded, or over ground.
    fn gone(&self, w: &World) -> f64 {
        apart(w, self.echo.and_then(|echo| echo.place)).max(self.way)
    }

    /// Whether what is told is a rise of more than 2 m.
    fn rises(&self, w: &World, asked: Vertical) -> bool {
        match asked {
            Vertical::Depth(asked) => asked < w.depth().unwrap_or(0.0) - 2.0,
            Vertical::Altitude(asked) => self.told(w).is_some_and(|altitude| asked > altitude + 2.0),
        }
    }

    /// By how much the bottom may have fallen since the depth changed, m.
    fn hidden(&self, w: &World) -> f64 {
        self.still.map_or(0.0, |(_, way, place)| 0.25 * apart(w, place).max(way))
    }

    /// The altitude, if it was told lately.
    pub fn told(&self, w: &World) -> Option<f64> {
        self.altitude.filter(|(tick, ..)| w.tick - tick <= FRESH_TICKS).map(|(_, altitude, _)| altitude)
    }

    /// The same, less by what the vehicle has sunk since.
    fn altitude(&self, w: &World) -> Option<f64> {
        let (_, altitude, depth) = self.altitude.filter(|_| self.told(w).is_some())?;
        let sunk = (w.depth().unwrap_or(0.0) - depth).max(0.0);
        Some(altitude - sunk)
    }

    pub fn hear(&mut self, w: &World, asked: Vertical) {
        let way = self.commanded.map_or(0.0, |command| command.speed) * TICK_S;
        self.way += way;
        if let Some((_, since)) = &mut self.other {
            *since += way;
        }
        let depth = w.depth().unwrap_or(0.0);
        match &mut self.still {
            Some((before, gone, _)) if *before == depth => {
                *gone += way;
                let goal = self.commanded.map(|command| command.vertical);
                let is_elsewhere = matches!(goal, Some(Vertical::Depth(goal)) if (goal - depth).abs() > 0.5);
                self.least.0 += u64::from(is_elsewhere);
            }
            _ => {
                self.still = Some((depth, 0.0, w.place(FRESH_TICKS)));
                self.least = (0, None);
            }
        }
        let commanded = self.commanded.map(|command| command.vertical);
        if self.rises(w, asked) || commanded.is_some_and(|commanded| self.rises(w, commanded)) {
            self.rise.asked(w.tick);
        }
        let Some(altitude) = w.lately("altitude", 0) else { return };
        let before = self.altitude.replace((w.tick, altitude, w.depth().unwrap_or(0.0)));
        let Some(depth) = w.lately("depth", FRESH_TICKS) else { return };
        let (gone, place) = (self.gone(w), w.place(FRESH_TICKS));
        let sum = depth + altitude;
        self.least.1 = Some(self.least.1.map_or(sum, |least| least.min(sum)));
        self.rise.told(w.tick, sum);
        let goal = self.commanded.map(|command| command.vertical);
        let held = matches!(goal, Some(Vertical::Altitude(goal)) if (altitude - goal).abs() < 0.5);
        // Another tells of the same bottom, but for 2 m and for what 20 m of way at most may change.
        let same = |old: &Echo, way: f64| (sum - old.sum).abs() <= 2.0 + 0.25 * way.min(20.0);
        let other = self.other.filter(|(old, since)| same(old, apart(w, old.place).max(*since))).map(|(old, _)| old);
        let agreed = self.echo.filter(|old| same(old, gone)).or(other);
        let confirmed = agreed.is_some_and(|old| w.tick - old.tick <= FRESH_TICKS);
        let new = Echo { tick: w.tick, depth, water: sum, sum, confirmed, agrees: agreed.is_some(), place };
        let new = match self.echo {
            // It may be an old one.
            Some(old) if before.is_some_and(|(_, before, _)| before == altitude) && !held => {
                Echo { depth: old.depth.min(depth), water: old.water.min(sum), ..new }
            }
            _ => new,
        };
        if agreed.is_none() && self.echo.is_some_and(|old| old.agrees) {
            self.other = Some((new, 0.0));
            return;
        }
        if agreed.is_none() && self.echo.is_some() {
            self.lately = None;
        }
        if new.agrees {
            self.deep = self.deep.max(sum);
        }
        self.other = None;
        self.way = 0.0;
        let mut lately = self.lately.unwrap_or([sum; 2]);
        for (mean, over) in lately.iter_mut().zip([2.0, 12.0]) {
            *mean += (sum - *mean) * (gone / (gone + over));
        }
        self.lately = Some(lately);
        self.echo = Some(new);
    }
}

/// How far it is from there, m.
fn apart(w: &World, there: Option<Point>) -> f64 {
    there.zip(w.place(FRESH_TICKS)).map_or(0.0, |(there, here)| there.distance(here))
}
