//! What a vehicle tells of itself: how tightly it turns, how fast it is, and how deep it may go.

use super::{Instrument, Surroundings};
use crate::world::bottom::DEEPEST_M;
use albacore_vehicle::measurements::{DEPTH_LIMIT, TOP_SPEED, TURN_RADIUS};
use albacore_vehicle::{Limits, Snapshot};
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
pub struct DataSheet {
    turn_radius: f64,
    top_speed: f64,
    depth_limit: f64,
}

impl DataSheet {
    /// What a vehicle can do within its own limits. One that knows no greatest depth goes as deep as there is water.
    pub fn new(abilities: &Abilities, limits: &Limits) -> Self {
        DataSheet {
            turn_radius: abilities.turn_radius,
            top_speed: limits.speed.map_or(abilities.top_speed, |most| abilities.top_speed.min(most)),
            depth_limit: limits.depth.unwrap_or(DEEPEST_M),
        }
    }
}

impl Instrument for DataSheet {
    fn measure(&mut self, around: &mut Surroundings, snapshot: &mut Snapshot) {
        if around.tick.is_multiple_of(EVERY_TICKS) {
            snapshot.push(TURN_RADIUS, &[self.turn_radius]);
            snapshot.push(TOP_SPEED, &[self.top_speed]);
            snapshot.push(DEPTH_LIMIT, &[self.depth_limit]);
        }
    }
}
