//! Circles a point.

use crate::law::{Args, Guidance, Law, Start, cross_track};
use crate::parameters::{ARRIVAL_RADIUS, CROSS_TRACK_GAIN};
use crate::words::{Reader, Writer};
use albacore_geometry::math::{PI, TAU, acos};
use albacore_geometry::{Heading, Point};

/// The circle is reached within this part of its radius, at most [`ARRIVAL_RADIUS`].
const ENTRY_PART: f64 = 0.25;

/// Nearer to the centre than this, in metres, no direction round it is to be made out.
const CENTER_M: f64 = 1e-3;

/// Which way round, seen from above.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Circling {
    /// The centre on the right.
    #[default]
    Clockwise,
    /// The centre on the left.
    Anticlockwise,
}

/// Keeps a circle round a centre for a number of turns. Ours: the papers only drive lines.
///
/// From outside the vehicle steers along the tangent to the circle, from inside it spirals outward, and near the
/// circle the law of the line takes over, with the circle's own direction as the track. Turns are counted from where
/// the circle is reached. A circle narrower than the vehicle can turn is driven as tightly as it goes, and counted
/// from the second time round.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Loiter {
    center: Point,
    radius: f64,
    circling: Circling,
    turns: f64,
    lead: f64,
    last: Point,
    started: bool,
    entered: bool,
    swept: f64,
}

impl Loiter {
    /// How many words the state takes.
    pub const WORDS: usize = 11;

    /// Round `center` at `radius` metres for `turns` (infinity: for ever), turns commanded `lead` metres early.
    pub fn new(center: Point, radius: f64, circling: Circling, turns: f64, lead: f64) -> Self {
        let last = Point::ORIGIN;
        Loiter { center, radius, circling, turns, lead, last, started: false, entered: false, swept: 0.0 }
    }

    /// Turns driven since the circle was reached; zero before.
    pub fn turned(&self) -> f64 {
        if self.entered { self.swept / TAU } else { 0.0 }
    }

    /// The angle by which to steer inside the tangent at a range from the centre, negative for outside.
    fn inward(&self, range: f64) -> f64 {
        let outside = range - self.radius;
        if outside <= 0.0 {
            return cross_track(outside);
        }
        // The line that touches the circle makes this angle with the tangent here; near the circle it is too steep a
        // law.
        (CROSS_TRACK_GAIN * outside).min(acos(self.radius / range))
    }

    fn side(&self) -> f64 {
        match self.circling {
            Circling::Clockwise => 1.0,
            Circling::Anticlockwise => -1.0,
        }
    }
}

impl Law<{ Loiter::WORDS }> for Loiter {
    fn begin(mut args: Args<'_>, start: &Start) -> Self {
        let (center, radius, turns) = (args.point(), args.number(), args.number());
        let turns = if turns > 0.0 { turns } else { f64::INFINITY };
        let circling = if args.flag() { Circling::Clockwise } else { Circling::Anticlockwise };
        Loiter::new(center, radius, circling, turns, start.lead())
    }

    /// One tick, from the vehicle's position and its course over ground. Arrived when the turns are done.
    fn step(&mut self, position: Point, course: Heading) -> Guidance {
        let side = self.side();
        let out = position - self.center;
        let range = out.length();
        if self.started && range > CENTER_M {
            self.swept += side * (out.toward() - (self.last - self.center).toward());
        }
        self.started = true;
        self.last = position;
        let near = (range - self.radius).abs() <= (ENTRY_PART * self.radius).min(ARRIVAL_RADIUS);
        if !self.entered && (near || self.swept.abs() >= TAU) {
            self.entered = true;
            self.swept = 0.0;
        }
        let arrived = self.entered && self.swept >= self.turns * TAU;
        if range <= CENTER_M {
            return Guidance { course, arrived };
        }
        let tangent = out.toward() + side * (PI / 2.0 + (self.lead / self.radius.max(CENTER_M)).min(1.0));
        Guidance { course: tangent + side * self.inward(range), arrived }
    }

    fn to_words(self) -> [f64; Self::WORDS] {
        Writer::new()
            .point(self.center)
            .number(self.radius)
            .flag(self.circling == Circling::Anticlockwise)
            .number(self.turns)
            .number(self.lead)
            .point(self.last)
            .flag(self.started)
            .flag(self.entered)
            .number(self.swept)
            .finish()
    }

    fn from_words(words: &[f64; Self::WORDS]) -> Self {
        let mut reader = Reader::new(words);
        Loiter {
            center: reader.point(),
            radius: reader.number(),
            circling: if reader.flag() { Circling::Anticlockwise } else { Circling::Clockwise },
            turns: reader.number(),
            lead: reader.number(),
            last: reader.point(),
            started: reader.flag(),
            entered: reader.flag(),
            swept: reader.number(),
        }
    }
}
