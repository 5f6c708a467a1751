//! Circles a point.

use crate::law::{Args, Guidance, Law, Start, cross_track};
use crate::parameters::{ARRIVAL_RADIUS, CROSS_TRACK_GAIN, STAND_OFF};
use crate::words::{Reader, Writer};
use albacore_geometry::math::{PI, TAU, acos};
use albacore_geometry::{Heading, Point};

/// The circle is reached within this part of its radius, at most [`ARRIVAL_RADIUS`].
const ENTRY_PART: f64 = 0.25;

/// The range has fallen when it is below this part of what it was.
const FALLEN: f64 = 0.9;

/// An approach that makes this many laps, and the way to the centre besides, without coming nearer or round by a quarter is in vain.
const LAPS_MAX: f64 = 3.0;

/// Each new approach comes from another side, this much farther round, rad: one that failed would fail again.
const NEXT_APPROACH: f64 = 2.4;

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
/// from the second time round. A vehicle that cannot help going round the other way, which turns about the centre as it
/// begins, or that gets no nearer, drives straight away and comes back, each time from farther and to a wider circle: a hull
/// may turn less tightly than is planned with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Loiter {
    center: Point,
    radius: f64,
    circling: Circling,
    turns: f64,
    lead: f64,
    turning_radius: f64,
    last: Point,
    started: bool,
    entered: bool,
    swept: f64,
    /// What has to be improved on, of the range or of the angle swept, and the way since it was.
    range: f64,
    most: f64,
    way: f64,
    /// Driving off for a new approach, in the direction `outward`.
    leaving: bool,
    outward: Heading,
}

impl Loiter {
    /// How many words the state takes.
    pub const WORDS: usize = 17;

    /// Round `center` at `radius` metres for `turns` (infinity: for ever), by a vehicle that turns within `turning_radius`
    /// metres, turns commanded `lead` metres early.
    pub fn new(center: Point, radius: f64, circling: Circling, turns: f64, lead: f64, turning_radius: f64) -> Self {
        Loiter {
            center,
            radius,
            circling,
            turns,
            lead,
            turning_radius,
            last: Point::ORIGIN,
            started: false,
            entered: false,
            swept: 0.0,
            range: f64::INFINITY,
            most: 0.0,
            way: 0.0,
            leaving: false,
            outward: Heading::NORTH,
        }
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
        Loiter::new(center, radius, circling, turns, start.lead(), start.turning_radius)
    }

    /// One tick, from the vehicle's position and its course over ground. Arrived when the turns are done.
    fn step(&mut self, position: Point, course: Heading) -> Guidance {
        let side = self.side();
        let out = position - self.center;
        let range = out.length();
        if self.started && range > CENTER_M {
            self.swept += side * (out.toward() - (self.last - self.center).toward());
            // Along the course: positions that are told wrong one after another make no way.
            self.way += (position - self.last).along(course);
        }
        self.started = true;
        self.last = position;
        let near = (range - self.radius).abs() <= (ENTRY_PART * self.radius).min(ARRIVAL_RADIUS);
        if !self.entered && (near || self.swept >= TAU) {
            (self.entered, self.swept, self.most) = (true, 0.0, 0.0);
        }
        if range < FALLEN * self.range || self.swept > self.most + TAU / 4.0 {
            (self.range, self.most, self.way) = (range.min(self.range), self.swept.max(self.most), 0.0);
        }
        let is_in_vain = self.way > range + LAPS_MAX * TAU * self.radius.max(self.turning_radius);
        if !self.leaving && (self.swept <= -TAU || is_in_vain) {
            (self.leaving, self.entered, self.outward) = (true, false, self.outward + NEXT_APPROACH);
        }
        if self.leaving {
            (self.swept, self.most, self.range, self.way) = (0.0, 0.0, f64::INFINITY, 0.0);
            if range < self.radius + STAND_OFF * self.turning_radius {
                return Guidance { course: self.outward, arrived: false };
            }
            self.leaving = false;
            // The next approach is to a circle that can be driven as far as is known, and one after it to a wider one.
            self.radius = self.radius.max(self.turning_radius);
            self.turning_radius *= 2.0;
        }
        let arrived = self.entered && self.swept >= self.turns * TAU;
        if range <= CENTER_M {
            return Guidance { course, arrived };
        }
        let tangent = out.toward() + side * (PI / 2.0 + (self.lead / self.radius.max(CENTER_M)).min(1.0));
        let along = tangent + side * self.inward(range);
        // A circle narrower than the vehicle can turn lies within the one that it drives, which it enters by a turn the right way round.
        let is_narrow = self.radius < self.turning_radius && range < 2.0 * self.turning_radius;
        let is_wrong_turn = side * (along - course) < -PI / 2.0;
        Guidance { course: if is_narrow && is_wrong_turn { course + side * (PI / 2.0) } else { along }, arrived }
    }

    fn to_words(self) -> [f64; Self::WORDS] {
        Writer::new()
            .point(self.center)
            .number(self.radius)
            .flag(self.circling == Circling::Anticlockwise)
            .number(self.turns)
            .number(self.lead)
            .number(self.turning_radius)
            .point(self.last)
            .flag(self.started)
            .flag(self.entered)
            .number(self.swept)
            .number(self.range)
            .number(self.most)
            .number(self.way)
            .flag(self.leaving)
            .heading(self.outward)
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
            turning_radius: reader.number(),
            last: reader.point(),
            started: reader.flag(),
            entered: reader.flag(),
            swept: reader.number(),
            range: reader.number(),
            most: reader.number(),
            way: reader.number(),
            leaving: reader.flag(),
            outward: reader.heading(),
        }
    }
}
