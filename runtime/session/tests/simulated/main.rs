//! Runs in the simulator: one binary, which links in the time of one. `digest.rs` is run under three profiles, `live.rs` waits for the
//! clock.

mod bottom;
mod compatibility;
mod delay;
mod flood;
mod intermittency;
mod journal;
#[path = "../library/mod.rs"]
mod library;
mod noise;
mod payload;
mod played;
mod profiler;
mod recorded;
mod recording;
mod replay;
mod sink;
mod sounding;
mod station;
mod watch;
