//! The mean flow from the acoustic Doppler current profiler: the 2005 paper's Appendix B.

use albacore_geometry::{Heading, Vector};
use serde::{Deserialize, Serialize};

/// Samples that are averaged: 200 s of one every 2 s, 100 s where both looks are heard.
const BUFFER: usize = 100;
/// No mean is given before this many samples: with a deviation of 0.05 m/s each, ten give 0.016 m/s.
const SAMPLES_MIN: usize = 10;
/// The profiler's velocities are valid above this speed through the water, m/s: an exact zero is a missing value.
const WATER_SPEED_MIN: f64 = 0.003;
/// Second gate: the absolute components of its difference from the mean sum to less than this, m/s. As printed, a 1-norm.
const STEP_MAX: f64 = 0.4;
/// The buffer restarts after this many rejections by the second gate in a row: a minute.
const REJECTIONS_MAX: usize = 30;

/// What a message must be to enter the mean; the defaults are the paper's.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FlowGates {
    /// The first gate: a flow sample's speed stays below this, m/s. Default 0.35.
    pub fastest: f64,
    /// The vehicle is faster over ground than this, m/s. Default 0.4.
    pub over_ground: f64,
    /// It is deeper than this, m. Default 1.
    pub depth: f64,
    /// It is higher above the bottom than this, m. Default 1.
    pub altitude: f64,
}

impl Default for FlowGates {
    fn default() -> Self {
        FlowGates { fastest: 0.35, over_ground: 0.4, depth: 1.0, altitude: 1.0 }
    }
}

/// A horizontal velocity in the vehicle's own frame, m/s.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BodyVelocity {
    /// Toward the nose.
    pub ahead: f64,
    /// Toward the right-hand side.
    pub starboard: f64,
}

/// One message of the profiler.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AdcpMessage {
    /// The vehicle's velocity over ground, in its own frame: the paper's v_g^b.
    pub over_ground: BodyVelocity,
    /// The vehicle's velocity through the water of the measured bin, in its own frame: the paper's v_f^b.
    pub through_water: BodyVelocity,
    /// The vehicle's heading.
    pub heading: Heading,
    /// Its depth, m.
    pub depth: f64,
    /// Its height above the bottom, m.
    pub altitude: f64,
}

/// What became of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It entered the mean.
    Accepted,
    /// One of the four conditions on the message does not hold.
    Invalid,
    /// Its flow is too fast to be one.
    TooFast,
    /// Its flow differs too much from the mean.
    TooFar,
    /// It differed too much, like all for a minute: the mean begins anew with it.
    Restarted,
}

/// The mean of the last hundred accepted flow samples.
///
/// Where the print leaves a gap: only samples that were heard are averaged (a buffer of zeros never lets a flow of
/// 0.21, 0.21 m/s in), the first sample meets the first gate alone, and a flow that has turned by more than the second gate
/// spans is believed after a minute (as printed it is refused for ever).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FlowEstimate {
    gates: FlowGates,
    /// At most [`BUFFER`] samples; the oldest is at `oldest` once it is full.
    samples: Vec<Vector>,
    oldest: usize,
    rejections: usize,
}

impl BodyVelocity {
    /// The velocity in the tangent frame, turned by R_b2t.
    pub fn to_tangent(self, heading: Heading) -> Vector {
        let ahead = heading.unit();
        Vector::new(
            self.ahead * ahead.north - self.starboard * ahead.east,
            self.ahead * ahead.east + self.starboard * ahead.north,
        )
    }

    /// The velocity of the tangent frame as the vehicle sees it.
    pub fn of_tangent(velocity: Vector, heading: Heading) -> Self {
        BodyVelocity { ahead: velocity.along(heading), starboard: velocity.right_of(heading) }
    }

    fn length(self) -> f64 {
        (self.ahead * self.ahead + self.starboard * self.starboard).sqrt()
    }
}

impl AdcpMessage {
    /// f_g^t = R_b2t (v_g^b - v_f^b).
    fn flow(&self) -> Vector {
        self.over_ground.to_tangent(self.heading) - self.through_water.to_tangent(self.heading)
    }
}

impl FlowEstimate {
    /// Nothing heard yet.
    pub fn new(gates: FlowGates) -> Self {
        FlowEstimate { gates, ..FlowEstimate::default() }
    }

    /// Takes in a message of the profiler.
    pub fn hear(&mut self, message: &AdcpMessage) -> Verdict {
        if self.is_valid(message) { self.add(message.flow()) } else { Verdict::Invalid }
    }

    /// Whether the paper's four conditions hold: fast enough over ground and in the water, deep and high enough.
    fn is_valid(&self, message: &AdcpMessage) -> bool {
        message.over_ground.length() > self.gates.over_ground
            && message.through_water.length() > WATER_SPEED_MIN
            && message.depth > self.gates.depth
            && message.altitude > self.gates.altitude
    }

    /// Takes in one flow sample, m/s toward.
    pub fn add(&mut self, flow: Vector) -> Verdict {
        let speed = flow.length();
        if speed >= self.gates.fastest || speed.is_nan() {
            return Verdict::TooFast;
        }
        let difference = self.average().map_or(Vector::ZERO, |mean| flow - mean);
        if difference.north.abs() + difference.east.abs() < STEP_MAX {
            self.rejections = 0;
            self.store(flow);
            return Verdict::Accepted;
        }
        self.rejections += 1;
        if self.rejections < REJECTIONS_MAX {
            return Verdict::TooFar;
        }
        *self = FlowEstimate::new(self.gates.clone());
        self.store(flow);
        Verdict::Restarted
    }

    /// The mean flow, m/s toward; none before ten samples.
    pub fn mean(&self) -> Option<Vector> {
        if self.samples.len() < SAMPLES_MIN { None } else { self.average() }
    }

    /// How many samples the mean is of.
    pub fn samples(&self) -> usize {
        self.samples.len()
    }

    fn average(&self) -> Option<Vector> {
        if self.samples.is_empty() {
            return None;
        }
        // Summed anew in the buffer's order, so that no rounding builds up over a long mission.
        let sum = self.samples.iter().fold(Vector::ZERO, |sum, &f| sum + f);
        Some(1.0 / self.samples.len() as f64 * sum)
    }

    fn store(&mut self, flow: Vector) {
        if self.samples.len() < BUFFER {
            self.samples.push(flow);
        } else if let Some(oldest) = self.samples.get_mut(self.oldest) {
            *oldest = flow;
            self.oldest = (self.oldest + 1) % BUFFER;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fed(flow: Vector, times: usize) -> FlowEstimate {
        let mut estimate = FlowEstimate::default();
        (0..times).for_each(|_| _ = estimate.add(flow));
        estimate
    }

    /// A fixed pattern of noise, of mean 0 over any hundred and deviation 0.05 m/s a component.
    fn wobble(i: usize) -> Vector {
        let unit = |k: usize| ((k % 100) as f64 - 49.5) / 28.866;
        0.05 * Vector::new(unit(37 * i), unit(61 * i + 13))
    }

    #[test]
    fn sees_the_current_from_any_heading() {
        let flow = Vector::new(-0.1, 0.08);
        for degrees in [0.0, 73.0, 200.0] {
            let heading = Heading::from_degrees(degrees);
            let water = 2.0 * heading.unit();
            let message = AdcpMessage {
                over_ground: BodyVelocity::of_tangent(water + flow, heading),
                through_water: BodyVelocity::of_tangent(water, heading),
                heading,
                depth: 5.0,
                altitude: 2.0,
            };
            let mut estimate = FlowEstimate::default();
            (0..9).for_each(|_| assert_eq!(estimate.hear(&message), Verdict::Accepted));
            assert_eq!(estimate.mean(), None, "not before ten");
            estimate.hear(&message);
            assert!((estimate.mean().unwrap() - flow).length() < 1e-12);
            for bad in [
                AdcpMessage { depth: 1.0, ..message },
                AdcpMessage { altitude: 0.9, ..message },
                AdcpMessage { through_water: BodyVelocity::default(), ..message },
                AdcpMessage { over_ground: BodyVelocity { ahead: 0.3, starboard: 0.2 }, ..message },
            ] {
                assert_eq!(estimate.hear(&bad), Verdict::Invalid);
            }
        }
    }

    /// Edge case 1: with a buffer of zeros, flows of |f|_1 >= 0.4 never got in, and noisy ones read 0.10 for 0.34.
    #[test]
    fn a_diagonal_flow_gets_in() {
        let diagonal = Vector::new(0.21, 0.21);
        assert!((fed(diagonal, 100).mean().unwrap() - diagonal).length() < 1e-12);
        let strong = Vector::new(0.24, 0.24);
        let mut estimate = FlowEstimate::default();
        (0..400).for_each(|i| _ = estimate.add(strong + wobble(i)));
        assert!(estimate.mean().unwrap().length() > 0.28, "{:?}", estimate.mean());
    }

    /// Edge case 2: a reversal of 0.42 m/s was refused for ever; one of 0.38 was not.
    #[test]
    fn a_reversal_is_believed_after_a_minute() {
        let mut estimate = fed(Vector::new(0.21, 0.0), 100);
        let verdicts: Vec<Verdict> = (0..40).map(|_| estimate.add(Vector::new(-0.21, 0.0))).collect();
        assert!(verdicts[..29].iter().all(|&v| v == Verdict::TooFar));
        assert_eq!(verdicts[29..31], [Verdict::Restarted, Verdict::Accepted]);
        assert!((estimate.mean().unwrap() - Vector::new(-0.21, 0.0)).length() < 1e-12);

        let mut estimate = fed(Vector::new(0.19, 0.0), 100);
        assert!((0..100).all(|_| estimate.add(Vector::new(-0.19, 0.0)) == Verdict::Accepted));
        assert!((estimate.mean().unwrap() + Vector::new(0.19, 0.0)).length() < 1e-12);
    }

    /// Edge case 3: the first gate biases strong flows low. It stays, as printed; the bias is known.
    #[test]
    fn strong_flows_read_low() {
        let mut estimate = FlowEstimate::default();
        (0..1000).for_each(|i| _ = estimate.add(Vector::new(0.33, 0.0) + wobble(i)));
        let speed = estimate.mean().unwrap().length();
        assert!((0.28..0.32).contains(&speed), "{speed}");
        assert_eq!(estimate.add(Vector::new(f64::NAN, 0.0)), Verdict::TooFast);
    }

    #[test]
    fn a_faster_flow_gets_in_where_the_gate_is_wider() {
        let mut estimate = FlowEstimate::new(FlowGates { fastest: 1.0, ..FlowGates::default() });
        (0..10).for_each(|_| assert_eq!(estimate.add(Vector::new(0.45, 0.6)), Verdict::Accepted));
        assert!((estimate.mean().unwrap().length() - 0.75).abs() < 1e-12);
        assert_eq!(estimate.add(Vector::new(0.0, 1.0)), Verdict::TooFast);
    }

    #[test]
    fn half_the_change_after_a_hundred_seconds() {
        let mut estimate = fed(Vector::new(0.1, 0.0), 100);
        (0..50).for_each(|_| _ = estimate.add(Vector::new(0.2, 0.0)));
        assert!((estimate.mean().unwrap().north - 0.15).abs() < 1e-12);
        assert_eq!(estimate.samples(), 100);
    }
}
