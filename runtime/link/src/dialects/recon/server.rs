//! The vehicle's side: what a guest's lines say, and the lines that tell of the vehicle.

use super::frame::{Deframer, seal};
use super::message::{Adcp, FromVehicle, RPM_AT_1_MPS, State, ToVehicle};
use super::mode::Mode;
use super::{DIALECT, grounding, instruments};
use crate::controller::DAY_MS;
use crate::dialect::Dialect;
use crate::server::{Goal, Refusal, Report, Request, Senses, ServerSide, StateReport};
use albacore_geometry::math::{cos, sin};

/// Ticks between messages of the profiler.
const ADCP_TICKS: u64 = 10;
/// The day's time at tick 0: noon.
const BEGIN_MS: u64 = 12 * 3_600_000;
/// So much of a message that cannot be understood is shown, bytes.
const SHOWN: usize = 40;

/// Numbers of `#E`. Ours: the sources print one sample, of another error. 4 and 5 tell of the bottom: `grounding`.
fn code(refusal: Refusal) -> u32 {
    match refusal {
        Refusal::NotDriving => 1,
        Refusal::Beyond => 2,
        Refusal::NotServed => 3,
        Refusal::NotUnderstood => 6,
    }
}

/// What is remembered of earlier lines.
#[derive(Default)]
pub struct Server {
    deframer: Deframer,
    /// Whether somebody asks for the vehicle's version.
    asked_version: bool,
}

impl ServerSide for Server {
    fn dialect(&self) -> &'static Dialect {
        &DIALECT
    }

    fn hear(&mut self, bytes: &[u8], heard: &mut Vec<Request>) {
        let asked_version = &mut self.asked_version;
        self.deframer.push(bytes, |frame| {
            heard.push(match frame.map(|body| ToVehicle::parse(body).map_err(|_| body)) {
                Ok(Ok(message)) => {
                    // However often it was asked in a tick.
                    *asked_version |= message == ToVehicle::VersionRequest;
                    request(&message)
                }
                Ok(Err(body)) if body.starts_with("C,") => Request::Unreadable(Some(format!("#{}", shortened(body)))),
                _ => Request::Unreadable(None),
            });
        });
    }

    fn say(&mut self, what: &Report, out: &mut Vec<u8>) {
        let mut say = |message: FromVehicle| out.extend_from_slice(seal(&message.to_string()).as_bytes());
        match what {
            Report::Sensed(snapshot, senses, tick) => {
                instruments::told(snapshot, senses).for_each(|measured| say(FromVehicle::Measured(measured)));
                if tick.is_multiple_of(ADCP_TICKS) {
                    say(FromVehicle::Adcp(adcp(senses)));
                }
            }
            Report::Aground(aground) => say(grounding::report(*aground)),
            Report::Accepted(goal) => {
                say(FromVehicle::Accepted(goal.strip_prefix("#C,").unwrap_or(goal).to_string()));
            }
            Report::Refused(refusal, why) => say(FromVehicle::Error(code(*refusal), (*why).to_string())),
            Report::Answered => {
                if std::mem::take(&mut self.asked_version) {
                    say(FromVehicle::Version("albacore front seat".into()));
                }
            }
            Report::State(report) => say(FromVehicle::State(state(report))),
        }
    }
}

fn request(message: &ToVehicle) -> Request {
    let goal = match message {
        ToVehicle::Override(true) => return Request::TakeOver,
        ToVehicle::Override(false) => return Request::GiveBack,
        ToVehicle::ClosestPoint(closest) => return Request::ClosestPoint(*closest),
        ToVehicle::VersionRequest | ToVehicle::Query(_) | ToVehicle::KeepAlive(_) | ToVehicle::Other(_) => {
            return Request::Other;
        }
        ToVehicle::HeadingRate(rate) => Goal::Turn(*rate),
        _ => message.set_point().map_or(Goal::Unknown, Goal::Hold),
    };
    Request::Goal(goal, format!("#{message}"))
}

fn adcp(senses: &Senses) -> Adcp {
    let Senses { heading, course, speed, altitude, flow, .. } = *senses;
    let drift = course - heading;
    Adcp {
        ahead: speed * cos(drift),
        starboard: speed * sin(drift),
        vertical: 0.0,
        altitude,
        heading,
        current: flow.map(|flow| (flow.along(heading), flow.right_of(heading))),
        look: 'U',
    }
}

fn state(report: &StateReport) -> State {
    let closest = if report.returns_to_closest_point { Mode::CLOSEST_POINT } else { 0 };
    let s = report.senses;
    State {
        time_ms: ((BEGIN_MS + 100 * report.tick) % u64::from(DAY_MS)) as u32,
        position: report.position,
        depth: s.depth,
        depth_goal: report.depth_goal,
        altitude: s.altitude,
        pitch: 0.0,
        roll: 0.0,
        rpm: s.speed * RPM_AT_1_MPS,
        rpm_goal: report.speed_goal * RPM_AT_1_MPS,
        speed: s.speed,
        heading: s.heading,
        heading_rate: s.turn_rate,
        heading_goal: report.heading_goal,
        mode: Mode(Mode::from(report.status).0 | closest),
        leg: Some(report.leg),
    }
}

/// As much of a message as a person needs to know it again.
fn shortened(body: &str) -> String {
    match body.get(..SHOWN) {
        Some(head) if body.len() > SHOWN => format!("{head}…"),
        _ => body.to_string(),
    }
}
