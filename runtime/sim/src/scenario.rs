//! A world in plain numbers: what a scenario file can say, with the values it has when it says nothing.

mod issues;
mod setting;

pub(crate) use issues::{FLOW_MAX, OfClause, ScenarioIssues, number, rounded_down};
pub use issues::{IssueCause, ScenarioError, ScenarioIssue};
pub use setting::Setting;

use crate::craft::fault::{self, Fault};
use crate::craft::sensors::InstrumentSetup;
use crate::craft::setup::{self, OwnMission, VehicleSetup};
use crate::world::bottom::{self, Bottom, NoGo};
use crate::world::plume::{self, Patch, Plume, Source};
use crate::world::recorded::{self, RecordedPlume};
use crate::world::stratification::{self, Stratification};
use crate::world::water::{self, Flow};
use albacore_front_seat::Handover;
use albacore_geometry::Area;
use albacore_vehicle::{Limits, Measurement};

/// The most clauses of one name in a scenario.
const CLAUSES_MAX: usize = 1024;

/// The world of a simulated run. SI units and radians throughout; points in the mission's tangent frame.
///
/// The default is still water, 20 m deep, without a plume, and a vehicle with perfect sensors of position.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scenario {
    /// Where the flow meanders and filaments live, widened by [`crate::Meander::margin`]. A meander or a plume needs it.
    pub region: Option<Area>,
    /// The water's motion.
    pub flow: Flow,
    /// Its temperature and salinity.
    pub stratification: Stratification,
    /// The water's depth.
    pub bottom: Bottom,
    /// Where the vehicle must not be.
    pub no_go: Vec<NoGo>,
    /// How the chemical spreads; none: the chemical sensor reads only its noise.
    pub plume: Option<Plume>,
    /// What releases chemical.
    pub sources: Vec<Source>,
    /// What was left in the water before the run.
    pub patches: Vec<Patch>,
    /// A plume that was computed elsewhere, and the flow that carries it, instead of those of our own.
    pub recording: Option<RecordedPlume>,
    /// The vehicle.
    pub vehicle: VehicleSetup,
    /// The vehicle's own limits; none: its hull's speed alone.
    pub limits: Option<Limits>,
    /// The mission that the vehicle swims by itself, while nobody else drives; none: it lies still.
    pub own_mission: Option<OwnMission>,
    /// How it answers who asks to drive; none: it gives way at once.
    pub handover: Option<Handover>,
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

    /// Whether there is any chemical to be sensed.
    pub fn has_plume(&self) -> bool {
        self.plume.is_some() || self.recording.is_some()
    }

    /// Each of them is looked at whenever the vehicle senses.
    fn check_counts(&self, objections: &mut ScenarioIssues) {
        let leaks = self.sources.iter().filter(|source| source.to.is_some()).count();
        for (clause, count) in [
            ("tide", self.flow.tides.len()),
            ("pit", self.bottom.pits.len()),
            ("no_go", self.no_go.len()),
            ("source", self.sources.len() - leaks),
            ("leak", leaks),
            ("patch", self.patches.len()),
            ("fault", self.faults.len()),
        ] {
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
        water::check(self, &mut objections);
        stratification::check(self, &mut objections);
        bottom::check(self, &mut objections);
        // An area that was read from a file has not met its constructor.
        if let Some(Err(error)) = self.region.as_ref().map(|region| Area::polygon(region.corners())) {
            let mut of = objections.of("region");
            of.unless(Some("area"), false, error.to_string(), "give its corners one after the other, round it");
        }
        for (i, zone) in self.no_go.iter().enumerate() {
            if let Err(error) = Area::polygon(zone.area.corners()) {
                let mut of = objections.nth("no_go", i);
                of.unless(Some("area"), false, error.to_string(), "give its corners one after the other, round it");
            }
        }
        // What follows looks at the region and the flow's direction.
        if objections.0.is_empty() {
            water::check_meander(self, &mut objections);
            plume::check(self, &mut objections);
            plume::check_sources(self, &mut objections);
            recorded::check(self, &mut objections);
        }
        setup::check(self, &mut objections);
        self.instruments.check(&mut objections);
        fault::check(self, &mut objections);
        if objections.0.is_empty() { Ok(()) } else { Err(ScenarioError { faults: objections.0 }) }
    }
}
