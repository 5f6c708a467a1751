//! What a dialect does for a served vehicle: it reads what a guest says, and writes what is said to him.

use crate::dialect::Dialect;
use crate::set_point::SetPoint;
use crate::status::Status;
use albacore_geometry::{Geodetic, Heading, Point, Vector};
use albacore_vehicle::Snapshot;

/// The vehicle's side of a dialect: a function of bytes, without a view of who drives.
pub trait ServerSide: Send {
    /// The dialect that it is of.
    fn dialect(&self) -> &'static Dialect;

    /// Takes in bytes, however they were cut on their way, and adds to `heard` what they say, in the order in which it came.
    fn hear(&mut self, bytes: &[u8], heard: &mut Vec<Request>);

    /// Adds the messages to `out` that say something to the guest.
    fn say(&mut self, what: &Report, out: &mut Vec<u8>);
}

/// What a guest says.
#[derive(Clone, Debug, PartialEq)]
pub enum Request {
    /// He wants to drive.
    TakeOver,
    /// The vehicle is to drive itself.
    GiveBack,
    /// Where the vehicle goes when it drives itself again: to the closest point of its leg, or to where the guest took over.
    ClosestPoint(bool),
    /// A goal, and how it stands on the wire.
    Goal(Goal, String),
    /// Something else, which tells no more than that he is there.
    Other,
    /// Bytes that are no message; where they were meant as a command, as much of it as a person needs to know it again.
    Unreadable(Option<String>),
}

/// A goal of a guest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// To hold something.
    Hold(SetPoint),
    /// To turn so fast, clockwise, rad/s.
    Turn(f64),
    /// One of the dialect's that our vehicles do not know.
    Unknown,
}

/// What is said to a guest.
pub enum Report<'a> {
    /// What was sensed in a tick, and what is known with it; numbers may be none that are finite.
    Sensed(&'a Snapshot, &'a Senses, u64),
    /// The vehicle lies on the bottom, or has come free.
    Aground(bool),
    /// A goal is followed as it is; how it stood on the wire.
    Accepted(&'a str),
    /// Something is not done, or not as it was asked for, and why.
    Refused(Refusal, &'a str),
    /// All requests of a tick were answered: what else the dialect owes an answer to comes now.
    Answered,
    /// The state after a tick.
    State(&'a StateReport),
}

/// Why something that was asked for is not done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// The guest does not drive.
    NotDriving,
    /// It is beyond the vehicle's limits, and held at them.
    Beyond,
    /// Our vehicles do not do that.
    NotServed,
    /// It cannot be understood.
    NotUnderstood,
}

/// What is known of the vehicle.
#[derive(Clone, Copy, Debug, Default)]
pub struct Senses {
    /// Where it believes to be.
    pub position: Point,
    /// Its course over ground.
    pub course: Heading,
    /// Its heading.
    pub heading: Heading,
    /// How fast it turns clockwise, rad/s.
    pub turn_rate: f64,
    /// Its speed over ground, m/s.
    pub speed: f64,
    /// Its depth, m.
    pub depth: f64,
    /// Its height above the bottom, m.
    pub altitude: Option<f64>,
    /// The current, m/s toward.
    pub flow: Option<Vector>,
    /// What is left in the battery, share of a full one.
    pub battery: f64,
}

/// A vehicle's state.
#[derive(Clone, Copy, Debug)]
pub struct StateReport {
    /// The tick that it is of.
    pub tick: u64,
    /// What is known of the vehicle.
    pub senses: Senses,
    /// Where it believes to be, on the globe.
    pub position: Geodetic,
    /// The heading that it holds.
    pub heading_goal: Heading,
    /// The speed that it holds, m/s.
    pub speed_goal: f64,
    /// The depth that it holds, or that the height above the bottom comes to which it holds, m.
    pub depth_goal: f64,
    /// Its own mission, and who drives.
    pub status: Status,
    /// When it drives itself again it goes to the closest point of its leg.
    pub returns_to_closest_point: bool,
    /// The leg of its own mission.
    pub leg: u32,
}
