//! The controller's side: what a vehicle's lines say, and the lines that say something to it.

use super::frame::{Deframer, seal};
use super::message::{Adcp, FromVehicle, SpeedGoal, State, ToVehicle};
use super::{DIALECT, grounding, instruments};
use crate::controller::{ControllerMessage, ControllerSide, Received};
use crate::dialect::Dialect;
use crate::set_point::SetPoint;
use albacore_geometry::Vector;
use albacore_geometry::math::atan2;
use albacore_vehicle::measurements::{
    ALTITUDE, COURSE, DEPTH, FLOW, HEADING, POSITION, SPEED, VEHICLE_MODE, WATER_DEPTH,
};

/// The dialect does not say how well the vehicle knows its position. Ours: what dead reckoning between acoustic fixes of
/// 2 m comes to, m an axis.
const POSITION_SIGMA: f64 = 3.0;
/// What a state and the Doppler log tell.
const TOLD: [u16; 9] = [POSITION, COURSE, HEADING, SPEED, DEPTH, ALTITUDE, WATER_DEPTH, FLOW, VEHICLE_MODE];
/// The course over ground is the heading and a drift angle that `#A` tells; older than this it is not known, ticks.
const DRIFT_TICKS: u64 = 50;
/// A vehicle that goes no faster than this by its own word is at rest, m/s: a profiler that tells 0 then is in order, and one
/// that tells 0 of a vehicle under way is not.
const AT_REST: f64 = 0.05;

/// What is remembered of earlier lines.
#[derive(Default)]
pub struct Controller {
    deframer: Deframer,
    memory: Memory,
}

#[derive(Default)]
struct Memory {
    /// How far the course is clockwise of the heading, rad, and the tick that it is of.
    drift: Option<(f64, u64)>,
    /// By the last state, m/s.
    speed: f64,
}

impl ControllerSide for Controller {
    fn dialect(&self) -> &'static Dialect {
        &DIALECT
    }

    fn can_tell(&self, measurement: u16) -> bool {
        TOLD.contains(&measurement) || instruments::measure(measurement)
    }

    fn hear(&mut self, bytes: &[u8], received: &mut Received) {
        let memory = &mut self.memory;
        self.deframer.push(bytes, |frame| {
            // A line that is no frame and a frame that is no message come to the same: noise.
            if let Some(message) = frame.ok().and_then(|body| FromVehicle::parse(body).ok()) {
                received.message();
                memory.take_in(message, received);
            } else {
                received.unreadable();
            }
        });
    }

    fn say(&mut self, what: &ControllerMessage, out: &mut Vec<u8>) {
        let message = match what {
            ControllerMessage::TakeOver => ToVehicle::Override(true),
            ControllerMessage::GiveBack => ToVehicle::Override(false),
            ControllerMessage::KeepAlive => {
                ToVehicle::KeepAlive(concat!("albacore ", env!("CARGO_PKG_VERSION")).into())
            }
            // The first commands of the first override are accepted after a question only.
            ControllerMessage::Begin => ToVehicle::Query("Depth".into()),
            // Goals latch, and each has a line of its own.
            ControllerMessage::SetPoint(set_point, _) => (*set_point).into(),
        };
        out.extend_from_slice(seal(&message.to_string()).as_bytes());
    }

    fn text(&self, set_point: SetPoint) -> String {
        format!("#{}", ToVehicle::from(set_point))
    }
}

impl Memory {
    fn take_in(&mut self, message: FromVehicle, received: &mut Received) {
        match message {
            FromVehicle::State(state) => self.take_in_state(&state, received),
            FromVehicle::Adcp(adcp) => self.take_in_adcp(&adcp, received),
            FromVehicle::Measured(measured) => {
                measured.numbers.into_iter().for_each(|(measurement, number)| received.sample(measurement, &[number]));
            }
            FromVehicle::Accepted(text) => take_in_echo(&text, received),
            FromVehicle::Error(code, text) => {
                let comma = if text.is_empty() { "" } else { ", " };
                let said = format!("the vehicle says: error {code}{comma}{text}");
                match grounding::parse(code, &text) {
                    Some(aground) => received.aground(aground, said),
                    None => received.notice(said),
                }
            }
            FromVehicle::Version(_) | FromVehicle::Other(_) => {}
        }
    }

    fn take_in_state(&mut self, state: &State, received: &mut Received) {
        let Some(tick) = received.begin_state(state.time_ms) else { return };
        self.speed = state.speed;
        received.position(state.position, POSITION_SIGMA);
        if let Some((angle, _)) = self.drift.filter(|(_, of)| tick.saturating_sub(*of) <= DRIFT_TICKS) {
            received.sample(COURSE, &[(state.heading + angle).radians()]);
        }
        received.sample(HEADING, &[state.heading.radians()]);
        received.sample(SPEED, &[state.speed]);
        received.sample(DEPTH, &[state.depth]);
        if let Some(altitude) = state.altitude {
            received.sample(ALTITUDE, &[altitude]);
            received.sample(WATER_DEPTH, &[state.depth + altitude]);
        }
        received
            .end_state(state.mode.into(), &[SetPoint::Heading(state.heading_goal), SetPoint::Depth(state.depth_goal)]);
    }

    fn take_in_adcp(&mut self, adcp: &Adcp, received: &mut Received) {
        let tick = received.tick();
        if adcp.ahead != 0.0 || adcp.starboard != 0.0 {
            self.drift = Some((atan2(adcp.starboard, adcp.ahead), tick));
        } else if self.speed < AT_REST {
            // At rest any direction is that of the course: no instrument is missing. The last one goes on.
            self.drift = Some((self.drift.map_or(0.0, |(angle, _)| angle), tick));
        }
        if let Some((ahead, starboard)) = adcp.current {
            let unit = adcp.heading.unit();
            let flow =
                Vector::new(ahead * unit.north - starboard * unit.east, ahead * unit.east + starboard * unit.north);
            received.sample(FLOW, &[flow.north, flow.east]);
        }
    }
}

/// An echo is no acceptance, but it was heard: what `#S` tells of the goals, heading and depth, it tells better. Of the others it
/// tells nothing.
fn take_in_echo(text: &str, received: &mut Received) {
    let Ok(echo) = ToVehicle::parse(&format!("C,{text}")) else { return };
    match (&echo, echo.set_point()) {
        (ToVehicle::Heading(heading), _) => received.heading_heard(*heading),
        (ToVehicle::Depth(_), _) => {}
        // Ours are in metres a second: an echo in another unit is of someone else's.
        (ToVehicle::Speed(SpeedGoal::Rpm(_) | SpeedGoal::Knots(_)), _) => received.other_speed(format!("#{echo}")),
        (_, Some(set_point)) => received.accepted(set_point),
        (_, None) => {}
    }
}
