//! Where the vehicle is and how the water moves, from what its sensors say.
//!
//! [`FlowEstimate`] averages the Doppler profiler's view of the current, [`DeadReckoning`] integrates velocity over ground
//! between acoustic fixes. Both are the 2005 paper's (App. B, Sec. IV). [`HealthMonitor`] watches whether what is told can be true, and
//! [`Trust`] lets a mission have what can be believed of it. No noise, no clock: pure functions of what they hear.

mod dead_reckoning;
mod flow_estimate;
mod gate;
mod health;
mod sounding;
mod trust;

pub use dead_reckoning::DeadReckoning;
pub use flow_estimate::{AdcpMessage, BodyVelocity, FlowEstimate, FlowGates, Verdict};
pub use health::{Anomaly, AnomalyEvent, HealthMonitor};
pub use trust::Trust;
