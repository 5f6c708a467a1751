//! Keeps a place in a current: a watch circle in which the vehicle lies still, and a way back from its edge.

use crate::parameters::{
    STATION_ADRIFT, STATION_INNER_RADIUS, STATION_OUTER_RADIUS, STATION_RETURN_TIME, STATION_SPEED_MAX,
    STATION_SPEED_MIN,
};
use crate::words::{Reader, Writer};
use albacore_geometry::math::PI;
use albacore_geometry::{Heading, Point};

/// Stays about the place where it was begun.
///
/// Within the outer radius the vehicle lies still, whatever carries it. From there on it goes back over ground, in about
/// [`STATION_RETURN_TIME`], until it is within the inner radius or has passed the place. What lies still is quiet and needs
/// no power; what goes back goes fast enough to be steered. Ours: the papers keep no place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// None before a position is known.
    place: Option<Point>,
    returning: bool,
    /// The least distance from the place on this way back, in metres.
    least: f64,
    adrift: bool,
}

/// What a vehicle knows of itself when it keeps a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Whereabouts {
    /// Where it is; none where nobody knows.
    pub position: Option<Point>,
    /// Its course over ground.
    pub course: Heading,
}

/// What to do in one tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stay {
    /// A course and a speed in m/s over ground; none to lie still.
    pub way: Option<(Heading, f64)>,
    /// Whether it is now carried off although it goes back, where that has changed in this tick.
    pub adrift: Option<bool>,
}

impl Station {
    /// How many words the state takes.
    pub const WORDS: usize = 6;

    /// At a place; where none is known yet, at the first that will be.
    pub fn new(place: Option<Point>) -> Self {
        Station { place, returning: false, least: 0.0, adrift: false }
    }

    /// One tick: `speed` is the fastest that it may go back over ground, in m/s. A vehicle that does not know where it is lies
    /// still.
    pub fn step(&mut self, at: Whereabouts, speed: f64) -> Stay {
        let before = self.adrift;
        let way = at.position.and_then(|position| self.way_back(position, at.course, speed));
        Stay { way, adrift: (self.adrift != before).then_some(self.adrift) }
    }

    fn way_back(&mut self, position: Point, course: Heading, speed: f64) -> Option<(Heading, f64)> {
        let place = *self.place.get_or_insert(position);
        let range = position.distance(place);
        let bearing = if range > 0.0 { (place - position).toward() } else { course };
        let passed = (bearing - course).abs() > PI / 2.0;
        if range > STATION_OUTER_RADIUS {
            self.least = if self.returning { self.least.min(range) } else { range };
            self.returning = true;
            self.adrift = range > self.least + STATION_ADRIFT;
        } else if range <= STATION_INNER_RADIUS || passed {
            self.returning = false;
            self.adrift = false;
        }
        let wanted = (range / STATION_RETURN_TIME).clamp(STATION_SPEED_MIN, STATION_SPEED_MAX);
        self.returning.then(|| (bearing, wanted.min(speed)))
    }

    /// The state as plain numbers.
    pub fn to_words(self) -> [f64; Self::WORDS] {
        Writer::new()
            .flag(self.place.is_some())
            .point(self.place.unwrap_or(Point::ORIGIN))
            .flag(self.returning)
            .number(self.least)
            .flag(self.adrift)
            .finish()
    }

    /// The state back from its numbers.
    pub fn from_words(words: &[f64; Self::WORDS]) -> Self {
        let mut reader = Reader::new(words);
        let known = reader.flag();
        let place = reader.point();
        Station {
            place: known.then_some(place),
            returning: reader.flag(),
            least: reader.number(),
            adrift: reader.flag(),
        }
    }
}
