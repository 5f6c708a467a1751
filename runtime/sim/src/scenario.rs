//! A world in plain numbers: what a scenario file can say, with the values it has when it says nothing.

use albacore_geometry::math::PI;
use albacore_geometry::{Area, Heading, Point, Vector};
use albacore_guidance::Rows;
use albacore_vehicle::Vertical;
use serde::{Deserialize, Serialize};

/// The world of a simulated run. SI units and radians throughout; points in the mission's tangent frame.
///
/// The default is still water, 20 m deep, without a plume, and a vehicle with perfect sensors of position.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Scenario {
    /// Where the flow meanders and filaments live, widened by [`Meander::margin`]. A meander or a plume needs it.
    pub region: Option<Area>,
    /// The water's motion.
    pub flow: Flow,
    /// The water's depth.
    pub bottom: Bottom,
    /// How the chemical spreads; none: the chemical sensor reads only its noise.
    pub plume: Option<Plume>,
    /// What releases chemical.
    pub sources: Vec<Source>,
    /// The vehicle.
    pub vehicle: KinematicVehicle,
    /// The mission that the vehicle swims by itself, while nobody else drives; none: it lies still.
    pub own_mission: Option<OwnMission>,
    /// How it answers who asks to drive; none: it gives way at once.
    pub handover: Option<Handover>,
    /// How the vehicle knows its position; none: perfectly.
    pub navigation: Option<Navigation>,
    /// The chemical sensor.
    pub fluorometer: Fluorometer,
    /// The flow sensor.
    pub adcp: Adcp,
    /// The echo sounder.
    pub sounder: Sounder,
}

/// The water's motion.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Flow {
    /// The mean flow, m/s toward. Default none.
    pub mean: Vector,
    /// Its wandering; none: uniform and steady.
    pub meander: Option<Meander>,
    /// Another current above this one, as in the 2003 trial; none: the same at every height.
    pub upper: Option<UpperFlow>,
}

/// A uniform current that lies over the flow that carries the plume.
///
/// The 2005 paper's own main source of wrong flow (Sec. IV): the upward profiler measures above the vehicle, and where the
/// boundary is low it measures this instead.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct UpperFlow {
    /// Its velocity, m/s toward. Default 0.225 m/s northward.
    pub mean: Vector,
    /// Height above the bottom where it begins, m. Default 3.5.
    pub above: f64,
}

impl Default for UpperFlow {
    fn default() -> Self {
        UpperFlow { mean: Vector::new(0.225, 0.0), above: 3.5 }
    }
}

/// A flow field that wanders: the advection field of Farrell et al. 2002 on a grid along the mean flow.
///
/// Each velocity component at the four corners is the mean plus coloured noise of standard deviation
/// `direction_sd` times the mean speed; inside, du/dt = -(u . grad) u + `viscosity`/2 lap u.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Meander {
    /// Standard deviation of the flow's direction at a corner, rad. The field damps it on its way in. Default 8 degrees.
    pub direction_sd: f64,
    /// Period of the noise, s: its bandwidth is 2 pi over it. Default 2732 s (0.0023 rad/s).
    pub period: f64,
    /// Damping ratio of the noise, between 0 and 1. Default 0.1.
    pub damping: f64,
    /// Twice the eddy viscosity of the field, m2/s: Farrell's k_x = k_y. Default 27.
    pub viscosity: f64,
    /// Side of a grid cell, about, m. Default 20.
    pub cell: f64,
    /// How far the grid reaches beyond the region on every side, m. Default 60.
    pub margin: f64,
    /// Time step of the field, s. Default 5.
    pub step: f64,
}

impl Default for Meander {
    fn default() -> Self {
        Meander {
            direction_sd: 8.0 * PI / 180.0,
            period: 2732.0,
            damping: 0.1,
            viscosity: 27.0,
            cell: 20.0,
            margin: 60.0,
            step: 5.0,
        }
    }
}

/// A plane bottom, level beyond either end of its slope, with pits in it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Bottom {
    /// Water depth where the slope begins, m. Default 20.
    pub from: f64,
    /// Water depth where it ends, m. Default 20.
    pub to: f64,
    /// The direction in which depth goes `from` .. `to`. Default north.
    pub toward: Heading,
    /// The length of the slope, m, centred on the frame's origin. Default 1000.
    pub across: f64,
    /// Where it is deeper than the plane. Default none.
    pub pits: Vec<Pit>,
}

/// A smooth round hollow in the bottom: a Gaussian.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Pit {
    /// What it is called.
    pub name: String,
    /// Its middle. Default the frame's origin.
    pub at: Point,
    /// How much deeper than the plane it is in its middle, m. Default 1.
    pub depth: f64,
    /// The standard deviation of its Gaussian, m: there it is 61 % as deep as in its middle. Default 20.
    pub radius: f64,
}

impl Default for Pit {
    fn default() -> Self {
        Pit { name: String::from("pit"), at: Point::ORIGIN, depth: 1.0, radius: 20.0 }
    }
}

impl Default for Bottom {
    fn default() -> Self {
        Bottom { from: 20.0, to: 20.0, toward: Heading::NORTH, across: 1000.0, pits: Vec::new() }
    }
}

/// How the chemical spreads: filaments that drift, diffuse and grow (Farrell et al. 2002).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Plume {
    /// Growth of a filament's squared radius, m2/s: r2 = `initial_radius`^2 + `growth` age. Default 1e-4.
    pub growth: f64,
    /// Radius of a filament at release, m: the standard deviation of its Gaussian. Default 0.2.
    pub initial_radius: f64,
    /// Horizontal diffusivity of filaments about the centre-line, m2/s. Default 0.027.
    pub diffusivity: f64,
    /// Vertical diffusivity of filaments, m2/s. Default 0: each stays at its source's height.
    pub vertical: f64,
    /// Height above the bottom of the layer that holds the plume, m. Default none: a flat plume, the same at any height.
    pub layer: Option<f64>,
    /// Time step, s: a whole number of ticks, 5 s at most. Default 1. Statistics do not depend on it.
    pub step: f64,
}

impl Default for Plume {
    fn default() -> Self {
        Plume { growth: 1e-4, initial_radius: 0.2, diffusivity: 0.027, vertical: 0.0, layer: None, step: 1.0 }
    }
}

/// What releases chemical.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Source {
    /// What it is called.
    pub name: String,
    /// Where it stands. Default the frame's origin.
    pub at: Point,
    /// Metres above the bottom. Default 0.2.
    pub height: f64,
    /// Filaments released a second, on average; the moments are a Poisson process. Default 1.
    pub rate: f64,
    /// What the sensor reads in the middle of one single filament of age `reference_age`, as a ratio of full scale.
    /// Default 0.08: twice a 4 % threshold.
    pub peak: f64,
    /// The age that `peak` is for, s. Default 8752: 1094 m at 12.5 cm/s.
    pub reference_age: f64,
}

impl Default for Source {
    fn default() -> Self {
        Source {
            name: String::from("source"),
            at: Point::ORIGIN,
            height: 0.2,
            rate: 1.0,
            peak: 0.08,
            reference_age: 8752.0,
        }
    }
}

/// A vehicle's own mission: rows from where it starts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct OwnMission {
    /// The rows: the first begins at the start and runs along the vehicle's heading there.
    pub rows: Rows,
    /// What it holds on them.
    pub vertical: Vertical,
}

/// How a vehicle's own computer answers who asks to drive it. Times are seconds since tick 0; 0 is never.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Handover {
    /// How long it takes to give way, s.
    pub after: f64,
    /// Whether it refuses.
    pub refuses: bool,
    /// Whether it never answers.
    pub silent: bool,
    /// When it stops listening for a while, and for how long.
    pub suspends: f64,
    /// For so long.
    pub lasting: f64,
    /// When it takes control back from who drives by then.
    pub takes_back: f64,
    /// From when on it offers to be driven.
    pub offers: f64,
}

/// A vehicle that follows its commands at once but for limits on its rates: no forces.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct KinematicVehicle {
    /// Where it starts. Default the frame's origin.
    pub start: Point,
    /// Each seed starts somewhere else, evenly in a disc of this radius about `start`, m. Default 0: all there.
    pub start_spread: f64,
    /// Its heading at the start. Default north.
    pub heading: Heading,
    /// Its depth at the start, m. Default 0.
    pub depth: f64,
    /// Its greatest speed through the water, m/s. Default 2.6 (REMUS 100).
    pub speed_max: f64,
    /// Its greatest rate of turn, rad/s. Default 10 degrees a second.
    pub turn_rate: f64,
    /// Time constant with which the heading closes a small error, s. Default 0.2: the command filter's is before it.
    pub heading_time: f64,
    /// Its greatest change of speed, m/s2. Default 0.25.
    pub acceleration: f64,
    /// Its greatest rate of climb and dive, m/s. Default 0.5.
    pub depth_rate: f64,
    /// Standard deviation of its wobble about a commanded altitude, m. Default 0: none.
    pub altitude_jitter: f64,
    /// The wobble never exceeds this, m. Default 0.7 (the 2005 paper's, Sec. IV).
    pub altitude_jitter_max: f64,
    /// Correlation time of the wobble, s. Default 10.
    pub altitude_jitter_time: f64,
    /// How long the battery lasts, s; its charge falls linearly. Default 22 h (REMUS 100).
    pub endurance: f64,
}

impl Default for KinematicVehicle {
    fn default() -> Self {
        KinematicVehicle {
            start: Point::ORIGIN,
            start_spread: 0.0,
            heading: Heading::NORTH,
            depth: 0.0,
            speed_max: 2.6,
            turn_rate: 10.0 * PI / 180.0,
            heading_time: 0.2,
            acceleration: 0.25,
            depth_rate: 0.5,
            altitude_jitter: 0.0,
            altitude_jitter_max: 0.7,
            altitude_jitter_time: 10.0,
            endurance: 22.0 * 3600.0,
        }
    }
}

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
