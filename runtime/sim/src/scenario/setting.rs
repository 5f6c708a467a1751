//! The clauses of a scenario by their names in a script, and what each sets in the world.

use super::Scenario;
use crate::craft::fault::Fault;
use crate::craft::sensors::InstrumentSetting;
use crate::craft::setup::VehicleSetup;
use crate::craft::setup::{OwnRows, OwnWaypoints};
use crate::world::bottom::{Ground, NoGo, Pit, Plane};
use crate::world::plume::{Leak, Patch};
use crate::world::plume::{Plume, Source};
use crate::world::stratification::Stratification;
use crate::world::water::MeanFlow;
use crate::world::water::{Tide, UpperFlow, Waves};
use albacore_front_seat::Handover;
use albacore_geometry::Area;
use albacore_vehicle::Limits;
use serde::Deserialize;

/// A clause of a scenario. Its parameters, their units, defaults and ranges are declared in the standard library.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
#[allow(missing_docs, reason = "the standard library says what each clause is")]
pub enum Setting {
    Flow(MeanFlow),
    Turning {
        rate: f64,
    },
    Tide(Tide),
    Waves(Waves),
    UpperLayer(UpperFlow),
    Stratification(Stratification),
    Region {
        area: Area,
    },
    Bottom(Plane),
    Pit(Pit),
    NoGo(NoGo),
    Plume(Plume),
    Source(Source),
    Leak(Leak),
    Patch(Patch),
    Vehicle(VehicleSetup),
    Limits(Limits),
    Rows(OwnRows),
    Waypoints(OwnWaypoints),
    Handover(Handover),
    Fault(Fault),
    /// A clause of an instrument, which the register of instruments names.
    #[serde(skip)]
    Instrument(InstrumentSetting),
}

impl Scenario {
    /// Takes in a clause. What there is one of is as the last clause says.
    pub fn set(&mut self, setting: Setting) {
        match setting {
            Setting::Flow(flow) => (self.flow.mean, self.flow.meander) = flow.into(),
            Setting::Turning { rate } => self.flow.turning = rate,
            Setting::Tide(tide) => self.flow.tides.push(tide),
            Setting::Waves(waves) => self.flow.waves = Some(waves),
            Setting::UpperLayer(upper) => self.flow.upper = Some(upper),
            Setting::Stratification(stratification) => self.stratification = stratification,
            Setting::Region { area } => self.region = Some(area),
            Setting::Bottom(plane) => self.bottom.ground = Ground::Plane(plane),
            Setting::Pit(pit) => self.bottom.pits.push(pit),
            Setting::NoGo(zone) => self.no_go.push(zone),
            Setting::Plume(plume) => self.plume = Some(plume),
            Setting::Source(source) => self.sources.push(source),
            Setting::Leak(leak) => self.sources.push(leak.into()),
            Setting::Patch(patch) => self.patches.push(patch),
            Setting::Vehicle(vehicle) => self.vehicle = vehicle,
            Setting::Limits(limits) => self.limits = Some(limits),
            Setting::Rows(rows) => self.own_mission = Some(rows.into()),
            Setting::Waypoints(waypoints) => self.own_mission = Some(waypoints.into()),
            Setting::Handover(handover) => self.handover = Some(handover),
            Setting::Fault(fault) => self.faults.push(fault),
            Setting::Instrument(instrument) => self.instruments.set(instrument),
        }
    }
}
