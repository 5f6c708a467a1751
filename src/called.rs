//! A vehicle at the end of a link, called for a mission of a script.

use crate::clock::now;
use crate::exit::Exit;
use crate::message;
use crate::plan::refused;
use crate::vehicle::told;
use albacore_session::{Called, HostClock, Plan, Script, WrittenUrl};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

/// The plan for a vehicle at the end of a link, and the link to it, which is open.
pub struct Call {
    /// What is run.
    pub plan: Plan,
    /// The vehicle, not yet heard.
    pub vehicle: Called,
    /// Where it is, and what it speaks.
    pub url: String,
}

impl Call {
    /// Opens a link as it is written. `rate` is how many times faster than real time the vehicle runs. What is in the way has been said.
    pub fn open(
        script: &Script,
        path: &Path,
        mission: Option<&str>,
        link: &str,
        rate: Option<f64>,
    ) -> Result<Self, Exit> {
        let refused = |error| refused(&error);
        let usage = |error| told(&error, Exit::Usage);
        let url = WrittenUrl::parse(link).map_err(usage)?;
        let file = path.display().to_string();
        let speaks = if url.is_silent() { Plan::dialect(script, &file, mission).map_err(refused)? } else { None };
        let url = url.of_vehicle(speaks).map_err(usage)?;
        let plan = Plan::on_link(script, &file, mission, &url.to_string()).map_err(refused)?;
        let vehicle = albacore_session::call(&url, &plan, rate.unwrap_or(1.0), host_clock())
            .map_err(|error| told(&error, Exit::Failed))?;
        message::write(&message::line(&format!("link open to {url}")));
        Ok(Call { plan, vehicle, url: url.to_string() })
    }

    /// Waits until the vehicle is heard, which nothing is asked of yet.
    pub fn hear(&mut self, interrupted: &AtomicBool) -> Result<(), Exit> {
        while !interrupted.load(Ordering::Relaxed) {
            match self.vehicle.ready() {
                Ok(true) => return Ok(()),
                Ok(false) => {}
                Err(error) => {
                    message::error(&error.to_string(), None);
                    return Err(Exit::Failed);
                }
            }
        }
        message::error("interrupted before the vehicle was heard", None);
        Err(Exit::NotWell)
    }
}

/// The time of the machine that runs the mission.
fn host_clock() -> HostClock {
    Box::new(now)
}
