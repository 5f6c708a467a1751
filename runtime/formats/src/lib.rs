//! Files of data: from their bytes to what they say, whole, or to all that is wrong with them.
//!
//! [`survey`] reads the depths of a survey of the bottom, [`area`] the polygons that charting programs save, [`recording`] a plume that was computed
//! elsewhere, [`series`] a column of what a run recorded. Whatever the bytes are, reading them ends, and takes no more room than a small multiple of theirs.

pub mod alog;
pub mod area;
mod fault;
pub mod recording;
pub mod series;
pub mod survey;

pub use fault::{Fault, Unreadable};

/// What is wrong with a file of data.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileFault {
    /// What is wrong, with the path.
    pub message: String,
    /// How to mend it.
    pub help: Option<String>,
}
