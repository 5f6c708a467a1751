//! Which measurements each sensor has, what it can measure, and how wrong it is when it is plausibly wrong.

use crate::craft::sensors::{RawSample, RawSensor};
use albacore_geometry::math::PI;
use albacore_geometry::{Heading, Vector};
use albacore_vehicle::measurements::{ALL, HEADING, info};
use albacore_vehicle::{Quantity, Reading, Sample};
use serde::Deserialize;

/// A sensor that can fail: by the measurement that it is named after, one with [`fails_as`](albacore_vehicle::measurements::MeasurementInfo), or
/// by a name of its own, where only a navigator has its samples.
///
/// `water_depth` is the sum of depth and altitude: it fails with either, and stays away where one of them does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub struct Sensor(Named);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Named {
    Measurement(u16),
    Raw(RawSensor, &'static str),
}

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
    /// All of them, in the order of their measurements; those that have none last.
    pub fn all() -> impl Iterator<Item = Sensor> {
        let told =
            (0..).zip(&ALL).filter(|(_, row)| row.fails_as.is_some()).map(|(number, _)| Named::Measurement(number));
        told.chain(RawSensor::named().map(|(raw, name)| Named::Raw(raw, name))).map(Sensor)
    }

    /// That of a measurement, if it can fail.
    pub fn of(measurement: u16) -> Option<Sensor> {
        info(measurement).fails_as.map(|_| Sensor(Named::Measurement(measurement)))
    }

    /// Whether a mission is told what it measures; of others a navigator alone has the samples.
    pub fn is_told(self) -> bool {
        self.measurement().is_some()
    }

    /// The measurement that it is named after, if it is.
    pub(crate) fn measurement(self) -> Option<u16> {
        match self.0 {
            Named::Measurement(number) => Some(number),
            Named::Raw(..) => None,
        }
    }

    /// What a navigator takes of it, if it does.
    pub(crate) fn raw(self) -> Option<RawSensor> {
        match self.0 {
            Named::Measurement(number) => RawSensor::of(number),
            Named::Raw(raw, _) => Some(raw),
        }
    }

    /// What a scenario calls it.
    pub fn name(self) -> &'static str {
        match self.0 {
            Named::Measurement(number) => info(number).fails_as.unwrap_or(info(number).name),
            Named::Raw(_, name) => name,
        }
    }

    /// Whether a measurement comes from it.
    pub(crate) fn has(self, measurement: u16) -> bool {
        let own = self.measurement();
        own.is_some() && (own == Some(measurement) || info(measurement).fails_with == own)
    }

    /// Whether the vehicle makes a measurement of what it tells, together with others.
    pub(crate) fn is_source_of(self, measurement: u16) -> bool {
        self.measurement().is_some_and(|own| info(measurement).sources.contains(&own))
    }
}

/// A sample that can be faulty.
pub(crate) trait Failing: Copy {
    /// Whether it is of a sensor.
    fn is_of(&self, sensor: Sensor) -> bool;
    /// Whether it tells the same as another, at another time.
    fn is_like(&self, other: &Self) -> bool;
    /// Its numbers.
    fn numbers(&mut self) -> &mut [f64];
    /// The greatest size of what comes as garbage: some times what can be.
    fn garbage(&self) -> f64;
    /// Has the usual error, so many times, where an error has a direction in that one.
    fn be_wrong(&mut self, size: f64, toward: Heading);
    /// The heading that it is, if it is one, rad.
    fn heading(&self) -> Option<f64>;
    /// Of a heading or a course: misses an angle, rad.
    fn miss(&mut self, angle: f64);
}

impl Failing for Sample {
    fn is_of(&self, sensor: Sensor) -> bool {
        sensor.has(self.measurement)
    }

    fn is_like(&self, other: &Self) -> bool {
        self.measurement == other.measurement
    }

    fn numbers(&mut self) -> &mut [f64] {
        &mut self.reading[..info(self.measurement).quantity.width()]
    }

    fn garbage(&self) -> f64 {
        garbage(info(self.measurement).quantity)
    }

    fn be_wrong(&mut self, size: f64, toward: Heading) {
        self.reading = wrong(info(self.measurement).quantity, self.reading, size, toward);
    }

    fn heading(&self) -> Option<f64> {
        (self.measurement == HEADING).then_some(self.reading[0])
    }

    fn miss(&mut self, angle: f64) {
        self.reading[0] = turned(self.reading[0], -angle);
    }
}

impl Failing for RawSample {
    fn is_of(&self, sensor: Sensor) -> bool {
        sensor.raw() == Some(self.sensor)
    }

    fn is_like(&self, other: &Self) -> bool {
        self.sensor == other.sensor
    }

    fn numbers(&mut self) -> &mut [f64] {
        self.numbers_mut()
    }

    fn garbage(&self) -> f64 {
        self.sensor.garbage()
    }

    fn be_wrong(&mut self, size: f64, toward: Heading) {
        self.sensor.wrong(self.numbers_mut(), size, toward);
    }

    fn heading(&self) -> Option<f64> {
        (self.sensor == RawSensor::Attitude).then(|| self.array::<3>()[2])
    }

    fn miss(&mut self, angle: f64) {
        if let [_, _, yaw] = self.numbers_mut() {
            *yaw -= angle;
        }
    }
}

/// The greatest size of what comes as garbage: some times what can be.
fn garbage(quantity: Quantity) -> f64 {
    match quantity {
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
fn wrong(quantity: Quantity, reading: Reading, size: f64, toward: Heading) -> Reading {
    let [a, b, c, d] = reading;
    let moved = |by: f64| {
        let off = size * by * toward.unit();
        let there = Vector::new(a, b) + off;
        [there.north, there.east, c, d]
    };
    match quantity {
        Quantity::Position => moved(50.0),
        Quantity::Flow => moved(0.1),
        Quantity::Direction => [turned(a, size * 20.0 * PI / 180.0), b, c, d],
        Quantity::Speed => [(a + size * 0.5).max(0.0), b, c, d],
        Quantity::Height => [(a + size * 2.0).max(0.0), b, c, d],
        Quantity::Ratio => [(a + size * 0.05).clamp(0.0, 1.0), b, c, d],
        Quantity::Temperature | Quantity::Salinity | Quantity::Word | Quantity::Date => [a + size, b, c, d],
    }
}

/// A heading, rad, turned by an angle, rad.
pub(super) fn turned(heading: f64, by: f64) -> f64 {
    (Heading::from_radians(heading) + by).radians()
}
