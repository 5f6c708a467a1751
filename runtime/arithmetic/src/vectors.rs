//! What is measured of vectors. Their sums and multiples are those of their components.

use crate::{Add, Interval, Mul, Operation, bounded};
use albacore_geometry::Vector;

/// The length of a vector: of north and east.
pub struct Length;

impl Operation<2> for Length {
    #[inline]
    fn execute([north, east]: [f64; 2]) -> f64 {
        bounded(Vector::new(north, east).length())
    }

    fn rule([north, east]: [Interval; 2]) -> Interval {
        let ((n, north), (e, east)) = (north.magnitudes(), east.magnitudes());
        Interval::new(Self::execute([n, e]), Self::execute([north, east]))
    }
}

/// The scalar product of two vectors: north and east of one, then of the other. With a unit vector it is how much of a vector
/// goes in a direction.
pub struct Dot;

impl Operation<4> for Dot {
    #[inline]
    fn execute([north, east, other_north, other_east]: [f64; 4]) -> f64 {
        bounded(Vector::new(north, east).dot(Vector::new(other_north, other_east)))
    }

    fn rule([north, east, other_north, other_east]: [Interval; 4]) -> Interval {
        if let [Some(a), Some(b), Some(c), Some(d)] = [north, east, other_north, other_east].map(Interval::constant) {
            return Interval::exactly(Self::execute([a, b, c, d]));
        }
        // Each product is bounded here and is not there: beyond the bound the sum may be anything.
        let products = [Mul::rule([north, other_north]), Mul::rule([east, other_east])];
        let is_exact = products.iter().all(|p| p.magnitudes().1 < crate::LARGEST);
        if is_exact { Add::rule(products) } else { Interval::ANY }
    }
}

/// From the least to the greatest coordinate of points along a direction.
pub struct Spread;

impl Operation<2> for Spread {
    #[inline]
    fn execute([least, greatest]: [f64; 2]) -> f64 {
        if least <= greatest { bounded(greatest - least) } else { 0.0 }
    }

    fn rule([least, greatest]: [Interval; 2]) -> Interval {
        Interval::new(Self::execute([least.high, greatest.low]), Self::execute([least.low, greatest.high]))
    }
}
