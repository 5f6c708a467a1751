//! What instruments tell before a navigator has made anything of it: the sensors that can fail there, and their samples.

use albacore_geometry::math::PI;
use albacore_geometry::{Heading, Vector};
use albacore_vehicle::measurements::{DEPTH, HEADING, SPEED};

/// The most numbers of a sample: of five receivers.
const NUMBERS_MAX: usize = 5;

/// A sensor whose samples a navigator takes as they are measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RawSensor {
    /// Rates of turn, rad/s, body.
    Gyroscope,
    /// Specific force, m/s2, body.
    Accelerometer,
    /// Roll, pitch and yaw, rad.
    Attitude,
    /// Depth, m of water.
    Pressure,
    /// Velocity over ground, m/s, body.
    DopplerLog,
    /// How long a transponder's signal took to each receiver, s.
    Receivers,
    /// Position by acoustic fixes, m north and east.
    AcousticFixes,
    /// The same by satellites.
    SatelliteFixes,
}

/// A row of the table of raw sensors.
struct Row {
    sensor: RawSensor,
    failing: Failing,
    /// Numbers of a sample.
    width: usize,
    /// The greatest size of what comes as garbage.
    garbage: f64,
}

/// How a `fault` clause calls a sensor.
enum Failing {
    /// By a name of its own.
    As(&'static str),
    /// As the measurement that comes from it too.
    With(u16),
}

/// The table, in the order of [`RawSensor`].
const ROWS: [Row; 8] = [
    Row { sensor: RawSensor::Gyroscope, failing: Failing::As("gyroscope"), width: 3, garbage: 20.0 },
    Row { sensor: RawSensor::Accelerometer, failing: Failing::As("accelerometer"), width: 3, garbage: 200.0 },
    Row { sensor: RawSensor::Attitude, failing: Failing::With(HEADING), width: 3, garbage: 6.0 * PI },
    Row { sensor: RawSensor::Pressure, failing: Failing::With(DEPTH), width: 1, garbage: 20_000.0 },
    Row { sensor: RawSensor::DopplerLog, failing: Failing::With(SPEED), width: 3, garbage: 30.0 },
    Row { sensor: RawSensor::Receivers, failing: Failing::As("receivers"), width: 5, garbage: 100.0 },
    Row { sensor: RawSensor::AcousticFixes, failing: Failing::As("acoustic_fixes"), width: 2, garbage: 1e6 },
    Row { sensor: RawSensor::SatelliteFixes, failing: Failing::As("satellite_fixes"), width: 2, garbage: 1e6 },
];

impl RawSensor {
    fn row(self) -> &'static Row {
        &ROWS[self as usize]
    }

    /// Those that fail by a name of their own, with that.
    pub fn named() -> impl Iterator<Item = (RawSensor, &'static str)> {
        ROWS.iter().filter_map(|row| match row.failing {
            Failing::As(name) => Some((row.sensor, name)),
            Failing::With(_) => None,
        })
    }

    /// The one that a measurement comes from.
    pub fn of(measurement: u16) -> Option<RawSensor> {
        let is_of = |row: &&Row| matches!(row.failing, Failing::With(number) if number == measurement);
        ROWS.iter().find(is_of).map(|row| row.sensor)
    }

    /// The greatest size of what comes as garbage.
    pub fn garbage(self) -> f64 {
        self.row().garbage
    }

    /// A sample with the usual error, so many times, where an error has a direction in that one.
    pub fn wrong(self, numbers: &mut [f64], size: f64, toward: Heading) {
        let mut off = |by: [f64; NUMBERS_MAX]| numbers.iter_mut().zip(by).for_each(|(x, by)| *x += size * by);
        match self {
            RawSensor::Gyroscope => off([2.0 * PI / 180.0; 5]),
            RawSensor::Accelerometer => off([0.5; 5]),
            RawSensor::Attitude => off([0.0, 0.0, 20.0 * PI / 180.0, 0.0, 0.0]),
            RawSensor::Pressure => off([2.0; 5]),
            RawSensor::DopplerLog => off([0.5, 0.0, 0.0, 0.0, 0.0]),
            // 15 m of water.
            RawSensor::Receivers => off([0.01; 5]),
            RawSensor::AcousticFixes | RawSensor::SatelliteFixes => {
                let Vector { north, east } = 50.0 * toward.unit();
                off([north, east, 0.0, 0.0, 0.0]);
            }
        }
    }
}

/// A sample of one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RawSample {
    /// Of which sensor.
    pub sensor: RawSensor,
    /// When in its tick it was taken: which of the inertial unit's samples it comes with.
    pub step: u16,
    numbers: [f64; NUMBERS_MAX],
}

impl RawSample {
    /// Of so many numbers as the sensor has.
    pub fn new<const N: usize>(sensor: RawSensor, step: u16, told: [f64; N]) -> Self {
        let mut numbers = [0.0; NUMBERS_MAX];
        numbers.iter_mut().zip(told).for_each(|(number, told)| *number = told);
        RawSample { sensor, step, numbers }
    }

    /// Its numbers, to be changed.
    pub fn numbers_mut(&mut self) -> &mut [f64] {
        &mut self.numbers[..self.sensor.row().width]
    }

    /// So many of them.
    pub fn array<const N: usize>(&self) -> [f64; N] {
        std::array::from_fn(|i| self.numbers.get(i).copied().unwrap_or_default())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_stands_at_its_place() {
        assert!(ROWS.iter().enumerate().all(|(i, row)| row.sensor as usize == i));
        assert_eq!(RawSensor::of(SPEED), Some(RawSensor::DopplerLog));
        assert_eq!(RawSensor::named().count(), 5);
    }
}
