//! Where the vehicle is and how the water moves, from what its sensors say.
//!
//! A [`Navigator`] estimates the position, in simulation and on a link: [`DeadReckoning`] integrates velocity over ground
//! between acoustic fixes. [`FlowEstimate`] averages the Doppler profiler's view of the current. Both are the 2005 paper's (App. B, Sec. IV). [`ukf`] is the unscented Kalman filter. [`HealthMonitor`] watches whether what is told can be true, and
//! [`Trust`] lets a mission have what can be believed of it. No noise, no clock: pure functions of what they hear.

mod flow_estimate;
mod gate;
mod health;
mod navigator;
mod navigators;
mod places;
mod sounding;
mod trust;
pub mod ukf;

pub use flow_estimate::{AdcpMessage, BodyVelocity, FlowEstimate, FlowGates, Verdict};
pub use health::{Anomaly, AnomalyEvent, HealthMonitor};
pub use navigator::{Estimate, Fix, Navigator, Raw, Sensed};
pub use navigators::{
    DeadReckoning, Departure, ErrorEllipse, Inertial, InertialSettings, NavigatorSetup, Nis, Reported,
};
pub use trust::Trust;
