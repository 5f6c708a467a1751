//! UDP, one message a datagram.

use super::{LOOK_BYTES, Transport, wait_for};
use crate::error::LinkError;
use crate::recon::LINE_MAX;
use std::io::ErrorKind;
use std::net::{SocketAddr, ToSocketAddrs, UdpSocket};
use std::os::fd::AsRawFd;
use std::time::Duration;

/// The most that one look takes in, whoever they come from.
const LOOK_DATAGRAMS: usize = LOOK_BYTES / LINE_MAX;

/// A socket, and who is at the other end.
pub struct Udp {
    socket: UdpSocket,
    peer: Option<SocketAddr>,
    /// A vehicle answers whoever spoke last; a controller knows its vehicle.
    serves: bool,
}

impl Udp {
    /// To a vehicle at a host's port, from a port of ours; 0 is any.
    pub fn call(host: &str, port: u16, local: u16) -> Result<Self, LinkError> {
        let peer = resolved(host, port)?;
        let any: SocketAddr = if peer.is_ipv4() { ([0, 0, 0, 0], local).into() } else { ([0_u16; 8], local).into() };
        Ok(Udp { socket: bound(any)?, peer: Some(peer), serves: false })
    }

    /// For controllers, at an address and port of ours; gives where they find us.
    pub fn serve(host: &str, port: u16) -> Result<(Self, SocketAddr), LinkError> {
        let socket = bound(resolved(host, port)?)?;
        let at = socket.local_addr().map_err(|error| unusable(&error.to_string()))?;
        Ok((Udp { socket, peer: None, serves: true }, at))
    }
}

impl Transport for Udp {
    fn receive(&mut self, into: &mut Vec<u8>, wait: Duration) -> Result<(), LinkError> {
        wait_for(self.socket.as_raw_fd(), wait);
        let mut buffer = [0; LINE_MAX];
        for _ in 0..LOOK_DATAGRAMS {
            match self.socket.recv_from(&mut buffer) {
                Ok((_, from)) if !self.serves && self.peer.is_some_and(|peer| peer.ip() != from.ip()) => {}
                Ok((count, from)) => {
                    self.peer = if self.serves { Some(from) } else { self.peer };
                    into.extend_from_slice(&buffer[..count]);
                    // A datagram is a message: what it lacks the next one does not bring.
                    if !buffer[..count].ends_with(b"\n") {
                        into.push(b'\n');
                    }
                }
                // Nobody listens yet at the other end: that is no more than silence.
                Err(error) if error.kind() == ErrorKind::ConnectionRefused => {}
                Err(error) if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::Interrupted) => return Ok(()),
                Err(error) => return Err(unusable(&error.to_string())),
            }
        }
        Ok(())
    }

    fn send(&mut self, lines: &[u8]) -> Result<(), LinkError> {
        let Some(peer) = self.peer else { return Ok(()) };
        for line in lines.split_inclusive(|b| *b == b'\n') {
            match self.socket.send_to(line, peer) {
                // A datagram that does not get out is lost, like one that gets lost on its way.
                Err(error) if matches!(error.kind(), ErrorKind::PermissionDenied | ErrorKind::AddrNotAvailable) => {
                    return Err(unusable(&error.to_string()));
                }
                _ => {}
            }
        }
        Ok(())
    }
}

fn resolved(host: &str, port: u16) -> Result<SocketAddr, LinkError> {
    let address = host.trim_start_matches('[').trim_end_matches(']');
    (address, port).to_socket_addrs().ok().and_then(|mut found| found.next()).ok_or_else(|| {
        LinkError::new(
            format!("there is no host `{host}`"),
            "check its name, or write its address, such as 192.168.1.20",
        )
    })
}

fn bound(at: SocketAddr) -> Result<UdpSocket, LinkError> {
    let socket = UdpSocket::bind(at).map_err(|error| match error.kind() {
        ErrorKind::AddrInUse => LinkError::new(
            format!("the port {} is in use by another program", at.port()),
            "end the program that holds it, or choose another port",
        ),
        ErrorKind::AddrNotAvailable => LinkError::new(
            format!("`{}` is no address of this machine", at.ip()),
            format!("listen at all of them: `udp:0.0.0.0:{}`", at.port()),
        ),
        ErrorKind::PermissionDenied => LinkError::new(
            format!("the port {} may not be used by you", at.port()),
            "choose one above 1023, such as 23456",
        ),
        _ => unusable(&error.to_string()),
    })?;
    socket.set_nonblocking(true).map_err(|error| unusable(&error.to_string()))?;
    Ok(socket)
}

fn unusable(what: &str) -> LinkError {
    LinkError::new(format!("the network cannot be used: {what}"), "check the network's settings and the address")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_datagram_is_a_line() {
        let (mut vehicle, at) = Udp::serve("127.0.0.1", 0).unwrap();
        vehicle.send(b"to nobody\n").unwrap();
        let mut controller = Udp::call("127.0.0.1", at.port(), 0).unwrap();
        controller.send(b"one\ntwo").unwrap();
        let mut came = Vec::new();
        while came.len() < 8 {
            vehicle.receive(&mut came, Duration::from_millis(100)).unwrap();
        }
        assert_eq!(came, b"one\ntwo\n");
        vehicle.send(b"three\n").unwrap();
        let mut answer = Vec::new();
        while answer.is_empty() {
            controller.receive(&mut answer, Duration::from_millis(100)).unwrap();
        }
        assert_eq!(answer, b"three\n");
    }

    #[test]
    fn a_port_in_use_and_an_unknown_host_are_told() {
        let (_held, at) = Udp::serve("127.0.0.1", 0).unwrap();
        let error = Udp::serve("127.0.0.1", at.port()).err().unwrap();
        assert!(error.message.contains("in use by another program"), "{error}");
        let error = Udp::serve("203.0.113.1", 23456).err().unwrap();
        assert!(error.help.contains("udp:0.0.0.0:23456"), "{error}");
    }
}
