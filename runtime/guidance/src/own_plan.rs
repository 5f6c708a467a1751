//! What a vehicle does when nobody else drives it: its own mission, rows to and fro, and the way back to it after a guest has
//! driven. On release it returns to the point where the guest took over, or to the closest point of its row, and goes on
//! (J. A. Farrell et al., the 2003 trials).

use crate::parameters::{ARRIVAL_RADIUS, TURN_RATE_MAX};
use crate::rows::{RowMission, Rows};
use crate::{Goto, turning_radius};
use albacore_geometry::{Heading, Point};

/// A plan under way.
#[derive(Clone, Debug)]
pub struct OwnPlan {
    rows: RowMission,
    doing: Doing,
    /// Where a guest took over, until the vehicle is back there.
    break_off: Option<Point>,
    to_closest_point: bool,
}

#[derive(Clone, Debug)]
enum Doing {
    Rows,
    /// A guest drives.
    Away,
    Return(Goto),
    Over,
}

/// A step in the life of a plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Milestone {
    /// A row begins, of so many.
    Row(u32, u32),
    /// The vehicle is back where the guest took over, and goes on with a row.
    Resumed(Point, u32),
    /// The rows are done.
    Over,
}

impl OwnPlan {
    /// Rows that begin at a place and run along a heading, the others to the right of the first.
    pub fn new(rows: Rows, start: Point, heading: Heading) -> Self {
        let rows = RowMission::new(rows, start, heading);
        OwnPlan { rows, doing: Doing::Rows, break_off: None, to_closest_point: false }
    }

    /// The row under way, from 1 on.
    pub fn row(&self) -> u32 {
        self.rows.number()
    }

    /// How many rows there are.
    pub fn rows(&self) -> u32 {
        self.rows.count()
    }

    /// The speed along them, m/s over ground.
    pub fn speed(&self) -> f64 {
        self.rows.speed()
    }

    /// Whether a guest drives.
    pub fn is_left(&self) -> bool {
        matches!(self.doing, Doing::Away)
    }

    /// Whether the rows are done.
    pub fn is_over(&self) -> bool {
        matches!(self.doing, Doing::Over)
    }

    /// Whether it returns to the closest point of its row, rather than to where the guest took over.
    pub fn returns_to_closest_point(&self) -> bool {
        self.to_closest_point
    }

    /// Lets it return to the closest point of its row, or not.
    pub fn return_to_closest_point(&mut self, closest: bool) {
        self.to_closest_point = closest;
    }

    /// A guest takes over at a place; false when there is nothing to take over.
    pub fn leave(&mut self, position: Point) -> bool {
        match self.doing {
            Doing::Away | Doing::Over => return false,
            // Asked again on its way back, the vehicle still knows where its own mission waits.
            Doing::Return(_) => {}
            Doing::Rows => self.break_off = Some(position),
        }
        self.doing = Doing::Away;
        true
    }

    /// The guest has left: back to where it took over, or to the closest point of the row.
    pub fn go_back(&mut self, position: Point) {
        if !self.is_left() {
            return;
        }
        let goal = if self.to_closest_point { self.rows.closest(position) } else { self.break_off.unwrap_or(position) };
        self.break_off = Some(goal);
        self.doing = Doing::Return(Goto::new(goal, ARRIVAL_RADIUS, turning_radius(self.rows.speed(), TURN_RATE_MAX)));
    }

    /// The course over ground to steer in the coming tick; none when a guest drives or the rows are done.
    pub fn step(&mut self, position: Point, course: Heading, tell: &mut dyn FnMut(Milestone)) -> Option<Heading> {
        if let Doing::Return(goto) = &mut self.doing {
            let guidance = goto.step(position, course);
            if !guidance.arrived {
                return Some(guidance.course);
            }
            let from = self.break_off.take().unwrap_or(position);
            self.rows.resume(from);
            self.doing = Doing::Rows;
            tell(Milestone::Resumed(from, self.rows.number()));
        }
        if !matches!(self.doing, Doing::Rows) {
            return None;
        }
        let before = self.rows.number();
        let course = self.rows.step(position, course);
        if self.rows.is_over() {
            self.doing = Doing::Over;
            tell(Milestone::Over);
        } else if self.rows.number() != before {
            tell(Milestone::Row(self.rows.number(), self.rows.count()));
        }
        Some(course)
    }
}
