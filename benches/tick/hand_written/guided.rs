//! What of a tick the guidance crate does, for machine and hand alike: laws, command filter, flow compensation.

use super::{SPEED_MAX, TURN_RATE_MAX};
use albacore_geometry::{Heading, Point, Vector};
use albacore_guidance::{CommandFilter, FollowLine, Goto, Law, through_water};
use albacore_vehicle::TICK_S;
use std::hint::black_box;

/// The law that leads the vehicle in a tick.
#[derive(Clone, Copy)]
pub enum Led {
    Goto(Goto),
    Line(FollowLine),
    /// Its course is computed by the strategy itself.
    Course,
}

/// A tick's guidance, as it is when the tick is over.
#[derive(Clone, Copy)]
pub struct Guided {
    pub led: Led,
    pub position: Point,
    pub course: Heading,
    pub filter: CommandFilter,
    pub asked: Heading,
    pub speed: f64,
    pub flow: Vector,
}

impl Guided {
    /// The same once more.
    pub fn step(&self) {
        match self.led {
            Led::Goto(mut goto) => _ = black_box(goto.step(self.position, self.course)),
            Led::Line(mut line) => _ = black_box(line.step(self.position, self.course)),
            Led::Course => {}
        }
        let mut filter = self.filter;
        let course = black_box(filter.step(self.asked, TURN_RATE_MAX, TICK_S));
        black_box(through_water(course, self.speed, self.flow, SPEED_MAX));
    }
}
