//! Which measurements each sensor has, what it can measure, and how wrong it is when it is plausibly wrong.

use albacore_geometry::math::PI;
use albacore_geometry::{Heading, Vector};
use albacore_vehicle::measurements::{ALL, info};
use albacore_vehicle::{Quantity, Reading};
use serde::Deserialize;

/// A sensor that can fail, by the measurement that it is named after: one with [`fails`](albacore_vehicle::measurements::MeasurementInfo).
///
/// `water_depth` is the sum of depth and altitude: it fails with either, and stays away where one of them does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub struct Sensor(u16);

/// A name that no sensor has which can fail.
#[derive(Clone, Debug, thiserror::Error)]
#[error("no sensor `{0}` can fail")]
pub struct UnknownSensor(String);

impl TryFrom<String> for Sensor {
    type Error = UnknownSensor;

    fn try_from(name: String) -> Result<Self, UnknownSensor> {
        Sensor::all().find(|sensor| sensor.name() == name).ok_or(UnknownSensor(name))
    }
}

impl Sensor {
    /// All of them, in the order of their measurements.
    pub fn all() -> impl Iterator<Item = Sensor> {
        (0..).zip(&ALL).filter(|(_, row)| row.fails).map(|(measurement, _)| Sensor(measurement))
    }

    /// That of a measurement, if it can fail.
    pub fn of(measurement: u16) -> Option<Sensor> {
        info(measurement).fails.then_some(Sensor(measurement))
    }

    /// The measurement that it is named after.
    pub(crate) fn measurement(self) -> u16 {
        self.0
    }

    /// What a scenario calls it.
    pub fn name(self) -> &'static str {
        info(self.0).name
    }

    /// Whether a measurement comes from it.
    pub(crate) fn has(self, measurement: u16) -> bool {
        measurement == self.0 || info(measurement).fails_with == Some(self.0)
    }

    /// Whether the vehicle makes a measurement of what it tells, together with others.
    pub(crate) fn is_source_of(self, measurement: u16) -> bool {
        info(measurement).sources.contains(&self.0)
    }

    /// What it measures.
    pub(crate) fn quantity(self) -> Quantity {
        info(self.0).quantity
    }

    /// The greatest size of what comes as garbage: some times what can be.
    pub(crate) fn garbage(self) -> f64 {
        match self.quantity() {
            Quantity::Position => 1e6,
            Quantity::Direction => 6.0 * PI,
            Quantity::Speed => 30.0,
            Quantity::Height => 20_000.0,
            Quantity::Flow => 20.0,
            Quantity::Ratio => 3.0,
            Quantity::Temperature | Quantity::Salinity | Quantity::Word | Quantity::Date => 1000.0,
        }
    }

    /// A reading with the usual error, so many times, where an error has a direction in that one.
    pub(crate) fn wrong(self, reading: Reading, size: f64, toward: Heading) -> Reading {
        let [a, b, c, d] = reading;
        let moved = |by: f64| {
            let off = size * by * toward.unit();
            let there = Vector::new(a, b) + off;
            [there.north, there.east, c, d]
        };
        match self.quantity() {
            Quantity::Position => moved(50.0),
            Quantity::Flow => moved(0.1),
            Quantity::Direction => [turned(a, size * 20.0 * PI / 180.0), b, c, d],
            Quantity::Speed => [(a + size * 0.5).max(0.0), b, c, d],
            Quantity::Height => [(a + size * 2.0).max(0.0), b, c, d],
            Quantity::Ratio => [(a + size * 0.05).clamp(0.0, 1.0), b, c, d],
            Quantity::Temperature | Quantity::Salinity | Quantity::Word | Quantity::Date => [a + size, b, c, d],
        }
    }
}

/// A heading, rad, turned by an angle, rad.
pub(crate) fn turned(heading: f64, by: f64) -> f64 {
    (Heading::from_radians(heading) + by).radians()
}
