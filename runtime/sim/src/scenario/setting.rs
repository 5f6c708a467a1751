//! The clauses of a scenario by their names in a script: those of the environment and of instruments have registers of their own.

use super::Scenario;
use crate::craft::fault::Fault;
use crate::craft::payload::Payload;
use crate::craft::sensors::InstrumentSetting;
use crate::craft::setup::VehicleSetup;
use crate::craft::setup::{OwnRows, OwnWaypoints};
use crate::world::EnvironmentSetting;
use albacore_front_seat::Handover;
use albacore_vehicle::Limits;
use serde::Deserialize;

/// A clause of a scenario. Its parameters, their units, defaults and ranges are declared in the standard library.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
#[allow(missing_docs, reason = "the standard library says what each clause is")]
pub enum Setting {
    Vehicle(VehicleSetup),
    Limits(Limits),
    Rows(OwnRows),
    Waypoints(OwnWaypoints),
    Handover(Handover),
    Payload(Payload),
    Fault(Fault),
    /// A clause of the environment, which the register of the world names.
    #[serde(skip)]
    Environment(EnvironmentSetting),
    /// A clause of an instrument, which the register of instruments names.
    #[serde(skip)]
    Instrument(InstrumentSetting),
}

impl Scenario {
    /// Takes in a clause. What there is one of is as the last clause says.
    pub fn set(&mut self, setting: Setting) {
        match setting {
            Setting::Vehicle(vehicle) => self.vehicle = vehicle,
            Setting::Limits(limits) => self.limits = Some(limits),
            Setting::Rows(rows) => self.own_mission = Some(rows.into()),
            Setting::Waypoints(waypoints) => self.own_mission = Some(waypoints.into()),
            Setting::Handover(handover) => self.handover = Some(handover),
            Setting::Payload(payload) => self.payloads.push(payload),
            Setting::Fault(fault) => self.faults.push(fault),
            Setting::Environment(environment) => self.environment.set(environment),
            Setting::Instrument(instrument) => self.instruments.set(instrument),
        }
    }
}
