//! Guidance statements: the one place where the machine runs a guidance law, and what it asks for.

use crate::Event;
use crate::state::{Asked, Run};
use albacore_geometry::{Heading, Point};
use albacore_guidance::parameters::STATION_POSITION_AGE_MAX;
use albacore_guidance::{Start, Station, Whereabouts, turning_radius_in_flow};
use albacore_program::{Channel, Guide, Input, Slot, Steering, setpoints};
use albacore_vehicle::TICK_S;

/// Speeds below this, in m/s, turn in no circle worth planning with.
const PLANNING_SPEED_MIN: f64 = 0.1;

impl Run {
    fn speed_in_force(&self, setpoints: Slot) -> Option<f64> {
        Channel::Speed.in_force(self.slice(setpoints, setpoints::WORDS))
    }

    fn planned_speed(&self, setpoints: Slot) -> f64 {
        self.speed_in_force(setpoints).unwrap_or(self.state.asked.speed).max(PLANNING_SPEED_MIN)
    }

    /// The radius of the tightest turn that speed, flow and the command filter allow.
    fn tightest_turn(&self, setpoints: Slot) -> f64 {
        turning_radius_in_flow(self.planned_speed(setpoints), self.flow().length(), self.state.limits.turn_rate)
    }

    /// Makes the state of a law from its arguments.
    pub fn begin(&mut self, guide: Guide, args: Slot, state: Slot, setpoints: Slot) {
        match guide.law().steering {
            Steering::Law(law) => {
                let start = Start {
                    position: self.position(),
                    course: self.course(),
                    speed: self.planned_speed(setpoints),
                    turning_radius: self.tightest_turn(setpoints),
                };
                let args = self.slice(args, guide.law().args_words()).to_vec();
                (law.begin)(&args, &start, &mut self.state.words[state as usize..][..law.words]);
            }
            Steering::Station => self.store_station(state, Station::new(self.known_position())),
            Steering::Along { .. } | Steering::AsBefore | Steering::Nothing => {}
        }
    }

    /// One tick of a law: asks for a course, and tells whether the statement has come to its own end.
    pub fn guide(&mut self, guide: Guide, args: Slot, state: Slot, setpoints: Slot) -> bool {
        match guide.law().steering {
            Steering::Law(law) => {
                let (position, course) = (self.position(), self.course());
                let guidance = (law.step)(&mut self.state.words[state as usize..][..law.words], position, course);
                self.ask(guidance.course, true, setpoints);
                self.is_lost |= !self.in_overlay && self.known_position().is_none();
                return guidance.arrived;
            }
            Steering::Along { over_ground } => {
                let asked = Heading::from_radians(self.get(args));
                self.ask(asked, over_ground, setpoints);
            }
            Steering::AsBefore => self.ask_as_before(setpoints),
            Steering::Station => {
                self.ask_as_before(setpoints);
                if !self.in_overlay {
                    self.keep_station(state, setpoints);
                }
            }
            Steering::Nothing => {}
        }
        false
    }

    /// Lies still, or goes back to the place that is kept. What goes on after it goes on from lying still.
    fn keep_station(&mut self, state: Slot, setpoints: Slot) {
        self.state.asked.speed = 0.0;
        let most = self.state.limits.speed.1;
        let speed = self.speed_in_force(setpoints).unwrap_or(most);
        let at = Whereabouts { position: self.known_position(), course: self.course() };
        let mut words = [0.0; Station::WORDS];
        words.copy_from_slice(self.slice(state, Station::WORDS as u32));
        let mut law = Station::from_words(&words);
        let stay = law.step(at, speed);
        self.store_station(state, law);
        self.state.way_back = stay.way;
        self.events.extend(stay.adrift.map(Event::Adrift));
    }

    fn store_station(&mut self, state: Slot, law: Station) {
        self.state.words[state as usize..state as usize + Station::WORDS].copy_from_slice(&law.to_words());
    }

    /// Where the vehicle is, if that has been heard of late.
    fn known_position(&self) -> Option<Point> {
        let at = self.senses.position?;
        let stamp = self.get(at + Input::STAMP);
        let age_s = (self.state.tick as f64 - stamp) * TICK_S;
        (stamp >= 0.0 && age_s <= STATION_POSITION_AGE_MAX).then(|| self.position())
    }

    /// Goes on with the course asked for before, and with the setpoints in force.
    fn ask_as_before(&mut self, setpoints: Slot) {
        let Asked { course, over_ground, .. } = self.state.asked;
        self.ask(course, over_ground, setpoints);
    }

    /// Asks for a course with the setpoints in force. Overlays ask for no course.
    fn ask(&mut self, course: Heading, over_ground: bool, at: Slot) {
        if self.in_overlay {
            return;
        }
        let asked = &mut self.state.asked;
        asked.course = course;
        asked.over_ground = over_ground;
        let words = &self.state.words[at as usize..(at + setpoints::WORDS) as usize];
        for channel in Channel::ALL {
            if let Some(value) = channel.in_force(words) {
                asked.set(channel, value);
            }
        }
    }
}
