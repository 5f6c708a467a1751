//! How alike two areas are.

use crate::area::Area;
use crate::plane::Point;

/// Places of an outline that are looked at, evenly far apart along it.
const PLACES: usize = 1000;

impl Area {
    /// How far its outline is from that of another area on average, m: the mean of the distances from each outline to the other. What one of them leaves out
    /// counts like what the other has too much.
    pub fn mean_distance(&self, other: &Area) -> f64 {
        0.5 * (self.mean_gap(other) + other.mean_gap(self))
    }

    /// The mean distance of the places on its outline from the outline of another area, m.
    fn mean_gap(&self, other: &Area) -> f64 {
        self.places().map(|place| other.gap(place).abs()).sum::<f64>() / PLACES as f64
    }

    /// Places on its outline, evenly far apart along it.
    fn places(&self) -> impl Iterator<Item = Point> + '_ {
        let step = self.edges().map(|edge| edge.line.length()).sum::<f64>() / PLACES as f64;
        let mut edges = self.edges();
        let (mut edge, mut along) = (edges.next(), 0.5 * step);
        (0..PLACES).filter_map(move |_| {
            while let Some(line) = edge.map(|edge| edge.line).filter(|line| along > line.length()) {
                along -= line.length();
                // Rounding may leave the last place beyond the end of the last edge.
                edge = Some(edges.next()?);
            }
            let line = edge?.line;
            let place = line.start + (along / line.length()) * (line.end - line.start);
            along += step;
            Some(place)
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::math::ln;
    use crate::{Area, Heading, Point};

    #[test]
    fn squares_one_within_the_other() {
        let square = |side: f64| Area::rectangle(Point::new(5.0, -3.0), Heading::from_degrees(20.0), side, side);
        assert_eq!(square(100.0).mean_distance(&square(100.0)), 0.0);
        // From the inner one all is 5 m; from the outer one the corners are farther: a tenth of each side, sqrt(5^2 + x^2) on the last 5 m.
        let corner = 0.5 * (2f64.sqrt() + ln(1.0 + 2f64.sqrt()));
        let outer = 5.0 * (0.9090909 + 0.0909091 * corner);
        let found = square(100.0).mean_distance(&square(110.0));
        assert!((found - 0.5 * (5.0 + outer)).abs() < 0.01, "{found}");
        assert!((square(110.0).surface() - 12_100.0).abs() < 1e-6);
    }

    /// Half of a square is as far from it as what it leaves out says.
    #[test]
    fn what_is_left_out_counts() {
        let whole = Area::rectangle(Point::ORIGIN, Heading::NORTH, 100.0, 100.0);
        let half = Area::rectangle(Point::new(25.0, 0.0), Heading::NORTH, 50.0, 100.0);
        assert!(half.mean_distance(&whole) > 10.0);
    }
}
