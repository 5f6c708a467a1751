//! The `recon` dialect: what the control computers of REMUS-class vehicles speak with a guest computer.
//!
//! It is "recon-style": the vendor's document was not used. Its facts come from three public controllers that agree with each
//! other, and from the 2003 paper (Arrieta, Farrell, Li & Pang, OMAE2003-37273), which says what it is for; where these are
//! silent the choice is ours and said so. `docs/links.md` tells the rest.

mod allowance;
mod clocks;
mod controller;
mod fields;
mod frame;
mod goal;
mod grounding;
mod happening;
mod message;
mod mode;
mod round_trip;
mod seawater;
mod server;
mod vehicle;
mod vehicle_time;

pub use albacore_front_seat::Milestone;
pub use albacore_guidance::{Route, Rows};
pub use controller::{Controller, Count};
pub use frame::{Deframer, LINE_MAX, Unreadable, seal};
pub use happening::Happening;
pub use message::{Adcp, Ctd, FromVehicle, Malformed, SpeedGoal, State, ToVehicle};
pub use mode::{Mode, Phase};
pub use round_trip::Moment;
pub use server::Server;
pub use vehicle::{HostClock, ReconVehicle};
