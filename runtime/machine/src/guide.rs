//! Guidance statements: their laws' states in words, and what they ask for.

use crate::Event;
use crate::state::{Asked, Run};
use albacore_geometry::{Heading, Point};
use albacore_guidance::dubins::{Pose, Words};
use albacore_guidance::parameters::{STATION_POSITION_AGE_MAX, TURN_LEAD_TIME};
use albacore_guidance::{
    Circling, CommandFilter, FollowLine, Goto, GotoPose, Loiter, Station, Whereabouts, turning_radius_in_flow,
};
use albacore_program::{Guide, Input, Slot, setpoints};
use albacore_vehicle::{TICK_S, Vertical};

/// Speeds below this, in m/s, turn in no circle worth planning with.
const PLANNING_SPEED_MIN: f64 = 0.1;

/// The filter is a guidance law's too: named here so that the two stay one crate's.
pub(crate) type Filter = CommandFilter;

impl Run {
    fn planned_speed(&self, setpoints: Slot) -> f64 {
        let speed = self.get(setpoints + setpoints::SPEED);
        (if speed == setpoints::NO_SPEED { self.state.asked.speed } else { speed }).max(PLANNING_SPEED_MIN)
    }

    /// The radius that was asked for, or the one that speed, flow and the command filter allow.
    fn radius(&self, asked: f64, setpoints: Slot) -> f64 {
        if asked > 0.0 {
            asked
        } else {
            turning_radius_in_flow(self.planned_speed(setpoints), self.flow().length(), self.state.limits.turn_rate)
        }
    }

    fn store<const N: usize>(&mut self, at: Slot, words: [f64; N]) {
        self.state.words[at as usize..at as usize + N].copy_from_slice(&words);
    }

    fn load<const N: usize>(&self, at: Slot) -> [f64; N] {
        let mut words = [0.0; N];
        words.copy_from_slice(&self.state.words[at as usize..at as usize + N]);
        words
    }

    /// Makes the state of a law from its frozen arguments.
    pub fn begin(&mut self, guide: Guide, args: Slot, state: Slot, setpoints: Slot) {
        let lead = self.planned_speed(setpoints) * TURN_LEAD_TIME;
        match guide {
            Guide::Goto => {
                let law = Goto::new(self.point(args), self.get(args + 2), self.radius(0.0, setpoints));
                self.store(state, law.to_words());
            }
            Guide::Follow => {
                let law = FollowLine::new(self.line(args), self.radius(self.get(args + 4), setpoints), lead);
                self.store(state, law.to_words());
            }
            Guide::Dubins => {
                let goal = Pose { point: self.point(args), heading: Heading::from_radians(self.get(args + 2)) };
                let start = Pose { point: self.position(), heading: self.course() };
                let words = if self.get(args + 4) == 1.0 { Words::Full } else { Words::Csc };
                let law = GotoPose::new(start, goal, self.radius(self.get(args + 3), setpoints), words, lead);
                self.store(state, law.to_words());
            }
            Guide::Loiter => {
                let turns = self.get(args + 3);
                let turns = if turns > 0.0 { turns } else { f64::INFINITY };
                let circling = if self.get(args + 4) == 1.0 { Circling::Clockwise } else { Circling::Anticlockwise };
                let law = Loiter::new(self.point(args), self.get(args + 2), circling, turns, lead);
                self.store(state, law.to_words());
            }
            Guide::Hold => {
                let law = Station::new(self.known_position());
                self.store(state, law.to_words());
            }
            Guide::Steer | Guide::SteerHeading | Guide::Keep | Guide::Wait => {}
        }
    }

    /// One tick of a law: asks for a course, and tells whether the statement has come to its own end.
    pub fn guide(&mut self, guide: Guide, args: Slot, state: Slot, setpoints: Slot) -> bool {
        let (position, course) = (self.position(), self.course());
        let guidance = match guide {
            Guide::Goto => {
                let mut law = Goto::from_words(&self.load(state));
                let guidance = law.step(position, course);
                self.store(state, law.to_words());
                guidance
            }
            Guide::Follow => {
                let mut law = FollowLine::from_words(&self.load(state));
                let guidance = law.step(position, course);
                self.store(state, law.to_words());
                guidance
            }
            Guide::Dubins => {
                let mut law = GotoPose::from_words(&self.load(state));
                let guidance = law.step(position, course);
                self.store(state, law.to_words());
                guidance
            }
            Guide::Loiter => {
                let mut law = Loiter::from_words(&self.load(state));
                let guidance = law.step(position, course);
                self.store(state, law.to_words());
                guidance
            }
            Guide::Steer | Guide::SteerHeading => {
                let asked = Heading::from_radians(self.get(args));
                self.ask(asked, guide == Guide::Steer, setpoints);
                return false;
            }
            Guide::Keep => {
                let Asked { course, over_ground, .. } = self.state.asked;
                self.ask(course, over_ground, setpoints);
                return false;
            }
            Guide::Hold => {
                let Asked { course, over_ground, .. } = self.state.asked;
                self.ask(course, over_ground, setpoints);
                if !self.in_overlay {
                    self.keep_station(state, setpoints);
                }
                return false;
            }
            Guide::Wait => return false,
        };
        self.ask(guidance.course, true, setpoints);
        guidance.arrived
    }

    /// Lies still, or goes back to the place that is kept. What goes on after it goes on from lying still.
    fn keep_station(&mut self, state: Slot, setpoints: Slot) {
        self.state.asked.speed = 0.0;
        let most = self.state.limits.speed.1;
        let speed = self.get(setpoints + setpoints::SPEED);
        let speed = if speed == setpoints::NO_SPEED { most } else { speed };
        let at = Whereabouts { position: self.known_position(), course: self.course() };
        let mut law = Station::from_words(&self.load(state));
        let stay = law.step(at, speed);
        self.store(state, law.to_words());
        self.state.way_back = stay.way;
        self.events.extend(stay.adrift.map(Event::Adrift));
    }

    /// Where the vehicle is, if that has been heard of late.
    fn known_position(&self) -> Option<Point> {
        let at = self.senses.position?;
        let stamp = self.get(at + Input::STAMP);
        let age_s = (self.state.tick as f64 - stamp) * TICK_S;
        (stamp >= 0.0 && age_s <= STATION_POSITION_AGE_MAX).then(|| self.position())
    }

    /// Asks for a course with the setpoints in force. Overlays ask for no course.
    fn ask(&mut self, course: Heading, over_ground: bool, at: Slot) {
        if self.in_overlay {
            return;
        }
        let asked = &mut self.state.asked;
        asked.course = course;
        asked.over_ground = over_ground;
        let words = &self.state.words;
        let word = |offset: u32| words[(at + offset) as usize];
        if word(setpoints::SPEED) != setpoints::NO_SPEED {
            asked.speed = word(setpoints::SPEED);
        }
        match word(setpoints::VERTICAL) {
            kind if kind == setpoints::DEPTH => asked.vertical = Vertical::Depth(word(setpoints::METRES)),
            kind if kind == setpoints::ALTITUDE => asked.vertical = Vertical::Altitude(word(setpoints::METRES)),
            _ => {}
        }
    }
}
