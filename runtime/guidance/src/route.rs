//! The route of a vehicle's own mission: straight legs, each of them followed from its start to its end.

use crate::parameters::{TURN_LEAD_TIME, TURN_RATE_MAX};
use crate::{FollowLine, Law, Rows, turning_radius};
use albacore_geometry::{Heading, Line, Point};
use serde::{Deserialize, Serialize};

/// Where a vehicle goes by itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Route {
    /// Rows from where it starts.
    Rows(Rows),
    /// From point to point.
    Waypoints(Waypoints),
}

/// Points to swim to, one after another, each along the line from the one before; to the first from where the vehicle starts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Waypoints {
    /// The points, in order.
    pub points: Vec<Point>,
    /// Speed over ground, m/s.
    pub speed: f64,
}

impl From<Rows> for Route {
    fn from(rows: Rows) -> Self {
        Route::Rows(rows)
    }
}

impl Default for Route {
    fn default() -> Self {
        Rows::default().into()
    }
}

impl Route {
    /// Its legs in order, for a vehicle that starts at a place and heading.
    pub fn legs(&self, start: Point, heading: Heading) -> Vec<Line> {
        match self {
            Route::Rows(rows) => rows.lines(start, heading),
            Route::Waypoints(Waypoints { points, .. }) => {
                let starts = std::iter::once(&start).chain(points);
                starts.zip(points).map(|(&start, &end)| Line { start, end }).collect()
            }
        }
    }

    /// The speed along it, m/s over ground.
    pub fn speed(&self) -> f64 {
        match self {
            Route::Rows(rows) => rows.speed,
            Route::Waypoints(waypoints) => waypoints.speed,
        }
    }
}

/// A route under way.
#[derive(Clone, Debug)]
pub struct UnderWay {
    legs: Vec<Line>,
    speed: f64,
    index: usize,
    follow: FollowLine,
}

impl UnderWay {
    /// At the beginning of a route.
    pub fn new(route: &Route, start: Point, heading: Heading) -> Self {
        let (legs, speed) = (route.legs(start, heading), route.speed());
        let first = legs.first().copied().unwrap_or(Line { start, end: start });
        UnderWay { legs, speed, index: 0, follow: follow(first, speed) }
    }

    /// The leg under way, from 1 on, as `#S` calls it.
    pub fn number(&self) -> u32 {
        (self.index as u32 + 1).min(self.count())
    }

    /// How many legs there are.
    pub fn count(&self) -> u32 {
        self.legs.len() as u32
    }

    /// The speed along them, m/s over ground.
    pub fn speed(&self) -> f64 {
        self.speed
    }

    /// Whether all legs are done.
    pub fn is_over(&self) -> bool {
        self.index >= self.legs.len()
    }

    /// The leg under way; none when all are done.
    fn leg(&self) -> Option<Line> {
        self.legs.get(self.index).copied()
    }

    /// The course over ground to steer; moves on to the next leg at the end of one.
    pub fn step(&mut self, position: Point, course: Heading) -> Heading {
        let guidance = self.follow.step(position, course);
        if guidance.arrived {
            self.index += 1;
            if let Some(leg) = self.leg() {
                self.follow = follow(leg, self.speed);
            }
        }
        guidance.course
    }

    /// The point of the leg that is nearest to a place.
    pub fn closest(&self, to: Point) -> Point {
        self.leg().map_or(to, |leg| closest(leg, to))
    }

    /// Goes on from a place: along what is left of the leg, or to its beginning if that was not reached yet.
    pub fn resume(&mut self, from: Point) {
        let Some(leg) = self.leg() else { return };
        let rest = if self.follow.along() { Line { start: closest(leg, from), end: leg.end } } else { leg };
        self.follow = follow(rest, self.speed);
    }
}

fn closest(leg: Line, to: Point) -> Point {
    let along = (to - leg.start).along(leg.heading()).clamp(0.0, leg.length());
    leg.start + along * leg.heading().unit()
}

fn follow(leg: Line, speed: f64) -> FollowLine {
    FollowLine::new(leg, turning_radius(speed, TURN_RATE_MAX), speed * TURN_LEAD_TIME)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn waypoints_are_joined_by_legs_from_the_start_on() {
        let (a, b) = (Point::new(100.0, 0.0), Point::new(100.0, 80.0));
        let route = Route::Waypoints(Waypoints { points: vec![a, b], speed: 1.2 });
        let start = Point::new(0.0, 5.0);
        assert_eq!(route.legs(start, Heading::NORTH), [Line { start, end: a }, Line { start: a, end: b }]);
        let mut under_way = UnderWay::new(&route, start, Heading::NORTH);
        assert_eq!((under_way.number(), under_way.count(), under_way.speed()), (1, 2, 1.2));
        under_way.index = 1;
        assert!(under_way.closest(Point::new(90.0, 30.0)).distance(Point::new(100.0, 30.0)) < 1e-9);
        under_way.index = 2;
        assert!(under_way.is_over() && under_way.number() == 2);
    }
}
