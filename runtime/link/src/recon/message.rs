//! Messages, both ways. The same letter means different things by direction, and `c` is not `C`.

use super::fields::{fixed, number, position, position_texts, time, time_text};
use super::mode::Mode;
use albacore_geometry::math::{degrees, radians};
use albacore_geometry::{Geodetic, Heading};
use std::fmt;

/// Metres a second in a knot.
const KNOT: f64 = 1852.0 / 3600.0;

/// What a vehicle says.
#[derive(Clone, Debug, PartialEq)]
pub enum FromVehicle {
    /// `#S`: its state, about nine times a second.
    State(State),
    /// `#A`: its Doppler profiler.
    Adcp(Adcp),
    /// `#c`: conductivity, temperature, depth.
    Ctd(Ctd),
    /// `#F`: its fluorometer: gain, and the value at that gain.
    Fluorometer {
        /// Gain.
        gain: f64,
        /// Value; the public sources give no unit.
        value: f64,
    },
    /// `#B`: its battery.
    Battery {
        /// Capacity; the public sources give no unit, ours sends watt hours.
        capacity: f64,
        /// What is left of it.
        available: f64,
        /// The same in per cent.
        percent: f64,
    },
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

/// The fields of `#c`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ctd {
    /// Degrees Celsius.
    pub temperature: f64,
    /// Conductivity.
    pub conductivity: f64,
    /// Salinity.
    pub salinity: f64,
    /// Depth, m.
    pub depth: f64,
    /// Speed of sound, m/s.
    pub sound_speed: f64,
}

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

/// A frame whose fields make no message.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`#{0}` is no message")]
pub struct Malformed(pub String);

/// `#S` and others name each field by letters before its number.
struct Fields<'a>(Vec<(&'a str, &'a str)>);

impl<'a> Fields<'a> {
    fn new(rest: &'a str) -> Self {
        let split = |field: &'a str| {
            // The mode is hexadecimal, its digits may be letters; nothing else begins like it or like the leg.
            let digits = |b: char| b.is_ascii_digit() || matches!(b, '-' | '+' | '.');
            let at = if field.starts_with(['M', 'l']) { 1 } else { field.find(digits).unwrap_or(field.len()) };
            field.split_at(at)
        };
        Fields(rest.split(',').map(split).collect())
    }

    fn text(&self, name: &str) -> Option<&'a str> {
        self.0.iter().find(|(n, _)| *n == name).map(|(_, value)| *value)
    }

    fn number(&self, name: &str) -> Option<f64> {
        number(self.text(name)?)
    }

    /// A direction in degrees.
    fn heading(&self, name: &str) -> Option<Heading> {
        compass(self.number(name)?)
    }

    /// 0 stands for what is not known.
    fn altitude(&self, name: &str) -> Option<Option<f64>> {
        self.number(name).map(|a| (a != 0.0).then_some(a))
    }
}

/// A heading in degrees that can be one; a sum of 8 bits lets one wrong line in 256 pass.
fn compass(degrees: f64) -> Option<Heading> {
    (-360.0..=360.0).contains(&degrees).then(|| Heading::from_degrees(degrees))
}

/// Degrees with one decimal, below 360.
fn compass_text(heading: Heading) -> String {
    let text = fixed(heading.degrees(), 1);
    if text == "360.0" { "0.0".to_string() } else { text }
}

/// A letter and what follows its comma.
fn lettered(body: &str) -> Option<(char, &str)> {
    let mut rest = body.chars();
    let letter = rest.next().filter(char::is_ascii_alphabetic)?;
    match rest.as_str() {
        "" => Some((letter, "")),
        rest => Some((letter, rest.strip_prefix(',')?)),
    }
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
            'c' => Ctd::read(&fields).map(FromVehicle::Ctd),
            'F' => {
                fields.number("G").and_then(|gain| Some(FromVehicle::Fluorometer { gain, value: fields.number("V")? }))
            }
            'B' => battery(&fields),
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

fn battery(fields: &Fields) -> Option<FromVehicle> {
    let (capacity, available, percent) = (fields.number("C")?, fields.number("A")?, fields.number("P")?);
    (0.0..=100.0).contains(&percent).then_some(FromVehicle::Battery { capacity, available, percent })
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
            depth: fields.number("D")?,
            depth_goal: fields.number("DG")?,
            altitude: fields.altitude("A")?,
            pitch: radians(fields.number("P")?),
            roll: radians(fields.number("R")?),
            rpm: fields.number("TR")?,
            rpm_goal: fields.number("TRG")?,
            speed: fields.number("V")?,
            heading: fields.heading("H")?,
            heading_rate: radians(fields.number("HR")?),
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
            ahead: fields.number("F")?,
            starboard: fields.number("S")?,
            vertical: fields.number("V")?,
            altitude: fields.altitude("A")?,
            heading: fields.heading("H")?,
            current: match (fields.text("CF"), fields.text("CS")) {
                (None, None) => None,
                (ahead, starboard) => Some((number(ahead?)?, number(starboard?)?)),
            },
            look: look.0.chars().next()?,
        })
    }
}

impl Ctd {
    fn read(fields: &Fields) -> Option<Self> {
        Some(Ctd {
            temperature: fields.number("T")?,
            conductivity: fields.number("C")?,
            salinity: fields.number("S")?,
            depth: fields.number("D")?,
            sound_speed: fields.number("V")?,
        })
    }
}

impl fmt::Display for FromVehicle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FromVehicle::State(state) => state.fmt(f),
            FromVehicle::Adcp(adcp) => adcp.fmt(f),
            FromVehicle::Ctd(c) => write!(
                f,
                "c,T{},C{},S{},D{},V{}",
                fixed(c.temperature, 3),
                fixed(c.conductivity, 3),
                fixed(c.salinity, 3),
                fixed(c.depth, 2),
                fixed(c.sound_speed, 2)
            ),
            FromVehicle::Fluorometer { gain, value } => write!(f, "F,G{},V{}", fixed(*gain, 0), fixed(*value, 4)),
            FromVehicle::Battery { capacity, available, percent } => {
                write!(f, "B,C{},A{},P{}", fixed(*capacity, 1), fixed(*available, 1), fixed(*percent, 1))
            }
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

impl ToVehicle {
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
            let value = number(value)?;
            return Some(ToVehicle::Speed(match unit {
                "rpm" => SpeedGoal::Rpm(value),
                "meters/sec" => SpeedGoal::MetresPerSecond(value),
                "knots" => SpeedGoal::Knots(value * KNOT),
                _ => return None,
            }));
        }
        let (how, rest) = rest.split_once(',')?;
        match (what, how) {
            ("Heading", "Goal") => compass(number(rest)?).map(ToVehicle::Heading),
            ("Heading", "Rate") => number(rest).map(|rate| ToVehicle::HeadingRate(radians(rate))),
            ("Depth", "Depth") => number(rest).map(ToVehicle::Depth),
            ("Depth", "Altitude") => number(rest).map(ToVehicle::Altitude),
            ("Depth", "Triangle") => {
                let numbers: Vec<f64> = rest.split(',').map(number).collect::<Option<_>>()?;
                numbers.try_into().ok().map(ToVehicle::Triangle)
            }
            _ => None,
        }
    }
}

impl fmt::Display for ToVehicle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ToVehicle::Override(on) => write!(f, "E,{}", u8::from(*on)),
            ToVehicle::ClosestPoint(on) => write!(f, "c,{}", u8::from(*on)),
            ToVehicle::Heading(heading) => write!(f, "C,Heading,Goal,{}", compass_text(*heading)),
            ToVehicle::HeadingRate(rate) => write!(f, "C,Heading,Rate,{}", fixed(degrees(*rate), 1)),
            ToVehicle::Depth(depth) => write!(f, "C,Depth,Depth,{}", fixed(*depth, 2)),
            ToVehicle::Altitude(altitude) => write!(f, "C,Depth,Altitude,{}", fixed(*altitude, 2)),
            ToVehicle::Triangle([top, altitude, rate, bottom]) => write!(
                f,
                "C,Depth,Triangle,{},{},{},{}",
                fixed(*top, 1),
                fixed(*altitude, 1),
                fixed(*rate, 1),
                fixed(*bottom, 1)
            ),
            ToVehicle::Speed(SpeedGoal::Rpm(rpm)) => write!(f, "C,Speed,{} rpm", fixed(*rpm, 0)),
            ToVehicle::Speed(SpeedGoal::MetresPerSecond(speed)) => {
                write!(f, "C,Speed,{} meters/sec", fixed(*speed, 2))
            }
            ToVehicle::Speed(SpeedGoal::Knots(speed)) => write!(f, "C,Speed,{} knots", fixed(*speed / KNOT, 2)),
            ToVehicle::Query(what) => write!(f, "Q,{what}"),
            ToVehicle::KeepAlive(text) => write!(f, "V,{text}"),
            ToVehicle::VersionRequest => f.write_str("v"),
            ToVehicle::Other(letter) => write!(f, "{letter}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CAPTURED: &str = "S,T15:08:37.672,LAT39N30.5553,LON74W19.4386,D-0.10,DG0.00,A0.00,P-0.3,R3.0,TR0,TRG0,V0.00,\
                            H0.4,HR0.0,HG0.0,M10,l0";

    fn state(body: &str) -> State {
        match FromVehicle::parse(body) {
            Ok(FromVehicle::State(state)) => state,
            other => panic!("{body}: {other:?}"),
        }
    }

    #[test]
    fn a_captured_state_is_read_and_written_again_byte_for_byte() {
        let captured = state(CAPTURED);
        assert_eq!(captured.time_ms, 54_517_672);
        assert!((captured.position.latitude_deg() - (39.0 + 30.5553 / 60.0)).abs() < 1e-12);
        assert!((captured.position.longitude_deg() + (74.0 + 19.4386 / 60.0)).abs() < 1e-12);
        assert_eq!(captured.depth, -0.1, "a depth may be negative");
        assert_eq!(captured.altitude, None, "an altitude of 0 is unknown");
        assert_eq!((captured.mode, captured.leg), (Mode(0x10), Some(0)));
        assert_eq!(captured.to_string(), CAPTURED);
    }

    #[test]
    fn older_vehicles_do_not_say_their_leg() {
        let older = CAPTURED.strip_suffix(",l0").unwrap();
        assert_eq!(state(older).leg, None);
        assert_eq!(state(older).to_string(), older);
    }

    #[test]
    fn the_low_bits_of_the_mode_are_a_number() {
        use super::super::mode::Phase;
        let mode = |hex: &str| state(&CAPTURED.replace("M10", &format!("M{hex}"))).mode;
        for (hex, phase, active) in [
            ("00", Phase::PreLaunch, false),
            ("01", Phase::InMission, false),
            ("0D", Phase::InMission, true),
            ("D", Phase::InMission, true),
            ("0E", Phase::Suspended, true),
            ("02", Phase::Suspended, false),
            ("03", Phase::Over, false),
            ("8D", Phase::InMission, true),
        ] {
            assert_eq!((mode(hex).phase(), mode(hex).has(Mode::ACTIVE)), (phase, active), "M{hex}");
        }
        assert!(mode("8D").has(Mode::NOT_ALLOWED));
        assert_eq!(Mode::new(Phase::InMission, Mode::ENABLED | Mode::ACTIVE), Mode(0x0D));
    }

    #[test]
    fn a_state_that_cannot_be_is_none() {
        for (from, to) in [
            ("LAT39N30.5553", "LAT99N30.5553"),
            ("LON74W19.4386", "LON74X19.4386"),
            ("T15:08:37.672", "T25:08:37.672"),
            ("H0.4", "H400.0"),
            ("D-0.10", "D-0.1O"),
            ("D-0.10", "Dnan"),
            ("M10", "M1G"),
            ("M10", "M"),
            (",V0.00", ""),
            ("l0", "lx"),
        ] {
            assert!(FromVehicle::parse(&CAPTURED.replace(from, to)).is_err(), "{to}");
        }
    }

    /// Upper and lower case, and the two directions, give one letter four meanings.
    #[test]
    fn a_letter_means_what_its_case_and_direction_say() {
        let echo = FromVehicle::Accepted("Heading,Goal,270.0".into());
        assert_eq!(FromVehicle::parse("C,Heading,Goal,270.0"), Ok(echo));
        assert_eq!(ToVehicle::parse("C,Heading,Goal,270.0"), Ok(ToVehicle::Heading(Heading::from_degrees(270.0))));
        assert!(matches!(FromVehicle::parse("c,T12.1,C3.4,S35,D3,V1500"), Ok(FromVehicle::Ctd(_))));
        assert_eq!(ToVehicle::parse("c,1"), Ok(ToVehicle::ClosestPoint(true)));
        assert_eq!(FromVehicle::parse("E,107,Illegal time"), Ok(FromVehicle::Error(107, "Illegal time".into())));
        assert_eq!(ToVehicle::parse("E,1"), Ok(ToVehicle::Override(true)));
        assert!(ToVehicle::parse("E,107,Illegal time").is_err());
        assert_eq!(ToVehicle::parse("v"), Ok(ToVehicle::VersionRequest));
        let text = "Sep 14 2011, 13:17:09";
        assert_eq!(ToVehicle::parse(&format!("V,{text}")), Ok(ToVehicle::KeepAlive(text.into())), "a text with commas");
        assert_eq!(FromVehicle::parse(&format!("V,{text}")), Ok(FromVehicle::Version(text.into())));
        assert_eq!(FromVehicle::parse("f,GPS,121W53.1985 36N36.3281"), Ok(FromVehicle::Other('f')));
    }

    #[test]
    fn messages_survive_being_written() {
        for body in [
            "E,0",
            "c,0",
            "C,Heading,Goal,359.9",
            "C,Heading,Rate,-5.0",
            "C,Depth,Depth,-0.10",
            "C,Depth,Altitude,2.00",
            "C,Depth,Triangle,3.0,3.0,10.0,30.0",
            "C,Speed,1.50 meters/sec",
            "C,Speed,600 rpm",
            "C,Speed,3.00 knots",
            "Q,Depth",
            "V,0.000000",
            "v",
        ] {
            assert_eq!(ToVehicle::parse(body).unwrap().to_string(), body);
        }
        for body in [
            "A,F1.200,S-0.050,V0.000,A12.50,H123.4,CF0.100,CS-0.050,CU0.000,U",
            "A,F1.200,S-0.050,V0.000,A0.00,H123.4,D",
            "c,T12.100,C3.400,S35.000,D3.00,V1500.00",
            "F,G1,V-0.0123",
            "B,C1000.0,A523.4,P52.3",
            "C,Speed,1.50 meters/sec",
            "E,107,Illegal time",
            "E,107",
            "V,Sep 14 2011, 13:17:09",
        ] {
            assert_eq!(FromVehicle::parse(body).unwrap().to_string(), body);
        }
        assert_eq!(ToVehicle::Heading(Heading::from_degrees(359.97)).to_string(), "C,Heading,Goal,0.0");
    }

    #[test]
    fn commands_that_make_no_sense_are_none() {
        for body in [
            "",
            ",",
            "C",
            "C,Heading",
            "C,Heading,Goal",
            "C,Heading,Goal,north",
            "C,Heading,Goal,1000",
            "C,Heading,Destination,39N30.5 74W19.4",
            "C,Depth,Triangle,1,2,3",
            "C,Speed,1.5",
            "C,Speed,1.5 furlongs",
            "C,Speed,inf meters/sec",
            "E",
            "E,2",
            "1,2",
            "CHeading",
        ] {
            assert!(ToVehicle::parse(body).is_err(), "{body}");
        }
    }
}
