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

/// A channel of the command.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "each variant is the channel of its name")]
pub enum Channel {
    Depth,
    Altitude,
    Speed,
}
