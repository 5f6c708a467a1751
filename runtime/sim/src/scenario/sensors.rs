//! The sensors: what a scenario says of them, and what of that cannot be.

use crate::scenario::{Objections, Scenario};
use albacore_vehicle::TICK_S;
use serde::{Deserialize, Serialize};

/// How the vehicle knows its position: dead reckoning from a known start, and acoustic fixes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Navigation {
    /// Growth of the position error, m/s^0.5: its standard deviation an axis after t seconds is this times the root of t.
    /// Default 0.05. 0 is perfect.
    pub walk: f64,
    /// Long-baseline fixes. Default none.
    pub lbl: Option<Lbl>,
}

impl Default for Navigation {
    fn default() -> Self {
        Navigation { walk: 0.05, lbl: None }
    }
}

/// Long-baseline acoustic fixes, applied as jumps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Lbl {
    /// Time between fixes, s; the first comes after one such time. Default 120.
    pub every: f64,
    /// Standard deviation of a fix, m an axis. Default 2.
    pub sigma: f64,
    /// A fix is taken only if it disagrees with dead reckoning by more than this, m. Default 0: always.
    pub gate: f64,
}

impl Default for Lbl {
    fn default() -> Self {
        Lbl { every: 120.0, sigma: 2.0, gate: 0.0 }
    }
}

/// The chemical sensor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Fluorometer {
    /// Samples a second; more than one may come in a tick. Default 10.
    pub rate: f64,
    /// Standard deviation of its noise, ratio of full scale. Default 0.003.
    pub noise: f64,
    /// False alarms a second, on average: samples that read at least 10 %. Default 0.
    pub false_alarms: f64,
    /// How far its intake is ahead of the vehicle's reference point, m. Default 0.8: the nose of a 1.6 m REMUS 100.
    pub ahead: f64,
}

impl Default for Fluorometer {
    fn default() -> Self {
        Fluorometer { rate: 10.0, noise: 0.003, false_alarms: 0.0, ahead: 0.8 }
    }
}

/// The flow sensor: an upward acoustic Doppler current profiler, read every 2 s.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Adcp {
    /// Standard deviation of each component of one flow sample, m/s. Default 0.05.
    pub noise: f64,
}

impl Default for Adcp {
    fn default() -> Self {
        Adcp { noise: 0.05 }
    }
}

/// The echo sounder, read at every tick: the height above the bottom, and with the vehicle's depth that of the water.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Sounder {
    /// Standard deviation of one echo, m. Default 0.
    pub noise: f64,
}

/// What of the sensors cannot be.
pub(crate) fn check(scenario: &Scenario, objections: &mut Objections) {
    if let Some(navigation) = &scenario.navigation {
        objections.not_negative("navigation.walk", navigation.walk);
        if let Some(lbl) = &navigation.lbl {
            objections.unless(
                lbl.every >= TICK_S && lbl.every.is_finite(),
                format!(
                    "`navigation.lbl.every` is {} s: fixes cannot come more often than every tick of {TICK_S} s",
                    lbl.every
                ),
            );
            objections.not_negative("navigation.lbl.sigma", lbl.sigma);
            objections.not_negative("navigation.lbl.gate", lbl.gate);
        }
    }
    let fluorometer = &scenario.fluorometer;
    objections.unless(
        fluorometer.rate > 0.0 && fluorometer.rate <= FLUOROMETER_RATE_MAX,
        format!("`fluorometer.rate` is {} Hz: it must be above 0 and at most {FLUOROMETER_RATE_MAX}", fluorometer.rate),
    );
    objections.not_negative("fluorometer.noise", fluorometer.noise);
    objections.not_negative("fluorometer.false_alarms", fluorometer.false_alarms);
    objections.unless(
        fluorometer.false_alarms <= fluorometer.rate,
        "`fluorometer.false_alarms` exceeds `fluorometer.rate`: a sample gives one alarm at most",
    );
    objections.finite("fluorometer.ahead", [fluorometer.ahead, 0.0]);
    objections.not_negative("adcp.noise", scenario.adcp.noise);
    objections.not_negative("sounder.noise", scenario.sounder.noise);
}

/// A chemical sensor gives at most this many samples a second.
const FLUOROMETER_RATE_MAX: f64 = 1000.0;
