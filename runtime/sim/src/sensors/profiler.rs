//! The upward acoustic Doppler current profiler and the flow estimate fed by it.

use crate::noise::{Noise, Stream};
use albacore_geometry::{Heading, Vector};
use albacore_navigation::{AdcpMessage, BodyVelocity, FlowEstimate};

/// Ticks between messages of the upward profiler: upward and downward take turns of 1 s, and the downward is not used this
/// near the bottom (the 2005 paper, App. B).
const MESSAGE_TICKS: u64 = 20;

/// What the profiler sees of the vehicle.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// Velocity over ground, m/s.
    pub ground_velocity: Vector,
    /// Velocity of the water where it measures, m/s.
    pub flow: Vector,
    /// Where the nose points.
    pub heading: Heading,
    /// Where the compass says that it points: the estimate turns by it.
    pub compass: Heading,
    /// Depth, m.
    pub depth: f64,
    /// Height above the bottom, m.
    pub altitude: f64,
}

/// The profiler.
#[derive(Clone, Debug)]
pub struct Profiler {
    noise: Noise,
    deviation: f64,
    estimate: FlowEstimate,
}

impl Profiler {
    /// With a standard deviation, in m/s, of each component of a flow sample.
    pub fn new(deviation: f64, seed: u64) -> Self {
        Profiler { noise: Noise::new(seed, Stream::Adcp), deviation, estimate: FlowEstimate::new() }
    }

    /// The mean flow, m/s toward, if a message comes at this tick and enough have been heard.
    ///
    /// All noise is put on the velocity through the water: a flow sample is the difference of both, so no more can be told
    /// from it.
    pub fn measure(&mut self, tick: u64, view: &View) -> Option<Vector> {
        if !tick.is_multiple_of(MESSAGE_TICKS) {
            return None;
        }
        let through_water = BodyVelocity::of_tangent(view.ground_velocity - view.flow, view.heading);
        let noise = |component: u64| self.deviation * self.noise.gaussian(2 * tick + component);
        self.estimate.hear(&AdcpMessage {
            over_ground: BodyVelocity::of_tangent(view.ground_velocity, view.heading),
            through_water: BodyVelocity {
                ahead: through_water.ahead + noise(0),
                starboard: through_water.starboard + noise(1),
            },
            heading: view.compass,
            depth: view.depth,
            altitude: view.altitude,
        });
        self.estimate.mean()
    }
}
