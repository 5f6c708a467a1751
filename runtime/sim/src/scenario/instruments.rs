//! The instruments of the vehicle itself, compass, pressure gauge, Doppler log, receiver of fixes, CTD: what a scenario says of
//! them, and what of that cannot be. Their defaults are perfect.

use crate::scenario::{Scenario, ScenarioIssues};
use albacore_geometry::{Heading, Vector};
use albacore_vehicle::TICK_S;
use serde::Deserialize;

/// Samples a second of what is read at every tick.
pub(crate) const EVERY_TICK: f64 = 1.0 / TICK_S;

/// The compass: its error turns heading, course, dead reckoning and the flow estimate alike.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
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
    /// Between a sample and its being told, s. Default 0.
    pub delay: f64,
}

impl Default for Compass {
    fn default() -> Self {
        Compass { rate: EVERY_TICK, noise: 0.0, bias: 0.0, deviation: 0.0, greatest_at: Heading::NORTH, delay: 0.0 }
    }
}

/// The pressure gauge, which tells the depth.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pressure {
    /// Samples a second. Default 10.
    pub rate: f64,
    /// Standard deviation of its noise, m of water.
    pub noise: f64,
    /// Its constant error, m of water: too deep.
    pub bias: f64,
    /// Between a sample and its being told, s. Default 0.
    pub delay: f64,
}

impl Default for Pressure {
    fn default() -> Self {
        Pressure { rate: EVERY_TICK, noise: 0.0, bias: 0.0, delay: 0.0 }
    }
}

/// The Doppler log, which tells speed and course over ground.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Dvl {
    /// Samples a second. Default 10.
    pub rate: f64,
    /// Standard deviation of each component of a sample, m/s.
    pub noise: f64,
    /// Its constant error, m/s: so much too fast ahead. Default 0.
    pub bias: f64,
    /// It sees the bottom from so high at most, m. Beyond it tells nothing, and dead reckoning goes on with the velocity that it
    /// told last. Default none: from any height.
    pub range: Option<f64>,
    /// Between a sample and its being told, s; dead reckoning has it at once. Default 0.
    pub delay: f64,
}

impl Default for Dvl {
    fn default() -> Self {
        Dvl { rate: EVERY_TICK, noise: 0.0, bias: 0.0, range: None, delay: 0.0 }
    }
}

/// Satellite fixes at the surface, taken by dead reckoning.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Gps {
    /// Time between fixes, s. Default 1.
    pub every: f64,
    /// Standard deviation of a fix, m an axis. Default 5.
    pub sigma: f64,
    /// The antenna is out of the water above this depth, m. Default 0.3.
    pub above: f64,
    /// The constant error of its fixes, m. Default none.
    pub bias: Vector,
    /// Between a fix's moment and its coming, s. Default 0.
    pub delay: f64,
}

impl Default for Gps {
    fn default() -> Self {
        Gps { every: 1.0, sigma: 5.0, above: 0.3, bias: Vector::ZERO, delay: 0.0 }
    }
}

/// The gauge of the battery's charge.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Battery {
    /// Samples a second. Default 0.1.
    pub rate: f64,
    /// Standard deviation of its noise, share of a full charge. Default 0.
    pub noise: f64,
    /// Its constant error, share of a full charge: too full. Default 0.
    pub bias: f64,
}

impl Default for Battery {
    fn default() -> Self {
        Battery { rate: 0.1, noise: 0.0, bias: 0.0 }
    }
}

/// The CTD: conductivity and temperature, and the practical salinity that is derived from them and the pressure.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ctd {
    /// Samples a second. Default 1.
    pub rate: f64,
    /// Standard deviation of a temperature, degrees Celsius. Default 0.
    pub temperature_noise: f64,
    /// Its constant error, degrees Celsius: too warm. Default 0.
    pub temperature_bias: f64,
    /// Standard deviation of a salinity. Default 0.
    pub salinity_noise: f64,
    /// Its constant error: too salty. Default 0.
    pub salinity_bias: f64,
    /// Above this depth its cell runs dry, and it tells nothing, m. Default 0.2.
    pub above: f64,
    /// Between a sample and its being told, s. Default 0.
    pub delay: f64,
}

impl Default for Ctd {
    fn default() -> Self {
        Ctd {
            rate: 1.0,
            temperature_noise: 0.0,
            temperature_bias: 0.0,
            salinity_noise: 0.0,
            salinity_bias: 0.0,
            above: 0.2,
            delay: 0.0,
        }
    }
}

/// What of the instruments cannot be.
pub(crate) fn check(scenario: &Scenario, objections: &mut ScenarioIssues) {
    if let Some(gps) = &scenario.gps {
        let mut of = objections.of("gps");
        of.at_most("bias", gps.bias.length(), GPS_BIAS_MAX);
        of.unless(
            None,
            scenario.navigation.is_some(),
            "`gps` needs a `navigation`: without one the vehicle knows its position exactly",
            "add `navigation(dead_reckoning())` to the scenario, or leave `gps` out",
        );
    }
}

/// No constant error of a fix is larger, m.
const GPS_BIAS_MAX: f64 = 1000.0;
