//! What a vehicle tells of itself: how tightly it turns, and how fast it is.

use super::{Instrument, Surroundings};
use albacore_vehicle::Snapshot;
use albacore_vehicle::measurements::{TOP_SPEED, TURN_RADIUS};
use serde::Deserialize;

/// Ticks between two samples of it.
const EVERY_TICKS: u64 = 10;

/// As its data sheet has it. Nothing steers by it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Abilities {
    /// Of the tightest circle that it drives, m.
    pub turn_radius: f64,
    /// Through the water, at most, m/s.
    pub top_speed: f64,
}

/// Tells it again and again, as a sensor does.
#[derive(Clone, Debug)]
pub struct DataSheet(pub Abilities);

impl Instrument for DataSheet {
    fn measure(&mut self, around: &mut Surroundings, snapshot: &mut Snapshot) {
        if around.tick.is_multiple_of(EVERY_TICKS) {
            snapshot.push(TURN_RADIUS, &[self.0.turn_radius]);
            snapshot.push(TOP_SPEED, &[self.0.top_speed]);
        }
    }
}
