//! A plume that was computed elsewhere, played back. A record knows no heights: its plume is the same at every depth.

mod interval;
mod playback;
mod settings;
#[cfg(test)]
mod tests;

pub use playback::{Playback, Still};
pub use settings::RecordedPlume;
pub(crate) use settings::check;
