//! The vehicle: its hull, its instruments, and what of both can fail.

pub(crate) mod fault;
pub mod hull;
pub(crate) mod incidents;
pub(crate) mod payload;
pub(crate) mod sensors;
pub(crate) mod setup;
pub(crate) mod start;
