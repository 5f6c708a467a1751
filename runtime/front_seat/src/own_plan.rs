//! What a vehicle does when nobody else drives it: its own mission, leg by leg, and the way back to it after a guest has
//! driven. On release it returns to the point where the guest took over, or to the closest point of its leg, and goes on
//! (J. A. Farrell et al., the 2003 trials).

use albacore_geometry::{Heading, Point};
use albacore_guidance::parameters::{ARRIVAL_RADIUS, TURN_RATE_MAX};
use albacore_guidance::{Goto, Law, Route, UnderWay, turning_radius};

/// A plan under way.
#[derive(Clone, Debug)]
pub struct OwnPlan {
    route: UnderWay,
    doing: Doing,
    /// Where a guest took over, until the vehicle is back there.
    break_off: Option<Point>,
    to_closest_point: bool,
}

#[derive(Clone, Debug)]
enum Doing {
    Legs,
    /// A guest drives.
    Away,
    Return(Goto),
    Over,
}

/// A step in the life of a plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Milestone {
    /// A leg begins, of so many.
    Leg(u32, u32),
    /// The vehicle is back where the guest took over, and goes on with a leg.
    Resumed(Point, u32),
    /// The legs are done.
    Over,
}

impl OwnPlan {
    /// A route, for a vehicle that starts at a place and heading.
    pub fn new(route: &Route, start: Point, heading: Heading) -> Self {
        let route = UnderWay::new(route, start, heading);
        OwnPlan { route, doing: Doing::Legs, break_off: None, to_closest_point: false }
    }

    /// The leg under way, from 1 on.
    pub fn leg(&self) -> u32 {
        self.route.number()
    }

    /// How many legs there are.
    pub fn legs(&self) -> u32 {
        self.route.count()
    }

    /// The speed along them, m/s over ground.
    pub fn speed(&self) -> f64 {
        self.route.speed()
    }

    /// Whether a guest drives.
    pub fn is_left(&self) -> bool {
        matches!(self.doing, Doing::Away)
    }

    /// Whether the legs are done.
    pub fn is_over(&self) -> bool {
        matches!(self.doing, Doing::Over)
    }

    /// Whether it returns to the closest point of its leg, rather than to where the guest took over.
    pub fn returns_to_closest_point(&self) -> bool {
        self.to_closest_point
    }

    /// Lets it return to the closest point of its leg, or not.
    pub fn return_to_closest_point(&mut self, closest: bool) {
        self.to_closest_point = closest;
    }

    /// A guest takes over at a place; false when there is nothing to take over.
    pub fn leave(&mut self, position: Point) -> bool {
        match self.doing {
            Doing::Away | Doing::Over => return false,
            // Asked again on its way back, the vehicle still knows where its own mission waits.
            Doing::Return(_) => {}
            Doing::Legs => self.break_off = Some(position),
        }
        self.doing = Doing::Away;
        true
    }

    /// The guest has left: back to where it took over, or to the closest point of the leg.
    pub fn go_back(&mut self, position: Point) {
        if !self.is_left() {
            return;
        }
        let goal =
            if self.to_closest_point { self.route.closest(position) } else { self.break_off.unwrap_or(position) };
        self.break_off = Some(goal);
        self.doing = Doing::Return(Goto::new(goal, ARRIVAL_RADIUS, turning_radius(self.route.speed(), TURN_RATE_MAX)));
    }

    /// The course over ground to steer in the coming tick; none when a guest drives or the legs are done.
    pub fn step(&mut self, position: Point, course: Heading, report: &mut dyn FnMut(Milestone)) -> Option<Heading> {
        if let Doing::Return(goto) = &mut self.doing {
            let guidance = goto.step(position, course);
            if !guidance.arrived {
                return Some(guidance.course);
            }
            let from = self.break_off.take().unwrap_or(position);
            self.route.resume(from);
            self.doing = Doing::Legs;
            report(Milestone::Resumed(from, self.route.number()));
        }
        if !matches!(self.doing, Doing::Legs) {
            return None;
        }
        let before = self.route.number();
        let course = self.route.step(position, course);
        if self.route.is_over() {
            self.doing = Doing::Over;
            report(Milestone::Over);
        } else if self.route.number() != before {
            report(Milestone::Leg(self.route.number(), self.route.count()));
        }
        Some(course)
    }
}
