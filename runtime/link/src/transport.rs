//! Bytes over a wire. Nothing here waits longer than it was told to, and what the other end does not take is lost, as on a wire.

mod faulty;
mod tty;
mod udp;

use crate::error::LinkError;
use crate::url::{Place, Url};
pub use faulty::{Faulty, LinkFault};
use nix::errno::Errno;
use nix::poll::{PollFd, PollFlags, poll};
use std::os::fd::RawFd;
use std::time::Duration;

/// The most that one look takes in, so that who babbles cannot hold us.
const LOOK_BYTES: usize = 64 * 1024;

/// A wire with another end.
pub trait Transport {
    /// Adds the bytes that have come to `into`; when there are none, waits for some, at most for `wait`.
    fn receive(&mut self, into: &mut Vec<u8>, wait: Duration) -> Result<(), LinkError>;

    /// Sends whole messages. An error is for ever: what only gets lost is none.
    fn send(&mut self, messages: &[u8]) -> Result<(), LinkError>;

    /// Why what was sent last was not even taken, if the system said so.
    fn trouble(&self) -> Option<&str> {
        None
    }

    /// From here on, and until it is let go, nobody is heard but who was heard last. A line has one other end anyway.
    fn hold(&mut self, _held: bool) {}
}

impl<T: Transport + ?Sized> Transport for Box<T> {
    fn receive(&mut self, into: &mut Vec<u8>, wait: Duration) -> Result<(), LinkError> {
        (**self).receive(into, wait)
    }

    fn send(&mut self, messages: &[u8]) -> Result<(), LinkError> {
        (**self).send(messages)
    }

    fn trouble(&self) -> Option<&str> {
        (**self).trouble()
    }

    fn hold(&mut self, held: bool) {
        (**self).hold(held);
    }
}

/// Opens a link to a vehicle.
pub fn call(url: &Url) -> Result<Box<dyn Transport + Send>, LinkError> {
    let dialect = url.dialect;
    match &url.place {
        Place::Serial(path, baud) => Ok(Box::new(tty::Tty::open(path, *baud, &dialect.framing)?)),
        Place::Udp { host, port: 0, .. } => Err(LinkError::new(
            format!("no vehicle can be called at port 0 of `{host}`"),
            format!(
                "write the port at which it listens: `albacore vehicle` prints its own, real ones mostly use {}",
                dialect.udp_port
            ),
        )),
        Place::Udp { host, port, local } => Ok(Box::new(udp::Udp::call(host, *port, *local, &dialect.framing)?)),
        Place::Pty => Err(LinkError::new(
            "`pty:` makes a new terminal, at which no vehicle waits",
            format!("open the one that `albacore vehicle` has made: `serial:/dev/pts/N?dialect={dialect}`"),
        )),
    }
}

/// Opens the vehicle's end of a link, and says where the other end finds it.
pub fn serve(url: &Url) -> Result<(Box<dyn Transport + Send>, String), LinkError> {
    let dialect = url.dialect;
    match &url.place {
        Place::Serial(path, baud) => Ok((Box::new(tty::Tty::open(path, *baud, &dialect.framing)?), url.to_string())),
        Place::Udp { host, port, .. } => {
            let (udp, at) = udp::Udp::serve(host, *port, &dialect.framing)?;
            Ok((Box::new(udp), format!("udp:{at}?dialect={dialect}")))
        }
        Place::Pty => {
            let (tty, path) = tty::Tty::pair(&dialect.framing)?;
            Ok((Box::new(tty), format!("serial:{path}?dialect={dialect}")))
        }
    }
}

/// Waits until a descriptor can be read, or for a while. A signal may end the wait early.
fn wait_for(descriptor: RawFd, wait: Duration) {
    let ms = i32::try_from(wait.as_millis()).unwrap_or(i32::MAX);
    if ms > 0 {
        // What is wrong with the descriptor the next read tells.
        let _ = poll(&mut [PollFd::new(descriptor, PollFlags::POLLIN)], ms);
    }
}

/// Whether a call only has to be made again later.
fn is_for_later(error: Errno) -> bool {
    matches!(error, Errno::EAGAIN | Errno::EINTR)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_vehicle_is_called_where_none_can_be() {
        for (url, why) in [("pty:?dialect=recon", "no vehicle waits"), ("udp:127.0.0.1:0?dialect=recon", "port 0")] {
            let error = call(&Url::parse(url).unwrap()).err().unwrap();
            assert!(error.message.contains(why), "{error}");
        }
    }
}
