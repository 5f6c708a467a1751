//! Which scenarios are impossible, and how that is said.

use crate::plume::{SPIN_UP_STEP_S, spin_up_begin};
use crate::scenario::Scenario;
use crate::water::{FlowFrame, mesh_fault};
use albacore_geometry::{Area, Vector};
use albacore_vehicle::TICK_S;

/// Why a scenario cannot be simulated: every fault found in it.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", faults.join("; "))]
pub struct ScenarioError {
    /// One sentence each, naming the field at fault.
    pub faults: Vec<String>,
}

/// Collects the faults of a scenario.
#[derive(Default)]
struct Faults(Vec<String>);

impl Faults {
    fn unless(&mut self, holds: bool, fault: impl Into<String>) {
        if !holds {
            self.0.push(fault.into());
        }
    }

    fn positive(&mut self, name: &str, value: f64) {
        self.unless(value > 0.0 && value.is_finite(), format!("`{name}` is {value}: it must be above 0"));
    }

    fn not_negative(&mut self, name: &str, value: f64) {
        self.unless(value >= 0.0 && value.is_finite(), format!("`{name}` is {value}: it must be 0 or more"));
    }

    fn flow(&mut self, name: &str, flow: Vector) {
        let speed = flow.length();
        self.unless(speed <= FLOW_MAX, format!("`{name}` is {speed} m/s: it must be {FLOW_MAX} m/s at most"));
    }

    fn finite(&mut self, name: &str, values: [f64; 2]) {
        self.unless(values.iter().all(|v| v.is_finite()), format!("`{name}` is not a finite number"));
    }
}

impl Scenario {
    /// Lists impossible physics, all of it at once.
    pub fn validate(&self) -> Result<(), ScenarioError> {
        let mut faults = Faults::default();
        self.check_water(&mut faults);
        // What follows looks at the region and the flow's direction.
        if faults.0.is_empty() {
            self.check_meander(&mut faults);
            self.check_plume(&mut faults);
            self.check_sources(&mut faults);
        }
        self.check_vehicle(&mut faults);
        self.check_sensors(&mut faults);
        if faults.0.is_empty() { Ok(()) } else { Err(ScenarioError { faults: faults.0 }) }
    }

    fn check_water(&self, faults: &mut Faults) {
        faults.flow("flow.mean", self.flow.mean);
        if let Some(upper) = &self.flow.upper {
            faults.flow("flow.upper.mean", upper.mean);
            faults.not_negative("flow.upper.above", upper.above);
        }
        faults.positive("bottom.from", self.bottom.from);
        faults.positive("bottom.to", self.bottom.to);
        faults.positive("bottom.across", self.bottom.across);
        faults.finite("bottom.toward", [self.bottom.toward.radians(), 0.0]);
        for pit in &self.bottom.pits {
            let name = &pit.name;
            faults.finite(&format!("pit {name}: at"), [pit.at.north, pit.at.east]);
            // A pit only deepens, so that the water is nowhere shallower than the plane.
            faults.positive(&format!("pit {name}: depth"), pit.depth);
            faults.positive(&format!("pit {name}: radius"), pit.radius);
        }
        // An area that was read from a file has not met its constructor.
        if let Some(Err(error)) = self.region.as_ref().map(|region| Area::polygon(region.corners())) {
            faults.0.push(format!("`region`: {error}"));
        }
    }

    fn check_meander(&self, faults: &mut Faults) {
        let Some(meander) = &self.flow.meander else { return };
        let before = faults.0.len();
        faults.unless(self.region.is_some(), "`flow.meander` needs a `region`: the flow wanders on a grid over it");
        faults.unless(self.flow.mean.length() > 0.0, "`flow.meander` needs a mean flow: `flow.mean` is 0");
        faults.unless(
            (0.0..=DIRECTION_SD_MAX).contains(&meander.direction_sd),
            format!("`flow.meander.direction_sd` is {} rad: it must be 0 to {DIRECTION_SD_MAX}", meander.direction_sd),
        );
        faults.positive("flow.meander.period", meander.period);
        faults.unless(
            meander.damping > 0.0 && meander.damping < 1.0,
            format!("`flow.meander.damping` is {}: it must be between 0 and 1", meander.damping),
        );
        faults.positive("flow.meander.viscosity", meander.viscosity);
        faults.positive("flow.meander.cell", meander.cell);
        faults.not_negative("flow.meander.margin", meander.margin);
        let least = self.plume.as_ref().map_or(0.0, |plume| plume.step).max(SPIN_UP_STEP_S / 2.0);
        faults.unless(
            meander.step >= least && meander.step <= FLOW_STEP_MAX_S,
            format!("`flow.meander.step` is {} s: it must be {least} to {FLOW_STEP_MAX_S}", meander.step),
        );
        if faults.0.len() == before {
            let frame = FlowFrame::new(&self.flow, self.region.as_ref());
            faults.0.extend(mesh_fault(meander, &frame, self.flow.mean.length()));
        }
    }

    fn check_plume(&self, faults: &mut Faults) {
        let Some(plume) = &self.plume else { return };
        faults.unless(self.region.is_some(), "`plume` needs a `region`: its filaments live there");
        faults.unless(self.flow.mean.length() > 0.0, "`plume` needs a flow to carry it: `flow.mean` is 0");
        faults.not_negative("plume.growth", plume.growth);
        faults.positive("plume.initial_radius", plume.initial_radius);
        faults.not_negative("plume.diffusivity", plume.diffusivity);
        faults.not_negative("plume.vertical", plume.vertical);
        match plume.layer {
            Some(layer) => {
                faults.positive("plume.layer", layer);
                let farthest = LARGEST_DRAW * (2.0 * plume.vertical * SPIN_UP_STEP_S).sqrt();
                faults.unless(
                    farthest <= layer || layer <= 0.0,
                    format!("`plume.vertical` mixes a `plume.layer` of {layer} m within seconds: leave both out for a flat plume"),
                );
            }
            None => faults.unless(
                plume.vertical <= 0.0,
                "`plume.vertical` needs a `plume.layer`: the height that holds the plume",
            ),
        }
        let ticks = plume.step / TICK_S;
        faults.unless(
            plume.step >= TICK_S && plume.step <= SPIN_UP_STEP_S && (ticks - ticks.round()).abs() < 1e-9,
            format!(
                "`plume.step` is {} s: it must be a whole number of ticks of {TICK_S} s, {SPIN_UP_STEP_S} s at most",
                plume.step
            ),
        );
    }

    fn check_sources(&self, faults: &mut Faults) {
        faults.unless(
            self.sources.is_empty() || self.plume.is_some(),
            "`sources` need a `plume`: without one nothing spreads",
        );
        let before = faults.0.len();
        for source in &self.sources {
            let name = &source.name;
            faults.finite(&format!("source {name}: at"), [source.at.north, source.at.east]);
            faults.not_negative(&format!("source {name}: height"), source.height);
            faults.positive(&format!("source {name}: rate"), source.rate);
            faults.positive(&format!("source {name}: peak"), source.peak);
            faults.not_negative(&format!("source {name}: reference_age"), source.reference_age);
            if let Some(region) = &self.region {
                let gap = region.gap(source.at);
                faults.unless(gap >= 0.0, format!("source `{name}` is {:.1} m outside the `region`", -gap));
            }
            if let Some(layer) = self.plume.as_ref().and_then(|plume| plume.layer) {
                faults.unless(
                    source.height <= layer,
                    format!(
                        "source `{name}` is {} m above the bottom, over the `plume.layer` of {layer} m",
                        source.height
                    ),
                );
            }
        }
        if faults.0.len() == before && self.plume.is_some() && self.flow.mean.length() > 0.0 {
            let transit = -spin_up_begin(self);
            let filaments = transit * self.sources.iter().map(|source| source.rate).sum::<f64>();
            faults.unless(
                transit <= SPIN_UP_MAX_S,
                format!("`flow.mean` is so slow that the plume takes {transit:.0} s to cross the region: at most {SPIN_UP_MAX_S} s are simulated"),
            );
            faults.unless(
                filaments <= FILAMENTS_MAX,
                format!("the sources' `rate` makes about {filaments:.0} filaments at a time: at most {FILAMENTS_MAX} are simulated"),
            );
        }
    }

    fn check_vehicle(&self, faults: &mut Faults) {
        let v = &self.vehicle;
        faults.finite("vehicle.start", [v.start.north, v.start.east]);
        faults.finite("vehicle.heading", [v.heading.radians(), 0.0]);
        faults.not_negative("vehicle.start_spread", v.start_spread);
        faults.not_negative("vehicle.depth", v.depth);
        // Where the start is scattered it may be anywhere: as shallow as the plane ever is.
        let water =
            if v.start_spread > 0.0 { self.bottom.from.min(self.bottom.to) } else { self.bottom.depth_at(v.start) };
        faults.unless(
            v.depth <= water || !water.is_finite(),
            format!(
                "`vehicle.depth` is {} m where the water is {water} m deep: the vehicle starts below the bottom",
                v.depth
            ),
        );
        for (name, value) in [
            ("vehicle.speed_max", v.speed_max),
            ("vehicle.turn_rate", v.turn_rate),
            ("vehicle.heading_time", v.heading_time),
            ("vehicle.acceleration", v.acceleration),
            ("vehicle.depth_rate", v.depth_rate),
            ("vehicle.altitude_jitter_time", v.altitude_jitter_time),
            ("vehicle.endurance", v.endurance),
        ] {
            faults.positive(name, value);
        }
        faults.not_negative("vehicle.altitude_jitter", v.altitude_jitter);
        faults.not_negative("vehicle.altitude_jitter_max", v.altitude_jitter_max);
    }

    fn check_sensors(&self, faults: &mut Faults) {
        if let Some(navigation) = &self.navigation {
            faults.not_negative("navigation.walk", navigation.walk);
            if let Some(lbl) = &navigation.lbl {
                faults.unless(
                    lbl.every >= TICK_S && lbl.every.is_finite(),
                    format!(
                        "`navigation.lbl.every` is {} s: fixes cannot come more often than every tick of {TICK_S} s",
                        lbl.every
                    ),
                );
                faults.not_negative("navigation.lbl.sigma", lbl.sigma);
                faults.not_negative("navigation.lbl.gate", lbl.gate);
            }
        }
        let fluorometer = &self.fluorometer;
        faults.unless(
            fluorometer.rate > 0.0 && fluorometer.rate <= FLUOROMETER_RATE_MAX,
            format!(
                "`fluorometer.rate` is {} Hz: it must be above 0 and at most {FLUOROMETER_RATE_MAX}",
                fluorometer.rate
            ),
        );
        faults.not_negative("fluorometer.noise", fluorometer.noise);
        faults.not_negative("fluorometer.false_alarms", fluorometer.false_alarms);
        faults.unless(
            fluorometer.false_alarms <= fluorometer.rate,
            "`fluorometer.false_alarms` exceeds `fluorometer.rate`: a sample gives one alarm at most",
        );
        faults.finite("fluorometer.ahead", [fluorometer.ahead, 0.0]);
        faults.not_negative("adcp.noise", self.adcp.noise);
        faults.not_negative("sounder.noise", self.sounder.noise);
    }
}

/// The fastest flow, m/s: tidal races reach 8.
const FLOW_MAX: f64 = 10.0;
/// The widest meander, rad: beyond it the flow turns round, and the plume with it.
const DIRECTION_SD_MAX: f64 = 1.0;
/// The longest step of the flow field, s.
const FLOW_STEP_MAX_S: f64 = 60.0;
/// The longest spin-up of a plume, s.
const SPIN_UP_MAX_S: f64 = 200_000.0;
/// The most filaments alive, by estimate.
const FILAMENTS_MAX: f64 = 200_000.0;
/// The bound of the diffusion's draws, in standard deviations ([`crate::Noise::nearly_gaussian_pair`]).
const LARGEST_DRAW: f64 = 3.46;
/// A chemical sensor gives at most this many samples a second.
const FLUOROMETER_RATE_MAX: f64 = 1000.0;
