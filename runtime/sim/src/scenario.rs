//! A world in plain numbers: what a scenario file can say, with the values it has when it says nothing.

mod issues;
mod setting;

pub(crate) use issues::{FLOW_MAX, OfClause, ScenarioIssues, number, rounded_down};
pub use issues::{IssueCause, ScenarioError, ScenarioIssue};
pub use setting::Setting;

use crate::craft::fault::{self, Fault};
use crate::craft::payload::{self, Payload};
use crate::craft::sensors::{AtRest, InstrumentSetup};
use crate::craft::setup::{self, OwnMission, VehicleSetup};
use crate::world::{self, Environment};
use albacore_front_seat::Handover;
use albacore_vehicle::{Limits, Measurement};

/// The most clauses of one name in a scenario.
const CLAUSES_MAX: usize = 1024;

/// The world of a simulated run. SI units and radians throughout; points in the mission's tangent frame.
///
/// The default is still water, 20 m deep, without a plume, and a vehicle with perfect sensors of position.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scenario {
    /// All that is there without the vehicle.
    pub environment: Environment,
    /// The vehicle.
    pub vehicle: VehicleSetup,
    /// The vehicle's own limits; none: its hull's speed alone.
    pub limits: Option<Limits>,
    /// The mission that the vehicle swims by itself, while nobody else drives; none: it lies still.
    pub own_mission: Option<OwnMission>,
    /// How it answers who asks to drive; none: it gives way at once.
    pub handover: Option<Handover>,
    /// How its payload answers.
    pub payloads: Vec<Payload>,
    /// Its instruments.
    pub instruments: InstrumentSetup,
    /// What goes wrong. Default nothing.
    pub faults: Vec<Fault>,
}

impl Scenario {
    /// What its vehicle tells.
    pub fn measurements(&self) -> Vec<Measurement> {
        self.instruments.measurements()
    }

    /// What its vehicle makes of commands, whoever gives them: its own limits, and its hull's speed.
    pub fn limits(&self) -> Limits {
        let limits = self.limits.clone().unwrap_or_default();
        let hull = self.vehicle.hull.speed_max();
        Limits { speed: Some(limits.speed.map_or(hull, |speed| speed.min(hull))), ..limits }
    }

    /// Why its vehicle tells no sample of a measurement before it is driven; `None` where nothing keeps it from that, or it swims a
    /// mission of its own.
    pub fn silence_at_start(&self, measurement: &str) -> Option<String> {
        if self.own_mission.is_some() {
            return None;
        }
        let (environment, vehicle) = (&self.environment, &self.vehicle);
        let flow = &environment.flow;
        let upper = flow.upper.as_ref().map_or(0.0, |upper| upper.mean.length());
        let is_even = environment.recording.is_none() && flow.meander.is_none();
        let drift = if is_even { flow.speed().max(upper) } else { f64::INFINITY };
        let altitude = environment.bottom.depth_at(vehicle.start) - vehicle.depth;
        self.instruments.silence(measurement, &AtRest { depth: vehicle.depth, altitude, drift })
    }

    /// Whether there is any chemical to be sensed.
    pub fn has_plume(&self) -> bool {
        self.has_filaments() || !self.environment.spills.is_empty()
    }

    /// Whether there are filaments of a plume: what is carried by the flow.
    pub fn has_filaments(&self) -> bool {
        self.environment.plume.is_some() || self.environment.recording.is_some()
    }

    /// Each of them is looked at whenever the vehicle senses.
    fn check_counts(&self, objections: &mut ScenarioIssues) {
        let counts = self.environment.counts();
        for (clause, count) in
            counts.into_iter().chain([("fault", self.faults.len()), ("payload", self.payloads.len())])
        {
            objections.nth(clause, CLAUSES_MAX.min(count.saturating_sub(1))).unless(
                None,
                count <= CLAUSES_MAX,
                format!("this scenario has {count} clauses `{clause}`: {CLAUSES_MAX} are the most"),
                "leave some out; a bottom of many depths is a grid, `bottom_grid(…)`",
            );
        }
    }

    /// Lists impossible physics, all of it at once: what several numbers come to. That each is within its range, and finite, is the
    /// checker's: ranges stand in the standard library's declarations.
    pub fn validate(&self) -> Result<(), ScenarioError> {
        let mut objections = ScenarioIssues::default();
        self.check_counts(&mut objections);
        if !objections.0.is_empty() {
            return Err(ScenarioError { faults: objections.0 });
        }
        world::check(self, &mut objections);
        setup::check(self, &mut objections);
        let has_transponder = self.environment.transponder.is_some();
        self.instruments.check(has_transponder, &self.vehicle.hull, &mut objections);
        payload::check(self, &mut objections);
        fault::check(self, &mut objections);
        if objections.0.is_empty() { Ok(()) } else { Err(ScenarioError { faults: objections.0 }) }
    }
}
