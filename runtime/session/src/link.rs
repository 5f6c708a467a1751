//! A vehicle at the end of a link, for a mission that lies on the globe.

use crate::plan::Plan;
use albacore_link::{HostClock, LinkError, LinkVehicle, Url, call as open};
use albacore_vehicle::Vehicle;

/// An open link to a vehicle, not yet heard.
pub type Called = Box<dyn Vehicle + Send>;

/// Opens a link to a vehicle, whose positions are given in the plan's frame. `rate` is how many times faster than real time the
/// vehicle runs; the clock is the host's, and tells no more than how long the vehicle has been silent.
pub fn call(url: &Url, plan: &Plan, rate: f64, clock: HostClock) -> Result<Called, LinkError> {
    let frame = plan.frame().ok_or_else(|| {
        LinkError::new("the mission has no place on the globe", "give its area as latitude and longitude")
    })?;
    let transport = open(url)?;
    Ok(Box::new(LinkVehicle::new(url.clone(), transport, frame, rate, clock)?))
}
