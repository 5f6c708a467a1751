//! What is known of a simulated vehicle whatever its sensors say.

use albacore_geometry::{Heading, Point, Vector};
use serde::{Deserialize, Serialize};

/// What is so, whatever the sensors say.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Truth {
    /// Where the vehicle is.
    pub position: Point,
    /// Where its nose points.
    pub heading: Heading,
    /// Nose up, rad.
    pub pitch: f64,
    /// Starboard side down, rad.
    pub roll: f64,
    /// Its direction over ground.
    pub course: Heading,
    /// Its speed over ground, m/s.
    pub speed_over_ground: f64,
    /// Its depth, m.
    pub depth: f64,
    /// Its height above the bottom, m.
    pub altitude: f64,
    /// The water's velocity where it is, m/s toward.
    pub flow: Vector,
    /// What a perfect chemical sensor without saturation would read, ratio of full scale.
    pub concentration: f64,
}
