//! What a vehicle cannot have done is not believed at once: one wrong sample is no reason to steer, and none to abort a mission.
//!
//! A sample that cannot follow the last one that was believed, for its distance, its time and what is known of the errors of both,
//! is withheld and told. It is believed when it persists: when samples that follow one another have said so for a while. So is all
//! of a channel that is wrong more often than now and then, even where it happens to fit. What no sensor can measure is never
//! believed. The limits are those of the watch ([`crate::HealthMonitor`]).

use crate::health::Kind;
use albacore_geometry::math::{asin, degrees};
use albacore_geometry::{Heading, Point};
use albacore_vehicle::channels::{ALTITUDE, BATTERY, COURSE, DEPTH, HEADING, POSITION, SPEED};
use albacore_vehicle::{Reading, TICK_S};
use std::fmt;

/// What persists for so long, s, and for so many samples, is believed.
const PERSISTS_S: f64 = 2.0;
const PERSISTS_SAMPLES: u32 = 3;
/// A bottom that comes nearer is believed with so many samples: to wait would be the greater risk.
const NEARER_SAMPLES: u32 = 2;
/// A first sample has nothing to follow: within so much, m, of where missions begin it is believed, and elsewhere with the second.
const BEGINS_WITHIN_M: f64 = 2_000.0;
const BEGINS_ABOVE_M: f64 = 20.0;
/// ... or a first battery with less in it than this.
const BEGINS_CHARGED: f64 = 0.2;
const FIRST_SAMPLES: u32 = 2;
/// From this speed over ground on the course turns as the nose does, m/s: at rest it is any, and against a current that leaves the
/// vehicle little way it turns many times as fast.
const HAS_COURSE: f64 = 1.0;
/// ... and as waves carry the vehicle to and fro, which change its velocity by so much in a second, m/s2, and by so much at most, m/s.
const SWAY: f64 = 2.5;
const SWAY_MAX: f64 = 2.0;
/// Each sample that is doubted counts so much, up to the most, and each that is believed takes one away. Above the trusted number a
/// sample is not believed because it fits: one in three may be wrong, and of several in a row no more than these.
const DOUBT: u32 = 2;
const DOUBTS_TRUSTED: u32 = 6;
const DOUBTS_MAX: u32 = 20;
/// That a channel was doubted is told again when it was not for so many ticks: 15 s.
const AGAIN_TICKS: u64 = 150;

/// The channels that are judged: what is measured of the vehicle itself, which is slow. What is measured of the water (flow, chemical,
/// temperature, salinity) may have any edge, and a mode is a word and no measure.
const JUDGED: [(u16, Kind); 7] = [
    (POSITION, Kind::Position),
    (COURSE, Kind::Course),
    (HEADING, Kind::Heading),
    (SPEED, Kind::Speed),
    (DEPTH, Kind::Depth),
    (ALTITUDE, Kind::Altitude),
    (BATTERY, Kind::Battery),
];

/// What is told of a doubt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Doubt {
    kind: Kind,
    change: Change,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Change {
    /// It has changed by so much in so many seconds, and is withheld.
    Rejected(f64, f64),
    /// It says so for so many seconds now, and is believed.
    Believed(f64, f64),
    /// It cannot be.
    Impossible(f64),
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (name, kind) = (self.kind.name(), self.kind);
        let by = |change: f64| match kind {
            Kind::Position => format!("{change:.0} m away"),
            Kind::Course | Kind::Heading => format!("{:.0} deg off", degrees(change)),
            Kind::Speed | Kind::Flow => format!("{change:.1} m/s off"),
            Kind::Chemical => format!("{change:.2} off"),
            Kind::Battery => format!("{:.0} % off", 100.0 * change),
            Kind::Depth | Kind::Altitude => format!("{change:.1} m off"),
        };
        match self.change {
            Change::Rejected(change, time) => write!(f, "rejected: {name}, {} in {time:.1} s", by(change)),
            Change::Believed(change, time) => write!(f, "believed: {name}, {} for {time:.1} s", by(change)),
            Change::Impossible(sigma) if kind == Kind::Position => {
                write!(f, "rejected: {name}, a sigma of {sigma:.1} m cannot be")
            }
            Change::Impossible(value) => write!(f, "rejected: {name}, {value:.1} cannot be"),
        }
    }
}

/// What persists, or does not.
#[derive(Clone, Copy, Debug)]
struct Doubtful {
    reading: Reading,
    tick: u64,
    since: u64,
    samples: u32,
}

/// A channel and what is believed of it.
#[derive(Clone, Copy, Debug)]
struct Channel {
    kind: Kind,
    believed: Option<(Reading, u64)>,
    /// Whether a second sample has confirmed what is believed.
    confirmed: bool,
    /// When a sample came last, whatever it said: what a vehicle may have done since grows with the time without any.
    came: u64,
    doubtful: Option<Doubtful>,
    /// How much the channel is doubted.
    doubts: u32,
    /// When it was doubted last.
    doubted: Option<u64>,
}

/// The gate of one run.
#[derive(Clone, Debug)]
pub struct Gate {
    channels: [Channel; JUDGED.len()],
    /// The speed over ground that was believed last, m/s.
    speed: f64,
    events: Vec<Doubt>,
}

impl Default for Gate {
    fn default() -> Self {
        Gate { channels: JUDGED.map(|(_, kind)| Channel::new(kind)), speed: 0.0, events: Vec::new() }
    }
}

impl Gate {
    /// Whether a sample of a tick is believed.
    pub fn believes(&mut self, tick: u64, channel: u16, reading: Reading) -> bool {
        let Some(index) = JUDGED.iter().position(|(judged, _)| *judged == channel) else { return true };
        if channel == COURSE && self.speed < HAS_COURSE && is_possible(Kind::Course, reading) {
            // What follows has nothing to follow.
            self.channels[index] = Channel::new(Kind::Course);
            return true;
        }
        let believed = self.channels[index].judge(tick, reading, self.speed, &mut self.events);
        if channel == SPEED && believed {
            self.speed = reading[0];
        }
        believed
    }

    /// What was doubted and believed again since this was last asked.
    pub fn take_events(&mut self) -> Vec<Doubt> {
        std::mem::take(&mut self.events)
    }
}

impl Channel {
    fn new(kind: Kind) -> Self {
        Channel { kind, believed: None, confirmed: false, came: 0, doubtful: None, doubts: 0, doubted: None }
    }

    /// Judges a sample of a vehicle that makes a speed over ground, m/s.
    fn judge(&mut self, tick: u64, reading: Reading, speed: f64, events: &mut Vec<Doubt>) -> bool {
        // That a number is none is seen by everybody.
        if reading.iter().any(|x| !x.is_finite()) {
            return true;
        }
        let kind = self.kind;
        if !is_possible(kind, reading) {
            self.came = tick;
            self.doubtful = None;
            self.doubt(tick, Change::Impossible(if kind == Kind::Position { reading[2] } else { reading[0] }), events);
            return false;
        }
        let seconds = |since: u64| tick.saturating_sub(since) as f64 * TICK_S;
        let came = std::mem::replace(&mut self.came, tick);
        let is_next = match self.believed {
            Some((before, _)) => follows(kind, reading, before, seconds(came), speed),
            None => begins(kind, reading),
        };
        if is_next && self.doubts <= DOUBTS_TRUSTED {
            self.believe(tick, reading);
            return true;
        }
        let (before, at) = self.believed.unwrap_or((Reading::default(), 0));
        let change = change(kind, reading, before);
        let first = Doubtful { reading, tick, since: tick, samples: 1 };
        let doubtful = match self.doubtful {
            Some(d) if follows(kind, reading, d.reading, seconds(d.tick), speed) => {
                Doubtful { since: d.since, samples: d.samples + 1, ..first }
            }
            _ => first,
        };
        let lasts = seconds(doubtful.since);
        let nearer = kind == Kind::Altitude && reading[0] < before[0];
        let persists = if self.believed.is_none() || !self.confirmed {
            doubtful.samples >= FIRST_SAMPLES
        } else if nearer {
            doubtful.samples >= NEARER_SAMPLES
        } else {
            doubtful.samples >= PERSISTS_SAMPLES && lasts >= PERSISTS_S
        };
        if persists {
            events.push(Doubt { kind, change: Change::Believed(change, lasts) });
            // A bottom that comes nearer is believed for itself; the channel is as doubtful as before.
            self.doubts = if nearer { self.doubts } else { 0 };
            self.believe(tick, reading);
            return true;
        }
        self.doubtful = Some(doubtful);
        if !is_next {
            self.doubt(tick, Change::Rejected(change, seconds(at)), events);
        }
        false
    }

    fn believe(&mut self, tick: u64, reading: Reading) {
        self.confirmed = self.believed.is_some();
        (self.believed, self.doubtful) = (Some((reading, tick)), None);
        self.doubts = self.doubts.saturating_sub(1);
    }

    fn doubt(&mut self, tick: u64, change: Change, events: &mut Vec<Doubt>) {
        let again = self.doubted.is_some_and(|last| tick < last + AGAIN_TICKS);
        if !again {
            events.push(Doubt { kind: self.kind, change });
        }
        self.doubted = Some(tick);
        self.doubts = (self.doubts + DOUBT).min(DOUBTS_MAX);
    }
}

/// Whether a reading can be. A position may be anywhere: where missions are is not known here; its standard deviation may not.
fn is_possible(kind: Kind, reading: Reading) -> bool {
    if kind == Kind::Position { reading[2] >= 0.0 } else { kind.can_be(reading) }
}

/// Whether a reading can follow another after some seconds, of a vehicle that makes a speed over ground, m/s. The gate judges a course
/// of a vehicle under way alone.
fn follows(kind: Kind, now: Reading, before: Reading, time: f64, speed: f64) -> bool {
    if kind != Kind::Course {
        return kind.can_follow(now, before, time);
    }
    let (now, before) = (Heading::from_radians(now[0]), Heading::from_radians(before[0]));
    let sway = asin(((SWAY * time).min(SWAY_MAX) / speed).min(1.0));
    let turn = now - before;
    // What waves add to a turn is to either side.
    let turned = before + turn.signum() * (turn.abs() - sway).max(0.0);
    Kind::Heading.can_follow([turned.radians(), 0.0, 0.0, 0.0], [before.radians(), 0.0, 0.0, 0.0], time)
}

/// Whether a first reading is where missions begin.
fn begins(kind: Kind, reading: Reading) -> bool {
    match kind {
        Kind::Position => Point::new(reading[0], reading[1]).distance(Point::ORIGIN) <= BEGINS_WITHIN_M,
        Kind::Depth => reading[0] <= BEGINS_ABOVE_M,
        Kind::Battery => reading[0] >= BEGINS_CHARGED,
        _ => true,
    }
}

/// By how much a reading differs from another, in SI units.
fn change(kind: Kind, now: Reading, before: Reading) -> f64 {
    match kind {
        Kind::Position | Kind::Flow => Point::new(now[0], now[1]).distance(Point::new(before[0], before[1])),
        Kind::Course | Kind::Heading => (Heading::from_radians(now[0]) - Heading::from_radians(before[0])).abs(),
        _ => (now[0] - before[0]).abs(),
    }
}

#[cfg(test)]
mod tests;
