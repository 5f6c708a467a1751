//! The sensors: what a scenario says of them, and what of that cannot be.

use crate::scenario::instruments::EVERY_TICK;
use crate::scenario::{Scenario, ScenarioIssues, told};
use albacore_geometry::Vector;
use albacore_navigation::FlowGates;
use serde::{Deserialize, Deserializer};

/// How the vehicle knows its position: dead reckoning from a known start, and acoustic fixes.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Navigation {
    /// Growth of the position error, m/s^0.5: its standard deviation an axis after t seconds is this times the root of t.
    /// Default 0.05. 0 is perfect.
    #[serde(default, rename = "dead_reckoning", deserialize_with = "walk")]
    pub walk: f64,
    /// Long-baseline fixes. Default none.
    #[serde(rename = "fixes")]
    pub lbl: Option<Lbl>,
}

/// Dead reckoning as a script says it.
#[derive(Deserialize)]
struct DeadReckoning {
    walk: f64,
}

fn walk<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    DeadReckoning::deserialize(from).map(|reckoning| reckoning.walk)
}

impl Default for Navigation {
    fn default() -> Self {
        Navigation { walk: 0.05, lbl: None }
    }
}

/// Long-baseline acoustic fixes, applied as jumps.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Lbl {
    /// Time between fixes, s; the first comes after one such time. Default 120.
    pub every: f64,
    /// Standard deviation of a fix, m an axis. Default 2.
    pub sigma: f64,
    /// A fix is taken only if it disagrees with dead reckoning by more than this, m. Default 0: always.
    pub gate: f64,
    /// The share of fixes that are outliers: reflections, heard for the direct way. Default 0.
    pub outliers: f64,
    /// How far an outlier is off, m, in any direction. Default 50.
    pub outlier: f64,
    /// The transponders drift with this velocity, m/s, and all fixes with them. Default none.
    pub drift: Vector,
    /// Between a fix's moment and its coming, s. Default 0.
    pub delay: f64,
}

impl Default for Lbl {
    fn default() -> Self {
        Lbl { every: 120.0, sigma: 2.0, gate: 0.0, outliers: 0.0, outlier: 50.0, drift: Vector::ZERO, delay: 0.0 }
    }
}

/// The chemical sensor.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fluorometer {
    /// Samples a second; more than one may come in a tick. Default 10.
    pub rate: f64,
    /// Standard deviation of its noise, ratio of full scale. Default 0.003.
    pub noise: f64,
    /// False alarms a second, on average: samples that read at least 10 %. Default 0.
    pub false_alarms: f64,
    /// How far its intake is ahead of the vehicle's reference point, m. Default 0.8: the nose of a 1.6 m REMUS 100.
    pub ahead: f64,
    /// Its constant error, ratio of full scale. Default 0.
    pub bias: f64,
    /// Between sample and reading, s: pump and tube. Default 0.
    pub delay: f64,
    /// It reads no more than this, ratio of full scale. Default 1.
    pub saturation: f64,
}

impl Default for Fluorometer {
    fn default() -> Self {
        Fluorometer { rate: 10.0, noise: 0.003, false_alarms: 0.0, ahead: 0.8, bias: 0.0, delay: 0.0, saturation: 1.0 }
    }
}

/// The flow sensor: an acoustic Doppler current profiler that looks up and down by turns. Its defaults are those of the
/// 2005 paper's Appendix B.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Adcp {
    /// Standard deviation of each component of the velocity of one bin, m/s. Default 0.05.
    pub noise: f64,
    /// Its constant error, m/s: so much too fast through the water, ahead. Default 0.
    pub bias: f64,
    /// It measures nothing nearer than this, m: it is still ringing. Default 0.75.
    pub blanking: f64,
    /// The thickness of a bin, m. Default 0.5.
    pub bin: f64,
    /// The flow is averaged over so many bins, the nearest that are valid. Default 1.
    pub count: u32,
    /// Which looks the flow is estimated from. Default upward.
    pub looks: Looks,
    /// Looks a second. Default 1.
    pub rate: f64,
    /// Between a look and the estimate that it enters, s. Default 0.
    pub delay: f64,
    /// What a look must be to enter the estimate. Default that of the 2005 paper.
    #[serde(flatten)]
    pub gates: FlowGates,
}

impl Default for Adcp {
    fn default() -> Self {
        let gates = FlowGates::default();
        Adcp {
            noise: 0.05,
            bias: 0.0,
            blanking: 0.75,
            bin: 0.5,
            count: 1,
            looks: Looks::Up,
            rate: 1.0,
            delay: 0.0,
            gates,
        }
    }
}

/// The looks of the profiler that the flow is estimated from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Looks {
    /// Upward: every other one, as the 2005 paper has it.
    #[default]
    Up,
    /// Downward: every other one.
    Down,
    /// Both.
    Both,
}

/// The echo sounder: the height above the bottom, and with the vehicle's depth that of the water.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sounder {
    /// Echoes a second. Default 10: at every tick.
    pub rate: f64,
    /// Standard deviation of one echo, m. Default 0.
    pub noise: f64,
    /// Its constant error, m: too far. Default 0.
    pub bias: f64,
    /// It hears no echo from nearer than this, m. Default 0.
    pub nearest: f64,
    /// It hears no echo from farther than this, m. Default none: from anywhere.
    pub farthest: Option<f64>,
    /// The share of echoes that are lost. Default 0.
    pub dropouts: f64,
    /// Between an echo and its being told, s. Default 0.
    pub delay: f64,
}

impl Default for Sounder {
    fn default() -> Self {
        Sounder { rate: EVERY_TICK, noise: 0.0, bias: 0.0, nearest: 0.0, farthest: None, dropouts: 0.0, delay: 0.0 }
    }
}

/// What of the sensors cannot be.
pub(crate) fn check(scenario: &Scenario, objections: &mut ScenarioIssues) {
    if let Some(lbl) = scenario.navigation.as_ref().and_then(|navigation| navigation.lbl.as_ref()) {
        objections.of("lbl").at_most("drift", lbl.drift.length(), LBL_DRIFT_MAX);
    }
    let fluorometer = &scenario.fluorometer;
    objections.of("fluorometer").unless(
        Some("false_alarms"),
        fluorometer.false_alarms <= fluorometer.rate,
        format!("`fluorometer` has more `false_alarms` than samples: its `rate` is {} Hz", told(fluorometer.rate)),
        "make them fewer: a sample gives one alarm at most",
    );
    let sounder = &scenario.sounder;
    if let Some(farthest) = sounder.farthest {
        objections.of("sounder").unless(
            Some("farthest"),
            farthest > sounder.nearest,
            format!(
                "`sounder` hears from {} m at most, and not from nearer than {} m",
                told(farthest),
                told(sounder.nearest)
            ),
            "make `farthest` greater than `nearest`, or it hears nothing",
        );
    }
}

/// Transponders drift no faster than this, m/s.
const LBL_DRIFT_MAX: f64 = 1.0;
