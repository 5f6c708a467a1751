//! What a vehicle is told in a tick, and the table by which all of it is shown.

use albacore_geometry::Heading;
use serde::{Deserialize, Serialize};

/// What the vertical channel is to hold.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Vertical {
    /// Metres below the surface.
    Depth(f64),
    /// Metres above the bottom.
    Altitude(f64),
}

/// What the vehicle is to do during the coming tick. Goals latch: they hold until the next command.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Command {
    /// Heading through the water.
    pub heading: Heading,
    /// Speed through the water, in m/s.
    pub speed: f64,
    /// Depth or altitude.
    pub vertical: Vertical,
}

impl Command {
    /// To go on a heading at a speed, m/s, at a depth or an altitude.
    pub const fn new(heading: Heading, speed: f64, vertical: Vertical) -> Self {
        Command { heading, speed, vertical }
    }

    /// Whether all that it holds are finite numbers.
    pub fn is_finite(&self) -> bool {
        COMMANDED.iter().all(|part| (part.value)(self).is_none_or(f64::is_finite))
    }

    /// To lie still at a depth.
    pub const fn still(heading: Heading, depth: f64) -> Self {
        Command::new(heading, 0.0, Vertical::Depth(depth))
    }
}

/// What a command may hold, as people read it: a column of an export, a line of a report, words of `why`.
#[derive(Clone, Copy, Debug)]
pub struct Commanded {
    /// What it is called.
    pub name: &'static str,
    /// The unit of [`value`](Commanded::value): degrees, and SI besides.
    pub unit: &'static str,
    /// What stands before and after its number in a sentence.
    pub said: (&'static str, &'static str),
    /// Digits behind the point that are worth reading.
    pub digits: u8,
    /// Its number, where a command has one.
    pub value: fn(&Command) -> Option<f64>,
}

/// All that a command may hold, in the order in which it is told.
pub const COMMANDED: [Commanded; 4] = [
    Commanded {
        name: "heading",
        unit: "deg",
        said: ("heading ", " deg"),
        digits: 2,
        value: |command| Some(command.heading.degrees()),
    },
    Commanded {
        name: "speed",
        unit: "m/s",
        said: ("", " m/s through the water"),
        digits: 3,
        value: |command| Some(command.speed),
    },
    Commanded {
        name: "depth",
        unit: "m",
        said: ("depth ", " m"),
        digits: 2,
        value: |command| if let Vertical::Depth(depth) = command.vertical { Some(depth) } else { None },
    },
    Commanded {
        name: "altitude",
        unit: "m",
        said: ("altitude ", " m"),
        digits: 2,
        value: |command| if let Vertical::Altitude(altitude) = command.vertical { Some(altitude) } else { None },
    },
];
