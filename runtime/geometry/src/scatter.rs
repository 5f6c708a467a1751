//! Places that are scattered evenly over an area.

use crate::area::Edge;
use crate::outline::chords;
use crate::plane::{Line, Point, Vector};

/// From one place to the next, in shares of the area northward and of the way across it eastward: powers of the plastic number, which no
/// first so many places fill unevenly (Roberts 2018, the sequence R2).
const STEPS: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_3];

/// From one seed to the next: the fractions of the roots of 2 and 3, which no number of steps makes.
const SEEDS: [f64; 2] = [0.414_213_562_373_095_05, 0.732_050_807_568_877_2];

/// The places come round again after so many, before their shares lose digits.
const PERIOD: f64 = 1_048_576.0;

/// Halvings that find where a share of an area ends: as many as a number has digits.
pub const HALVINGS: u32 = 53;

/// The place of an index among those that are scattered over an area, which is given by its edges: each part of it has its share of the
/// first so many, however many they are, as in a spatially balanced sample of stations. Another seed begins elsewhere. The origin if there
/// are no edges.
pub fn scattered(edges: impl Iterator<Item = Edge> + Clone, index: f64, seed: f64) -> Point {
    let [north, east] = [0, 1].map(|i| fraction(within(index) * STEPS[i] + fraction(within(seed) * SEEDS[i])));
    let Some(first) = edges.clone().next() else { return Point::ORIGIN };
    let line = parallel(edges.clone(), first.line.start, north);
    let pieces = chords(edges, Vector::new(0.0, 1.0), Point::new(line, first.line.start.east), |p| p.north > line);
    let mut left = east * pieces.iter().map(|piece| piece.length()).sum::<f64>();
    for piece in &pieces {
        if left <= piece.length() {
            return piece.start + Vector::new(0.0, left);
        }
        left -= piece.length();
    }
    pieces.last().map_or(first.line.start, |piece| piece.end)
}

/// How far north the line lies, eastward, below which a share of the area is.
fn parallel(edges: impl Iterator<Item = Edge> + Clone, near: Point, share: f64) -> f64 {
    let norths = edges.clone().map(|edge| edge.line.start.north);
    let (mut low, mut high) =
        norths.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), north| (low.min(north), high.max(north)));
    let wanted = share * surface_below(edges.clone(), near, high);
    for _ in 0..HALVINGS {
        let middle = low + 0.5 * (high - low);
        if surface_below(edges.clone(), near, middle) < wanted {
            low = middle;
        } else {
            high = middle;
        }
    }
    low + 0.5 * (high - low)
}

/// What of an area lies to the south of a parallel, m2. Lengths are counted from a place near it, so that none is lost far away.
fn surface_below(edges: impl Iterator<Item = Edge>, near: Point, parallel: f64) -> f64 {
    // The sum over all edges of what lies between them and the meridian of that place (Green).
    let beside = |Edge { line: Line { start, end }, .. }: Edge| {
        let rise = end.north - start.north;
        if rise == 0.0 {
            return 0.0;
        }
        let [from, to] = [start, end].map(|corner| corner.north.min(parallel));
        let east = |north: f64| start.east - near.east + (north - start.north) / rise * (end.east - start.east);
        0.5 * (east(from) + east(to)) * (to - from)
    };
    edges.map(beside).sum::<f64>().abs()
}

fn fraction(x: f64) -> f64 {
    x - x.floor()
}

fn within(index: f64) -> f64 {
    index - (index / PERIOD).floor() * PERIOD
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Area, Heading};

    fn places(area: &Area, count: u32, seed: f64) -> Vec<Point> {
        (1..=count).map(|i| scattered(area.edges(), f64::from(i), seed)).collect()
    }

    /// Far away, turned, and with a dent that reaches nearly across.
    fn dented() -> Area {
        let corners = [(0.0, 0.0), (300.0, 40.0), (310.0, 240.0), (60.0, 90.0), (20.0, 260.0), (-40.0, 180.0)];
        Area::polygon(&corners.map(|(north, east)| Point::new(north + 40_000.0, east - 70_000.0))).unwrap()
    }

    #[test]
    fn all_lie_inside_and_each_part_has_its_share() {
        let turned = Area::rectangle(Point::new(500.0, -300.0), Heading::from_degrees(33.0), 800.0, 20.0);
        for area in [dented(), turned] {
            for seed in [0.0, 1.0, -7.0, 9_007_199_254_740_992.0] {
                let found = places(&area, 2_000, seed);
                assert!(found.iter().all(|p| area.gap(*p) > -1e-6));
                // The share of a part, by a fine grid.
                let middle = found.iter().fold(Vector::ZERO, |sum, p| sum + (1.0 / 2_000.0) * (*p - Point::ORIGIN));
                let middle = Point::ORIGIN + middle;
                let is_in = |p: &Point| p.north < middle.north && p.east < middle.east;
                let (mut inside, mut part) = (0.0, 0.0);
                for i in 0..500 {
                    for j in 0..500 {
                        let at = |i: i32| 2.0 * f64::from(i - 250);
                        let p = Point::new(middle.north + at(i) + 1.0, middle.east + at(j) + 1.0);
                        if area.contains(p) {
                            inside += 1.0;
                            part += f64::from(u8::from(is_in(&p)));
                        }
                    }
                }
                let share = found.iter().filter(|p| is_in(p)).count() as f64 / 2_000.0;
                assert!((share - part / inside).abs() < 0.01, "{share} {}", part / inside);
            }
        }
    }

    #[test]
    fn a_few_lie_apart_and_another_seed_has_others() {
        let square = Area::rectangle(Point::ORIGIN, Heading::NORTH, 100.0, 100.0);
        let found = places(&square, 16, 0.0);
        let nearest = |p: &Point| {
            found.iter().filter(|other| *other != p).map(|other| p.distance(*other)).fold(f64::INFINITY, f64::min)
        };
        // Sixteen on a grid lie 25 m apart.
        assert!(found.iter().map(nearest).fold(f64::INFINITY, f64::min) > 15.0);
        assert!(places(&square, 16, 1.0).iter().zip(&found).all(|(a, b)| a.distance(*b) > 1.0));
    }

    #[test]
    fn areas_that_hardly_are_have_places_too() {
        let thin = Area::rectangle(Point::new(1e6, 1e6), Heading::from_degrees(90.0), 10.0, 1e-3);
        assert!(places(&thin, 100, 0.0).iter().all(|p| thin.gap(*p) > -1e-3));
        assert_eq!(scattered(std::iter::empty(), 3.0, 0.0), Point::ORIGIN);
    }
}
