//! The vehicle's end of a link: its own computer in the front seat, which follows a route of its own until a guest asks to drive.
//!
//! It serves any [`Vehicle`], one tick at a time, and is a function of what is said to it in these ticks. On release, and when
//! the guest is silent for too long, it returns to the point where the guest took over and goes on with its leg (the 2003 paper).

mod event;
mod side;

pub use event::ServerEvent;
pub use side::{Goal, Refusal, Report, Request, Senses, ServerSide, StateReport};

use crate::grounding;
use crate::set_point::SetPoint;
use crate::status::{Phase, Status};
use albacore_front_seat::{FrontSeat, Handover, Known, Milestone, OwnPlan};
use albacore_geometry::{Heading, Point, TangentFrame, Vector};
use albacore_guidance::Route;
use albacore_guidance::parameters::TURN_RATE_MAX;
use albacore_vehicle::measurements::{ALTITUDE, BATTERY, COURSE, DEPTH, FLOW, HEADING, POSITION, SPEED};
use albacore_vehicle::{Command, Control, Snapshot, TICK_S, Vehicle, VehicleError, Vertical};

/// Ticks without a message after which who serves faster than real time should wait for the guest.
const PATIENCE_TICKS: u64 = 10;
/// Bytes that are taken in of a tick: what a line of 819,200 baud brings in one.
const TAKEN_MAX: usize = 8192;

/// What a guest has asked for; it holds until something else is asked for.
#[derive(Clone, Copy)]
struct Goals {
    command: Command,
    /// The heading turns clockwise, rad/s.
    rate: f64,
}

impl Goals {
    /// The same with one of them changed.
    fn holding(self, set_point: SetPoint) -> Self {
        let rate = if let SetPoint::Heading(_) = set_point { 0.0 } else { self.rate };
        Goals { command: set_point.placed_in(self.command), rate }
    }
}

/// A vehicle and its own computer, served to a guest.
pub struct Server<V> {
    side: Box<dyn ServerSide>,
    vehicle: V,
    frame: TangentFrame,
    /// Its own plan, and how it answers who asks to drive.
    seat: FrontSeat,
    control: Control,
    /// When a guest gave control back last, or left.
    left: Option<u64>,
    /// What the guest wants who drives; none while the vehicle follows its own plan.
    goals: Option<Goals>,
    silent: u64,
    tick: u64,
    snapshot: Snapshot,
    senses: Senses,
    command: Option<Command>,
    unreadable: u64,
    /// The vehicle has taken itself back, from us too: it leaks, say.
    given_up: bool,
    /// Whether the vehicle lay on the bottom in the last tick.
    aground: bool,
    /// Why something was refused last, and when.
    refused: Option<(&'static str, u64)>,
    out: Vec<u8>,
    happenings: Vec<ServerEvent>,
}

impl<V: Vehicle> Server<V> {
    /// The computer of a vehicle that speaks so, starts at a place and heading of a frame, and holds a depth or an altitude on its route.
    pub fn new(
        side: Box<dyn ServerSide>,
        vehicle: V,
        frame: TangentFrame,
        route: &Route,
        start: (Point, Heading),
        vertical: Vertical,
    ) -> Self {
        let speed_max = vehicle.limits().speed.unwrap_or(f64::INFINITY);
        let seat = FrontSeat::new(Some((route, vertical)), Handover::default(), start, speed_max);
        let happenings =
            seat.plan().map(|plan| ServerEvent::Plan(Milestone::Leg(1, plan.legs()))).into_iter().collect();
        Server {
            side,
            vehicle,
            frame,
            seat,
            control: Control::Monitoring,
            left: None,
            goals: None,
            silent: 0,
            tick: 0,
            snapshot: Snapshot::default(),
            senses: Senses { position: start.0, heading: start.1, course: start.1, battery: 1.0, ..Senses::default() },
            command: None,
            unreadable: 0,
            given_up: false,
            aground: false,
            refused: None,
            out: Vec::new(),
            happenings,
        }
    }

    /// The same, answering so who asks to drive.
    pub fn answering(self, handover: Handover) -> Self {
        Server { seat: self.seat.answering(handover), ..self }
    }

    /// What is to be sent; taken once.
    pub fn take_output(&mut self) -> Vec<u8> {
        std::mem::take(&mut self.out)
    }

    /// What happened; taken once.
    pub fn take_happenings(&mut self) -> Vec<ServerEvent> {
        std::mem::take(&mut self.happenings)
    }

    /// Messages that could not be read.
    pub fn unreadable(&self) -> u64 {
        self.unreadable
    }

    /// Ticks that have passed.
    pub fn ticks(&self) -> u64 {
        self.tick
    }

    /// Where the vehicle believes to be.
    pub fn position(&self) -> Point {
        self.senses.position
    }

    /// Whether a guest drives.
    pub fn is_driven(&self) -> bool {
        self.goals.is_some()
    }

    /// Whether a guest drives and has not been heard for a second. Who lets the vehicle's time run faster than real time
    /// should let it run no faster now: the guest may only be late, and its time-out is of the vehicle's time.
    pub fn waits_for_guest(&self) -> bool {
        self.is_driven() && self.silent >= PATIENCE_TICKS
    }

    /// One tick, with the bytes that came since the last: the newest of them, for its time is bounded too.
    pub fn tick(&mut self, bytes: &[u8]) -> Result<(), VehicleError> {
        let bytes = &bytes[bytes.len().saturating_sub(TAKEN_MAX)..];
        self.vehicle.sense(&mut self.snapshot)?;
        if self.tick == 0 {
            self.vehicle.take_over()?;
        }
        self.happenings.extend(self.vehicle.notices().into_iter().map(ServerEvent::Notice));
        if !self.given_up && matches!(self.snapshot.control, Control::Released | Control::Refused) {
            (self.given_up, self.goals, self.command) = (true, None, None);
            self.happenings.push(ServerEvent::GivenUp);
        }
        self.tell_senses();
        self.tell_grounding();
        self.hear(bytes);
        self.answer();
        if !self.given_up
            && let Some(command) = self.steer()
        {
            self.vehicle.command(&command)?;
            self.command = Some(command);
        }
        self.tell_state();
        self.tick += 1;
        Ok(())
    }

    fn hear(&mut self, bytes: &[u8]) {
        let mut heard = Vec::new();
        self.side.hear(bytes, &mut heard);
        let is_unreadable = |request: &Request| matches!(request, Request::Unreadable(_));
        let (unreadable, heard): (Vec<_>, Vec<_>) = heard.into_iter().partition(is_unreadable);
        self.unreadable += unreadable.len() as u64;
        self.silent = if heard.is_empty() { self.silent + 1 } else { 0 };
        for request in unreadable {
            if let Request::Unreadable(Some(command)) = request {
                self.refuse(&command, Refusal::NotUnderstood, "is no command of this dialect");
            }
        }
        for request in heard {
            self.obey(request);
        }
        self.say(&Report::Answered);
        let timeout = self.timeout_ticks();
        if self.is_driven() && self.silent >= timeout {
            self.happenings.push(ServerEvent::TimedOut(timeout));
            self.leave();
        }
    }

    /// Ticks without a message after which a guest has left.
    fn timeout_ticks(&self) -> u64 {
        self.side.dialect().timeout_ticks
    }

    fn obey(&mut self, request: Request) {
        match request {
            Request::TakeOver if self.given_up => {}
            Request::TakeOver => {
                self.seat.ask(self.seconds(), self.senses.position);
                self.answer();
            }
            Request::GiveBack => {
                if self.is_driven() {
                    self.happenings.push(ServerEvent::Released);
                }
                self.leave();
            }
            Request::ClosestPoint(closest) => self.seat.return_to_closest_point(closest),
            Request::Goal(goal, text) => self.set_goal(goal, &text),
            Request::Other | Request::Unreadable(_) => {}
        }
    }

    /// Who drives now.
    fn answer(&mut self) {
        if self.given_up {
            return;
        }
        let before = self.control;
        self.control = self.seat.answer(self.seconds(), self.senses.position);
        match (self.is_driven(), self.seat.is_driven()) {
            (false, true) => self.give_over(),
            (true, false) => self.goals = None,
            _ => {}
        }
        match (before, self.control) {
            (before, now) if before == now => {}
            (_, Control::Released) => self.happenings.push(ServerEvent::TakenBack),
            (_, Control::Suspended) => self.happenings.push(ServerEvent::Suspended),
            (Control::Suspended, _) => self.happenings.push(ServerEvent::GoesOn),
            _ => {}
        }
    }

    fn give_over(&mut self) {
        self.happenings.push(ServerEvent::Taken(self.senses.position, self.leg()));
        let (heading, speed) = (self.senses.heading, self.seat.plan().map_or(0.0, OwnPlan::speed));
        self.goals = Some(Goals { command: Command::new(heading, speed, self.seat.vertical()), rate: 0.0 });
    }

    fn set_goal(&mut self, goal: Goal, text: &str) {
        let Some(goals) = self.goals else {
            return self.refuse(text, Refusal::NotDriving, "override is not active");
        };
        if self.control == Control::Suspended {
            return self.refuse(text, Refusal::NotDriving, "the mission is suspended");
        }
        let wanted = match goal {
            Goal::Hold(set_point) => goals.holding(set_point),
            Goal::Turn(rate) if rate.abs() <= TURN_RATE_MAX => Goals { rate, ..goals },
            Goal::Turn(_) => return self.refuse(text, Refusal::Beyond, "faster than this vehicle turns"),
            Goal::Unknown => return self.refuse(text, Refusal::NotServed, "this vehicle does not do that"),
        };
        self.goals = Some(wanted);
        self.answer_goal(goal, wanted, text);
    }

    /// The goal is accepted, where the vehicle follows it as it is; else it is said how far it does. The vehicle gives
    /// notice of that itself.
    fn answer_goal(&mut self, goal: Goal, wanted: Goals, text: &str) {
        let mut found = None;
        self.vehicle.clamp_command(&wanted.command, &mut |beyond| {
            if let Goal::Hold(set_point) = goal
                && set_point.is_beyond(&beyond)
            {
                found = Some(beyond);
            }
        });
        match found {
            Some(beyond) => self.say(&Report::Refused(Refusal::Beyond, &beyond.to_string())),
            None => self.say(&Report::Accepted(text)),
        }
    }

    fn refuse(&mut self, what: &str, refusal: Refusal, why: &'static str) {
        self.say(&Report::Refused(refusal, why));
        // Who does not listen says it again and again; who watches need not hear it as often.
        let timeout = self.timeout_ticks();
        let again = self.refused.is_some_and(|(last, tick)| last == why && self.tick - tick < timeout);
        if !again {
            self.happenings.push(ServerEvent::Refused(what.to_string(), why));
        }
        self.refused = Some((why, self.tick));
    }

    /// The guest is gone.
    fn leave(&mut self) {
        self.left = Some(self.tick);
        self.goals = None;
        self.seat.leave(self.senses.position);
    }

    /// The leg under way.
    fn leg(&self) -> u32 {
        self.seat.plan().map_or(0, OwnPlan::leg)
    }

    /// What to do in the coming tick.
    fn steer(&mut self) -> Option<Command> {
        if self.control == Control::Suspended {
            // It stays where it is.
            let Senses { heading, depth, .. } = self.senses;
            return Some(Command::still(heading, depth));
        }
        if let Some(goals) = &mut self.goals {
            goals.command.heading = goals.command.heading + goals.rate * TICK_S;
            return Some(goals.command);
        }
        let Senses { position, course, heading, flow, .. } = self.senses;
        let known = Known { position, course, heading, flow: flow.unwrap_or(Vector::ZERO) };
        let happenings = &mut self.happenings;
        self.seat.steer(known, &mut |milestone| happenings.push(ServerEvent::Plan(milestone)))
    }

    /// Takes in what was sensed, and passes it on.
    fn tell_senses(&mut self) {
        let heading = self.senses.heading;
        // A number that is none is as if it had not come.
        for sample in self.snapshot.samples.iter().filter(|s| s.reading.iter().all(|x| x.is_finite())) {
            let [a, b, ..] = sample.reading;
            match sample.measurement {
                POSITION => self.senses.position = Point::new(a, b),
                COURSE => self.senses.course = Heading::from_radians(a),
                HEADING => self.senses.heading = Heading::from_radians(a),
                SPEED => self.senses.speed = a,
                DEPTH => self.senses.depth = a,
                ALTITUDE => self.senses.altitude = Some(a),
                FLOW => self.senses.flow = Some(Vector::new(a, b)),
                BATTERY => self.senses.battery = a,
                _ => {}
            }
        }
        self.senses.turn_rate = (self.senses.heading - heading) / TICK_S;
        self.side.say(&Report::Sensed(&self.snapshot, &self.senses, self.tick), &mut self.out);
    }

    /// Says that the vehicle lies on the bottom, as long as it does, and once that it has come free.
    fn tell_grounding(&mut self) {
        let aground = self.snapshot.aground;
        let again = aground && self.tick.is_multiple_of(grounding::AGAIN_TICKS);
        if aground != self.aground || again {
            self.say(&Report::Aground(aground));
            self.aground = aground;
        }
    }

    fn status(&self) -> Status {
        let driven = Status { phase: Phase::InMission, is_enabled: true, is_active: true, is_forbidden: false };
        let idle = Status { is_enabled: false, is_active: false, ..driven };
        if self.given_up {
            Status { phase: Phase::Over, is_forbidden: true, ..idle }
        } else if self.control == Control::Suspended {
            Status { phase: Phase::Suspended, ..driven }
        } else if self.is_driven() {
            driven
        } else if self.seat.is_over() {
            Status { phase: Phase::Over, ..idle }
        } else {
            let timeout = self.timeout_ticks();
            match self.control {
                // Who has given control back is to see that it was taken.
                Control::Offered if self.left.is_none_or(|left| self.tick - left >= timeout) => {
                    Status { is_active: true, ..idle }
                }
                Control::Refused => Status { is_forbidden: true, ..idle },
                _ => idle,
            }
        }
    }

    /// Since tick 0.
    fn seconds(&self) -> f64 {
        self.tick as f64 * TICK_S
    }

    fn tell_state(&mut self) {
        let s = self.senses;
        // What it is told is one thing; it says what it does.
        let goal = self.vehicle.held().or(self.command);
        let depth_goal = match goal.map(|c| c.vertical) {
            Some(Vertical::Depth(depth)) => depth,
            // Where the water is shallower than that it stays at the surface, and it goes no deeper than it may whatever it hears.
            Some(Vertical::Altitude(altitude)) => {
                let most = self.vehicle.limits().depth.unwrap_or(f64::INFINITY);
                (s.depth + s.altitude.unwrap_or(altitude) - altitude).max(0.0).min(most)
            }
            None => s.depth,
        };
        let status = self.status();
        let report = StateReport {
            tick: self.tick,
            senses: s,
            position: self.frame.to_geodetic(s.position),
            heading_goal: goal.map_or(s.heading, |c| c.heading),
            speed_goal: goal.map_or(0.0, |c| c.speed),
            depth_goal,
            status,
            returns_to_closest_point: status.phase != Phase::Over
                && self.seat.plan().is_some_and(OwnPlan::returns_to_closest_point),
            leg: self.leg(),
        };
        self.say(&Report::State(&report));
    }

    fn say(&mut self, what: &Report) {
        self.side.say(what, &mut self.out);
    }
}
