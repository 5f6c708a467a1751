//! The water below, as far as it is known: what the limits of depth and altitude are held by. They never fail open.
//!
//! The altitude is an echo. Where none comes, or the same one again and again while the depth changes, nothing is known of what
//! lies deeper than the vehicle has been: it descends no further than to where the least altitude was last known to hold, and rises
//! from there as the bottom may. From where it dived by echoes that are not believed any more it rises at once. Where none has ever
//! come it rises to the surface, but for what a chart says.

use crate::Event;
use crate::least::LeastOfLate;
use crate::slope::{SLOPE_MAX, Slope};
use crate::state::{Limits, Run};
use albacore_geometry::Point;
use albacore_program::{Channel, Input, LIMIT_FRESH_S, Slot};
use albacore_vehicle::{TICK_S, Vertical};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The least depth of the water that a chart has within a distance (m) of a place, m; none where it has no depths.
pub type Chart = Arc<dyn Fn(Point, f64) -> Option<f64> + Send + Sync>;

/// What was told so many ticks ago counts.
const FRESH_TICKS: u64 = (LIMIT_FRESH_S / TICK_S) as u64;
/// An altitude this near to the one that is commanded is held, m: then the depth may change and it does not.
const HELD_M: f64 = 0.5;
/// A vehicle that is deeper by so much, m, than it may be has been led too deep.
const SUNK_M: f64 = 0.5;
/// A vehicle that is deeper by so much, m, than the bottom lets it be does not go where it is told: it is told to rise.
const PASSED_M: f64 = 1.0;
/// An echo counts for so long, s, that no other has confirmed, or after which came what is not believed.
const DOUBTFUL_S: f64 = 1.0;
/// Echoes agree that tell of the same depth of the water but for so much, m, and for the slope of the bottom on so much of the way
/// between them at most, m.
const AGREE_M: f64 = 2.0;
const AGREE_WAY_M: f64 = 20.0;
/// Where nothing came for 5 s but what is not believed, the dive that it led to is undone by so many metres: by that a true echo shows
/// itself, too.
pub(crate) const UNDONE_M: f64 = 2.5;
/// An altitude that is below the least by this share of it, or by so much, m, is no noise: it leads up, whatever the depth is told
/// to be.
const LOW_SHARE: f64 = 0.25;
const LOW_MAX_M: f64 = 0.5;
/// A depth or an altitude is told to be held that is given otherwise than asked by more than this, m: it follows the bottom.
const TOLD_M: f64 = 0.5;
/// Who is told to be shallower by more than this, m, is told to rise.
const RISE_M: f64 = 2.0;
/// A chart is asked for so many standard deviations of the position around it, and for so much more, m.
const CHART_SIGMAS: f64 = 3.0;
const CHART_MARGIN_M: f64 = 10.0;

/// What is known of the water below.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Bottom {
    /// The altitude that was told last: by itself it leads up, however deep the vehicle is, and if it is doubted too.
    sounded: Option<Sounded>,
    heard: Option<Heard>,
    /// What came after it is not believed.
    doubted: bool,
    /// The way through the water that was commanded since it came, m; what the current adds is told by the position.
    way: f64,
    /// An echo that does not fit the one before: another has to agree with it. And the way since it came.
    lone: Option<Heard>,
    lone_way: f64,
    slope: Slope,
    /// The tick from which limits are held: an echo may be on its way.
    begun: Option<u64>,
    /// The deepest water that was told, m.
    water_max: f64,
    /// An altitude that was asked for has led too deep, and deeper than by what we hear of it by so much, m.
    below: f64,
    /// The depth that is told again and again, if it is.
    still: Option<Still>,
    /// The water that was told since the vehicle was told to rise, m: a depth that is told late makes of it deeper water.
    in_rise: LeastOfLate,
    /// It was told that the bottom is lost.
    lost: bool,
    /// Where the vehicle is is not known: a chart tells nothing of the water there.
    misplaced: bool,
}

/// An altitude, m, with the tick in which it was told, and the depth, m, that was known then.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Sounded {
    tick: u64,
    altitude: f64,
    depth: f64,
}

/// What an echo tells: depth and water depth when it came, m. Of echoes that are all the same the least of either: as long as they
/// are, they may be one that is told again and again.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Heard {
    tick: u64,
    depth: f64,
    water: f64,
    /// Depth and altitude of the latest, added up.
    water_now: f64,
    /// Whether another has confirmed it: one that came shortly before.
    confirmed: bool,
    /// Whether it agrees with another, whenever that came. One that does not tells nothing once it is too old to count.
    agrees: bool,
    /// Where the vehicle was, as far as it was known.
    at: Option<Point>,
}

/// A depth (m) since it changed last: from then on it tells nothing of how deep an altitude may have led.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Still {
    depth: f64,
    /// For how many ticks another depth was commanded all the same.
    elsewhere: u64,
    /// The way through the water that was commanded since, m.
    way: f64,
    /// Where the vehicle was, as far as it was known.
    at: Option<Point>,
    /// The least that depth and altitude came to since, m. A depth that is stuck makes of a rise deeper water.
    water: f64,
}

impl Heard {
    /// Whether another echo, which tells of so much water, m, so much way later, m, tells of the same bottom.
    fn agrees_with(&self, water: f64, way: f64) -> bool {
        (water - self.water_now).abs() <= AGREE_M + SLOPE_MAX * way.min(AGREE_WAY_M)
    }
}

/// What is known of the water below while a command is made, found once.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Below {
    /// The depth of the vehicle, m.
    depth: f64,
    /// How deep it may go whatever the water is, m.
    deepest: f64,
    /// What the latest echo told, unless it is too old to count.
    heard: Option<Heard>,
    /// The altitude that was told last, m, unless it is too old to count.
    pub sounded: Option<f64>,
    /// The same, less what the vehicle has dived since, where that is less than the limit lets it be, m.
    low: Option<f64>,
}

impl Below {
    /// Whether the altitude by itself is less than the limit lets it be.
    pub fn is_low(&self) -> bool {
        self.low.is_some()
    }
}

impl Bottom {
    /// A position has come, which may be doubted.
    pub fn doubt_place(&mut self, is_doubted: bool) {
        self.misplaced = is_doubted;
    }
}

/// The way that was commanded, m, or that from one place to another, where both are known, if that is more.
fn way_between(commanded: f64, from: Option<Point>, to: Option<Point>) -> f64 {
    commanded.max(from.zip(to).map_or(0.0, |(from, to)| to.distance(from)))
}

impl Run {
    /// Takes in the altitude that has come in this tick, if one has; and the water below, if it is an echo of that.
    pub fn sound(&mut self, is_echo: bool) {
        let tick = self.state.tick;
        let way = self.state.command.map_or(0.0, |command| command.speed) * TICK_S;
        self.state.bottom.way += way;
        self.state.bottom.lone_way += way;
        let (now, here) = (self.depth(), self.place());
        let is_elsewhere = self.state.command.is_some_and(|command| match command.vertical {
            Vertical::Depth(goal) => (goal - now).abs() > HELD_M,
            Vertical::Altitude(_) => false,
        });
        match &mut self.state.bottom.still {
            Some(still) if still.depth == now => {
                still.way += way;
                still.elsewhere += u64::from(is_elsewhere);
            }
            _ => {
                let still = Still { depth: now, elsewhere: 0, way: 0.0, at: here, water: f64::MAX };
                self.state.bottom.still = Some(still);
            }
        }
        if self.is_told_to_rise() {
            self.state.bottom.in_rise.begin(tick);
        }
        let told = |at: Option<u32>, ticks: f64| {
            let at = at.filter(|at| self.get(at + Input::STAMP) >= 0.0)?;
            (tick as f64 - self.get(at + Input::STAMP) <= ticks).then(|| self.get(at + Input::VALUE))
        };
        let depth = told(self.senses.depth, LIMIT_FRESH_S / TICK_S);
        let Some(altitude) = told(self.senses.altitude, 0.0) else { return };
        let last = self.state.bottom.sounded.replace(Sounded { tick, altitude, depth: self.depth() });
        let Some(depth) = depth.filter(|_| is_echo) else { return };
        let held = match self.state.command.map(|command| command.vertical) {
            Some(Vertical::Altitude(goal)) => (altitude - goal).abs() < HELD_M,
            _ => false,
        };
        let water = depth + altitude;
        if let Some(still) = &mut self.state.bottom.still {
            still.water = still.water.min(water);
        }
        self.state.bottom.in_rise.add(tick, water);
        let again = last.is_some_and(|last| last.altitude == altitude) && !held;
        let before = self.state.bottom.heard.filter(|_| again);
        let Bottom { heard, lone, lone_way, way, .. } = self.state.bottom;
        let way = way_between(way, heard.and_then(|heard| heard.at), here);
        let lone_way = lone.map_or(0.0, |lone| way_between(lone_way, lone.at, here));
        let agreed = heard.filter(|heard| heard.agrees_with(water, way));
        let agreed = agreed.or(lone.filter(|lone| lone.agrees_with(water, lone_way)));
        let heard_now = Heard {
            tick,
            depth: before.map_or(depth, |before| before.depth.min(depth)),
            water: before.map_or(water, |before| before.water.min(water)),
            water_now: water,
            confirmed: agreed.is_some_and(|agreed| tick - agreed.tick <= FRESH_TICKS),
            agrees: agreed.is_some(),
            at: here,
        };
        let bottom = &mut self.state.bottom;
        bottom.doubted = false;
        if agreed.is_none() && heard.is_some_and(|heard| heard.agrees) {
            (bottom.lone, bottom.lone_way) = (Some(heard_now), 0.0);
            return;
        }
        if heard.is_some() && agreed.is_none() {
            bottom.slope = Slope::default();
        }
        bottom.slope.sound(water, way);
        if heard_now.agrees {
            bottom.water_max = bottom.water_max.max(water);
        }
        (bottom.heard, bottom.lone, bottom.way) = (Some(heard_now), None, 0.0);
    }

    /// Whether the mission asks for a depth above that of the vehicle, or for a greater altitude than it has, or a limit leads up.
    fn is_told_to_rise(&self) -> bool {
        let rises = |vertical: Vertical| match vertical {
            Vertical::Depth(metres) => metres < self.depth() - RISE_M,
            Vertical::Altitude(metres) => self.sounded().is_some_and(|altitude| metres > altitude + RISE_M),
        };
        rises(self.state.asked.vertical) || self.state.command.is_some_and(|command| rises(command.vertical))
    }

    /// Where the vehicle is, unless that is not known any more.
    fn place(&self) -> Option<Point> {
        let age = |at: Slot| self.state.tick as f64 - self.get(at + Input::STAMP);
        let told = |at: &Slot| self.get(at + Input::STAMP) >= 0.0 && age(*at) <= LIMIT_FRESH_S / TICK_S;
        self.senses.position.filter(told).map(|_| self.position())
    }

    /// The way since the latest echo, m: through the water as commanded, or over ground, if that is more. A current carries who stands
    /// still, too.
    fn way(&self) -> f64 {
        way_between(self.state.bottom.way, self.state.bottom.heard.and_then(|heard| heard.at), self.place())
    }

    /// The way since the depth changed last, m.
    fn still_way(&self) -> f64 {
        self.state.bottom.still.map_or(0.0, |still| way_between(still.way, still.at, self.place()))
    }

    /// The least water, m, that was sounded since the depth changed last, of one that should have changed since.
    fn still_water(&self) -> f64 {
        let is_stuck = |still: &Still| still.elsewhere as f64 * TICK_S > LIMIT_FRESH_S;
        self.state.bottom.still.filter(is_stuck).map_or(f64::MAX, |still| still.water)
    }

    /// An altitude has come that is not believed.
    pub fn doubt_sounding(&mut self) {
        self.state.bottom.doubted = true;
    }

    /// Holds what is asked of the vertical within the limits. Depth and altitude are bound to one another by the water's depth:
    /// the limits of both hold, whichever is asked for. Of two that cannot both hold, the one that leads up does.
    pub fn limit_vertical(&mut self, asked: Vertical, below: &Below) -> Vertical {
        let Limits { altitude, depth, .. } = self.state.limits;
        let Below { deepest, heard: known, .. } = *below;
        let bounded = altitude.0 > 0.0 || deepest < f64::MAX;
        let floor = self.floor(altitude.0, known).min(deepest);
        let is_lost = known.is_none() && altitude.0 > 0.0;
        self.tell_of_bottom(is_lost, floor);
        // Who is told to be deeper than any command can have led has a depth that is told wrong: with a bottom that is lost, it goes up.
        let is_passed = below.depth > floor + PASSED_M;
        let must_rise = below.is_low() || is_passed && (floor < deepest || is_lost);
        let up = self.leads_up(floor);
        let floor = if known.is_some() { floor.min(self.floor_in_rise(altitude.0)) } else { floor };
        let given = match (asked, known) {
            (Vertical::Depth(_), _) if must_rise => Vertical::Depth(up),
            (Vertical::Altitude(metres), Some(Heard { water_now: water, .. })) => {
                let given = self.within_limits(Channel::Altitude, metres);
                let highest = if depth.0 > 0.0 { (water - depth.0).max(altitude.0) } else { f64::MAX };
                let given = given.max(self.ahead(altitude.0)).min(highest);
                match self.may_lead_too_deep(given, water, deepest) {
                    true if must_rise => Vertical::Depth(up),
                    true => Vertical::Depth((water - given).min(floor).max(0.0)),
                    false => Vertical::Altitude(given),
                }
            }
            // An altitude that nobody measures cannot be held within anything.
            (Vertical::Altitude(_), None) if bounded => Vertical::Depth(if must_rise { up } else { floor }),
            (Vertical::Altitude(metres), None) => Vertical::Altitude(self.within_limits(Channel::Altitude, metres)),
            (Vertical::Depth(metres), _) => {
                let given = self.within_limits(Channel::Depth, metres);
                let shallowest = known.map_or(0.0, |heard| heard.water - altitude.1);
                Vertical::Depth(given.max(shallowest).min(floor).max(0.0))
            }
        };
        self.tell_limited_vertical(asked, given, known.map(|heard| heard.water_now));
        given
    }

    /// Says when a depth or an altitude that is asked for is held by its own limit, or is told otherwise by more than noise for the sake of
    /// the other, `water` deep (m).
    fn tell_limited_vertical(&mut self, asked: Vertical, given: Vertical, water: Option<f64>) {
        let (channel, asked, given) = match (asked, given, water) {
            (Vertical::Depth(asked), Vertical::Depth(given), _) => (Channel::Depth, asked, given),
            (Vertical::Altitude(asked), Vertical::Altitude(given), _) => (Channel::Altitude, asked, given),
            (Vertical::Altitude(asked), Vertical::Depth(given), Some(water)) => {
                (Channel::Altitude, asked, water - given)
            }
            // An altitude that is unknown has been told to be.
            (Vertical::Altitude(asked), ..) => (Channel::Altitude, asked, self.within_limits(Channel::Altitude, asked)),
            (Vertical::Depth(asked), ..) => (Channel::Depth, asked, asked),
        };
        let other = if channel == Channel::Depth { Channel::Altitude } else { Channel::Depth };
        self.tell_limited(other, None);
        let own = self.within_limits(channel, asked);
        let apart = if self.state.limited[channel as usize] { 0.0 } else { TOLD_M };
        let held = own != asked || (given - asked).abs() > apart;
        self.tell_limited(channel, held.then_some((asked, given)));
    }

    /// The depth, m, that a vehicle is told that must rise: the least, or less where the water allows no more. How deep it is may
    /// be told wrong, and the floor with it: one that does not rise is told to surface.
    fn leads_up(&self, floor: f64) -> f64 {
        if self.state.lift.is_patient() { self.state.limits.depth.0.min(floor) } else { 0.0 }
    }

    /// Whether an altitude may lead deeper than the vehicle may be, in water of a depth, m: then it is held by the depth that it comes to.
    /// The vehicle may measure another altitude than we hear, or go by an older one: once that has led too deep, it would again. And a
    /// depth that is stuck or late in a dive makes the water seem to become shallower: it counts as deep as it ever was. A depth that
    /// is stuck while the altitude is held hides a bottom that falls.
    fn may_lead_too_deep(&mut self, altitude: f64, water: f64, deepest: f64) -> bool {
        let (depth, hidden) = (self.depth(), SLOPE_MAX * self.still_way());
        let bottom = &mut self.state.bottom;
        if depth > deepest + SUNK_M {
            bottom.below = bottom.below.max(depth - (water - altitude));
        }
        let may = bottom.water_max.max(water) + hidden - altitude + bottom.below > deepest;
        if !may {
            bottom.below = 0.0;
        }
        may
    }

    /// What is known while a command is made, from the first of which on limits are held.
    pub fn below(&mut self) -> Below {
        self.state.bottom.begun.get_or_insert(self.state.tick);
        let least = self.state.limits.altitude.0;
        let low = least - (LOW_SHARE * least).min(LOW_MAX_M);
        let (depth, sounded) = (self.depth(), self.sounded_lately());
        // A hull that dives goes on for some metres after it is told to rise.
        let now = sounded.map(|sounded| sounded.altitude - (depth - sounded.depth).max(0.0));
        Below {
            depth,
            deepest: self.deepest(),
            heard: self.heard_lately(),
            sounded: sounded.map(|sounded| sounded.altitude),
            low: now.filter(|altitude| *altitude < low),
        }
    }

    /// The altitude that was told last, m, unless it is too old to count.
    fn sounded(&self) -> Option<f64> {
        self.sounded_lately().map(|sounded| sounded.altitude)
    }

    fn sounded_lately(&self) -> Option<Sounded> {
        self.state.bottom.sounded.filter(|sounded| self.state.tick - sounded.tick <= FRESH_TICKS)
    }

    /// What the latest echo told, unless it is too old to count.
    fn heard_lately(&self) -> Option<Heard> {
        let (fresh, doubted) = (self.state.echo_fresh, self.state.bottom.doubted);
        let fresh = |heard: &Heard| if heard.confirmed && !doubted { fresh } else { fresh.min(DOUBTFUL_S / TICK_S) };
        let age = |heard: &Heard| (self.state.tick - heard.tick + self.state.lag.round_trip) as f64;
        let counts = |heard: &Heard| (heard.agrees || self.has_just_begun()) && age(heard) <= fresh(heard);
        let heard = self.state.bottom.heard.filter(counts)?;
        // One that does not fit it may yet be the bottom, which is nearer then.
        let lone = self.state.bottom.lone.filter(|lone| age(lone) <= DOUBTFUL_S / TICK_S);
        Some(match lone.filter(|lone| lone.water < heard.water) {
            Some(lone) => Heard { water: lone.water, water_now: lone.water_now.min(heard.water_now), ..heard },
            None => heard,
        })
    }

    /// The latest echo that tells of the bottom though it is too old to count: another agreed with it.
    fn heard_before(&self) -> Option<Heard> {
        self.state.bottom.heard.filter(|heard| heard.agrees)
    }

    /// Whether depth or altitude has a limit that leads up.
    pub fn bounds_vertical(&self) -> bool {
        self.state.limits.altitude.0 > 0.0 || self.deepest() < f64::MAX
    }

    /// How deep the vehicle may go whatever the water is, m.
    fn deepest(&self) -> f64 {
        self.state.limits.depth.1.min(self.above_bottom())
    }

    /// By how much the vehicle is deeper than it may be, m, as far as that is known: by its depth, and without one by its altitude. Without
    /// either it is taken to be as deep as it was: nothing tells that it rises. Of a bottom that is lost it is known that it may rise on
    /// the way.
    pub fn too_deep(&self, below: &Below) -> Option<f64> {
        let least = self.state.limits.altitude.0;
        let told = |stamp: f64| stamp >= 0.0;
        let fresh = |stamp: f64| told(stamp) && self.state.tick as f64 - stamp <= LIMIT_FRESH_S / TICK_S;
        let stamp = self.get(self.senses.depth? + Input::STAMP);
        match (below.sounded, told(stamp)) {
            (None, false) => return None,
            (Some(altitude), false) => return Some(least - altitude),
            // The depth that was told last is the best that is known of it.
            (Some(altitude), true) if !fresh(stamp) => {
                return Some((least - altitude).max(below.depth - below.deepest));
            }
            _ => {}
        }
        let by_altitude = match (self.heard_before(), below.heard) {
            (_, Some(heard)) => heard.water - self.ahead(least),
            (Some(heard), None) if least > 0.0 => self.risen(heard, least),
            (None, None) if least > 0.0 => self.charted().map_or(self.unheard(), |water| water - least),
            _ => f64::MAX,
        };
        let by = below.depth - by_altitude.min(below.deepest).max(0.0);
        // What is low leads up though it is not believed: a depth that is stuck disproves every altitude.
        Some(below.low.map_or(by, |altitude| by.max(least - altitude)))
    }

    /// How deep the vehicle may go if the bottom has risen on the way since an echo, m.
    fn risen(&self, heard: Heard, altitude_min: f64) -> f64 {
        heard.water - self.ahead(altitude_min) - SLOPE_MAX * self.way()
    }

    /// How deep the vehicle may go by a least altitude, m, and by what is known of the water.
    fn floor(&self, altitude_min: f64, known: Option<Heard>) -> f64 {
        let floor = match (self.heard_before(), known) {
            (_, Some(heard)) => heard.water.min(self.still_water()) - self.ahead(altitude_min),
            _ if altitude_min <= 0.0 && !self.asks_for_altitude() => return f64::MAX,
            (Some(heard), None) => {
                let lasts = (self.state.tick - heard.tick) as f64 * TICK_S;
                let undone = if self.state.bottom.doubted && lasts > LIMIT_FRESH_S { UNDONE_M } else { 0.0 };
                (heard.depth - undone).min(self.risen(heard, altitude_min))
            }
            (None, None) => self.charted().map_or(self.unheard(), |water| water - altitude_min),
        };
        floor.max(0.0)
    }

    /// How deep the vehicle may go by the water that was told since a rise, if the depth is told late, m.
    fn floor_in_rise(&self, altitude_min: f64) -> f64 {
        (self.state.bottom.in_rise.least(self.state.tick) - self.ahead(altitude_min)).max(0.0)
    }

    /// The altitude here at which a least altitude, m, will hold ahead.
    fn ahead(&self, altitude_min: f64) -> f64 {
        if altitude_min > 0.0 { altitude_min + self.state.bottom.slope.rises() } else { altitude_min }
    }

    fn asks_for_altitude(&self) -> bool {
        matches!(self.state.asked.vertical, Vertical::Altitude(_))
    }

    /// Where no echo has come yet: no deeper than now for as long as one may be on its way, then the surface.
    fn unheard(&self) -> f64 {
        if self.has_just_begun() { self.depth() } else { 0.0 }
    }

    fn has_just_begun(&self) -> bool {
        self.state.bottom.begun.map_or(0, |begun| self.state.tick - begun) <= FRESH_TICKS
    }

    fn charted(&self) -> Option<f64> {
        let chart = self.chart.as_ref().filter(|_| !self.state.bottom.misplaced)?;
        // Where the vehicle was is no place where it is.
        let age = |at: Slot| self.state.tick as f64 - self.get(at + Input::STAMP) + self.state.lag.round_trip as f64;
        let told = |at: &Slot| self.get(at + Input::STAMP) >= 0.0 && age(*at) <= LIMIT_FRESH_S / TICK_S;
        let at = self.senses.position.filter(told)?;
        let sigma = self.get(at + Input::VALUE + 2);
        chart(self.position(), CHART_SIGMAS * sigma + CHART_MARGIN_M)
    }

    /// Says once that the bottom is lost, and that it is found again. What has just begun is no loss.
    fn tell_of_bottom(&mut self, lost: bool, floor: f64) {
        let lost = lost && !(self.state.bottom.heard.is_none() && self.has_just_begun());
        if lost != self.state.bottom.lost {
            self.state.bottom.lost = lost;
            self.events.push(if lost { Event::BottomLost(floor) } else { Event::BottomFound });
        }
    }
}
