//! What the vehicle's instruments make of the truth.

mod battery;
mod compass;
mod ctd;
mod delay;
mod dvl;
mod fluorometer;
mod position;
mod pressure;
mod profiler;
mod rate;
mod sounder;

pub use battery::Battery;
pub use compass::Compass;
pub use ctd::Ctd;
pub use dvl::Dvl;
pub use fluorometer::Fluorometer;
pub use position::Positioning;
pub use pressure::Pressure;
pub use profiler::{Profiler, View};
pub use sounder::EchoSounder;
