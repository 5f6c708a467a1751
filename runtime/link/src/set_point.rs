//! One of the three things that a command asks for.

use albacore_geometry::Heading;
use albacore_vehicle::{Command, Vertical};

/// What a vehicle is to hold in one way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SetPoint {
    /// A heading through the water.
    Heading(Heading),
    /// A speed through the water, m/s.
    Speed(f64),
    /// Metres below the surface.
    Depth(f64),
    /// Metres above the bottom.
    Altitude(f64),
}

impl SetPoint {
    /// Those of a command.
    pub fn of(command: &Command) -> [SetPoint; 3] {
        let vertical = match command.vertical {
            Vertical::Depth(depth) => SetPoint::Depth(depth),
            Vertical::Altitude(altitude) => SetPoint::Altitude(altitude),
        };
        [SetPoint::Heading(command.heading), SetPoint::Speed(command.speed), vertical]
    }

    /// Its place among those of a command.
    pub(crate) fn place(self) -> usize {
        match self {
            SetPoint::Heading(_) => 0,
            SetPoint::Speed(_) => 1,
            SetPoint::Depth(_) | SetPoint::Altitude(_) => 2,
        }
    }
}
