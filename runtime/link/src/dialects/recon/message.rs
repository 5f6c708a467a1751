//! Messages, both ways. The same letter means different things by direction, and `c` is not `C`.

mod from_vehicle;
mod to_vehicle;

pub use from_vehicle::{Adcp, FromVehicle, State};
pub(super) use to_vehicle::RPM_AT_1_MPS;
pub use to_vehicle::{SpeedGoal, ToVehicle};

use super::fields::{fixed, number, ranges, sensor_number, within};
use albacore_geometry::Heading;
use std::ops::RangeInclusive;

/// A frame whose fields make no message.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`#{0}` is no message")]
pub struct Malformed(pub String);

/// `#S` and others name each field by letters before its number.
pub(super) struct Fields<'a>(Vec<(&'a str, &'a str)>);

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

    pub fn text(&self, name: &str) -> Option<&'a str> {
        self.0.iter().find(|(n, _)| *n == name).map(|(_, value)| *value)
    }

    pub fn number(&self, name: &str) -> Option<f64> {
        number(self.text(name)?)
    }

    /// A number in a range; a sum of 8 bits lets one wrong line in 256 pass.
    pub fn within(&self, name: &str, range: RangeInclusive<f64>) -> Option<f64> {
        within(self.text(name)?, range)
    }

    /// A direction in degrees.
    pub fn heading(&self, name: &str) -> Option<Heading> {
        compass(self.text(name)?)
    }

    /// What a sensor tells.
    pub fn sensor_number(&self, name: &str) -> Option<f64> {
        sensor_number(self.text(name)?)
    }

    /// 0 stands for what is not known, and so does what is a little below the bottom; what no sounder is out by is told as it is.
    pub fn altitude(&self, name: &str) -> Option<Option<f64>> {
        self.sensor_number(name).map(|a| (a > 0.0 || !ranges::HEIGHTS.contains(&a)).then_some(a))
    }
}

/// A heading in degrees.
fn compass(text: &str) -> Option<Heading> {
    within(text, ranges::ANGLES).map(Heading::from_degrees)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recon::Mode;
    use crate::status::Phase;

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

    /// The attack: a sounder that hears nothing made each state unreadable, and the run ended for want of one.
    #[test]
    fn what_a_sensor_tells_costs_no_more_than_itself() {
        let nines = format!("A{}", "9".repeat(400));
        for (told, altitude) in [
            ("A-19562.36", Some(-19_562.36)),
            ("A-999", Some(-999.0)),
            ("A-3.2", None),
            ("A99999.00", Some(99_999.0)),
            (nines.as_str(), Some(1e8)),
        ] {
            assert_eq!(state(&CAPTURED.replace("A0.00", told)).altitude, altitude, "{told}");
        }
        assert_eq!(state(&CAPTURED.replace("D-0.10", "D99999")).depth, 99_999.0);
        assert_eq!(state(&CAPTURED.replace(",V0.00", ",V-999.0")).speed, -999.0);
        for absurd in [("P-0.3", "P-999"), ("R3.0", "R1000"), ("TR0", "TR999999999"), ("HR0.0", "HR99999")] {
            assert_eq!(state(&CAPTURED.replace(absurd.0, absurd.1)).time_ms, 54_517_672, "{absurd:?}");
        }
    }

    #[test]
    fn older_vehicles_do_not_say_their_leg() {
        let older = CAPTURED.strip_suffix(",l0").unwrap();
        assert_eq!(state(older).leg, None);
        assert_eq!(state(older).to_string(), older);
    }

    #[test]
    fn the_low_bits_of_the_mode_are_a_number() {
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
        assert!(matches!(FromVehicle::parse("c,T12.1,C3.4,S35,D3,V1500"), Ok(FromVehicle::Measured(_))));
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
