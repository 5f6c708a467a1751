//! The dear functions of headings, remembered for the few values that a tick asks for again and again.
//!
//! A script that says `toward upflow` for each element of a list means one sine and one cosine, and the flow's direction
//! changes only when a sample of it comes. What is remembered is found by its exact bits, so that no result depends on it:
//! it is no part of a run's state.

use albacore_geometry::{Heading, Vector};

/// How many of each are remembered: what one tick of a strategy and its overlays asks for, and no more than is quickly
/// searched.
const REMEMBERED: usize = 4;

/// Headings with their unit vectors, and vectors with their headings. Neither function is made part of the loop over instructions, whose
/// beginning would cost more by it than the call.
#[derive(Clone)]
pub(crate) struct Trig {
    units: Memo<u64, Vector>,
    directions: Memo<(u64, u64), f64>,
}

impl Trig {
    pub fn new() -> Self {
        let north = Heading::NORTH;
        Trig {
            units: Memo::new(north.radians().to_bits(), north.unit()),
            directions: Memo::new((0.0_f64.to_bits(), 0.0_f64.to_bits()), Vector::ZERO.toward().radians()),
        }
    }

    /// The unit vector along an angle in radians, clockwise from north.
    #[inline(never)]
    pub fn unit(&mut self, angle_rad: f64) -> Vector {
        self.units.get(angle_rad.to_bits(), || Heading::from_radians(angle_rad).unit())
    }

    /// The direction of a vector, in radians.
    #[inline(never)]
    pub fn toward(&mut self, v: Vector) -> f64 {
        self.directions.get((v.north.to_bits(), v.east.to_bits()), || v.toward().radians())
    }
}

/// The last few values of a function. A new one takes the place of the oldest.
#[derive(Clone)]
struct Memo<K, V> {
    known: [(K, V); REMEMBERED],
    oldest: usize,
}

impl<K: Copy + PartialEq, V: Copy> Memo<K, V> {
    fn new(key: K, value: V) -> Self {
        Memo { known: [(key, value); REMEMBERED], oldest: 0 }
    }

    fn get(&mut self, key: K, compute: impl FnOnce() -> V) -> V {
        if let Some((_, value)) = self.known.iter().find(|(known, _)| *known == key) {
            return *value;
        }
        let value = compute();
        if let Some(place) = self.known.get_mut(self.oldest) {
            *place = (key, value);
        }
        self.oldest = (self.oldest + 1) % REMEMBERED;
        value
    }
}
