//! Whether what the sensors tell can be true: a watch over all that comes from the vehicle.
//!
//! A [`HealthMonitor`] looks at every snapshot and at what was commanded, knows nothing else, and says what it sees once when it begins
//! and once when it is over. It changes nothing: what a mission does about a bad sensor is the mission's to say. In simulation
//! and on a link it is the same. What it cannot see is told in `docs/faults.md`.

mod commanded;
mod mirrored;
mod motion;
mod noise;
mod watched;

use crate::places::Places;
use albacore_vehicle::measurements::{
    self, ALTITUDE, COURSE, DEPTH, FLOW, HEADING, POSITION, SPEED, WATER_DEPTH, info,
};
use albacore_vehicle::{Command, Control, Reading, Snapshot, Vertical};
use commanded::Commanded;
use mirrored::Mirrored;
use motion::Motion;
use std::fmt;
use watched::Watched;

/// What was seen is over when it was not seen for so many ticks: 15 s.
const WELL_AFTER_TICKS: u64 = 150;
/// Depth and altitude add up to the depth of the water, but for this, m, and for a while.
const SUM_MAX: f64 = 2.0;
const UNEVEN_TICKS: u64 = 100;
/// For so many ticks, 1 s, after another depth or altitude was commanded the vehicle follows; a depth that is exactly the same for as
/// long tells nothing of how.
const FOLLOWS_TICKS: u64 = 10;
/// Below this speed over ground a vehicle stands still, m/s.
const AT_REST: f64 = 0.05;

/// Something that is not as it should be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anomaly {
    /// No sample for five of its periods, and for 2 s.
    Silent(u16),
    /// A number that is none.
    NotANumber(u16),
    /// A number that cannot be measured.
    OutOfRange(u16),
    /// A change that no vehicle can make.
    Jumps(u16),
    /// The same number again and again, where it must change.
    Stuck(u16),
    /// The positions move otherwise than speed tells.
    SpeedAgainstPosition,
    /// The positions move elsewhere than course tells.
    CourseAgainstPosition,
    /// The way through the water, as course, speed and flow tell it, is not where the nose points.
    HeadingAgainstMotion,
    /// Depth and altitude are not the depth of the water.
    DepthAgainstWater,
    /// The heading stays far from the one commanded.
    HeadingNotAsCommanded,
    /// The depth stays away from the one commanded.
    DepthNotAsCommanded,
    /// The altitude stays away from the one commanded.
    AltitudeNotAsCommanded,
}

/// An anomaly that begins or is over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AnomalyEvent {
    /// What.
    pub anomaly: Anomaly,
    /// Whether it begins.
    pub begins: bool,
}

impl fmt::Display for Anomaly {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Anomaly::Silent(measurement) => write!(f, "{} silent", info(*measurement).name),
            Anomaly::NotANumber(measurement) => write!(f, "{} not a number", info(*measurement).name),
            Anomaly::OutOfRange(measurement) => write!(f, "{} out of range", info(*measurement).name),
            Anomaly::Jumps(measurement) => write!(f, "{} jumps", info(*measurement).name),
            Anomaly::Stuck(measurement) => write!(f, "{} stuck", info(*measurement).name),
            Anomaly::SpeedAgainstPosition => f.write_str("speed and position disagree"),
            Anomaly::CourseAgainstPosition => f.write_str("course and position disagree"),
            Anomaly::HeadingAgainstMotion => f.write_str("heading and motion disagree"),
            Anomaly::DepthAgainstWater => f.write_str("depth and altitude disagree with the water's depth"),
            Anomaly::HeadingNotAsCommanded => f.write_str("heading not as commanded"),
            Anomaly::DepthNotAsCommanded => f.write_str("depth not as commanded"),
            Anomaly::AltitudeNotAsCommanded => f.write_str("altitude not as commanded"),
        }
    }
}

impl fmt::Display for AnomalyEvent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let what = if self.begins { "detected" } else { "again well" };
        write!(f, "{what}: {}", self.anomaly)
    }
}

/// The watch of one run.
#[derive(Clone, Debug)]
pub struct HealthMonitor {
    /// Those that are watched, and the place of each measurement among them.
    measurements: Vec<Watched>,
    places: Places,
    mirrored: Mirrored,
    motion: Motion,
    commanded: Commanded,
    /// The depth or altitude that was commanded last, and since when.
    vertical: Option<(Vertical, u64)>,
    /// For how many ticks depth and altitude have not added up.
    uneven: u64,
    anomalies: Anomalies,
}

/// What was told by a measurement in a tick, where it can be believed by itself.
#[derive(Clone, Copy, Debug)]
struct Credible {
    reading: Reading,
    /// For how many ticks it has been exactly the same.
    same: u64,
    /// Of a flow, whether it has shown that it never stays the same for long.
    lively: bool,
}

/// What was told in a tick.
#[derive(Clone, Copy, Debug, Default)]
struct Heard {
    tick: u64,
    position: Option<Credible>,
    course: Option<Credible>,
    heading: Option<Credible>,
    speed: Option<Credible>,
    depth: Option<Credible>,
    altitude: Option<Credible>,
    flow: Option<Credible>,
}

/// What is seen, and since when not any more.
#[derive(Clone, Debug, Default)]
struct Anomalies {
    tick: u64,
    /// What is seen now, and the tick at which it was seen last.
    seen: Vec<(Anomaly, u64)>,
    events: Vec<AnomalyEvent>,
}

impl Default for HealthMonitor {
    fn default() -> Self {
        let watched = (0..).zip(&measurements::ALL).filter(|(_, row)| row.is_watched);
        HealthMonitor {
            places: Places::of(|row| row.is_watched),
            measurements: watched.map(|(number, _)| Watched::new(number)).collect(),
            mirrored: Mirrored::default(),
            motion: Motion::default(),
            commanded: Commanded::default(),
            vertical: None,
            uneven: 0,
            anomalies: Anomalies::default(),
        }
    }
}

impl HealthMonitor {
    /// Looks at what came in a tick. `command` is the last that was sent.
    pub fn look(&mut self, tick: u64, snapshot: &Snapshot, command: Option<&Command>) -> Vec<AnomalyEvent> {
        self.anomalies.tick = tick;
        let is_steered = self.is_steered(tick, command);
        let is_blind = self.watched(DEPTH).is_some_and(|depth| depth.rests(tick) > FOLLOWS_TICKS);
        let mut heard = Heard { tick, ..Heard::default() };
        let mut water_depth = None;
        for sample in &snapshot.samples {
            match self.places.of_number(sample.measurement).and_then(|place| self.measurements.get_mut(place)) {
                Some(measurement) => {
                    let credible = measurement.hear(tick, sample.reading, &mut self.anomalies);
                    heard.take(sample.measurement, credible);
                }
                None if sample.measurement == WATER_DEPTH => water_depth = Some(sample.reading[0]),
                None => {}
            }
        }
        self.mirrored.look(&heard);
        let is_the_vehicles = self.mirrored.is_the_vehicles();
        self.watched(DEPTH).into_iter().for_each(|depth| depth.moves(is_the_vehicles));
        self.watched(ALTITUDE).into_iter().for_each(|altitude| altitude.learns(!(is_steered && is_blind)));
        // A vehicle that stands still has no course.
        if self.motion.speed() < AT_REST {
            self.watched(COURSE).into_iter().for_each(|course| course.excuse(tick));
        }
        self.measurements.iter().for_each(|measurement| measurement.wait(tick, &mut self.anomalies));
        let command = command.filter(|_| snapshot.control == Control::InControl);
        self.motion.look(&heard, &mut self.anomalies);
        self.commanded.look(&heard, command, self.motion.speed(), &mut self.anomalies);
        self.add_up(&heard, water_depth);
        self.anomalies.settle()
    }

    fn watched(&mut self, measurement: u16) -> Option<&mut Watched> {
        self.places.of_number(measurement).and_then(|place| self.measurements.get_mut(place))
    }

    /// Whether something is seen now.
    pub(crate) fn sees(&self, anomaly: Anomaly) -> bool {
        self.anomalies.sees(anomaly)
    }

    /// Whether the vehicle is led up or down by commands that change, by limits that follow the altitude, say: its way shows in the
    /// altitude. Where the depth does not tell of it, it looks like noise.
    fn is_steered(&mut self, tick: u64, command: Option<&Command>) -> bool {
        let now = command.map(|command| command.vertical);
        self.vertical = match (self.vertical, now) {
            (Some((before, since)), Some(now)) if before == now => Some((before, since)),
            _ => now.map(|now| (now, tick)),
        };
        self.vertical.is_some_and(|(_, since)| tick < since + FOLLOWS_TICKS)
    }

    /// Depth and altitude add up to the depth of the water.
    fn add_up(&mut self, heard: &Heard, water_depth: Option<f64>) {
        let (Some(depth), Some(altitude), Some(water)) = (heard.depth, heard.altitude, water_depth) else { return };
        let even = (depth.reading[0] + altitude.reading[0] - water).abs() <= SUM_MAX;
        self.uneven = if even { 0 } else { self.uneven + 1 };
        if self.uneven > UNEVEN_TICKS {
            self.anomalies.see(Anomaly::DepthAgainstWater);
        }
    }
}

impl Heard {
    fn take(&mut self, measurement: u16, credible: Option<Credible>) {
        let place = match measurement {
            POSITION => &mut self.position,
            COURSE => &mut self.course,
            HEADING => &mut self.heading,
            SPEED => &mut self.speed,
            DEPTH => &mut self.depth,
            ALTITUDE => &mut self.altitude,
            FLOW => &mut self.flow,
            _ => return,
        };
        if credible.is_some() {
            *place = credible;
        }
    }
}

impl Anomalies {
    fn see(&mut self, anomaly: Anomaly) {
        match self.seen.iter_mut().find(|(known, _)| *known == anomaly) {
            Some((_, last)) => *last = self.tick,
            None => {
                self.seen.push((anomaly, self.tick));
                self.events.push(AnomalyEvent { anomaly, begins: true });
            }
        }
    }

    fn sees(&self, anomaly: Anomaly) -> bool {
        self.last_seen(anomaly).is_some()
    }

    /// When it was seen last, if that is not over yet.
    fn last_seen(&self, anomaly: Anomaly) -> Option<u64> {
        self.seen.iter().find(|(known, _)| *known == anomaly).map(|(_, last)| *last)
    }

    /// What has begun, and what is over.
    fn settle(&mut self) -> Vec<AnomalyEvent> {
        let (tick, events) = (self.tick, &mut self.events);
        self.seen.retain(|(anomaly, last)| {
            let stays = tick < last + WELL_AFTER_TICKS;
            if !stays {
                events.push(AnomalyEvent { anomaly: *anomaly, begins: false });
            }
            stays
        });
        std::mem::take(events)
    }
}

#[cfg(test)]
mod tests;
