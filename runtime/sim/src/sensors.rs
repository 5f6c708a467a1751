//! What the vehicle's instruments make of the truth.

mod fluorometer;
mod position;
mod profiler;

pub use fluorometer::Fluorometer;
pub use position::Positioning;
pub use profiler::{Profiler, View};
