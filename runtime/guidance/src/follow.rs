//! Follows a straight line from its start to its end.

use crate::dubins::{Pose, Words};
use crate::goto_pose::GotoPose;
use crate::law::{Args, Guidance, Law, Start, cross_track};
use crate::parameters::{ARRIVAL_RADIUS, LINE_CAPTURE_ANGLE};
use crate::words::{Reader, Writer};
use albacore_geometry::{Heading, Line, Point};

/// After this many approaches that ended at the start of the line without being on it, the line is followed all the
/// same: its own law comes back from anywhere, and a vehicle that cannot arrive in line must not try for ever.
const APPROACHES_MAX: u8 = 2;

/// First drives onto the start of a line, then along it (2005 paper, appendix A.2).
///
/// The approach is a [`GotoPose`] with the paper's words; it ends, and the line begins, within 10 m of the start and
/// 30 degrees of the line's direction, at once if the vehicle is already there. Along the line the course is the
/// line's direction plus K d, at most 45 degrees, d metres left of it.
///
/// The paper does not say when a line ends. Ours ends where the vehicle passes abeam of its end, and not within some
/// radius before it: a line is driven whole, whatever is measured on it. One shorter than 10 m may then end on the
/// first tick, for the vehicle begins anywhere within 10 m of its start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FollowLine {
    line: Line,
    phase: Phase,
    approaches: u8,
    approach: GotoPose,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Phase {
    /// Nothing decided yet.
    Fresh,
    /// On the way to the start.
    Approach,
    /// On the line.
    Along,
}

impl FollowLine {
    /// How many words the state takes.
    pub const WORDS: usize = GotoPose::WORDS + 6;

    /// Along `line`, turning with `radius` metres on the way to it, turns commanded `lead` metres early. A line without
    /// length points north.
    pub fn new(line: Line, radius: f64, lead: f64) -> Self {
        let start = Pose { point: line.start, heading: line.heading() };
        let approach = GotoPose::new(start, start, radius, Words::Csc, lead);
        FollowLine { line, phase: Phase::Fresh, approaches: 0, approach }
    }

    /// Whether the vehicle is on the line itself, no more on the way to its start.
    pub fn along(&self) -> bool {
        self.phase == Phase::Along
    }

    /// Whether the line may begin here.
    fn placed(&self, position: Point, course: Heading) -> bool {
        position.distance(self.line.start) <= ARRIVAL_RADIUS
            && (course - self.line.heading()).abs() <= LINE_CAPTURE_ANGLE
    }

    fn approach_from(&mut self, position: Point, course: Heading) -> Guidance {
        self.phase = Phase::Approach;
        self.approaches = self.approaches.saturating_add(1);
        self.approach.restart(Pose { point: position, heading: course });
        // A fresh path may have no length; the line's own state decides what an end means.
        Guidance { arrived: false, ..self.approach.step(position, course) }
    }

    fn keep(&self, position: Point) -> Guidance {
        let (direction, offset) = (self.line.heading(), position - self.line.start);
        let course = direction + cross_track(-offset.right_of(direction));
        Guidance { course, arrived: offset.along(direction) >= self.line.length() }
    }
}

impl Law<{ FollowLine::WORDS }> for FollowLine {
    fn begin(mut args: Args<'_>, start: &Start) -> Self {
        FollowLine::new(args.line(), start.radius(args.number()), start.lead())
    }

    /// One tick, from the vehicle's position and its course over ground. Arrived abeam of the line's end.
    fn step(&mut self, position: Point, course: Heading) -> Guidance {
        if self.phase != Phase::Along && self.placed(position, course) {
            self.phase = Phase::Along;
        }
        match self.phase {
            Phase::Along => self.keep(position),
            Phase::Fresh => self.approach_from(position, course),
            Phase::Approach => {
                let guidance = self.approach.step(position, course);
                if !guidance.arrived {
                    return guidance;
                }
                if self.approaches >= APPROACHES_MAX {
                    self.phase = Phase::Along;
                    return self.keep(position);
                }
                self.approach_from(position, course)
            }
        }
    }

    #[inline]
    fn to_words(self) -> [f64; Self::WORDS] {
        let phase = match self.phase {
            Phase::Fresh => 0.0,
            Phase::Approach => 1.0,
            Phase::Along => 2.0,
        };
        Writer::new()
            .point(self.line.start)
            .point(self.line.end)
            .number(phase)
            .number(f64::from(self.approaches))
            .numbers(&self.approach.to_words())
            .finish()
    }

    #[inline]
    fn from_words(words: &[f64; Self::WORDS]) -> Self {
        let mut reader = Reader::new(words);
        FollowLine {
            line: Line { start: reader.point(), end: reader.point() },
            phase: match reader.number() {
                1.0 => Phase::Approach,
                2.0 => Phase::Along,
                _ => Phase::Fresh,
            },
            approaches: reader.number() as u8,
            approach: GotoPose::from_words(&reader.numbers()),
        }
    }
}
