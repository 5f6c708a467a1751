//! The `recon` dialect: what the control computers of REMUS-class vehicles speak with a guest computer.
//!
//! It is "recon-style": the vendor's document was not used. Its facts come from three public controllers that agree with each
//! other, and from the 2003 paper (Arrieta, Farrell, Li & Pang, OMAE2003-37273), which says what it is for; where these are
//! silent the choice is ours and said so. `docs/links.md` tells the rest.

mod controller;
mod fields;
mod frame;
mod grounding;
mod instruments;
mod message;
mod mode;
mod server;

pub use frame::{Deframer, LINE_MAX, Unreadable, seal};
pub use instruments::Measured;
pub use message::{Adcp, FromVehicle, Malformed, SpeedGoal, State, ToVehicle};
pub use mode::Mode;

use crate::controller::ControllerSide;
use crate::dialect::{Dialect, Framing};
use crate::server::ServerSide;

/// Its row in the table of dialects.
pub static DIALECT: Dialect = Dialect {
    name: "recon",
    schemes: &["serial", "udp", "pty"],
    // What public controllers set.
    baud: 57_600,
    udp_port: 23_456,
    settings: &[],
    state: "#S",
    // 5 s: public controllers keep it alive at 0.2 Hz at least.
    timeout_ticks: 50,
    framing: Framing {
        longest: LINE_MAX,
        first: |bytes| bytes.iter().position(|byte| *byte == b'\n').map(|at| at + 1),
        end: b"\n",
        is_message: frame::is_message,
    },
    controller: |_| Ok(controller()),
    server: |_| Ok(server()),
};

/// The controller's side.
pub fn controller() -> Box<dyn ControllerSide> {
    Box::new(controller::Controller::default())
}

/// The vehicle's side.
pub fn server() -> Box<dyn ServerSide> {
    Box::new(server::Server::default())
}
