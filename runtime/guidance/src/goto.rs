//! Drives to a point, and notices when it only circles it.

use crate::law::{Args, Guidance, Law, Start};
use crate::parameters::{NAVIGATION_JUMP, STAND_OFF};
use crate::words::{Reader, Writer};
use albacore_geometry::math::TAU;
use albacore_geometry::{Heading, Point};

/// The range has fallen when it is below this part of what it was.
const FALLEN: f64 = 0.9;

/// A goal that is circled counts as reached within this many arrival radii.
const ORBIT_ACCEPT: f64 = 1.5;

/// Drives straight at a goal until within a radius of it, whatever the course there (2005 paper, appendix A.1).
///
/// Printed, the heading is arctan(y - y_d, x - x_d), which points away from the goal; meant, as the paper's own
/// formula for a line shows, is the bearing of the goal from the vehicle.
///
/// A vehicle whose turning circle is wider than the arrival radius can circle a goal for ever (at 2 m/s and 10
/// degrees per second 11.5 m against 10 m). So once the bearing has swept a full turn without the range falling by a
/// tenth:
/// - within 1.5 radii, the goal counts as reached the next time the vehicle is that near;
/// - otherwise, or when that does not happen within another turn, the vehicle drives straight away from the goal
///   until three turning radii off, and comes back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Goto {
    goal: Point,
    radius: f64,
    turning_radius: f64,
    last: Point,
    started: bool,
    /// The range that has to be improved on, and the angle swept since it was.
    lap_range: f64,
    swept: f64,
    /// An orbit within reach of the goal has been found.
    lenient: bool,
    /// Driving off for a new approach, in the direction `outward`.
    leaving: bool,
    outward: Heading,
}

impl Goto {
    /// How many words the state takes.
    pub const WORDS: usize = 12;

    /// To within `radius` metres of a goal, by a vehicle that turns within `turning_radius` metres.
    pub fn new(goal: Point, radius: f64, turning_radius: f64) -> Self {
        Goto {
            goal,
            radius,
            turning_radius,
            last: Point::ORIGIN,
            started: false,
            lap_range: f64::INFINITY,
            swept: 0.0,
            lenient: false,
            leaving: false,
            outward: Heading::NORTH,
        }
    }

    /// Counts the bearing's sweep since the range last fell, and decides what a full turn means.
    fn watch_orbit(&mut self, last: Point, position: Point, range: f64) {
        if self.leaving {
            self.leaving = false;
            // A hull may turn less tightly than is planned with: the next new approach, if there is one, begins farther off.
            self.turning_radius *= 2.0;
            self.lap_range = range;
            self.swept = 0.0;
        }
        self.swept += (position - self.goal).toward() - (last - self.goal).toward();
        if range < FALLEN * self.lap_range {
            self.lap_range = range;
            self.swept = 0.0;
        }
        if self.swept.abs() < TAU {
            return;
        }
        self.swept = 0.0;
        if !self.lenient && self.lap_range < ORBIT_ACCEPT * self.radius {
            self.lenient = true;
        } else {
            self.leaving = true;
            self.outward = (position - self.goal).toward();
        }
    }
}

impl Law<{ Goto::WORDS }> for Goto {
    fn begin(mut args: Args<'_>, start: &Start) -> Self {
        Goto::new(args.point(), args.number(), start.turning_radius)
    }

    /// One tick, from the vehicle's position and its course over ground.
    fn step(&mut self, position: Point, course: Heading) -> Guidance {
        let last = if self.started { self.last } else { position };
        let range = position.distance(self.goal);
        self.started = true;
        self.last = position;
        let bearing = if range > 0.0 { (self.goal - position).toward() } else { course };
        let reach = if self.lenient { ORBIT_ACCEPT * self.radius } else { self.radius };
        if closest(self.goal, last, position) <= reach {
            return Guidance { course: bearing, arrived: true };
        }
        if self.leaving && range < STAND_OFF * self.turning_radius {
            return Guidance { course: self.outward, arrived: false };
        }
        self.watch_orbit(last, position, range);
        Guidance { course: if self.leaving { self.outward } else { bearing }, arrived: false }
    }

    #[inline]
    fn to_words(self) -> [f64; Self::WORDS] {
        Writer::new()
            .point(self.goal)
            .number(self.radius)
            .number(self.turning_radius)
            .point(self.last)
            .flag(self.started)
            .number(self.lap_range)
            .number(self.swept)
            .flag(self.lenient)
            .flag(self.leaving)
            .heading(self.outward)
            .finish()
    }

    #[inline]
    fn from_words(words: &[f64; Self::WORDS]) -> Self {
        let mut reader = Reader::new(words);
        Goto {
            goal: reader.point(),
            radius: reader.number(),
            turning_radius: reader.number(),
            last: reader.point(),
            started: reader.flag(),
            lap_range: reader.number(),
            swept: reader.number(),
            lenient: reader.flag(),
            leaving: reader.flag(),
            outward: reader.heading(),
        }
    }
}

/// Metres from a goal to the nearest point of the way between two ticks, so that a small goal passed in between counts.
fn closest(goal: Point, from: Point, to: Point) -> f64 {
    let way = to - from;
    let squared = way.dot(way);
    // A jump of the navigation was not driven: only its end counts.
    if squared == 0.0 || squared > NAVIGATION_JUMP * NAVIGATION_JUMP {
        return goal.distance(to);
    }
    let part = ((goal - from).dot(way) / squared).clamp(0.0, 1.0);
    goal.distance(from + part * way)
}
