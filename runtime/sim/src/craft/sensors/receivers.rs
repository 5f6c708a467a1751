//! The inverted ultra-short baseline: five receivers aboard that hear a transponder, whose signal a clock counts.

use super::raw::{RawSample, RawSensor};
use crate::craft::hull::{State, attitude_of};
use crate::noise::Noise;
use crate::world::World;
use albacore_geometry::Point;
use albacore_vehicle::TICK_S;
use albacore_vehicle::rate::is_due;
use nalgebra::Vector3;
use serde::Deserialize;

/// The receivers. The default is Table 1 of Jayasiri et al. (2016).
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct InvertedUsbl {
    /// Signals a second. Default 1.
    pub rate: f64,
    /// Standard deviation of a time of arrival before it is counted, s. Default 1/sqrt(3) us.
    pub noise: f64,
    /// The clock that counts it, Hz: it counts whole periods. Default 500 kHz.
    pub clock: f64,
    /// How fast the vehicle takes sound to be, m/s. Default as its CTD tells it, and without one as it truly was
    /// where and when the run began.
    pub sound_speed: Option<f64>,
    /// They hear no transponder from farther, m. Default none: from anywhere.
    pub range: Option<f64>,
    /// The share of signals that are lost. Default 0.
    pub dropouts: f64,
}

impl Default for InvertedUsbl {
    fn default() -> Self {
        InvertedUsbl { rate: 1.0, noise: 0.577e-6, clock: 500e3, sound_speed: None, range: None, dropouts: 0.0 }
    }
}

impl InvertedUsbl {
    /// The standard deviation of a time of arrival with what counting adds, s: that of the even distribution over a period.
    pub fn sigma(&self) -> f64 {
        (self.noise * self.noise + 1.0 / (12.0 * self.clock * self.clock)).sqrt()
    }
}

/// The receivers of a run.
#[derive(Clone, Debug)]
pub struct ReceiverArray {
    settings: InvertedUsbl,
    /// Where they are aboard, m, body.
    receivers: [[f64; 3]; 5],
    noise: Noise,
    dropouts: Noise,
}

impl ReceiverArray {
    /// Those of a run, at places aboard (m, body).
    pub fn new(settings: &InvertedUsbl, receivers: [[f64; 3]; 5], seed: u64) -> Self {
        let (noise, dropouts) = (Noise::named(seed, "receivers"), Noise::named(seed, "receiver dropouts"));
        ReceiverArray { settings: settings.clone(), receivers, noise, dropouts }
    }

    /// What they tell at the end of a tick: Eq. (12) and (13), with the noise before the counting.
    pub fn measure(&self, tick: u64, state: &State, step: u16, world: &World, raw: &mut Vec<RawSample>) {
        let s = &self.settings;
        let time = tick as f64 * TICK_S;
        let Some(transponder) = world.transponder() else { return };
        let is_lost = s.dropouts > 0.0 && self.dropouts.uniform(tick) < s.dropouts;
        if !is_due(s.rate, tick) || is_lost || !transponder.is_heard(time) {
            return;
        }
        let [north, east, depth, _, _, _] = state.pose.into();
        let way = Vector3::new(north, east, depth) - Vector3::from(transponder.place(time));
        if s.range.is_some_and(|range| way.norm() > range) {
            return;
        }
        let sound = transponder.sound_speed(world.stratification(), Point::new(north, east), depth, time);
        let attitude = attitude_of(&state.pose);
        let arrivals: [f64; 5] = std::array::from_fn(|i| {
            let to_receiver = way + Vector3::from(attitude.to_ned(self.receivers[i]));
            let arrival = to_receiver.norm() / sound + s.noise * self.noise.gaussian(5 * tick + i as u64);
            (arrival * s.clock).floor() / s.clock
        });
        raw.push(RawSample::new(RawSensor::Receivers, step, arrivals));
    }

    /// A time of arrival that was counted, as it is to be expected, s: counting down takes half a period off.
    pub fn expected(&self, counted: f64) -> f64 {
        counted + 0.5 / self.settings.clock
    }
}
