//! The vehicle's side: its own computer in the front seat, which follows a route of its own until a guest asks to drive.
//!
//! It serves any [`Vehicle`], one tick at a time, and is a function of the bytes that come in these ticks. On release, and when
//! the guest is silent for 5 s, it returns to the point where the guest took over and goes on with its leg (the 2003 paper).

use super::controller::FULL_SCALE_VOLTS;
use super::fields::DAY_MS;
use super::frame::{Deframer, seal};
use super::grounding;
use super::happening::{Happening, shortened};
use super::message::{Adcp, FromVehicle, SpeedGoal, State, ToVehicle};
use super::mode::{Mode, Phase};
use super::seawater;
use albacore_front_seat::{FrontSeat, Handover, Known, Milestone, OwnPlan};
use albacore_geometry::math::{cos, sin};
use albacore_geometry::{Heading, Point, TangentFrame, Vector};
use albacore_guidance::Route;
use albacore_guidance::parameters::TURN_RATE_MAX;
use albacore_vehicle::channels::{
    ALTITUDE, BATTERY, CHEMICAL, COURSE, DEPTH, FLOW, HEADING, POSITION, SALINITY, SPEED, TEMPERATURE,
};
use albacore_vehicle::{Beyond, Command, Control, Snapshot, TICK_S, Vehicle, VehicleError, Vertical};

/// Ticks without a message after which a guest has left: 5 s (public controllers keep it alive at 0.2 Hz at least).
pub(super) const TIMEOUT_TICKS: u64 = 50;
/// Ticks without a message after which who serves faster than real time should wait for the guest.
const PATIENCE_TICKS: u64 = 10;
/// Bytes that are taken in of a tick: what a line of 819,200 baud brings in one.
const TAKEN_MAX: usize = 8192;
/// Ticks between messages of the profiler.
const ADCP_TICKS: u64 = 10;
/// The day's time at tick 0: noon.
const BEGIN_MS: u64 = 12 * 3_600_000;
/// Turns of the propeller a minute for 1 m/s. Ours: 1500 turns for the 2.6 m/s of a REMUS 100.
const RPM_AT_1_MPS: f64 = 1500.0 / 2.6;
/// The battery of a REMUS 100, Wh.
const CAPACITY_WH: f64 = 1000.0;

/// Numbers of `#E`. Ours: the sources print one sample, of another error.
const NOT_IN_OVERRIDE: u32 = 1;
const OUT_OF_BOUNDS: u32 = 2;
const NOT_SERVED: u32 = 3;
// 4 and 5 tell of the bottom: `grounding`.
const NOT_UNDERSTOOD: u32 = 6;

/// What a guest has asked for; it holds until something else is asked for.
#[derive(Clone, Copy)]
struct Goals {
    heading: Heading,
    /// Clockwise, rad/s.
    rate: f64,
    speed: f64,
    vertical: Vertical,
}

impl Goals {
    fn command(&self) -> Command {
        Command { heading: self.heading, speed: self.speed, vertical: self.vertical }
    }
}

/// What is known of the vehicle.
#[derive(Clone, Copy, Default)]
struct Senses {
    position: Point,
    course: Heading,
    heading: Heading,
    turn_rate: f64,
    speed: f64,
    depth: f64,
    altitude: Option<f64>,
    flow: Option<Vector>,
    battery: f64,
}

/// A vehicle and its own computer, served to a guest.
pub struct Server<V> {
    vehicle: V,
    frame: TangentFrame,
    /// Its own plan, and how it answers who asks to drive.
    seat: FrontSeat,
    control: Control,
    /// When a guest gave control back last, or left.
    left: Option<u64>,
    /// What the guest wants who drives; none while the vehicle follows its own plan.
    goals: Option<Goals>,
    deframer: Deframer,
    heard: Vec<ToVehicle>,
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
    /// Whether somebody asks for its version.
    asked_version: bool,
    out: Vec<u8>,
    happenings: Vec<Happening>,
}

impl<V: Vehicle> Server<V> {
    /// The computer of a vehicle that starts at a place and heading of a frame, and holds a depth or an altitude on its route.
    pub fn new(vehicle: V, frame: TangentFrame, route: &Route, start: (Point, Heading), vertical: Vertical) -> Self {
        let speed_max = vehicle.limits().speed.unwrap_or(f64::INFINITY);
        let seat = FrontSeat::new(Some((route, vertical)), Handover::default(), start, speed_max);
        let happenings = seat.plan().map(|plan| Happening::Plan(Milestone::Leg(1, plan.legs()))).into_iter().collect();
        Server {
            vehicle,
            frame,
            seat,
            control: Control::Monitoring,
            left: None,
            goals: None,
            deframer: Deframer::default(),
            heard: Vec::new(),
            silent: 0,
            tick: 0,
            snapshot: Snapshot::default(),
            senses: Senses { position: start.0, heading: start.1, course: start.1, battery: 1.0, ..Senses::default() },
            command: None,
            unreadable: 0,
            given_up: false,
            aground: false,
            refused: None,
            asked_version: false,
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
    pub fn take_happenings(&mut self) -> Vec<Happening> {
        std::mem::take(&mut self.happenings)
    }

    /// Lines that could not be read.
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
        self.happenings.extend(self.vehicle.notices().into_iter().map(Happening::Notice));
        if !self.given_up && matches!(self.snapshot.control, Control::Released | Control::Refused) {
            (self.given_up, self.goals, self.command) = (true, None, None);
            self.happenings.push(Happening::GivenUp);
        }
        self.tell_samples();
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
        let (heard, unreadable) = (&mut self.heard, &mut self.unreadable);
        let mut absurd = Vec::new();
        self.deframer.push(bytes, |frame| match frame.map(|body| ToVehicle::parse(body).map_err(|_| body)) {
            Ok(Ok(message)) => heard.push(message),
            unread => {
                *unreadable += 1;
                absurd.extend(unread.ok().and_then(Result::err).filter(|body| body.starts_with("C,")).map(shortened));
            }
        });
        self.silent = if self.heard.is_empty() { self.silent + 1 } else { 0 };
        for command in absurd {
            self.refuse(&command, NOT_UNDERSTOOD, "is no command of this dialect");
        }
        for message in std::mem::take(&mut self.heard) {
            self.obey(&message);
        }
        if std::mem::take(&mut self.asked_version) {
            self.say(&FromVehicle::Version("albacore front seat".into()));
        }
        if self.is_driven() && self.silent >= TIMEOUT_TICKS {
            self.happenings.push(Happening::TimedOut);
            self.leave();
        }
    }

    fn obey(&mut self, message: &ToVehicle) {
        match message {
            ToVehicle::Override(true) if self.given_up => {}
            ToVehicle::Override(true) => {
                self.seat.ask(self.seconds(), self.senses.position);
                self.answer();
            }
            ToVehicle::Override(false) => {
                if self.is_driven() {
                    self.happenings.push(Happening::Released);
                }
                self.leave();
            }
            ToVehicle::ClosestPoint(closest) => self.seat.return_to_closest_point(*closest),
            // However often it was asked in a tick.
            ToVehicle::VersionRequest => self.asked_version = true,
            ToVehicle::Query(_) | ToVehicle::KeepAlive(_) | ToVehicle::Other(_) => {}
            command => self.set_goal(command),
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
            (_, Control::Released) => self.happenings.push(Happening::TakenBack),
            (_, Control::Suspended) => self.happenings.push(Happening::Suspended),
            (Control::Suspended, _) => self.happenings.push(Happening::GoesOn),
            _ => {}
        }
    }

    fn give_over(&mut self) {
        self.happenings.push(Happening::Taken(self.senses.position, self.leg()));
        let (heading, speed) = (self.senses.heading, self.seat.plan().map_or(0.0, OwnPlan::speed));
        self.goals = Some(Goals { heading, rate: 0.0, speed, vertical: self.seat.vertical() });
    }

    fn set_goal(&mut self, command: &ToVehicle) {
        let Some(goals) = &mut self.goals else {
            return self.refuse(&command.to_string(), NOT_IN_OVERRIDE, "override is not active");
        };
        if self.control == Control::Suspended {
            return self.refuse(&command.to_string(), NOT_IN_OVERRIDE, "the mission is suspended");
        }
        let wanted = match command {
            ToVehicle::Heading(heading) => Goals { heading: *heading, rate: 0.0, ..*goals },
            ToVehicle::HeadingRate(rate) if rate.abs() <= TURN_RATE_MAX => Goals { rate: *rate, ..*goals },
            ToVehicle::HeadingRate(_) => {
                return self.refuse(&command.to_string(), OUT_OF_BOUNDS, "faster than this vehicle turns");
            }
            ToVehicle::Depth(depth) => Goals { vertical: Vertical::Depth(*depth), ..*goals },
            ToVehicle::Altitude(altitude) => Goals { vertical: Vertical::Altitude(*altitude), ..*goals },
            ToVehicle::Speed(speed) => Goals { speed: metres_per_second(*speed), ..*goals },
            _ => return self.refuse(&command.to_string(), NOT_SERVED, "this vehicle does not do that"),
        };
        *goals = wanted;
        self.answer_goal(command, wanted);
    }

    /// An echo, where the vehicle follows the goal as it is; else an error that says as far as it does. The vehicle gives
    /// notice of that itself.
    fn answer_goal(&mut self, goal: &ToVehicle, wanted: Goals) {
        let (mut of_speed, mut of_vertical) = (None, None);
        self.vehicle.clamp_command(&wanted.command(), &mut |beyond| match beyond {
            Beyond::Fast(_) | Beyond::Astern => of_speed = Some(beyond),
            Beyond::Deep(_) | Beyond::Low(_) | Beyond::High => of_vertical = Some(beyond),
        });
        let beyond = match goal {
            ToVehicle::Speed(_) => of_speed,
            ToVehicle::Depth(_) | ToVehicle::Altitude(_) => of_vertical,
            _ => None,
        };
        let echo = goal.to_string();
        self.say(&match beyond {
            Some(beyond) => FromVehicle::Error(OUT_OF_BOUNDS, beyond.to_string()),
            None => FromVehicle::Accepted(echo.strip_prefix("C,").unwrap_or(&echo).to_string()),
        });
    }

    fn refuse(&mut self, what: &str, code: u32, why: &'static str) {
        self.say(&FromVehicle::Error(code, why.to_string()));
        // Who does not listen says it again and again; who watches need not hear it as often.
        let again = self.refused.is_some_and(|(last, tick)| last == why && self.tick - tick < TIMEOUT_TICKS);
        if !again {
            self.happenings.push(Happening::Refused(format!("#{what}"), why));
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
            goals.heading = goals.heading + goals.rate * TICK_S;
            return Some(goals.command());
        }
        let Senses { position, course, heading, flow, .. } = self.senses;
        let known = Known { position, course, heading, flow: flow.unwrap_or(Vector::ZERO) };
        let happenings = &mut self.happenings;
        self.seat.steer(known, &mut |milestone| happenings.push(Happening::Plan(milestone)))
    }

    /// Takes in what was sensed, and passes on what has messages of its own.
    fn tell_samples(&mut self) {
        let snapshot = std::mem::take(&mut self.snapshot);
        let heading = self.senses.heading;
        let (mut temperature, mut salinity) = (None, None);
        // On the wire there is no number for what is none.
        for sample in snapshot.samples.iter().filter(|s| s.reading.iter().all(|x| x.is_finite())) {
            let [a, b, ..] = sample.reading;
            match sample.channel {
                POSITION => self.senses.position = Point::new(a, b),
                COURSE => self.senses.course = Heading::from_radians(a),
                HEADING => self.senses.heading = Heading::from_radians(a),
                SPEED => self.senses.speed = a,
                DEPTH => self.senses.depth = a,
                ALTITUDE => self.senses.altitude = Some(a),
                FLOW => self.senses.flow = Some(Vector::new(a, b)),
                CHEMICAL => self.say(&FromVehicle::Fluorometer { gain: 1.0, value: a * FULL_SCALE_VOLTS }),
                BATTERY => {
                    self.senses.battery = a;
                    let (capacity, available, percent) = (CAPACITY_WH, CAPACITY_WH * a, 100.0 * a);
                    self.say(&FromVehicle::Battery { capacity, available, percent });
                }
                TEMPERATURE => temperature = Some(a),
                SALINITY => salinity = Some(a),
                _ => {}
            }
        }
        if let (Some(temperature), Some(salinity)) = (temperature, salinity) {
            self.say(&FromVehicle::Ctd(seawater::ctd(temperature, salinity, self.senses.depth)));
        }
        self.senses.turn_rate = (self.senses.heading - heading) / TICK_S;
        self.snapshot = snapshot;
        if self.tick.is_multiple_of(ADCP_TICKS) {
            self.tell_adcp();
        }
    }

    /// Says that the vehicle lies on the bottom, as long as it does, and once that it has come free: its state has no flag for
    /// it.
    fn tell_grounding(&mut self) {
        let aground = self.snapshot.aground;
        let again = aground && self.tick.is_multiple_of(grounding::AGAIN_TICKS);
        if aground != self.aground || again {
            self.say(&grounding::told(aground));
            self.aground = aground;
        }
    }

    fn tell_adcp(&mut self) {
        let Senses { heading, course, speed, altitude, flow, .. } = self.senses;
        let drift = course - heading;
        self.say(&FromVehicle::Adcp(Adcp {
            ahead: speed * cos(drift),
            starboard: speed * sin(drift),
            vertical: 0.0,
            altitude,
            heading,
            current: flow.map(|flow| (flow.along(heading), flow.right_of(heading))),
            look: 'U',
        }));
    }

    fn mode(&self) -> Mode {
        let closest =
            if self.seat.plan().is_some_and(OwnPlan::returns_to_closest_point) { Mode::CLOSEST_POINT } else { 0 };
        if self.given_up {
            Mode::new(Phase::Over, Mode::NOT_ALLOWED)
        } else if self.control == Control::Suspended {
            Mode::new(Phase::Suspended, closest | Mode::ENABLED | Mode::ACTIVE)
        } else if self.is_driven() {
            Mode::new(Phase::InMission, closest | Mode::ENABLED | Mode::ACTIVE)
        } else if self.seat.is_over() {
            Mode::new(Phase::Over, 0)
        } else {
            let answer = match self.control {
                // Who has given control back is to see that it was taken.
                Control::Offered if self.left.is_none_or(|left| self.tick - left >= TIMEOUT_TICKS) => Mode::ACTIVE,
                Control::Refused => Mode::NOT_ALLOWED,
                _ => 0,
            };
            Mode::new(Phase::InMission, closest | answer)
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
        let speed_goal = goal.map_or(0.0, |c| c.speed);
        self.say(&FromVehicle::State(State {
            time_ms: ((BEGIN_MS + 100 * self.tick) % u64::from(DAY_MS)) as u32,
            position: self.frame.to_geodetic(s.position),
            depth: s.depth,
            depth_goal,
            altitude: s.altitude,
            pitch: 0.0,
            roll: 0.0,
            rpm: s.speed * RPM_AT_1_MPS,
            rpm_goal: speed_goal * RPM_AT_1_MPS,
            speed: s.speed,
            heading: s.heading,
            heading_rate: s.turn_rate,
            heading_goal: goal.map_or(s.heading, |c| c.heading),
            mode: self.mode(),
            leg: Some(self.leg()),
        }));
    }

    fn say(&mut self, message: &FromVehicle) {
        self.out.extend_from_slice(seal(&message.to_string()).as_bytes());
    }
}

fn metres_per_second(speed: SpeedGoal) -> f64 {
    match speed {
        SpeedGoal::Rpm(rpm) => rpm / RPM_AT_1_MPS,
        SpeedGoal::MetresPerSecond(speed) | SpeedGoal::Knots(speed) => speed,
    }
}
