//! Which measurements each sensor has, what it can measure, and how wrong it is when it is plausibly wrong.

use albacore_geometry::math::PI;
use albacore_geometry::{Heading, Vector};
use albacore_vehicle::measurements::{ALTITUDE, CHEMICAL, COURSE, DEPTH, FLOW, HEADING, POSITION, SPEED, info};
use albacore_vehicle::{Quantity, Reading};
use serde::Deserialize;

/// A sensor that can fail, with the measurements that come from it alone.
///
/// `water_depth` is the sum of depth and altitude: it fails with either, and stays away where one of them does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Sensor {
    /// Dead reckoning and fixes: `position` with its standard deviation. Wrong: 50 m off, somewhere.
    Position,
    /// The compass: `heading`, and `course`, for the velocity over ground is measured by the vehicle and turned with the
    /// compass. Wrong: 20 degrees clockwise.
    Heading,
    /// The Doppler log: `speed`. Wrong: 0.5 m/s too fast.
    Speed,
    /// The pressure gauge: `depth`. Wrong: 2 m too deep.
    Depth,
    /// The echo sounder: `altitude`. Wrong: 2 m too high.
    Altitude,
    /// The Doppler profiler: `flow`. Wrong: 0.1 m/s added, toward somewhere.
    Flow,
    /// The fluorometer: `chemical`. Wrong: 5 % of full scale added, up to full scale.
    Chemical,
}

impl Sensor {
    /// All of them.
    pub const ALL: [Sensor; 7] = [
        Sensor::Position,
        Sensor::Heading,
        Sensor::Speed,
        Sensor::Depth,
        Sensor::Altitude,
        Sensor::Flow,
        Sensor::Chemical,
    ];

    /// The measurement that it is named after.
    pub(crate) fn measurement(self) -> u16 {
        match self {
            Sensor::Position => POSITION,
            Sensor::Heading => HEADING,
            Sensor::Speed => SPEED,
            Sensor::Depth => DEPTH,
            Sensor::Altitude => ALTITUDE,
            Sensor::Flow => FLOW,
            Sensor::Chemical => CHEMICAL,
        }
    }

    /// What a scenario calls it.
    pub fn name(self) -> &'static str {
        info(self.measurement()).name
    }

    /// Whether a measurement comes from it.
    pub(crate) fn has(self, measurement: u16) -> bool {
        measurement == self.measurement() || self == Sensor::Heading && measurement == COURSE
    }

    /// What it measures.
    pub(crate) fn quantity(self) -> Quantity {
        info(self.measurement()).quantity
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
            Quantity::Temperature | Quantity::Salinity | Quantity::Word => 1000.0,
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
            Quantity::Temperature | Quantity::Salinity | Quantity::Word => [a + size, b, c, d],
        }
    }
}

/// A heading, rad, turned by an angle, rad.
pub(crate) fn turned(heading: f64, by: f64) -> f64 {
    (Heading::from_radians(heading) + by).radians()
}
