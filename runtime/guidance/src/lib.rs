//! How a vehicle is steered: to a point, along a line, onto a pose, round a circle, and through a current.
//!
//! Everything here is a pure function of a small state that the caller keeps, and each state can be taken apart into
//! plain numbers and put together again. Courses are over ground, headings clockwise from north, in radians, metres
//! and seconds. There is no clock: what must be limited in time is limited in metres driven. The laws are those of
//! appendix A of J. A. Farrell, S. Pang and W. Li, "Chemical plume tracing via an autonomous underwater vehicle",
//! IEEE J. Oceanic Eng. 30 (2005), called the 2005 paper below; where they are mended, the file says so.

mod compensate;
pub mod dubins;
mod filter;
mod follow;
mod goto;
mod goto_pose;
mod law;
mod loiter;
pub mod parameters;
mod route;
mod rows;
mod station;
mod words;

pub use compensate::{ThroughWater, through_water};
pub use filter::CommandFilter;
pub use follow::FollowLine;
pub use goto::Goto;
pub use goto_pose::GotoPose;
pub use law::{Args, Guidance, Law, LawOverWords, Start, cross_track};
pub use loiter::{Circling, Loiter};
pub use parameters::{turning_radius, turning_radius_in_flow};
pub use route::{Route, UnderWay, Waypoints};
pub use rows::Rows;
pub use station::{Station, Stay, Whereabouts};
