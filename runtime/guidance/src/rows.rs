//! The vehicle's own mission: parallel rows, to and fro, as the 2003 paper's `Navigate Rows`.

use crate::parameters::{TURN_LEAD_TIME, TURN_RATE_MAX};
use crate::{FollowLine, turning_radius};
use albacore_geometry::math::PI;
use albacore_geometry::{Heading, Line, Point};
use serde::{Deserialize, Serialize};

/// Rows to swim: how long, how far apart and how many.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rows {
    /// Length of a row, m.
    pub length: f64,
    /// Distance between two rows, m.
    pub spacing: f64,
    /// How many there are.
    pub count: u32,
    /// Speed over ground along them, m/s.
    pub speed: f64,
}

impl Default for Rows {
    fn default() -> Self {
        Rows { length: 200.0, spacing: 30.0, count: 6, speed: 1.5 }
    }
}

/// Reads `200x30x6`: rows of 200 m, 30 m apart, six of them.
impl std::str::FromStr for Rows {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong =
            || "write LENGTHxSPACINGxCOUNT, such as `200x30x6`: rows of 200 m, 30 m apart, six of them".to_string();
        let parts: Vec<&str> = text.split('x').collect();
        let [length, spacing, count] = parts.as_slice() else { return Err(wrong()) };
        let metres = |text: &str| text.trim_end_matches('m').trim().parse::<f64>().map_err(|_| wrong());
        let rows = Rows {
            length: metres(length)?,
            spacing: metres(spacing)?,
            count: count.trim().parse().map_err(|_| wrong())?,
            ..Rows::default()
        };
        let sound = (10.0..=100_000.0).contains(&rows.length)
            && (1.0..=10_000.0).contains(&rows.spacing)
            && (1..=1000).contains(&rows.count);
        let limits = "rows are 10 m to 100 km long, 1 m to 10 km apart, and 1 to 1000";
        if sound { Ok(rows) } else { Err(limits.to_string()) }
    }
}

/// Rows under way.
#[derive(Clone, Debug)]
pub struct RowMission {
    rows: Rows,
    first: Line,
    index: u32,
    follow: FollowLine,
}

impl RowMission {
    /// The first row begins at `start` and runs along `heading`; the others lie to the right of it.
    pub fn new(rows: Rows, start: Point, heading: Heading) -> Self {
        let first = Line { start, end: start + rows.length * heading.unit() };
        RowMission { rows, first, index: 0, follow: follow(first, rows.speed) }
    }

    /// The row under way, from 1 on, as `#S` calls it a leg.
    pub fn number(&self) -> u32 {
        (self.index + 1).min(self.rows.count)
    }

    /// How many rows there are.
    pub fn count(&self) -> u32 {
        self.rows.count
    }

    /// The speed along them, m/s over ground.
    pub fn speed(&self) -> f64 {
        self.rows.speed
    }

    /// Whether all rows are done.
    pub fn is_over(&self) -> bool {
        self.index >= self.rows.count
    }

    fn line(&self) -> Line {
        let across = f64::from(self.index) * self.rows.spacing * (self.first.heading() + PI / 2.0).unit();
        let line = Line { start: self.first.start + across, end: self.first.end + across };
        if self.index.is_multiple_of(2) { line } else { Line { start: line.end, end: line.start } }
    }

    /// The course over ground to steer; moves on to the next row at the end of one.
    pub fn step(&mut self, position: Point, course: Heading) -> Heading {
        let guidance = self.follow.step(position, course);
        if guidance.arrived {
            self.index += 1;
            self.follow = follow(self.line(), self.rows.speed);
        }
        guidance.course
    }

    /// The point of the row that is nearest to a place.
    pub fn closest(&self, to: Point) -> Point {
        let line = self.line();
        let along = (to - line.start).along(line.heading()).clamp(0.0, line.length());
        line.start + along * line.heading().unit()
    }

    /// Goes on from a place: along what is left of the row, or to its beginning if that was not reached yet.
    pub fn resume(&mut self, from: Point) {
        let line = self.line();
        let rest = if self.follow.along() { Line { start: self.closest(from), end: line.end } } else { line };
        self.follow = follow(rest, self.rows.speed);
    }
}

fn follow(line: Line, speed: f64) -> FollowLine {
    FollowLine::new(line, turning_radius(speed, TURN_RATE_MAX), speed * TURN_LEAD_TIME)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_read_or_told_how_to_write() {
        let rows: Rows = "200x30x6".parse().unwrap();
        assert_eq!((rows.length, rows.spacing, rows.count), (200.0, 30.0, 6));
        assert_eq!("200mx30mx6".parse::<Rows>(), Ok(rows));
        for wrong in ["", "200", "200x30", "200x30x6x1", "axbxc", "200x30x-1", "NaNx1x1"] {
            assert!(wrong.parse::<Rows>().is_err(), "{wrong}");
        }
        assert!("1x30x6".parse::<Rows>().unwrap_err().contains("10 m to 100 km"));
    }

    #[test]
    fn every_second_row_runs_back() {
        let mut mission = RowMission::new("100x20x2".parse().unwrap(), Point::ORIGIN, Heading::NORTH);
        assert_eq!(mission.line(), Line { start: Point::ORIGIN, end: Point::new(100.0, 0.0) });
        mission.index = 1;
        assert!(mission.line().start.distance(Point::new(100.0, 20.0)) < 1e-9);
        assert!(mission.line().end.distance(Point::new(0.0, 20.0)) < 1e-9);
        assert!(mission.closest(Point::new(40.0, 33.0)).distance(Point::new(40.0, 20.0)) < 1e-9);
    }
}
