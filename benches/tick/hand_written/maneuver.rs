//! `maneuver.bowtie`: two lines through a centre.

use super::senses::Senses;
use albacore_geometry::math::radians;
use albacore_geometry::{Heading, Line, Point};
use albacore_guidance::parameters::{TURN_LEAD_TIME, TURN_RATE_MAX};
use albacore_guidance::{FollowLine, Law, turning_radius_in_flow};

const HALF: f64 = 13.0;

#[derive(Clone)]
pub struct Bowtie {
    centre: Point,
    up: Heading,
    side: f64,
    speed: f64,
    second: bool,
    line: FollowLine,
}

impl Bowtie {
    /// Gives the course of its first tick as well.
    pub fn enter(centre: Point, speed: f64, senses: &Senses) -> (Self, Heading) {
        let up = senses.flow.toward() + radians(180.0);
        let right = (senses.position - centre).along(up + radians(90.0)) >= 0.0;
        let side = if right { 1.0 } else { -1.0 };
        let (line, course) = follow(centre, up + side * radians(-15.0), speed, senses);
        (Bowtie { centre, up, side, speed, second: false, line }, course)
    }

    /// The line that is followed.
    pub fn line(&self) -> FollowLine {
        self.line
    }

    /// The course; none when both lines are behind.
    pub fn step(&mut self, senses: &Senses) -> Option<Heading> {
        let guidance = self.line.step(senses.position, senses.course);
        if !guidance.arrived {
            return Some(guidance.course);
        }
        if self.second {
            return None;
        }
        self.second = true;
        let (line, course) = follow(self.centre, self.up + self.side * radians(15.0), self.speed, senses);
        self.line = line;
        Some(course)
    }
}

fn follow(centre: Point, leg: Heading, speed: f64, senses: &Senses) -> (FollowLine, Heading) {
    let line = Line { start: centre - HALF * leg.unit(), end: centre + HALF * leg.unit() };
    let radius = turning_radius_in_flow(speed, senses.flow.length(), TURN_RATE_MAX);
    let mut law = FollowLine::new(line, radius, speed * TURN_LEAD_TIME);
    let course = law.step(senses.position, senses.course).course;
    (law, course)
}
