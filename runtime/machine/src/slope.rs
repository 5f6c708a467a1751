//! How steeply the bottom rises on the way of a vehicle: a limit that is held over it has to be held ahead.

use serde::{Deserialize, Serialize};

/// The ways over which the depth of the water is averaged, m: what echoes scatter goes, and the slope stays.
const NEAR_M: f64 = 2.0;
const FAR_M: f64 = 12.0;
/// The way on which the bottom is taken to rise on as it did, m: at 1.5 m/s a hull has its nose up by then.
const AHEAD_M: f64 = 15.0;
/// How steep a bottom may be. One that rises more steeply is a step.
pub(crate) const SLOPE_MAX: f64 = 0.25;

/// Means of the depth of the water on the way behind, m.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Slope {
    means: Option<(f64, f64)>,
}

impl Slope {
    /// Takes in the depth of the water, m, so many metres of way after the one before.
    pub fn sound(&mut self, water: f64, way: f64) {
        let (near, far) = self.means.unwrap_or((water, water));
        let mean = |mean: f64, over: f64| mean + (water - mean) * (way / (way + over));
        self.means = Some((mean(near, NEAR_M), mean(far, FAR_M)));
    }

    /// How much the bottom rises ahead, m.
    pub fn rises(&self) -> f64 {
        let (near, far) = self.means.unwrap_or_default();
        AHEAD_M * ((far - near) / (FAR_M - NEAR_M)).clamp(0.0, SLOPE_MAX)
    }
}
