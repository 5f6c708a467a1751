//! The instruments of the vehicle itself, compass, pressure gauge, Doppler log, receiver of fixes: what a scenario says of them,
//! and what of that cannot be. Their defaults are perfect.

use crate::scenario::{Bounds, Objections, Scenario};
use albacore_geometry::Heading;
use albacore_vehicle::TICK_S;
use serde::{Deserialize, Serialize};

/// Samples a second of what is read at every tick.
pub(crate) const EVERY_TICK: f64 = 1.0 / TICK_S;

/// The compass: its error turns heading, course, dead reckoning and the flow estimate alike.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Compass {
    /// Samples of the heading a second. Default 10.
    pub rate: f64,
    /// Standard deviation of its noise, rad.
    pub noise: f64,
    /// Its constant error, rad, clockwise.
    pub bias: f64,
    /// The greatest deviation that the vehicle's own iron causes, rad: semicircular, as the cosine of the heading from where it is
    /// greatest (coefficients B and C of compass adjusters).
    pub deviation: f64,
    /// The heading of the greatest deviation, clockwise.
    pub greatest_at: Heading,
}

impl Default for Compass {
    fn default() -> Self {
        Compass { rate: EVERY_TICK, noise: 0.0, bias: 0.0, deviation: 0.0, greatest_at: Heading::NORTH }
    }
}

/// The pressure gauge, which tells the depth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Pressure {
    /// Samples a second. Default 10.
    pub rate: f64,
    /// Standard deviation of its noise, m of water.
    pub noise: f64,
    /// Its constant error, m of water: too deep.
    pub bias: f64,
}

impl Default for Pressure {
    fn default() -> Self {
        Pressure { rate: EVERY_TICK, noise: 0.0, bias: 0.0 }
    }
}

/// The Doppler log, which tells speed and course over ground.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Dvl {
    /// Samples a second. Default 10.
    pub rate: f64,
    /// Standard deviation of each component of a sample, m/s.
    pub noise: f64,
    /// It sees the bottom from so high at most, m. Beyond it tells nothing, and dead reckoning goes on with the velocity that it
    /// told last. Default none: from any height.
    pub range: Option<f64>,
}

impl Default for Dvl {
    fn default() -> Self {
        Dvl { rate: EVERY_TICK, noise: 0.0, range: None }
    }
}

/// Satellite fixes at the surface, taken by dead reckoning.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Gps {
    /// Time between fixes, s. Default 1.
    pub every: f64,
    /// Standard deviation of a fix, m an axis. Default 5.
    pub sigma: f64,
    /// The antenna is out of the water above this depth, m. Default 0.3.
    pub above: f64,
}

impl Default for Gps {
    fn default() -> Self {
        Gps { every: 1.0, sigma: 5.0, above: 0.3 }
    }
}

/// What of the instruments cannot be.
pub(crate) fn check(scenario: &Scenario, objections: &mut Objections) {
    let Scenario { compass, pressure, dvl, gps, .. } = scenario;
    let mut of = objections.of("compass");
    of.rate("rate", compass.rate);
    of.not_negative("noise", compass.noise);
    of.finite("bias", [compass.bias, 0.0]);
    of.finite("deviation", [compass.deviation, 0.0]);
    of.finite("greatest_at", [compass.greatest_at.radians(), 0.0]);
    let mut of = objections.of("pressure");
    of.rate("rate", pressure.rate);
    of.not_negative("noise", pressure.noise);
    of.finite("bias", [pressure.bias, 0.0]);
    let mut of = objections.of("dvl");
    of.rate("rate", dvl.rate);
    of.not_negative("noise", dvl.noise);
    if let Some(range) = dvl.range {
        of.positive("range", range);
    }
    if let Some(gps) = gps {
        let mut of = objections.of("gps");
        // A fix a tick at most.
        of.bounds("every", gps.every, Bounds::AtLeast(TICK_S));
        of.not_negative("sigma", gps.sigma);
        of.not_negative("above", gps.above);
        of.unless(
            None,
            scenario.navigation.is_some(),
            "`gps` needs a `navigation`: without one the vehicle knows its position exactly",
            "add `navigation(dead_reckoning())` to the scenario, or leave `gps` out",
        );
    }
}
