//! A simulated world with a vehicle in it that is served to others: the far end of a link.

use crate::faults::Faults;
use crate::plan::PlanError;
use crate::scenario;
use albacore_geometry::TangentFrame;
use albacore_lang::Script;
use albacore_link::{Dialect, LinkError, Route, Rows, Server, Url};
use albacore_sim::{Scenario, Simulator};
use albacore_vehicle::Vertical;
use std::sync::Arc;

/// A vehicle at the surface swims its rows this far above the bottom, m.
const ROWS_ALTITUDE: f64 = 2.0;

/// A scenario with a place on the globe, and what its vehicle speaks.
#[derive(Clone, Debug)]
pub struct ServedVehicle {
    /// Its name.
    pub name: String,
    /// What its vehicle speaks, if that is said.
    pub dialect: Option<&'static Dialect>,
    scenario: Arc<Scenario>,
    frame: TangentFrame,
}

/// A simulated vehicle and the computer in its front seat.
pub type FarEnd = Server<Simulator>;

impl ServedVehicle {
    /// A scenario that the script knows, by its name, else the one that the script's mission runs in. It lies where that
    /// mission lies, else where its own positions are.
    pub fn new(script: &Script, file: &str, wanted: Option<&str>) -> Result<Self, PlanError> {
        let own = |mission: &albacore_lang::MissionInfo| mission.scenario.clone();
        let known: Vec<&str> = script.scenarios().collect();
        let Some(wanted) = wanted.map(str::to_string).or_else(|| script.missions().find_map(own)) else {
            let help = format!("name it: `{file}#NAME`; there is {}", known.join(", "));
            return Err(PlanError::Asked(format!("which scenario of `{file}` is to be served?"), Some(help)));
        };
        let (lowered, understood) = scenario::named(script, &wanted, scenario::place_of(script, &wanted)?)?;
        let Some(origin) = lowered.origin else {
            let help =
                "give its `start:` as latitude and longitude, or serve it from a script with a mission that runs in it";
            return Err(PlanError::Asked(
                format!("the scenario `{wanted}` has no place on the globe"),
                Some(help.into()),
            ));
        };
        let (scenario, dialect) = (Arc::new(understood.world), understood.dialect);
        Ok(ServedVehicle { name: lowered.name, dialect, scenario, frame: TangentFrame { origin } })
    }

    /// The same with faults added to those of the scenario.
    pub fn with_faults(self, faults: &Faults) -> Result<Self, PlanError> {
        Ok(ServedVehicle { scenario: faults.in_scenario(self.scenario)?, ..self })
    }

    /// The vehicle in it at the end of a link, with rows to swim, else the mission of the scenario, else rows all the same: the first from where it
    /// starts and along its heading, at the depth at which it starts, or near the bottom if that is the surface.
    pub fn far_end(&self, url: &Url, seed: u64, rows: Option<Rows>) -> Result<FarEnd, PlanError> {
        let side = (url.dialect.server)(&url.settings)
            .map_err(|LinkError { message, help }| PlanError::Asked(message, Some(help)))?;
        // Its computer is the front seat's: the simulated one gives way to that at once.
        let handover = self.scenario.handover.clone().unwrap_or_default();
        let scenario = Scenario { handover: None, ..(*self.scenario).clone() };
        let simulator = Simulator::new(&scenario, seed).map_err(|error| scenario::cannot_begin(&error))?;
        let vehicle = &self.scenario.vehicle;
        let own = self.scenario.own_mission.as_ref();
        let vertical = match (own, vehicle.depth) {
            (Some(own), _) => own.vertical,
            (None, depth) if depth > 0.0 => Vertical::Depth(depth),
            _ => Vertical::Altitude(ROWS_ALTITUDE),
        };
        let route = rows.map(Route::Rows).or(own.map(|own| own.route.clone())).unwrap_or_default();
        let start = simulator.truth().position;
        let far_end = Server::new(side, simulator, self.frame, &route, (start, vehicle.heading), vertical);
        Ok(far_end.answering(handover))
    }
}
