//! UDP, one message a datagram.

use super::{LOOK_BYTES, Transport, wait_for};
use crate::dialect::Framing;
use crate::error::LinkError;
use std::io::ErrorKind;
use std::net::{SocketAddr, ToSocketAddrs, UdpSocket};
use std::os::fd::AsRawFd;
use std::time::Duration;

/// So many times as many datagrams as one look takes in it throws away, because they come from someone else: who babbles cannot crowd
/// out the peer.
const STRAY: usize = 64;

/// A socket, and who is at the other end.
pub struct Udp {
    socket: UdpSocket,
    peer: Option<SocketAddr>,
    /// A vehicle answers whoever spoke last and made sense; a controller knows its vehicle.
    serves: bool,
    /// The peer drives: nobody else is heard.
    held: bool,
    /// Why the system did not take what was sent last.
    trouble: Option<String>,
    framing: &'static Framing,
}

impl Udp {
    /// To a vehicle at a host's port, from a port of ours; 0 is any.
    pub fn call(host: &str, port: u16, local: u16, framing: &'static Framing) -> Result<Self, LinkError> {
        let peer = resolved(host, port)?;
        if peer.ip().is_unspecified() {
            return Err(LinkError::new(
                format!("`{host}` is where a vehicle listens, on all addresses of its computer, and no vehicle's own"),
                "write the address of that computer, such as 192.168.1.20; 127.0.0.1 is this one",
            ));
        }
        let any: SocketAddr = if peer.is_ipv4() { ([0, 0, 0, 0], local).into() } else { ([0_u16; 8], local).into() };
        Ok(Udp { peer: Some(peer), ..Udp::new(bound(any)?, false, framing) })
    }

    /// For controllers, at an address and port of ours; gives where they find us.
    pub fn serve(host: &str, port: u16, framing: &'static Framing) -> Result<(Self, SocketAddr), LinkError> {
        let socket = bound(resolved(host, port)?)?;
        let at = socket.local_addr().map_err(|error| unusable(&error.to_string()))?;
        Ok((Udp::new(socket, true, framing), at))
    }

    fn new(socket: UdpSocket, serves: bool, framing: &'static Framing) -> Self {
        Udp { socket, peer: None, serves, held: false, trouble: None, framing }
    }
}

impl Udp {
    /// Whether a datagram is for us. In one look one peer is heard: what it asks for is done before another can speak.
    fn is_heard(&mut self, datagram: &[u8], from: SocketAddr, first: bool) -> bool {
        if !self.serves {
            return self.peer.is_none_or(|peer| peer.ip() == from.ip());
        }
        let known = self.peer == Some(from);
        let heard = known || !self.held && first && (self.framing.is_message)(datagram);
        if heard {
            self.peer = Some(from);
        }
        heard
    }
}

impl Transport for Udp {
    fn receive(&mut self, into: &mut Vec<u8>, wait: Duration) -> Result<(), LinkError> {
        wait_for(self.socket.as_raw_fd(), wait);
        let mut buffer = vec![0; self.framing.longest];
        let most = LOOK_BYTES / buffer.len();
        let (mut taken, mut stray) = (0, 0);
        while taken < most && stray < STRAY * most {
            match self.socket.recv_from(&mut buffer) {
                Ok((count, from)) if !self.is_heard(&buffer[..count], from, into.is_empty()) => stray += 1,
                Ok((count, _)) => {
                    taken += 1;
                    into.extend_from_slice(&buffer[..count]);
                    // A datagram is a message: what it lacks the next one does not bring.
                    if !buffer[..count].ends_with(self.framing.end) {
                        into.extend_from_slice(self.framing.end);
                    }
                }
                Err(error) if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::Interrupted) => return Ok(()),
                // Nobody listens yet at the other end, or the network is down: that is no more than silence.
                Err(_) => stray += 1,
            }
        }
        Ok(())
    }

    fn send(&mut self, messages: &[u8]) -> Result<(), LinkError> {
        let Some(peer) = self.peer else { return Ok(()) };
        for message in self.framing.messages(messages) {
            // What does not get out is lost, like what gets lost on its way: a network may refuse a datagram and take the next,
            // while a firewall is loaded or an interface comes up.
            match self.socket.send_to(message, peer) {
                Ok(_) => self.trouble = None,
                Err(error) if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::ConnectionRefused) => {}
                Err(error) => self.trouble = Some(error.to_string()),
            }
        }
        Ok(())
    }

    fn trouble(&self) -> Option<&str> {
        self.trouble.as_deref()
    }

    fn hold(&mut self, held: bool) {
        self.held = held;
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

    const FRAMING: &Framing = &crate::recon::DIALECT.framing;

    fn heard(vehicle: &mut Udp) -> Vec<u8> {
        let mut came = Vec::new();
        vehicle.receive(&mut came, Duration::from_millis(100)).unwrap();
        came
    }

    #[test]
    fn who_drives_is_the_only_one_that_is_heard_whoever_speaks() {
        let hello = crate::recon::seal("V,one");
        let (mut vehicle, at) = Udp::serve("127.0.0.1", 0, FRAMING).unwrap();
        let controller = || Udp::call("127.0.0.1", at.port(), 0, FRAMING).unwrap();
        let (mut first, mut second) = (controller(), controller());
        second.send(b"garbage\n").unwrap();
        assert!(heard(&mut vehicle).is_empty(), "who makes no sense is no peer");
        first.send(hello.as_bytes()).unwrap();
        second.send(hello.as_bytes()).unwrap();
        assert_eq!(heard(&mut vehicle), hello.as_bytes(), "one in a look");
        vehicle.hold(true);
        for _ in 0..200 {
            second.send(hello.as_bytes()).unwrap();
        }
        first.send(b"mine\n").unwrap();
        assert_eq!(heard(&mut vehicle), b"mine\n");
        vehicle.send(b"yours\n").unwrap();
        assert_eq!(heard(&mut first), b"yours\n");
        assert!(heard(&mut second).is_empty());
        vehicle.hold(false);
        second.send(hello.as_bytes()).unwrap();
        assert_eq!(heard(&mut vehicle), hello.as_bytes());
        vehicle.send(b"yours\n").unwrap();
        assert_eq!(heard(&mut second), b"yours\n");
    }

    #[test]
    fn a_datagram_is_a_line() {
        let (mut vehicle, at) = Udp::serve("127.0.0.1", 0, FRAMING).unwrap();
        vehicle.send(b"to nobody\n").unwrap();
        let mut controller = Udp::call("127.0.0.1", at.port(), 0, FRAMING).unwrap();
        let hello = crate::recon::seal("V,one");
        controller.send(format!("{hello}two").as_bytes()).unwrap();
        let mut came = Vec::new();
        while came.len() < hello.len() + 4 {
            vehicle.receive(&mut came, Duration::from_millis(100)).unwrap();
        }
        assert_eq!(came, format!("{hello}two\n").as_bytes());
        vehicle.send(b"three\n").unwrap();
        let mut answer = Vec::new();
        while answer.is_empty() {
            controller.receive(&mut answer, Duration::from_millis(100)).unwrap();
        }
        assert_eq!(answer, b"three\n");
    }

    #[test]
    fn what_the_system_refuses_is_lost_and_remembered() {
        // No socket may speak to everyone unless it asked for that.
        let mut controller = Udp::call("255.255.255.255", 23456, 0, FRAMING).unwrap();
        controller.send(b"to all\n").unwrap();
        assert!(controller.trouble().is_some());
        let (_vehicle, at) = Udp::serve("127.0.0.1", 0, FRAMING).unwrap();
        controller.peer = Some(at);
        controller.send(b"to one\n").unwrap();
        assert_eq!(controller.trouble(), None);
    }

    #[test]
    fn a_port_in_use_and_an_unknown_host_are_told() {
        let (_held, at) = Udp::serve("127.0.0.1", 0, FRAMING).unwrap();
        let error = Udp::serve("127.0.0.1", at.port(), FRAMING).err().unwrap();
        assert!(error.message.contains("in use by another program"), "{error}");
        let error = Udp::serve("203.0.113.1", 23456, FRAMING).err().unwrap();
        assert!(error.help.contains("udp:0.0.0.0:23456"), "{error}");
    }
}
