//! What a vehicle says.

use super::super::fields::{fixed, position, position_texts, ranges, time, time_text, within};
use super::super::instruments::{self, Measured};
use super::super::mode::Mode;
use super::{Fields, Malformed, compass_text, lettered};
use albacore_geometry::math::{degrees, radians};
use albacore_geometry::{Geodetic, Heading};
use std::fmt;

/// What a vehicle says.
#[derive(Clone, Debug, PartialEq)]
pub enum FromVehicle {
    /// `#S`: its state, about nine times a second.
    State(State),
    /// `#A`: its Doppler profiler.
    Adcp(Adcp),
    /// An instrument's message.
    Measured(Measured),
    /// `#C`: the echo of a command that was accepted.
    Accepted(String),
    /// `#E`: an error: number and text.
    Error(u32, String),
    /// `#V`: what answers `#v`.
    Version(String),
    /// A message that says nothing to us, by its letter.
    Other(char),
}

/// The fields of `#S`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Milliseconds of the vehicle's day.
    pub time_ms: u32,
    /// Where it believes to be; 0.0001 minutes fine, about 0.2 m.
    pub position: Geodetic,
    /// Depth, m.
    pub depth: f64,
    /// The depth it holds, m.
    pub depth_goal: f64,
    /// Height above the bottom, m; unknown when the message says 0.
    pub altitude: Option<f64>,
    /// Pitch, rad.
    pub pitch: f64,
    /// Roll, rad.
    pub roll: f64,
    /// Turns of the propeller a minute.
    pub rpm: f64,
    /// ... and what it holds.
    pub rpm_goal: f64,
    /// Speed, m/s. The sources do not say over what; ours is over ground.
    pub speed: f64,
    /// Heading; 0.1 degrees fine.
    pub heading: Heading,
    /// Rate of turn, rad/s.
    pub heading_rate: f64,
    /// The heading it holds.
    pub heading_goal: Heading,
    /// What it is doing.
    pub mode: Mode,
    /// The leg of its own mission; older vehicles do not say.
    pub leg: Option<u32>,
}

/// The fields of `#A`: velocities along the vehicle's own axes, m/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Adcp {
    /// Over ground, toward the nose.
    pub ahead: f64,
    /// Over ground, toward starboard.
    pub starboard: f64,
    /// Over ground, up.
    pub vertical: f64,
    /// Height above the bottom, m; unknown when the message says 0.
    pub altitude: Option<f64>,
    /// Heading of the vehicle as it measured.
    pub heading: Heading,
    /// The water's own velocity over ground, toward the nose and toward starboard; none when it is not known.
    pub current: Option<(f64, f64)>,
    /// Where it looks: `U` or `D`.
    pub look: char,
}

impl FromVehicle {
    /// Reads the body of a frame that a vehicle sent.
    pub fn parse(body: &str) -> Result<Self, Malformed> {
        let malformed = || Malformed(body.to_string());
        let (letter, rest) = lettered(body).ok_or_else(malformed)?;
        let fields = Fields::new(rest);
        let message = match letter {
            'S' => State::read(&fields).map(FromVehicle::State),
            'A' => Adcp::read(&fields).map(FromVehicle::Adcp),
            letter if instruments::has(letter) => instruments::parse(letter, &fields, body).map(FromVehicle::Measured),
            'C' => Some(FromVehicle::Accepted(rest.to_string())),
            'E' => {
                let (code, text) = rest.split_once(',').unwrap_or((rest, ""));
                code.parse().ok().map(|code| FromVehicle::Error(code, text.to_string()))
            }
            'V' => Some(FromVehicle::Version(rest.to_string())),
            other => Some(FromVehicle::Other(other)),
        };
        message.ok_or_else(malformed)
    }
}

impl State {
    fn read(fields: &Fields) -> Option<Self> {
        let leg = match fields.text("l") {
            Some(leg) => Some(leg.parse().ok()?),
            None => None,
        };
        let mode = fields.text("M").filter(|m| matches!(m.len(), 1 | 2))?;
        Some(State {
            time_ms: time(fields.text("T")?)?,
            position: position(fields.text("LAT")?, fields.text("LON")?)?,
            depth: fields.sensor_number("D")?,
            depth_goal: fields.within("DG", ranges::HEIGHTS)?,
            altitude: fields.altitude("A")?,
            pitch: radians(fields.sensor_number("P")?),
            roll: radians(fields.sensor_number("R")?),
            rpm: fields.sensor_number("TR")?,
            rpm_goal: fields.sensor_number("TRG")?,
            speed: fields.sensor_number("V")?,
            heading: fields.heading("H")?,
            heading_rate: radians(fields.sensor_number("HR")?),
            heading_goal: fields.heading("HG")?,
            mode: Mode(u8::from_str_radix(mode, 16).ok()?),
            leg,
        })
    }
}

impl Adcp {
    fn read(fields: &Fields) -> Option<Self> {
        let look = fields.0.iter().rev().find(|(name, value)| name.len() == 1 && value.is_empty())?;
        Some(Adcp {
            ahead: fields.within("F", ranges::SPEEDS)?,
            starboard: fields.within("S", ranges::SPEEDS)?,
            vertical: fields.sensor_number("V")?,
            altitude: fields.altitude("A")?,
            heading: fields.heading("H")?,
            current: match (fields.text("CF"), fields.text("CS")) {
                (None, None) => None,
                (ahead, starboard) => Some((within(ahead?, ranges::SPEEDS)?, within(starboard?, ranges::SPEEDS)?)),
            },
            look: look.0.chars().next()?,
        })
    }
}

impl fmt::Display for FromVehicle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FromVehicle::State(state) => state.fmt(f),
            FromVehicle::Adcp(adcp) => adcp.fmt(f),
            FromVehicle::Measured(measured) => f.write_str(&measured.message),
            FromVehicle::Accepted(text) => write!(f, "C,{text}"),
            FromVehicle::Error(code, text) if text.is_empty() => write!(f, "E,{code}"),
            FromVehicle::Error(code, text) => write!(f, "E,{code},{text}"),
            FromVehicle::Version(text) => write!(f, "V,{text}"),
            FromVehicle::Other(letter) => write!(f, "{letter}"),
        }
    }
}

impl fmt::Display for State {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (latitude, longitude) = position_texts(self.position);
        write!(f, "S,T{},LAT{latitude},LON{longitude}", time_text(self.time_ms))?;
        write!(f, ",D{},DG{}", fixed(self.depth, 2), fixed(self.depth_goal, 2))?;
        write!(f, ",A{}", fixed(self.altitude.unwrap_or(0.0), 2))?;
        write!(f, ",P{},R{}", fixed(degrees(self.pitch), 1), fixed(degrees(self.roll), 1))?;
        write!(f, ",TR{},TRG{}", fixed(self.rpm, 0), fixed(self.rpm_goal, 0))?;
        write!(f, ",V{},H{}", fixed(self.speed, 2), compass_text(self.heading))?;
        write!(f, ",HR{},HG{}", fixed(degrees(self.heading_rate), 1), compass_text(self.heading_goal))?;
        write!(f, ",M{:02X}", self.mode.0)?;
        self.leg.map_or(Ok(()), |leg| write!(f, ",l{leg}"))
    }
}

impl fmt::Display for Adcp {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "A,F{},S{}", fixed(self.ahead, 3), fixed(self.starboard, 3))?;
        write!(f, ",V{},A{}", fixed(self.vertical, 3), fixed(self.altitude.unwrap_or(0.0), 2))?;
        write!(f, ",H{}", compass_text(self.heading))?;
        if let Some((ahead, starboard)) = self.current {
            write!(f, ",CF{},CS{},CU0.000", fixed(ahead, 3), fixed(starboard, 3))?;
        }
        write!(f, ",{}", self.look)
    }
}
