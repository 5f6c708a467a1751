//! What guidance is asked for, and on which channels.

use serde::{Deserialize, Serialize};

/// A guidance law. Arguments are frozen at the beginning, except the course of `steer`, which the code computes anew.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Guide {
    /// Arguments: point (2), radius of arrival.
    Goto,
    /// Arguments: line (4), turning radius.
    Follow,
    /// Arguments: point (2), heading, turning radius, 1 for all six words.
    Dubins,
    /// Arguments: course over ground. Never ends.
    Steer,
    /// Arguments: heading through the water. Never ends.
    SteerHeading,
    /// Keeps course; the setpoints say the rest. Never ends.
    Keep,
    /// Stays: speed 0. Never ends.
    Hold,
    /// Goes on as commanded last. Never ends.
    Wait,
    /// Arguments: centre (2), radius, turns (0: for ever), 1 for clockwise.
    Loiter,
}

/// The words that a guidance law keeps while its statement lasts: the most that any of them needs.
pub const GUIDANCE_WORDS: u32 = 32;
/// The least radius, of arrival, of a turn or of a circle, m. A turning radius of 0 stands for the one that the speed allows.
pub const RADIUS_MIN_M: f64 = 0.1;

impl Guide {
    /// The argument that is a radius, and whether it may be 0.
    pub fn radius(self) -> Option<(u32, bool)> {
        match self {
            Guide::Goto | Guide::Loiter => Some((2, false)),
            Guide::Follow => Some((4, true)),
            Guide::Dubins => Some((3, true)),
            Guide::Steer | Guide::SteerHeading | Guide::Keep | Guide::Hold | Guide::Wait => None,
        }
    }
}

/// A channel of the command.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "each variant is the channel of its name")]
pub enum Channel {
    Depth,
    Altitude,
    Speed,
}
