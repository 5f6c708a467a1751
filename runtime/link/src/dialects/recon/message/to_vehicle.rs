//! What a controller says.

use super::super::fields::{fixed, fixed_down, fixed_up, number, ranges, within};
use super::{Malformed, compass, compass_text, lettered};
use crate::set_point::SetPoint;
use albacore_geometry::Heading;
use albacore_geometry::math::{degrees, radians};
use std::fmt;

/// Metres a second in a knot.
const KNOT: f64 = 1852.0 / 3600.0;
/// Turns of the propeller a minute for 1 m/s. Ours: 1500 turns for the 2.6 m/s of a REMUS 100.
pub(crate) const RPM_AT_1_MPS: f64 = 1500.0 / 2.6;

/// What a controller says.
#[derive(Clone, Debug, PartialEq)]
pub enum ToVehicle {
    /// `#E,1` and `#E,0`: enable override, or give it back.
    Override(bool),
    /// `#c,1`: after the override go to the closest point of the track.
    ClosestPoint(bool),
    /// `#C,Heading,Goal,270.0`: hold a heading.
    Heading(Heading),
    /// `#C,Heading,Rate,5.0`: turn, rad/s.
    HeadingRate(f64),
    /// `#C,Depth,Depth,3.00`: hold a depth, m.
    Depth(f64),
    /// `#C,Depth,Altitude,2.00`: hold a height above the bottom, m.
    Altitude(f64),
    /// `#C,Depth,Triangle,…`: go up and down: least depth (m), altitude (m), rate, greatest depth (m).
    Triangle([f64; 4]),
    /// `#C,Speed,…`.
    Speed(SpeedGoal),
    /// `#Q,Depth`: a question. One is needed before the first commands are accepted.
    Query(String),
    /// `#V,…`: the version, which keeps the link alive while nothing is commanded.
    KeepAlive(String),
    /// `#v`: what is your version?
    VersionRequest,
    /// A message that we do not know, by its letter.
    Other(char),
}

/// A speed, in one of the dialect's three units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpeedGoal {
    /// Turns of the propeller a minute.
    Rpm(f64),
    /// Metres a second.
    MetresPerSecond(f64),
    /// Knots, kept in metres a second.
    Knots(f64),
}

impl From<SetPoint> for ToVehicle {
    fn from(set_point: SetPoint) -> Self {
        match set_point {
            SetPoint::Heading(heading) => ToVehicle::Heading(heading),
            SetPoint::Speed(speed) => ToVehicle::Speed(SpeedGoal::MetresPerSecond(speed)),
            SetPoint::Depth(depth) => ToVehicle::Depth(depth),
            SetPoint::Altitude(altitude) => ToVehicle::Altitude(altitude),
        }
    }
}

impl ToVehicle {
    /// The set-point that it asks a vehicle to hold.
    pub fn set_point(&self) -> Option<SetPoint> {
        Some(match self {
            ToVehicle::Heading(heading) => SetPoint::Heading(*heading),
            ToVehicle::Depth(depth) => SetPoint::Depth(*depth),
            ToVehicle::Altitude(altitude) => SetPoint::Altitude(*altitude),
            ToVehicle::Speed(SpeedGoal::Rpm(rpm)) => SetPoint::Speed(rpm / RPM_AT_1_MPS),
            ToVehicle::Speed(SpeedGoal::MetresPerSecond(speed) | SpeedGoal::Knots(speed)) => SetPoint::Speed(*speed),
            _ => return None,
        })
    }

    /// Reads the body of a frame that a controller sent.
    pub fn parse(body: &str) -> Result<Self, Malformed> {
        let malformed = || Malformed(body.to_string());
        let (letter, rest) = lettered(body).ok_or_else(malformed)?;
        let flag = || match rest {
            "1" => Some(true),
            "0" => Some(false),
            _ => None,
        };
        let message = match letter {
            'E' => flag().map(ToVehicle::Override),
            'c' => flag().map(ToVehicle::ClosestPoint),
            'C' => ToVehicle::command(rest),
            'Q' => Some(ToVehicle::Query(rest.to_string())),
            'V' => Some(ToVehicle::KeepAlive(rest.to_string())),
            'v' => Some(ToVehicle::VersionRequest),
            other => Some(ToVehicle::Other(other)),
        };
        message.ok_or_else(malformed)
    }

    fn command(rest: &str) -> Option<Self> {
        let (what, rest) = rest.split_once(',')?;
        if what == "Speed" {
            let (value, unit) = rest.split_once(' ')?;
            return match unit {
                "rpm" => within(value, ranges::TURNS).map(SpeedGoal::Rpm),
                "meters/sec" => within(value, ranges::SPEEDS).map(SpeedGoal::MetresPerSecond),
                "knots" => within(value, ranges::SPEEDS).map(|knots| SpeedGoal::Knots(knots * KNOT)),
                _ => None,
            }
            .map(ToVehicle::Speed);
        }
        let (how, rest) = rest.split_once(',')?;
        match (what, how) {
            ("Heading", "Goal") => compass(rest).map(ToVehicle::Heading),
            ("Heading", "Rate") => within(rest, ranges::TURN_RATES).map(|rate| ToVehicle::HeadingRate(radians(rate))),
            ("Depth", "Depth") => within(rest, ranges::HEIGHTS).map(ToVehicle::Depth),
            ("Depth", "Altitude") => within(rest, ranges::HEIGHTS).map(ToVehicle::Altitude),
            ("Depth", "Triangle") => {
                let numbers: Vec<f64> = rest.split(',').map(number).collect::<Option<_>>()?;
                numbers.try_into().ok().map(ToVehicle::Triangle)
            }
            _ => None,
        }
    }
}

/// Goals are rounded to the side that limits leave free: none is deeper, nearer to the bottom or faster than it was asked for.
impl fmt::Display for ToVehicle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ToVehicle::Override(on) => write!(f, "E,{}", u8::from(*on)),
            ToVehicle::ClosestPoint(on) => write!(f, "c,{}", u8::from(*on)),
            ToVehicle::Heading(heading) => write!(f, "C,Heading,Goal,{}", compass_text(*heading)),
            ToVehicle::HeadingRate(rate) => write!(f, "C,Heading,Rate,{}", fixed(degrees(*rate), 1)),
            ToVehicle::Depth(depth) => write!(f, "C,Depth,Depth,{}", fixed_down(*depth, 2)),
            ToVehicle::Altitude(altitude) => write!(f, "C,Depth,Altitude,{}", fixed_up(*altitude, 2)),
            ToVehicle::Triangle([top, altitude, rate, bottom]) => write!(
                f,
                "C,Depth,Triangle,{},{},{},{}",
                fixed(*top, 1),
                fixed(*altitude, 1),
                fixed(*rate, 1),
                fixed(*bottom, 1)
            ),
            ToVehicle::Speed(SpeedGoal::Rpm(rpm)) => write!(f, "C,Speed,{} rpm", fixed_down(*rpm, 0)),
            ToVehicle::Speed(SpeedGoal::MetresPerSecond(speed)) => {
                write!(f, "C,Speed,{} meters/sec", fixed_down(*speed, 2))
            }
            ToVehicle::Speed(SpeedGoal::Knots(speed)) => write!(f, "C,Speed,{} knots", fixed_down(*speed / KNOT, 2)),
            ToVehicle::Query(what) => write!(f, "Q,{what}"),
            ToVehicle::KeepAlive(text) => write!(f, "V,{text}"),
            ToVehicle::VersionRequest => f.write_str("v"),
            ToVehicle::Other(letter) => write!(f, "{letter}"),
        }
    }
}
