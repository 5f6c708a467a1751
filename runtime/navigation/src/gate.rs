//! What a vehicle cannot have done is not believed at once: one wrong sample is no reason to steer, and none to abort a mission.
//!
//! A sample that cannot follow the last one that was believed, for its distance, its time and what is known of the errors of both,
//! is withheld and told. It is believed when it persists: when samples that follow one another have said so for a while. So is all
//! of a measurement that is wrong more often than now and then, even where it happens to fit. What no sensor can measure is never
//! believed. The limits are those of the watch ([`crate::HealthMonitor`]).

use crate::places::Places;
use albacore_geometry::math::asin;
use albacore_geometry::{Heading, Point};
use albacore_vehicle::measurements::{
    self, ALTITUDE, BATTERY, COURSE, DEPTH, HEADING, MeasurementInfo, POSITION, SPEED, info,
};
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
/// ... and a position whose standard deviation is no more than this, m: a larger one would let any other follow it.
const BEGINS_SIGMA_M: f64 = 100.0;
/// The standard deviation of a poor satellite fix, m an axis.
const FIX_SIGMA_M: f64 = 10.0;
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
/// That a measurement was doubted is told again when it was not for so many ticks: 15 s.
const AGAIN_TICKS: u64 = 150;

/// What is told of a doubt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Doubt {
    measurement: u16,
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
        let MeasurementInfo { name, quantity, .. } = info(self.measurement);
        let by = |change: f64| quantity.show_difference(change);
        match self.change {
            Change::Rejected(change, time) => write!(f, "rejected: {name}, {} in {time:.1} s", by(change)),
            Change::Believed(change, time) => write!(f, "believed: {name}, {} for {time:.1} s", by(change)),
            Change::Impossible(sigma) if self.measurement == POSITION => {
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

/// A measurement and what is believed of it.
#[derive(Clone, Copy, Debug)]
struct Judged {
    number: u16,
    believed: Option<(Reading, u64)>,
    /// Whether a second sample has confirmed what is believed.
    confirmed: bool,
    /// When a sample came last, whatever it said: what a vehicle may have done since grows with the time without any.
    came: u64,
    doubtful: Option<Doubtful>,
    /// How much the measurement is doubted.
    doubts: u32,
    /// When it was doubted last.
    doubted: Option<u64>,
}

/// The gate of one run.
#[derive(Clone, Debug)]
pub struct Gate {
    /// Those that are judged, and the place of each measurement among them.
    measurements: Vec<Judged>,
    places: Places,
    /// The speed over ground that was believed last, m/s.
    speed: f64,
    events: Vec<Doubt>,
}

impl Default for Gate {
    fn default() -> Self {
        let judged = (0..).zip(&measurements::ALL).filter(|(_, row)| row.is_gated);
        Gate {
            measurements: judged.map(|(number, _)| Judged::new(number)).collect(),
            places: Places::of(|row| row.is_gated),
            speed: 0.0,
            events: Vec::new(),
        }
    }
}

impl Gate {
    /// Whether a sample of a tick is believed.
    pub fn believes(&mut self, tick: u64, measurement: u16, reading: Reading) -> bool {
        let place = self.places.of_number(measurement);
        let Some(judge) = place.and_then(|place| self.measurements.get_mut(place)) else { return true };
        if measurement == COURSE && self.speed < HAS_COURSE && is_possible(COURSE, reading) {
            // What follows has nothing to follow.
            *judge = Judged::new(COURSE);
            return true;
        }
        let believed = judge.judge(tick, reading, self.speed, &mut self.events);
        if measurement == SPEED && believed {
            self.speed = reading[0];
        }
        believed
    }

    /// What was doubted and believed again since this was last asked.
    pub fn take_events(&mut self) -> Vec<Doubt> {
        std::mem::take(&mut self.events)
    }
}

impl Judged {
    fn new(number: u16) -> Self {
        Judged { number, believed: None, confirmed: false, came: 0, doubtful: None, doubts: 0, doubted: None }
    }

    /// Judges a sample of a vehicle that makes a speed over ground, m/s.
    fn judge(&mut self, tick: u64, reading: Reading, speed: f64, events: &mut Vec<Doubt>) -> bool {
        // That a number is none is seen by everybody.
        if reading.iter().any(|x| !x.is_finite()) {
            return true;
        }
        let number = self.number;
        if !is_possible(number, reading) {
            self.came = tick;
            self.doubtful = None;
            self.doubt(tick, Change::Impossible(if number == POSITION { reading[2] } else { reading[0] }), events);
            return false;
        }
        let seconds = |since: u64| tick.saturating_sub(since) as f64 * TICK_S;
        let came = std::mem::replace(&mut self.came, tick);
        let is_next = match self.believed {
            Some((before, _)) => follows(number, reading, before, seconds(came), speed),
            None => begins(number, reading),
        };
        if is_next && self.doubts <= DOUBTS_TRUSTED {
            self.believe(tick, reading);
            return true;
        }
        let (before, at) = self.believed.unwrap_or((Reading::default(), 0));
        let change = info(number).quantity.difference(reading, before);
        let first = Doubtful { reading, tick, since: tick, samples: 1 };
        let doubtful = match self.doubtful {
            Some(d) if follows(number, reading, self.held(d.reading), seconds(d.tick), speed) => {
                Doubtful { since: d.since, samples: d.samples + 1, ..first }
            }
            _ => first,
        };
        let lasts = seconds(doubtful.since);
        let nearer = number == ALTITUDE && reading[0] < before[0];
        let persists = if self.believed.is_none() || !self.confirmed {
            doubtful.samples >= FIRST_SAMPLES
        } else if nearer {
            doubtful.samples >= NEARER_SAMPLES
        } else {
            doubtful.samples >= PERSISTS_SAMPLES && lasts >= PERSISTS_S
        };
        if persists {
            events.push(Doubt { measurement: number, change: Change::Believed(change, lasts) });
            // A bottom that comes nearer is believed for itself; the measurement is as doubtful as before.
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

    /// A doubtful reading as the next is held against it: its standard deviation is as doubtful as itself, and counts no more than
    /// that of the last position that was believed, or of a satellite fix. Such fixes scatter about the truth, each by itself.
    fn held(&self, doubtful: Reading) -> Reading {
        let [a, b, sigma, d] = doubtful;
        let most = self.believed.map_or(BEGINS_SIGMA_M, |(before, _)| before[2].max(FIX_SIGMA_M));
        if self.number == POSITION { [a, b, sigma.min(most), d] } else { doubtful }
    }

    fn believe(&mut self, tick: u64, reading: Reading) {
        self.confirmed = self.believed.is_some();
        (self.believed, self.doubtful) = (Some((reading, tick)), None);
        self.doubts = self.doubts.saturating_sub(1);
    }

    fn doubt(&mut self, tick: u64, change: Change, events: &mut Vec<Doubt>) {
        let again = self.doubted.is_some_and(|last| tick < last + AGAIN_TICKS);
        if !again {
            events.push(Doubt { measurement: self.number, change });
        }
        self.doubted = Some(tick);
        self.doubts = (self.doubts + DOUBT).min(DOUBTS_MAX);
    }
}

/// Whether a reading can be. A position may be anywhere: where missions are is not known here; its standard deviation may not.
fn is_possible(number: u16, reading: Reading) -> bool {
    if number == POSITION { reading[2] >= 0.0 } else { info(number).quantity.can_be(reading) }
}

/// Whether a reading can follow another after some seconds, of a vehicle that makes a speed over ground, m/s. The gate judges a course
/// of a vehicle under way alone.
fn follows(number: u16, now: Reading, before: Reading, time: f64, speed: f64) -> bool {
    if number != COURSE {
        return info(number).can_follow(now, before, time);
    }
    let (now, before) = (Heading::from_radians(now[0]), Heading::from_radians(before[0]));
    let sway = asin(((SWAY * time).min(SWAY_MAX) / speed).min(1.0));
    let turn = now - before;
    // What waves add to a turn is to either side.
    let turned = before + turn.signum() * (turn.abs() - sway).max(0.0);
    info(HEADING).can_follow([turned.radians(), 0.0, 0.0, 0.0], [before.radians(), 0.0, 0.0, 0.0], time)
}

/// Whether a first reading is where missions begin.
fn begins(number: u16, reading: Reading) -> bool {
    match number {
        POSITION => {
            Point::new(reading[0], reading[1]).distance(Point::ORIGIN) <= BEGINS_WITHIN_M
                && reading[2] <= BEGINS_SIGMA_M
        }
        DEPTH => reading[0] <= BEGINS_ABOVE_M,
        BATTERY => reading[0] >= BEGINS_CHARGED,
        _ => true,
    }
}

#[cfg(test)]
mod tests;
