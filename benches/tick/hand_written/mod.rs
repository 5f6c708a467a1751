//! What `missions/duck_single_2005.alb` does from its first tick to the end of its strategy, written by hand: what the
//! machine's tick is held against.
//!
//! It uses the same geometry, guidance and libm, and gives the same commands to the bit. It stops where the strategy does
//! (the stamp and the way home are not written), and after an abort it gives nothing (no recovery). It tells nobody what
//! happens: there is no trace.

mod cage;
mod cpt;
mod guided;
mod maneuver;
mod search;
mod senses;

use albacore_geometry::math::radians;
use albacore_geometry::{Area, Heading, Point};
use albacore_guidance::parameters::{ARRIVAL_RADIUS, TURN_RATE_MAX};
use albacore_guidance::{CommandFilter, Goto, Law, through_water, turning_radius_in_flow};
use albacore_vehicle::{Command, Control, Snapshot, TICK_S, Vertical};
use cage::Cage;
use cpt::{Cpt, Parameters};
pub use guided::Guided;
use guided::Led;
use senses::{Freshness, Senses};

const CRUISE: f64 = 2.0;
const ALTITUDE: f64 = 2.0;
const ALTITUDE_MIN: f64 = 1.5;
const SPEED_MAX: f64 = 2.6;
const MISSION_TICKS: u64 = 120 * 60 * 10;
const STRATEGY_TICKS: u64 = 90 * 60 * 10;

/// The mission under way.
#[derive(Clone)]
pub struct Mission {
    area: Area,
    cage: Cage,
    /// How far inside the cage the vehicle is in this tick, m.
    inside: f64,
    senses: Senses,
    freshness: Freshness,
    asked: Asked,
    filter: CommandFilter,
    doing: Doing,
    tick: u64,
    began: u64,
}

/// What a statement asks for, before cage, limits and compensation.
#[derive(Clone, Copy)]
struct Asked {
    course: Heading,
    over_ground: bool,
    speed: f64,
    vertical: Vertical,
}

#[derive(Clone)]
#[expect(clippy::large_enum_variant, reason = "there is one, and it is nearly always the largest")]
enum Doing {
    Waiting,
    Transit(Goto),
    Tracing { cpt: Cpt, since: u64 },
    Over,
}

impl Mission {
    /// A mission that has not begun.
    pub fn new() -> Option<Self> {
        let area = Area::rectangle(Point::ORIGIN, Heading::from_degrees(320.0), 1094.0, 367.0);
        Some(Mission {
            cage: Cage::new(&area),
            inside: 0.0,
            area,
            senses: Senses::new(),
            freshness: Freshness::default(),
            asked: Asked { course: Heading::NORTH, over_ground: false, speed: 0.0, vertical: Vertical::Depth(0.0) },
            filter: CommandFilter::new(Heading::NORTH),
            doing: Doing::Waiting,
            tick: 0,
            began: 0,
        })
    }

    /// One tick.
    pub fn step(&mut self, snapshot: &Snapshot) -> Option<Command> {
        self.senses.take_in(self.tick, &snapshot.samples);
        let command = match snapshot.control {
            Control::InControl => self.drive(),
            Control::Suspended | Control::Monitoring | Control::Requesting => None,
            _ if matches!(self.doing, Doing::Waiting) => None,
            _ => self.over(),
        };
        self.tick += 1;
        command
    }

    /// The guidance of the last tick.
    pub fn guided(&self) -> Guided {
        let led = match &self.doing {
            Doing::Transit(goto) => Led::Goto(*goto),
            Doing::Tracing { cpt, .. } => cpt.led(),
            Doing::Waiting | Doing::Over => Led::Course,
        };
        let Senses { position, course, flow, .. } = self.senses;
        let Asked { course: asked, speed, .. } = self.asked;
        Guided { led, position, course, filter: self.filter, asked, speed, flow }
    }

    fn over(&mut self) -> Option<Command> {
        self.doing = Doing::Over;
        None
    }

    fn drive(&mut self) -> Option<Command> {
        self.inside = self.cage.inside(self.senses.position);
        match self.doing {
            Doing::Over => return None,
            Doing::Waiting if self.senses.complete() => {
                self.start();
                return Some(self.command());
            }
            Doing::Waiting => return None,
            _ => {}
        }
        match self.freshness.check(&self.senses, self.tick) {
            senses::Verdict::Fresh => {}
            senses::Verdict::Hold => {
                let speed = std::mem::replace(&mut self.asked.speed, 0.0);
                let command = self.command();
                self.asked.speed = speed;
                return Some(command);
            }
            senses::Verdict::Abort => return self.over(),
        }
        let time_is_up = self.tick - self.began >= MISSION_TICKS;
        if Cage::is_left(self.inside) || !self.go_on() || time_is_up {
            return self.over();
        }
        Some(self.command())
    }

    fn start(&mut self) {
        self.began = self.tick;
        self.filter = CommandFilter::new(self.senses.heading);
        let flow = self.senses.flow;
        let corner = cage::corner(&self.area, flow.toward(), self.senses.position);
        let mut goto = Goto::new(corner, ARRIVAL_RADIUS, turning_radius_in_flow(CRUISE, flow.length(), TURN_RATE_MAX));
        self.ask(goto.step(self.senses.position, self.senses.course).course);
        self.doing = Doing::Transit(goto);
    }

    /// One tick of what is being done; false when there is no more.
    fn go_on(&mut self) -> bool {
        let course = match &mut self.doing {
            Doing::Transit(goto) => {
                let guidance = goto.step(self.senses.position, self.senses.course);
                if guidance.arrived {
                    let parameters = Parameters {
                        area: self.area.clone(),
                        cruise: CRUISE,
                        threshold: 0.04,
                        lambda_ticks: 50,
                        beta: radians(20.0),
                        advance: 18.0,
                        cross: 18.0,
                        bowties: 2,
                    };
                    let (cpt, course) = Cpt::enter(parameters, &self.senses);
                    self.doing = Doing::Tracing { cpt, since: self.tick };
                    course
                } else {
                    guidance.course
                }
            }
            Doing::Tracing { cpt, since } => match cpt.step(&self.senses) {
                Some(course) if self.tick - *since < STRATEGY_TICKS => course,
                _ => return false,
            },
            Doing::Waiting | Doing::Over => return false,
        };
        self.ask(course);
        true
    }

    fn ask(&mut self, course: Heading) {
        self.asked = Asked { course, over_ground: true, speed: CRUISE, vertical: Vertical::Altitude(ALTITUDE) };
    }

    /// Cage, limits, command filter, flow compensation.
    fn command(&mut self) -> Command {
        let Asked { course: asked, over_ground, speed, vertical } = self.asked;
        let amended = self.cage.amend(asked, self.inside, self.senses.position, self.senses.heading);
        let speed = speed.min(SPEED_MAX);
        let vertical = match vertical {
            Vertical::Altitude(metres) => Vertical::Altitude(metres.max(ALTITUDE_MIN)),
            Vertical::Depth(metres) => match self.senses.water_depth {
                Some(water) => Vertical::Depth(metres.min((water - ALTITUDE_MIN).max(0.0))),
                None => Vertical::Depth(metres),
            },
        };
        let course = self.filter.step(amended, TURN_RATE_MAX, TICK_S);
        if (over_ground || amended != asked) && speed > 0.0 {
            let water = through_water(course, speed, self.senses.flow, SPEED_MAX);
            Command::new(water.heading, water.speed, vertical)
        } else {
            Command::new(course, speed, vertical)
        }
    }
}
