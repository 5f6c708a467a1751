//! What the numbers of a reading are: how many, what they can be, and by how much one reading differs from another.

use crate::Reading;
use albacore_geometry::math::{PI, degrees};
use albacore_geometry::{Heading, Point};

/// What a measurement measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// m north, m east, and the standard deviation of both in m.
    Position,
    /// rad clockwise from north.
    Direction,
    /// m/s over ground.
    Speed,
    /// m below the surface, or above the bottom.
    Height,
    /// m/s toward north and east.
    Flow,
    /// A share of the whole scale.
    Ratio,
    /// Degrees Celsius.
    Temperature,
    /// Practical salinity.
    Salinity,
    /// The place of a word in its list.
    Word,
    /// Seconds since the beginning of 1970, UTC.
    Date,
}

impl Quantity {
    /// How many numbers of a [`Reading`] it uses.
    pub const fn width(self) -> usize {
        match self {
            Quantity::Position => 3,
            Quantity::Flow => 2,
            _ => 1,
        }
    }

    /// Whether its numbers are measured, each in a unit: a word has none, and a date is told by a clock.
    pub const fn is_measured(self) -> bool {
        !matches!(self, Quantity::Word | Quantity::Date)
    }

    /// Whether a reading can be: the ocean is 11 km deep, no tide runs at 10 m/s, no vehicle of ours at 15.
    #[inline]
    pub fn can_be(self, reading: Reading) -> bool {
        let [a, b, c, _] = reading;
        match self {
            Quantity::Position => a.abs() <= 1e5 && b.abs() <= 1e5 && c >= 0.0,
            Quantity::Direction => a.abs() <= 2.0 * PI,
            Quantity::Speed => (-1.0..=15.0).contains(&a),
            Quantity::Height => (-1.0..=11_000.0).contains(&a),
            Quantity::Flow => Point::new(a, b).distance(Point::ORIGIN) <= 10.0,
            Quantity::Ratio => (-0.1..=1.1).contains(&a),
            Quantity::Temperature => (-5.0..=50.0).contains(&a),
            Quantity::Salinity => (-1.0..=60.0).contains(&a),
            Quantity::Word | Quantity::Date => a >= 0.0,
        }
    }

    /// By how much a reading differs from another: m, rad, m/s, or as it is.
    #[inline]
    pub fn difference(self, now: Reading, before: Reading) -> f64 {
        match self {
            Quantity::Position | Quantity::Flow => {
                Point::new(now[0], now[1]).distance(Point::new(before[0], before[1]))
            }
            _ => self.step(now, before).abs(),
        }
    }

    /// The way from a reading to the next, of what is one number: a direction turns to the nearer side, clockwise positive.
    #[inline]
    pub fn step(self, now: Reading, before: Reading) -> f64 {
        match self {
            Quantity::Direction => Heading::from_radians(now[0]) - Heading::from_radians(before[0]),
            _ => now[0] - before[0],
        }
    }

    /// Such a difference, as a person reads it.
    pub fn show_difference(self, difference: f64) -> String {
        match self {
            Quantity::Position => format!("{difference:.0} m away"),
            Quantity::Direction => format!("{:.0} deg off", degrees(difference)),
            Quantity::Speed | Quantity::Flow => format!("{difference:.1} m/s off"),
            Quantity::Height => format!("{difference:.1} m off"),
            Quantity::Ratio => format!("{:.0} % off", 100.0 * difference),
            Quantity::Temperature => format!("{difference:.1} C off"),
            Quantity::Date => format!("{difference:.1} s off"),
            Quantity::Salinity | Quantity::Word => format!("{difference:.1} off"),
        }
    }
}
