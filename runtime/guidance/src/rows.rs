//! Parallel rows, to and fro, as the 2003 paper's `Navigate Rows`.

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

impl Rows {
    /// Each of them, to and fro: the first begins at `start` and runs along `heading`, the others lie to the right of it.
    pub fn lines(&self, start: Point, heading: Heading) -> Vec<Line> {
        let first = Line { start, end: start + self.length * heading.unit() };
        let line = |index: u32| {
            let across = f64::from(index) * self.spacing * (first.heading() + PI / 2.0).unit();
            let line = Line { start: first.start + across, end: first.end + across };
            if index.is_multiple_of(2) { line } else { Line { start: line.end, end: line.start } }
        };
        (0..self.count).map(line).collect()
    }
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
        let rows: Rows = "100x20x2".parse().unwrap();
        let lines = rows.lines(Point::ORIGIN, Heading::NORTH);
        assert_eq!((lines.len(), lines[0]), (2, Line { start: Point::ORIGIN, end: Point::new(100.0, 0.0) }));
        assert!(lines[1].start.distance(Point::new(100.0, 20.0)) < 1e-9);
        assert!(lines[1].end.distance(Point::new(0.0, 20.0)) < 1e-9);
    }
}
