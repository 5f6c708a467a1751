//! What happens at the vehicle's side, and how it is told.

use albacore_front_seat::Milestone;
use albacore_geometry::Point;
use albacore_vehicle::TICK_S;
use std::fmt;

/// What happened, for who watches.
#[derive(Clone, Debug, PartialEq)]
pub enum ServerEvent {
    /// A step in the life of the vehicle's own plan.
    Plan(Milestone),
    /// A guest drives; from where, and on which leg.
    Taken(Point, u32),
    /// The guest has given control back.
    Released,
    /// The guest has been silent for so many ticks.
    TimedOut(u64),
    /// The vehicle has taken control back.
    TakenBack,
    /// Its mission stands still, and it listens to nobody.
    Suspended,
    /// And goes on.
    GoesOn,
    /// Something that was asked for is not done, and why.
    Refused(String, &'static str),
    /// What the vehicle gave notice of.
    Notice(String),
    /// The vehicle has given up: it takes no commands any more, from nobody.
    GivenUp,
}

impl fmt::Display for ServerEvent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ServerEvent::Plan(Milestone::Leg(leg, of)) => write!(f, "leg {leg} of {of}"),
            ServerEvent::Taken(at, leg) => {
                write!(f, "override taken at ({:.1}, {:.1}) m, on leg {leg}", at.north, at.east)
            }
            ServerEvent::Released => f.write_str("override released; returns to the break-off point"),
            ServerEvent::TimedOut(ticks) => {
                let seconds = *ticks as f64 * TICK_S;
                write!(f, "override timed out: no message for {seconds} s; returns to the break-off point")
            }
            ServerEvent::TakenBack => f.write_str("override taken back; returns to the break-off point"),
            ServerEvent::Suspended => f.write_str("suspended: the vehicle stays where it is, and listens to nobody"),
            ServerEvent::GoesOn => f.write_str("suspended no more"),
            ServerEvent::Plan(Milestone::Resumed(at, leg)) => {
                write!(f, "back at the break-off point ({:.1}, {:.1}) m; resumes leg {leg}", at.north, at.east)
            }
            ServerEvent::Plan(Milestone::Over) => f.write_str("the last leg is done: mission over"),
            ServerEvent::Notice(notice) => f.write_str(notice),
            ServerEvent::GivenUp => f.write_str("the vehicle has given up, and floats up"),
            ServerEvent::Refused(what, why) => write!(f, "refused `{what}`: {why}"),
        }
    }
}
