//! How long the steps of a plume may be.

use crate::scenario::Scenario;
use crate::world::plume::Plume;
use albacore_geometry::math::TAU;

/// The plume's own steps are this long at most, s.
pub const LONGEST_PLUME_STEP_S: f64 = 5.0;
/// Old filaments, and those of the spin-up, go in steps so many times as long: this at most, s.
pub const LONGEST_STEP_S: f64 = 20.0;
/// In a step the mean flow goes this share of a cell of the field at most.
const CELL_SHARE: f64 = 0.25;
/// A step is this share of a period of the flow at most.
const PERIOD_SHARE: f64 = 0.01;
/// The bound of a diffusion's draw, in standard deviations ([`Noise::nearly_gaussian_pair`](crate::Noise)).
const LARGEST_DRAW: f64 = 3.46;

/// The steps of filaments by their age.
///
/// In the middle of a step of T seconds a filament is off the straight line that it is moved on by a deviation of
/// sqrt(K T / 2), that of a Brownian bridge. It is too wide for that to be seen where it is not above its radius r: T <= 2 r2 / K.
#[derive(Clone, Copy, Debug)]
pub struct Steps {
    /// At birth, s, and the growth with age.
    young: f64,
    growth: f64,
    longest: f64,
}

impl Steps {
    /// Those of a scenario's plume.
    pub fn new(scenario: &Scenario, plume: &Plume) -> Self {
        if !plume.graded {
            return Steps { young: 0.0, growth: 0.0, longest: 0.0 };
        }
        let per_squared_radius = 2.0 / plume.diffusivity.max(plume.vertical).max(f64::MIN_POSITIVE);
        Steps {
            young: per_squared_radius * plume.initial_radius * plume.initial_radius,
            growth: per_squared_radius * plume.growth,
            longest: longest(scenario),
        }
    }

    /// How many steps of `step` seconds a filament of an age (s) takes at once: a power of two, so that blocks keep in step.
    pub fn at_once(&self, age: f64, step: f64) -> u64 {
        let most = (self.young + self.growth * age).min(self.longest);
        let mut steps = 1;
        while 2.0 * steps as f64 * step <= most {
            steps *= 2;
        }
        steps
    }
}

/// The longest step of a scenario's plume, s: so short that in one a filament neither crosses its layer nor much of a cell of the
/// field, and the flow does not change much.
pub fn longest(scenario: &Scenario) -> f64 {
    let flow = &scenario.environment.flow;
    let meander = flow.meander.as_ref().map(|meander| meander.period);
    let turn = (flow.turning != 0.0).then(|| TAU / flow.turning.abs());
    let periods = meander.into_iter().chain(turn).chain(flow.tides.iter().map(|tide| tide.period));
    let mut longest = periods.fold(LONGEST_STEP_S, |longest, period| longest.min(PERIOD_SHARE * period));
    if let Some(meander) = &flow.meander {
        longest = longest.min(CELL_SHARE * meander.cell / flow.speed());
    }
    if let Some(plume) = &scenario.environment.plume
        && let Some(layer) = plume.layer
    {
        longest = longest.min(crossed_in(layer, plume.vertical));
    }
    longest.max(LONGEST_PLUME_STEP_S)
}

/// Whether no filament can cross its layer in one step, s: it is mirrored at one wall of it at most.
pub fn stays_in_layer(plume: &Plume, step: f64) -> bool {
    plume.layer.is_none_or(|layer| step <= crossed_in(layer, plume.vertical))
}

/// In how long a step the largest draw of the vertical diffusion (m2/s) is as high as the layer (m), s.
fn crossed_in(layer: f64, vertical: f64) -> f64 {
    let draw = layer / LARGEST_DRAW;
    if vertical > 0.0 { draw * draw / (2.0 * vertical) } else { f64::INFINITY }
}
