//! The link to a real vehicle: where it goes, how bytes travel, and what they mean.
//!
//! A [`Url`] names a transport and a dialect. A [`Transport`] carries bytes over a serial line, a pseudo terminal or UDP; it
//! is the only part that touches the operating system. A dialect is a pair of state machines, the controller's and the
//! vehicle's, that are pure functions of the bytes that come and the ticks that pass: [`recon`].

mod error;
pub mod recon;
mod transport;
mod url;

pub use error::LinkError;
pub use transport::{Faulty, LinkFault, Transport, call, serve};
pub use url::{Dialect, Place, Url, WrittenUrl};
