//! Drives to a point so as to arrive there on a given heading, along a Dubins path.

use crate::dubins::{Path, Pose, Words, shortest};
use crate::goto::Goto;
use crate::law::{Args, Guidance, Law, Start, cross_track};
use crate::parameters::{ARRIVAL_RADIUS, CROSS_TRACK_GAIN, CROSS_TRACK_MAX, LINE_CAPTURE_ANGLE, NAVIGATION_JUMP};
use crate::words::{Reader, Writer};
use albacore_geometry::{Heading, Point};

/// Farther than this off the path, in metres, another path is planned: here the correction is at its 45 degrees (d_1 of
/// appendix A.2, 9 m) and has nothing more to say.
const OFF_PATH: f64 = CROSS_TRACK_MAX / CROSS_TRACK_GAIN;

/// Arcs grow by this factor when the vehicle left its path without a jump of its navigation: it does not turn as
/// tightly as was thought.
const WIDEN: f64 = 1.25;

/// Arcs never grow to more than this many times the radius first planned with.
const WIDEN_MAX: f64 = 4.0;

/// So many paths that were left one after another, none of them begun nearer to the goal by a tenth, are enough: this
/// vehicle cannot keep any, and drives to the point alone.
const LEFT_MAX: u8 = 12;

/// The goal is nearer when its range is below this part of what it was.
const NEARER: f64 = 0.9;

/// So many times a path that ended across the goal's heading is planned again; then an end is an end.
const RETRIES_MAX: u8 = 3;

/// Follows the shortest path of bounded curvature to a pose (2005 paper, appendix A.3, "go to point with heading").
///
/// The paper plans a path and says nothing of keeping to it. Here the path is a track: each tick commands the path's
/// direction a little ahead of the vehicle (`lead` metres, for the lag of filter and vehicle) plus the same
/// cross-track correction that follows a line. When the vehicle is more than 9 m from where it should be, a new path
/// is planned from where it is, at most once for each turning radius driven; likewise when the path ends more than 30
/// degrees across the goal's heading.
///
/// A vehicle that turns far less tightly than is planned with, or is carried by a current near its own speed, can leave
/// every path. Then the point is what counts: it is driven to by [`Goto`], which learns from its own failures, to within
/// the paper's radius of arrival and on whatever heading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GotoPose(Way);

#[derive(Clone, Copy, Debug, PartialEq)]
enum Way {
    /// Along a path.
    Path(PathToPose),
    /// To the point alone, too many paths having been left.
    Point(Goto),
}

/// A path to a pose, and how far along it the vehicle is.
#[derive(Clone, Copy, Debug, PartialEq)]
struct PathToPose {
    path: Path,
    goal: Pose,
    words: Words,
    radius: f64,
    lead: f64,
    /// Metres along the path.
    progress: f64,
    last: Point,
    /// Metres driven since the path was planned, and whether the navigation jumped on the way.
    driven: f64,
    jumped: bool,
    retries: u8,
    /// The range of the goal to be improved on, and how many paths were left since it was.
    range: f64,
    left: u8,
}

impl GotoPose {
    /// How many words the state takes.
    pub const WORDS: usize = PathToPose::WORDS + 1;

    /// From `start` to `goal` with arcs of `radius` metres, turns commanded `lead` metres early
    /// (speed x [`TURN_LEAD_TIME`](crate::parameters::TURN_LEAD_TIME)).
    pub fn new(start: Pose, goal: Pose, radius: f64, words: Words, lead: f64) -> Self {
        let path = shortest(start, goal, radius, words);
        GotoPose(Way::Path(PathToPose {
            path,
            goal,
            words,
            radius: path.radius,
            lead,
            progress: 0.0,
            last: start.point,
            driven: 0.0,
            jumped: false,
            retries: 0,
            range: f64::INFINITY,
            left: 0,
        }))
    }

    /// The path now followed, and how many metres of it are left. None where the point alone is driven to.
    pub fn path(&self) -> Option<(&Path, f64)> {
        match &self.0 {
            Way::Path(to) => Some((&to.path, to.path.length() - to.progress)),
            Way::Point(_) => None,
        }
    }

    /// Begins anew from a pose, with arcs as wide as they have become. Who could keep no path goes on to the point.
    pub(crate) fn restart(&mut self, from: Pose) {
        if let Way::Path(to) = &mut self.0 {
            // Nothing more was learnt of how the vehicle turns.
            to.jumped = true;
            to.retries = 0;
            to.last = from.point;
            to.plan_again(from);
        }
    }
}

impl PathToPose {
    const WORDS: usize = Path::WORDS + 14;

    /// One tick; none once too many paths were left.
    fn step(&mut self, position: Point, course: Heading) -> Option<Guidance> {
        let step = position.distance(self.last);
        self.last = position;
        self.jumped |= step > NAVIGATION_JUMP;
        self.driven += step.min(NAVIGATION_JUMP);
        let mut foot = self.path.project(position, self.progress);
        let miss = position.distance(self.path.pose_at(foot.distance).point);
        let across = (course - self.goal.heading).abs() > LINE_CAPTURE_ANGLE;
        let retry = across && foot.distance >= self.path.length() && self.retries < RETRIES_MAX;
        if (miss > OFF_PATH || retry) && self.driven >= self.path.radius {
            self.retries += u8::from(retry);
            self.leave(position);
            if self.left >= LEFT_MAX {
                return None;
            }
            self.plan_again(Pose { point: position, heading: course });
            foot = self.path.project(position, 0.0);
        }
        self.progress = foot.distance;
        let ahead = self.path.pose_at(self.progress + self.lead).heading;
        Some(Guidance { course: ahead + cross_track(foot.left), arrived: self.progress >= self.path.length() })
    }

    fn plan_again(&mut self, from: Pose) {
        let wider = (WIDEN * self.path.radius).min(WIDEN_MAX * self.radius);
        let radius = if self.jumped { self.path.radius } else { wider };
        self.path = shortest(from, self.goal, radius, self.words);
        self.progress = 0.0;
        self.driven = 0.0;
        self.jumped = false;
    }

    /// Counts a path that was left.
    fn leave(&mut self, position: Point) {
        let range = position.distance(self.goal.point);
        if range < NEARER * self.range {
            (self.range, self.left) = (range, 0);
        }
        self.left = self.left.saturating_add(1);
    }

    #[inline]
    fn to_words(self) -> [f64; Self::WORDS] {
        Writer::new()
            .numbers(&self.path.to_words())
            .point(self.goal.point)
            .heading(self.goal.heading)
            .flag(self.words == Words::Full)
            .number(self.radius)
            .number(self.lead)
            .number(self.progress)
            .point(self.last)
            .number(self.driven)
            .flag(self.jumped)
            .number(f64::from(self.retries))
            .number(self.range)
            .number(f64::from(self.left))
            .finish()
    }

    #[inline]
    fn from_words(words: &[f64; Self::WORDS]) -> Self {
        let mut reader = Reader::new(words);
        PathToPose {
            path: Path::from_words(&reader.numbers()),
            goal: Pose { point: reader.point(), heading: reader.heading() },
            words: if reader.flag() { Words::Full } else { Words::Csc },
            radius: reader.number(),
            lead: reader.number(),
            progress: reader.number(),
            last: reader.point(),
            driven: reader.number(),
            jumped: reader.flag(),
            retries: reader.number() as u8,
            range: reader.number(),
            left: reader.number() as u8,
        }
    }
}

impl Law<{ GotoPose::WORDS }> for GotoPose {
    fn begin(mut args: Args<'_>, start: &Start) -> Self {
        let goal = Pose { point: args.point(), heading: args.heading() };
        let radius = start.radius(args.number());
        let words = if args.flag() { Words::Full } else { Words::Csc };
        GotoPose::new(Pose { point: start.position, heading: start.course }, goal, radius, words, start.lead())
    }

    /// One tick, from the vehicle's position and its course over ground. Arrived at the end of the path, which can be
    /// up to 9 m from the goal after a late jump of the navigation: another path for the last metres would be a whole
    /// loop.
    fn step(&mut self, position: Point, course: Heading) -> Guidance {
        let to = match &mut self.0 {
            Way::Point(to_point) => return to_point.step(position, course),
            Way::Path(to) => to,
        };
        if let Some(guidance) = to.step(position, course) {
            return guidance;
        }
        let mut to_point = Goto::new(to.goal.point, ARRIVAL_RADIUS, to.path.radius);
        let guidance = to_point.step(position, course);
        self.0 = Way::Point(to_point);
        guidance
    }

    #[inline]
    fn to_words(self) -> [f64; Self::WORDS] {
        let mut words = [0.0; Self::WORDS];
        let [is_to_point, state @ ..] = &mut words;
        match self.0 {
            Way::Path(to) => *state = to.to_words(),
            Way::Point(to_point) => {
                *is_to_point = 1.0;
                state[..Goto::WORDS].copy_from_slice(&to_point.to_words());
            }
        }
        words
    }

    #[inline]
    fn from_words(words: &[f64; Self::WORDS]) -> Self {
        let [is_to_point, state @ ..] = words;
        GotoPose(if *is_to_point == 0.0 {
            Way::Path(PathToPose::from_words(state))
        } else {
            Way::Point(Goto::from_words(&Reader::new(state).numbers()))
        })
    }
}
