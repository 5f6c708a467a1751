//! Instruments that have a message of their own, in the order in which a vehicle tells of them.

mod seawater;

use super::fields::{fixed, ranges};
use super::message::Fields;
use crate::server::Senses;
use albacore_vehicle::measurements::{BATTERY, CHEMICAL, SALINITY, TEMPERATURE};
use albacore_vehicle::{Reading, Snapshot};

/// All of them.
static ALL: [Instrument; 3] = [
    // The fluorometer: gain, and the value at that gain.
    Instrument {
        letter: 'F',
        measures: &[CHEMICAL],
        read: |fields| {
            fields.number("G")?;
            Some([fields.number("V")? / FULL_SCALE_VOLTS, 0.0, 0.0, 0.0])
        },
        write: |[chemical, ..], _| format!("G1,V{}", fixed(chemical * FULL_SCALE_VOLTS, 4)),
    },
    // The CTD: temperature (degrees Celsius), conductivity (the sources give no unit; ours sends S/m), practical salinity, depth (m) and
    // the speed of sound (m/s). Only temperature and salinity are read.
    Instrument {
        letter: 'c',
        measures: &[TEMPERATURE, SALINITY],
        read: |fields| {
            fields.number("C").and(fields.sensor_number("D")).and(fields.number("V"))?;
            Some([fields.number("T")?, fields.number("S")?, 0.0, 0.0])
        },
        write: |[temperature, salinity, ..], senses| {
            let conductivity = seawater::conductivity(temperature, salinity, senses.depth);
            let sound_speed = seawater::sound_speed(temperature, salinity, senses.depth);
            let [t, c, s] = [temperature, conductivity, salinity].map(|x| fixed(x, 3));
            format!("T{t},C{c},S{s},D{},V{}", fixed(senses.depth, 2), fixed(sound_speed, 2))
        },
    },
    // The battery: capacity, what is left of it, and the same in per cent. The sources give no unit of the first two; ours sends watt hours.
    Instrument {
        letter: 'B',
        measures: &[BATTERY],
        read: |fields| {
            fields.number("C").and(fields.number("A"))?;
            Some([fields.within("P", ranges::CHARGES)? / 100.0, 0.0, 0.0, 0.0])
        },
        write: |[charge, ..], _| {
            let [c, a, p] = [CAPACITY_WH, CAPACITY_WH * charge, 100.0 * charge].map(|x| fixed(x, 1));
            format!("C{c},A{a},P{p}")
        },
    },
];

/// The fluorometer's full scale: 5 V, as the 2003 trials' Seapoint gives. The sources give no unit.
const FULL_SCALE_VOLTS: f64 = 5.0;
/// The battery of a REMUS 100, Wh.
const CAPACITY_WH: f64 = 1000.0;

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

/// Whether one of them measures it.
pub fn measure(measurement: u16) -> bool {
    ALL.iter().any(|instrument| instrument.measures.contains(&measurement))
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
    use std::collections::BTreeSet;

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
        for instrument in &ALL {
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
        let letters: BTreeSet<char> = ALL.iter().map(|instrument| instrument.letter).collect();
        assert_eq!(letters.len(), ALL.len());
    }

    #[test]
    fn a_message_without_one_of_its_fields_is_none() {
        for instrument in &ALL {
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
