//! What a controller hears: facts in the order in which they came, whatever the dialect.

use super::vehicle_time::{Stamp, VehicleTime};
use crate::set_point::SetPoint;
use crate::status::Status;
use albacore_geometry::{Geodetic, Heading, TangentFrame};
use albacore_navigation::{Estimate, Fix, Navigator, Reported, Sensed};
use albacore_vehicle::measurements::{COURSE, HEADING, POSITION, SPEED};
use albacore_vehicle::{Reading, Sample, TICK_S};

/// How much came, and how much of it made sense.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Count {
    /// Bytes.
    pub bytes: u64,
    /// Messages.
    pub messages: u64,
    /// Lines, or what else is framed, that were none.
    pub unreadable: u64,
}

/// Something that a vehicle has said.
#[derive(Debug)]
pub(super) enum Fact {
    /// The time of the state that follows.
    Time(Stamp),
    /// A measurement; it belongs to the next state.
    Sample(Sample),
    /// The end of a state: who drives, and what the vehicle holds.
    State(Status, Vec<SetPoint>),
    /// It has taken up a set-point, of which its states tell nothing.
    Accepted(SetPoint),
    /// It has taken up a speed that is none of ours.
    OtherSpeed(String),
    /// It has heard a heading goal.
    HeadingHeard(Heading),
    /// It lies on the bottom, or does so no more; in its own words.
    Aground(bool, String),
    /// Something for people.
    Notice(String),
}

/// Takes down what a dialect reads.
pub struct Received {
    frame: TangentFrame,
    time: VehicleTime,
    /// Makes the position that a mission reads of those that the vehicle tells.
    pub(super) navigator: Box<dyn Navigator>,
    motion: Motion,
    facts: Vec<Fact>,
    pub(super) count: Count,
}

/// What the vehicle has told last of its motion.
#[derive(Clone, Copy, Debug, Default)]
struct Motion {
    heading: Heading,
    course: Heading,
    /// Over ground, m/s.
    speed: f64,
}

impl Received {
    pub(super) fn new(frame: TangentFrame) -> Self {
        Received {
            frame,
            time: VehicleTime::default(),
            navigator: Box::new(Reported::default()),
            motion: Motion::default(),
            facts: Vec::new(),
            count: Count::default(),
        }
    }

    pub(super) fn take_facts(&mut self) -> Vec<Fact> {
        std::mem::take(&mut self.facts)
    }

    /// A message was read.
    pub fn message(&mut self) {
        self.count.messages += 1;
    }

    /// Something came that is none.
    pub fn unreadable(&mut self) {
        self.count.unreadable += 1;
    }

    /// The tick of the last state.
    pub fn tick(&self) -> u64 {
        self.time.tick()
    }

    /// A state begins that has this stamp, in milliseconds of any clock of the vehicle, modulo a day: the tick that it is of. None where
    /// it is late, repeated, or not to be believed yet: it says nothing then.
    #[must_use]
    pub fn begin_state(&mut self, stamp_ms: u32) -> Option<u64> {
        let before = self.time.tick();
        let stamp = self.time.hear(stamp_ms);
        let tick = match stamp {
            Stamp::Doubtful => return None,
            Stamp::Tick(tick) | Stamp::ClockSet(tick) => tick,
        };
        let Motion { heading, course, speed } = self.motion;
        let sensed = Sensed { ground_velocity: speed * course.unit(), heading };
        self.navigator.predict(&sensed, tick.saturating_sub(before) as f64 * TICK_S);
        self.facts.push(Fact::Time(stamp));
        Some(tick)
    }

    /// The state that was begun is complete: who drives, and what the vehicle holds, as far as it says so.
    pub fn end_state(&mut self, status: Status, holds: &[SetPoint]) {
        self.facts.push(Fact::State(status, holds.to_vec()));
    }

    /// A sample of one of our measurements. It belongs to the state under way, or to the next one.
    pub fn sample(&mut self, measurement: u16, numbers: &[f64]) {
        let mut reading = Reading::default();
        for (slot, number) in reading.iter_mut().zip(numbers) {
            *slot = *number;
        }
        match measurement {
            HEADING => self.motion.heading = Heading::from_radians(reading[0]),
            COURSE => self.motion.course = Heading::from_radians(reading[0]),
            SPEED => self.motion.speed = reading[0],
            _ => {}
        }
        self.facts.push(Fact::Sample(Sample { measurement, reading }));
    }

    /// Where the vehicle believes to be, and the standard deviation of that, m an axis.
    pub fn position(&mut self, position: Geodetic, sigma: f64) {
        self.navigator.update(&Fix { position: self.frame.to_point(position), sigma, gate: 0.0 });
        let Estimate { position, sigma } = self.navigator.estimate();
        self.sample(POSITION, &[position.north, position.east, sigma]);
    }

    /// The vehicle says that it has taken up a set-point. Only for those that its states do not tell.
    pub fn accepted(&mut self, set_point: SetPoint) {
        self.facts.push(Fact::Accepted(set_point));
    }

    /// The vehicle says that it has taken up a speed in a unit that set-points do not have, in its own words: it does not hold ours.
    pub fn other_speed(&mut self, said: String) {
        self.facts.push(Fact::OtherSpeed(said));
    }

    /// The vehicle repeats a heading goal that it was told, which proves that it has heard it, and not that it holds it.
    pub fn heading_heard(&mut self, heading: Heading) {
        self.facts.push(Fact::HeadingHeard(heading));
    }

    /// The vehicle says that it lies on the bottom, or that it does so no more. `said` is for people.
    pub fn aground(&mut self, aground: bool, said: String) {
        self.facts.push(Fact::Aground(aground, said));
    }

    /// Something that the vehicle says to people.
    pub fn notice(&mut self, text: String) {
        self.facts.push(Fact::Notice(text));
    }
}
