//! Instruments that have a message of their own: a file for each, and this is their register.

mod battery;
mod ctd;
mod fluorometer;
mod seawater;

use super::message::Fields;
use crate::server::Senses;
use albacore_vehicle::{Reading, Snapshot};

/// All of them, in the order in which a vehicle tells of them.
static ALL: [&Instrument; 3] = [&fluorometer::INSTRUMENT, &ctd::INSTRUMENT, &battery::INSTRUMENT];

/// What a message of an instrument is.
struct Instrument {
    /// Its letter.
    letter: char,
    /// What it measures: a number each.
    measures: &'static [u16],
    /// These numbers in a message; none where it is no such message.
    read: fn(&Fields) -> Option<Reading>,
    /// The fields of the message with these numbers, of a vehicle that senses so.
    write: fn(Reading, &Senses) -> String,
}

/// What an instrument has measured, and the message that tells it.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// The measurements, with the number of each.
    pub numbers: Vec<(u16, f64)>,
    /// The message.
    pub message: String,
}

impl Instrument {
    fn measured(&self, reading: Reading, message: String) -> Measured {
        Measured { numbers: self.measures.iter().copied().zip(reading).collect(), message }
    }
}

/// Whether a letter is that of an instrument.
pub fn has(letter: char) -> bool {
    ALL.iter().any(|instrument| instrument.letter == letter)
}

/// What an instrument's message says, by its letter.
pub fn parse(letter: char, fields: &Fields, message: &str) -> Option<Measured> {
    let instrument = ALL.iter().find(|instrument| instrument.letter == letter)?;
    Some(instrument.measured((instrument.read)(fields)?, message.to_string()))
}

/// The messages of a tick. One with several measurements is sent where all of them came.
pub fn told(snapshot: &Snapshot, senses: &Senses) -> impl Iterator<Item = Measured> {
    // On the wire there is no number for what is none.
    let number = |measurement| {
        let of_it = snapshot.samples.iter().filter(|sample| sample.measurement == measurement);
        of_it.map(|sample| sample.reading[0]).rfind(|number| number.is_finite())
    };
    ALL.iter().filter_map(move |instrument| {
        let mut reading = Reading::default();
        for (slot, measurement) in reading.iter_mut().zip(instrument.measures) {
            *slot = number(*measurement)?;
        }
        let message = format!("{},{}", instrument.letter, (instrument.write)(reading, senses));
        Some(instrument.measured(reading, message))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dialects::recon::FromVehicle;
    use albacore_geometry::{Heading, Point};
    use std::collections::HashSet;

    const SENSES: Senses = Senses {
        position: Point::ORIGIN,
        course: Heading::NORTH,
        heading: Heading::NORTH,
        turn_rate: 0.0,
        speed: 0.0,
        depth: 3.0,
        altitude: None,
        flow: None,
        battery: 1.0,
    };

    fn message_of(instrument: &Instrument, number: f64) -> Vec<Measured> {
        let mut snapshot = Snapshot::default();
        instrument.measures.iter().for_each(|measurement| snapshot.push(*measurement, &[number]));
        told(&snapshot, &SENSES).collect()
    }

    #[test]
    fn what_is_told_is_read_again() {
        for instrument in ALL {
            for number in [0.0, 0.123_4, 0.5, 1.0] {
                let [measured] = &message_of(instrument, number)[..] else {
                    panic!("{}: not one message", instrument.letter)
                };
                let Ok(FromVehicle::Measured(read)) = FromVehicle::parse(&measured.message) else {
                    panic!("{measured:?}")
                };
                assert_eq!(read.message, measured.message);
                assert_eq!(read.numbers.len(), instrument.measures.len());
                for ((measurement, told), (read_as, read)) in measured.numbers.iter().zip(&read.numbers) {
                    assert!(measurement == read_as && (told - read).abs() <= 1e-3, "{measured:?}: {read}");
                }
            }
            assert_eq!(message_of(instrument, f64::NAN), [], "no number, no message");
        }
        let letters: HashSet<char> = ALL.iter().map(|instrument| instrument.letter).collect();
        assert_eq!(letters.len(), ALL.len());
    }

    #[test]
    fn a_message_without_one_of_its_fields_is_none() {
        for instrument in ALL {
            let [Measured { message, .. }] = &message_of(instrument, 0.5)[..] else { panic!("not one message") };
            let parts: Vec<&str> = message.split(',').collect();
            for without in 1..parts.len() {
                let mut rest = parts.clone();
                rest.remove(without);
                assert!(FromVehicle::parse(&rest.join(",")).is_err(), "{message} without {}", parts[without]);
            }
        }
    }
}
