//! The link to a vehicle: where it goes, how bytes travel, what they mean, and who drives.
//!
//! A [`Url`] names a transport and a [`Dialect`]. A [`Transport`] carries bytes over a serial line, a pseudo terminal or UDP; it
//! is the only part that touches the operating system. The [`Controller`] and the [`Server`] are the two ends of a link, whatever
//! is spoken on it: pure functions of the bytes that come and the ticks that pass. What the bytes mean is a dialect's to say, by a
//! [`ControllerSide`] and a [`ServerSide`]; [`dialects`] is the table of them. A [`LinkVehicle`] is a controller on a transport.

mod controller;
mod dialect;
pub mod dialects;
mod error;
mod grounding;
mod port;
mod server;
mod set_point;
mod status;
mod transport;
mod url;

pub use albacore_front_seat::Milestone;
pub use albacore_guidance::{Route, Rows};
pub use controller::{Controller, ControllerMessage, ControllerSide, Count, Received};
pub use dialect::{Dialect, Framing, Settings};
pub use dialects::recon;
pub use error::LinkError;
pub use port::{HostClock, LinkVehicle};
pub use server::{Goal, Refusal, Report, Request, Senses, Server, ServerEvent, ServerSide, StateReport};
pub use set_point::SetPoint;
pub use status::{Phase, Status};
pub use transport::{Faulty, LinkFault, Transport, call, serve};
pub use url::{Place, Url, WrittenUrl};
