//! How finely a plume is computed in time.

use crate::scenario::Scenario;
use crate::world::plume::Plume;
use albacore_geometry::math::TAU;
use albacore_vehicle::TICK_S;

/// The plume's own steps are this long at most, s.
pub const LONGEST_STEP_S: f64 = 5.0;
/// All filaments go in strides of as many of these steps as fit, and of this at most, s.
pub const LONGEST_STRIDE_S: f64 = 128.0;
/// No filament goes straight on for longer, s: who comes back to a place must not find it as it was left.
const LONGEST_STRAIGHT_S: f64 = 16.0;
/// In a stride the mean flow goes this share of a cell of the field at most.
const CELL_SHARE: f64 = 1.0;
/// A stride is this share of a period of the flow at most.
const PERIOD_SHARE: f64 = 0.05;

/// Strides, and the parts of them that filaments go straight on in, by their age.
///
/// In the middle of a part of T seconds a filament is off the straight line that it is moved on by a deviation of
/// sqrt(K T / 2), that of a Brownian bridge. It is too wide for that to be seen where it is not above its radius r: T <= 2 r2 / K.
#[derive(Clone, Copy, Debug)]
pub struct Steps {
    /// The plume's own step, s.
    pub step: f64,
    /// Steps in a stride of the run, and of the spin-up: powers of two.
    pub stride: u64,
    pub of_spin_up: u64,
    /// Steps in a part at birth, their growth with age, per s, and the most.
    young: f64,
    growth: f64,
    longest: f64,
}

impl Steps {
    /// Those of a scenario's plume.
    pub fn new(scenario: &Scenario, plume: &Plume) -> Self {
        let of_spin_up = power_of_two(longest(scenario) / plume.step);
        let per_squared_radius = 2.0 / plume.diffusivity.max(plume.vertical).max(f64::MIN_POSITIVE) / plume.step;
        Steps {
            step: plume.step,
            stride: if plume.graded { of_spin_up } else { 1 },
            of_spin_up,
            young: per_squared_radius * plume.initial_radius * plume.initial_radius,
            growth: per_squared_radius * plume.growth,
            longest: LONGEST_STRAIGHT_S / plume.step,
        }
    }

    /// How many steps a filament of an age (s) goes straight on: a power of two, so that they are parts of a stride.
    pub fn straight(&self, age: f64) -> u64 {
        power_of_two((self.young + self.growth * age).min(self.longest))
    }
}

/// The largest power of two that is not more; 1 at least.
fn power_of_two(most: f64) -> u64 {
    // The cast saturates.
    1 << (most as u64).max(1).ilog2()
}

/// The longest stride of a scenario's plume, s: so short that in one a filament does not cross much of what the flow changes over,
/// in space or in time.
fn longest(scenario: &Scenario) -> f64 {
    let flow = &scenario.environment.flow;
    let meander = flow.meander.as_ref().map(|meander| meander.period);
    let turn = (flow.turning != 0.0).then(|| TAU / flow.turning.abs());
    let periods = meander.into_iter().chain(turn).chain(flow.tides.iter().map(|tide| tide.period));
    let mut longest = periods.fold(LONGEST_STRIDE_S, |longest, period| longest.min(PERIOD_SHARE * period));
    if let Some(meander) = &flow.meander {
        longest = longest.min(CELL_SHARE * meander.side(flow.speed()) / flow.speed());
    }
    longest.max(LONGEST_STEP_S)
}

/// The stride of a scenario's spin-up, s: nobody looks before 0, so that it is the longest.
pub fn spin_up_stride(scenario: &Scenario) -> f64 {
    let plume = scenario.environment.plume.as_ref();
    plume.map_or(LONGEST_STRIDE_S, |plume| plume.step * Steps::new(scenario, plume).of_spin_up as f64)
}

/// How far ahead of the run the water is computed for a scenario's plume, s: to the middle of a stride.
pub fn ahead(scenario: &Scenario) -> f64 {
    let strides =
        scenario.environment.plume.as_ref().map(|plume| plume.step * Steps::new(scenario, plume).stride as f64);
    strides.map_or(0.0, |stride| 0.5 * stride + TICK_S)
}
