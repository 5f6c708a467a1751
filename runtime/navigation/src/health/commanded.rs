//! What was told against what was commanded: a vehicle that does not follow, or a sensor that does not tell that it does.

use super::{Anomalies, Anomaly, Credible, Heard};
use albacore_geometry::Heading;
use albacore_geometry::math::PI;
use albacore_vehicle::measurements::{ALTITUDE, DEPTH, HEADING};
use albacore_vehicle::{Command, Vertical};

/// The heading may be so far from the one commanded, rad, and further for so many ticks, 20 s, in which it turns towards that by no
/// more than this. A slow hull lags behind in a spiral, and takes its time to turn right about.
const HEADING_MAX: f64 = 60.0 * PI / 180.0;
const HEADING_TICKS: u64 = 200;
const HEADING_TURNS: f64 = 15.0 * PI / 180.0;
/// It stands still for so many ticks while another is commanded: 10 s.
const HEADING_SAME: u64 = 100;
/// Below this speed a vehicle cannot steer, m/s.
const SPEED_MIN: f64 = 0.5;
/// Depth and altitude are looked at so many ticks apart: 30 s ...
const LOOK_TICKS: u64 = 300;
/// ... in which they come nearer to what is commanded by so much, m, or are as near as this, m.
const NEARER_MIN: f64 = 0.5;
const NEAR: f64 = 1.5;
/// A goal that moves by more than this, m, is another one.
const GOAL_MOVES: f64 = 0.3;
/// Above this depth a vehicle may be held down by nothing but the surface, m.
const SURFACE: f64 = 0.3;
/// A depth that is exactly the same for so many ticks, 20 s, while another is commanded; an altitude for 10 s while the depth
/// changes by so much, m, in itself and in its mean over some 20 s: waves raise and lower what the pressure gauge tells.
const DEPTH_SAME: u64 = 200;
const ALTITUDE_SAME: u64 = 100;
const DEPTH_CHANGES: f64 = 1.0;
const DEPTH_MEAN_TICKS: f64 = 200.0;
/// While a depth stays the same altitudes that lie no farther apart, m, the last no older than so many ticks, 5 s, say that it is true: the
/// vehicle does not dive, held by limits of its own, say.
const LEVEL: f64 = 1.0;
const LEVEL_TICKS: u64 = 50;
/// An altitude so near to the one commanded, m, is held.
const HELD: f64 = 0.5;

/// What is remembered of how commands are followed.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Commanded {
    astray: Option<HeadingError>,
    goal: Option<Goal>,
    depth: Depth,
    /// That when the altitude was first told that is still told.
    depth_then: Option<Depth>,
    /// The altitudes since the depth is the same.
    altitudes: Option<Altitudes>,
}

/// The least and the greatest of altitudes, m, and when the last of them was told.
#[derive(Clone, Copy, Debug)]
struct Altitudes {
    least: f64,
    greatest: f64,
    tick: u64,
}

/// A heading that is far off.
#[derive(Clone, Copy, Debug)]
struct HeadingError {
    /// What was told last, and which way from there the one commanded is the nearer.
    heading: Heading,
    is_clockwise: bool,
    /// For how many ticks it has not turned there enough, and by how much it has, rad.
    ticks: u64,
    turned: f64,
}

/// The depth that was told last, when, and its mean, m.
#[derive(Clone, Copy, Debug, Default)]
struct Depth {
    tick: u64,
    last: f64,
    mean: Option<f64>,
}

impl Depth {
    fn hear(&mut self, tick: u64, depth: f64) {
        let mean = self.mean.unwrap_or(depth);
        let share = (tick.saturating_sub(self.tick) as f64 / DEPTH_MEAN_TICKS).min(1.0);
        *self = Depth { tick, last: depth, mean: Some(mean + share * (depth - mean)) };
    }

    /// How far from a depth it is, by itself and by its mean: waves are not the vehicle's.
    fn off(self, wanted: f64) -> f64 {
        let off = |depth: f64| (depth - wanted).abs();
        off(self.last).min(off(self.mean.unwrap_or(self.last)))
    }

    /// Whether it is another than it was, by itself and by its mean. A vehicle that had just come to rest then was already where its mean
    /// was going.
    fn differs(self, then: Depth) -> bool {
        let both = |depth: Depth| (depth.last, depth.mean.unwrap_or(depth.last));
        let ((now, mean), (last, mean_then)) = (both(self), both(then));
        now.min(mean) > last.max(mean_then) + DEPTH_CHANGES || now.max(mean) < last.min(mean_then) - DEPTH_CHANGES
    }
}

/// A depth or an altitude that is to be reached.
#[derive(Clone, Copy, Debug)]
struct Goal {
    vertical: Vertical,
    /// The tick of the last look, and how far off it has been at most since, m: a hull that dives fast goes on for a while.
    since: u64,
    farthest: f64,
    /// It was no nearer at the last look.
    missed: bool,
}

impl Commanded {
    pub fn look(&mut self, heard: &Heard, command: Option<&Command>, speed: f64, anomalies: &mut Anomalies) {
        if let Some(told) = heard.depth {
            self.depth.hear(heard.tick, told.reading[0]);
        }
        self.gather_altitudes(heard);
        self.look_at_altitude(heard.altitude, command, anomalies);
        let Some(command) = command else {
            *self = Commanded { depth: self.depth, altitudes: self.altitudes, ..Commanded::default() };
            return;
        };
        if let Some(told) = heard.heading {
            self.look_at_heading(told, command, speed, anomalies);
        }
        self.look_at_goal(heard, command.vertical, speed.min(command.speed) > SPEED_MIN, anomalies);
    }

    /// Is it far off, and does not turn to where it should?
    fn look_at_heading(&mut self, told: Credible, command: &Command, speed: f64, anomalies: &mut Anomalies) {
        let heading = Heading::from_radians(told.reading[0]);
        let off = command.heading - heading;
        if off.abs() <= HEADING_MAX || speed.min(command.speed) <= SPEED_MIN {
            self.astray = None;
            return;
        }
        let is_clockwise = off > 0.0;
        let before = self.astray.unwrap_or(HeadingError { heading, is_clockwise, ticks: 0, turned: 0.0 });
        let clockwise = heading - before.heading;
        let turned = before.turned + if before.is_clockwise { clockwise } else { -clockwise };
        let (ticks, turned) = if turned > HEADING_TURNS { (0, 0.0) } else { (before.ticks + 1, turned) };
        self.astray = Some(HeadingError { heading, is_clockwise, ticks, turned });
        if ticks > HEADING_TICKS {
            anomalies.see(Anomaly::HeadingNotAsCommanded);
        }
        if ticks.min(told.same) > HEADING_SAME {
            anomalies.see(Anomaly::Stuck(HEADING));
        }
    }

    /// Every 30 s: is it nearer?
    fn look_at_goal(&mut self, heard: &Heard, vertical: Vertical, has_way: bool, anomalies: &mut Anomalies) {
        let (told, wanted, anomaly) = match vertical {
            Vertical::Depth(depth) => (heard.depth, depth, Anomaly::DepthNotAsCommanded),
            Vertical::Altitude(altitude) => (heard.altitude, altitude, Anomaly::AltitudeNotAsCommanded),
        };
        let Some(told) = told else { return };
        // Where the water is too shallow for an altitude the vehicle swims at the surface; from there it has yet to set out.
        if matches!(vertical, Vertical::Altitude(_)) && self.depth.last < SURFACE {
            self.goal = None;
            return;
        }
        let off = match vertical {
            Vertical::Altitude(_) => (told.reading[0] - wanted).abs(),
            Vertical::Depth(_) => self.depth.off(wanted),
        };
        let now = Goal { vertical, since: heard.tick, farthest: off, missed: false };
        let goal = self.goal.get_or_insert(now);
        if !is_same(goal.vertical, vertical) {
            *goal = now;
        } else if heard.tick >= goal.since + LOOK_TICKS {
            *goal = Goal { missed: off > NEAR && off > goal.farthest - NEARER_MIN, ..now };
        } else {
            goal.farthest = goal.farthest.max(off);
        }
        if goal.missed {
            anomalies.see(anomaly);
            let is_depth = matches!(vertical, Vertical::Depth(_));
            // A hull without way may well stay where it is.
            let is_still = has_way && told.same > DEPTH_SAME && self.depth.last >= SURFACE;
            if is_depth && is_still && !self.is_level(heard.tick) {
                anomalies.see(Anomaly::Stuck(DEPTH));
            }
        }
    }

    fn gather_altitudes(&mut self, heard: &Heard) {
        if heard.depth.is_some_and(|told| told.same == 0) {
            self.altitudes = None;
        }
        if let Some(told) = heard.altitude {
            let (altitude, before) = (told.reading[0], self.altitudes);
            let bound = |of: fn(&Altitudes) -> f64, pick: fn(f64, f64) -> f64| {
                before.as_ref().map_or(altitude, |before| pick(of(before), altitude))
            };
            let (least, greatest) = (bound(|a| a.least, f64::min), bound(|a| a.greatest, f64::max));
            self.altitudes = Some(Altitudes { least, greatest, tick: heard.tick });
        }
    }

    /// Whether the altitude says that the vehicle stays as deep as it is.
    fn is_level(&self, tick: u64) -> bool {
        self.altitudes.is_some_and(|a| a.greatest - a.least < LEVEL && tick <= a.tick + LEVEL_TICKS)
    }

    /// An altitude that stays the same while the depth changes, and is not what is held.
    fn look_at_altitude(&mut self, told: Option<Credible>, command: Option<&Command>, anomalies: &mut Anomalies) {
        let Some(told) = told else { return };
        let is_held = match command.map(|command| command.vertical) {
            Some(Vertical::Depth(_)) => false,
            Some(Vertical::Altitude(goal)) => (told.reading[0] - goal).abs() < HELD,
            None => true,
        };
        if told.same == 0 || is_held {
            self.depth_then = None;
            return;
        }
        let then = *self.depth_then.get_or_insert(self.depth);
        if told.same > ALTITUDE_SAME && self.depth.differs(then) {
            anomalies.see(Anomaly::Stuck(ALTITUDE));
        }
    }
}

fn is_same(a: Vertical, b: Vertical) -> bool {
    match (a, b) {
        (Vertical::Depth(a), Vertical::Depth(b)) | (Vertical::Altitude(a), Vertical::Altitude(b)) => {
            (a - b).abs() <= GOAL_MOVES
        }
        _ => false,
    }
}
