//! The vehicle's clock, which tells the date.

use super::{Instrument, Surroundings};
use albacore_vehicle::Snapshot;
use albacore_vehicle::measurements::UTC;
use serde::Deserialize;

/// Ticks between two samples of it.
const EVERY_TICKS: u64 = 10;

/// The date.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Date {
    /// When runs begin, s since the beginning of 1970, UTC.
    pub begins: f64,
}

/// A clock that is right.
#[derive(Clone, Debug)]
pub struct Clock(pub Date);

impl Instrument for Clock {
    fn measure(&mut self, around: &mut Surroundings, snapshot: &mut Snapshot) {
        if around.tick.is_multiple_of(EVERY_TICKS) {
            snapshot.push(UTC, &[self.0.begins + around.time_s()]);
        }
    }
}
