//! One of the things that a command asks for.

use albacore_geometry::Heading;
use albacore_geometry::math::radians;
use albacore_vehicle::{Beyond, Command, Vertical};

/// How far what the vehicle holds may be from what was asked: what a goal that moves comes to while it is on its way. In
/// degrees (the command filter lets a heading turn by 10 a second), m, and m/s.
const HEADING_SLACK_DEG: f64 = 10.0;
const HEIGHT_SLACK: f64 = 0.5;
const SPEED_SLACK: f64 = 0.2;

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
    /// How many a command has at most.
    pub(crate) const PLACES: usize = 3;

    /// Those of a command, but for what it leaves open: that is not said.
    pub fn of(command: &Command) -> impl Iterator<Item = SetPoint> {
        let vertical = match command.vertical {
            Vertical::Depth(depth) => SetPoint::Depth(depth),
            Vertical::Altitude(altitude) => SetPoint::Altitude(altitude),
        };
        [Some(SetPoint::Heading(command.heading)), Some(SetPoint::Speed(command.speed)), Some(vertical)]
            .into_iter()
            .flatten()
    }

    /// Its place among those of a command.
    pub(crate) fn place(self) -> usize {
        match self {
            SetPoint::Heading(_) => 0,
            SetPoint::Speed(_) => 1,
            SetPoint::Depth(_) | SetPoint::Altitude(_) => 2,
        }
    }

    /// A command with this one in its place.
    pub(crate) fn placed_in(self, command: Command) -> Command {
        match self {
            SetPoint::Heading(heading) => Command { heading, ..command },
            SetPoint::Speed(speed) => Command { speed, ..command },
            SetPoint::Depth(depth) => Command { vertical: Vertical::Depth(depth), ..command },
            SetPoint::Altitude(altitude) => Command { vertical: Vertical::Altitude(altitude), ..command },
        }
    }

    /// Whether it is this one that is beyond a vehicle's limits.
    pub(crate) fn is_beyond(self, beyond: &Beyond) -> bool {
        match self {
            SetPoint::Heading(_) => false,
            SetPoint::Speed(_) => matches!(beyond, Beyond::Fast(_) | Beyond::Astern),
            SetPoint::Depth(_) | SetPoint::Altitude(_) => {
                matches!(beyond, Beyond::Deep(_) | Beyond::Low(_) | Beyond::High)
            }
        }
    }

    /// Whether a vehicle that holds the other one has taken this one up.
    pub(crate) fn is_held_as(self, held: SetPoint) -> bool {
        match (held, self) {
            (SetPoint::Heading(a), SetPoint::Heading(b)) => (a - b).abs() <= radians(HEADING_SLACK_DEG),
            (SetPoint::Depth(a), SetPoint::Depth(b)) | (SetPoint::Altitude(a), SetPoint::Altitude(b)) => {
                (a - b).abs() <= HEIGHT_SLACK
            }
            (SetPoint::Speed(a), SetPoint::Speed(b)) => (a - b).abs() <= SPEED_SLACK,
            _ => false,
        }
    }
}
