//! What every guidance law is: how it begins, what it answers each tick, and how its state is kept in words.

use crate::parameters::{CROSS_TRACK_GAIN, CROSS_TRACK_MAX, TURN_LEAD_TIME};
use crate::words::Reader;
use albacore_geometry::{Heading, Line, Point};

/// The answer of a guidance function for one tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guidance {
    /// The course over ground to command.
    pub course: Heading,
    /// Whether the statement has done what it was asked. The course is then still a sensible one to go on with.
    pub arrived: bool,
}

/// A law that leads somewhere: each tick a course over ground, until it has arrived. Its state takes `N` words.
pub trait Law<const N: usize>: Sized {
    /// From the arguments of its statement, in the order in which they are declared.
    fn begin(args: Args<'_>, start: &Start) -> Self;

    /// One tick, from the vehicle's position and its course over ground.
    fn step(&mut self, position: Point, course: Heading) -> Guidance;

    /// The state as plain numbers.
    fn to_words(self) -> [f64; N];

    /// The state back from its numbers.
    fn from_words(words: &[f64; N]) -> Self;
}

/// What a law is told of the vehicle when its statement begins.
#[derive(Clone, Copy, Debug)]
pub struct Start {
    /// Where it is.
    pub position: Point,
    /// Its course over ground.
    pub course: Heading,
    /// The speed to plan with, m/s.
    pub speed: f64,
    /// The tightest turn that speed, flow and the turn rate allow, m.
    pub turning_radius: f64,
}

impl Start {
    /// The radius that was asked for; where none was, 0, the tightest.
    pub fn radius(&self, asked: f64) -> f64 {
        if asked > 0.0 { asked } else { self.turning_radius }
    }

    /// How far ahead a turn is commanded, m.
    pub fn lead(&self) -> f64 {
        self.speed * TURN_LEAD_TIME
    }
}

/// The arguments of a statement, read in their order.
pub struct Args<'a>(Reader<'a>);

impl<'a> Args<'a> {
    /// Arguments as plain numbers.
    pub fn new(words: &'a [f64]) -> Self {
        Args(Reader::new(words))
    }

    /// A number, or a length in metres.
    pub fn number(&mut self) -> f64 {
        self.0.number()
    }

    /// Whether something is so.
    pub fn flag(&mut self) -> bool {
        self.0.flag()
    }

    /// A point.
    pub fn point(&mut self) -> Point {
        self.0.point()
    }

    /// A heading.
    pub fn heading(&mut self) -> Heading {
        self.0.heading()
    }

    /// A line.
    pub fn line(&mut self) -> Line {
        Line { start: self.point(), end: self.point() }
    }
}

/// The functions of a law over the words that whoever runs it keeps.
#[derive(Clone, Copy, Debug)]
pub struct LawOverWords {
    /// Makes the state of the arguments.
    pub begin: fn(args: &[f64], start: &Start, state: &mut [f64]),
    /// One tick.
    pub step: fn(state: &mut [f64], position: Point, course: Heading) -> Guidance,
    /// How many words the state takes.
    pub words: usize,
}

impl LawOverWords {
    /// Those of a law. Its state is the first of the words.
    pub const fn of<const N: usize, L: Law<N>>() -> Self {
        LawOverWords {
            begin: |args, start, state| state[..N].copy_from_slice(&L::begin(Args::new(args), start).to_words()),
            step: |state, position, course| {
                let words = &mut state.as_chunks_mut::<N>().0[0];
                let mut law = L::from_words(words);
                let guidance = law.step(position, course);
                *words = law.to_words();
                guidance
            },
            words: N,
        }
    }
}

/// The angle in radians to turn clockwise of the track's own direction when `left` metres to the left of it (negative
/// to the right): K d, at most 45 degrees either way (2005 paper, appendix A.2).
///
/// Printed, the saturated branch is chosen by d >= d_1 without the absolute value, so that 20 m to the right would
/// command 100 degrees to the left; the distance is meant, and taken, without its sign.
pub fn cross_track(left: f64) -> f64 {
    (CROSS_TRACK_GAIN * left).clamp(-CROSS_TRACK_MAX, CROSS_TRACK_MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use albacore_geometry::math::radians;

    #[test]
    fn five_degrees_a_metre_up_to_forty_five() {
        let check = |left: f64, degrees: f64| assert!((cross_track(left) - radians(degrees)).abs() < 1e-12, "{left} m");
        check(0.0, 0.0);
        check(1.0, 5.0);
        check(-8.9, -44.5);
        check(9.0, 45.0);
        check(20.0, 45.0);
        check(-20.0, -45.0);
    }
}
