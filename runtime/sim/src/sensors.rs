//! What the vehicle's instruments make of the truth.

mod fluorometer;
mod position;
mod profiler;
mod sounder;

pub use fluorometer::Fluorometer;
pub use position::Positioning;
pub use profiler::{Profiler, View};
pub use sounder::EchoSounder;
