//! Serial lines and pseudo terminals.

use super::{LOOK_BYTES, Transport, is_for_later, wait_for};
use crate::dialect::Framing;
use crate::error::LinkError;
use nix::errno::Errno;
use nix::fcntl::{FcntlArg, OFlag, fcntl};
use nix::unistd::{read, write};
use serialport::{ClearBuffer, ErrorKind, SerialPort, TTYPort};
use std::io;
use std::os::fd::AsRawFd;
use std::path::Path;
use std::time::Duration;

/// An open terminal: 8 data bits, no parity, one stop bit, raw.
pub struct Tty {
    port: TTYPort,
    /// What it is called in messages.
    name: String,
    /// The other end of a pair, held open so that a peer that goes does not end the line; a real one has no ends either.
    _slave: Option<TTYPort>,
    framing: &'static Framing,
    /// The rest of a message that was sent in part: without it the next one would be lost too.
    rest: Vec<u8>,
}

impl Tty {
    /// Opens a device for us alone. What came before is thrown away.
    pub fn open(path: &str, baud: u32, framing: &'static Framing) -> Result<Self, LinkError> {
        let port = TTYPort::open(&serialport::new(path, baud)).map_err(|error| refused(path, baud, &error))?;
        let tty = Tty::with(port, path.to_string(), None, framing)?;
        tty.port.clear(ClearBuffer::All).map_err(|error| refused(path, baud, &error))?;
        Ok(tty)
    }

    /// A new pseudo terminal, and the path at which the other end opens it.
    pub fn pair(framing: &'static Framing) -> Result<(Self, String), LinkError> {
        let failed = |what: String| {
            LinkError::new(format!("no pseudo terminal can be made: {what}"), "look at the system's limit of them")
        };
        let (master, slave) = TTYPort::pair().map_err(|error| failed(error.to_string()))?;
        let path = slave.name().ok_or_else(|| failed("it has no name".to_string()))?;
        Ok((Tty::with(master, path.clone(), Some(slave), framing)?, path))
    }

    fn with(port: TTYPort, name: String, slave: Option<TTYPort>, framing: &'static Framing) -> Result<Self, LinkError> {
        // Otherwise a write waits for a peer that does not read.
        fcntl(port.as_raw_fd(), FcntlArg::F_SETFL(OFlag::O_NONBLOCK)).map_err(|error| gone(&name, error))?;
        Ok(Tty { port, name, _slave: slave, framing, rest: Vec::new() })
    }

    /// Writes what the line takes now; gives how much.
    fn write_some(&self, bytes: &[u8]) -> Result<usize, LinkError> {
        match write(self.port.as_raw_fd(), bytes) {
            Ok(count) => Ok(count),
            Err(error) if is_for_later(error) => Ok(0),
            Err(error) => Err(gone(&self.name, error)),
        }
    }
}

impl Transport for Tty {
    fn receive(&mut self, into: &mut Vec<u8>, wait: Duration) -> Result<(), LinkError> {
        wait_for(self.port.as_raw_fd(), wait);
        let mut buffer = [0; 4096];
        let most = into.len() + LOOK_BYTES;
        while into.len() < most {
            match read(self.port.as_raw_fd(), &mut buffer) {
                Ok(0) => return Err(gone(&self.name, Errno::EIO)),
                Ok(count) => into.extend_from_slice(&buffer[..count]),
                Err(error) if is_for_later(error) => return Ok(()),
                Err(error) => return Err(gone(&self.name, error)),
            }
        }
        Ok(())
    }

    fn send(&mut self, messages: &[u8]) -> Result<(), LinkError> {
        let rest = std::mem::take(&mut self.rest);
        let sent = self.write_some(&rest)?;
        if sent < rest.len() {
            self.rest = rest[sent..].to_vec();
            return Ok(());
        }
        let sent = self.write_some(messages)?;
        let ends = self.framing.messages(messages).scan(0, |end, message| {
            *end += message.len();
            Some(*end)
        });
        // Of a message that has begun the rest goes first next time; those that have not begun are lost.
        if let Some(end) = { ends }.find(|end| sent <= *end).filter(|_| sent > 0) {
            self.rest = messages[sent..end].to_vec();
        }
        Ok(())
    }
}

/// The device was there and is no more.
fn gone(name: &str, error: Errno) -> LinkError {
    LinkError::new(
        format!("the line `{name}` is gone: {}", error.desc().to_lowercase()),
        "check that the device is plugged in, or that the other end still runs",
    )
}

/// Why a device cannot be opened.
fn refused(path: &str, baud: u32, error: &serialport::Error) -> LinkError {
    match error.kind() {
        _ if !Path::new(path).exists() => {
            let ports: Vec<String> =
                serialport::available_ports().unwrap_or_default().into_iter().map(|p| p.port_name).collect();
            let help = if ports.is_empty() {
                "this machine has no serial ports; plug the adapter in, or try `albacore vehicle` with `pty:`"
                    .to_string()
            } else {
                format!("there is {}", ports.join(", "))
            };
            LinkError::new(format!("there is no port `{path}`"), help)
        }
        // serialport says so of a device that someone else holds.
        ErrorKind::NoDevice => LinkError::new(
            format!("`{path}` is in use by another program"),
            "end the program that holds it (`fuser` tells which), or choose another port",
        ),
        ErrorKind::Io(io::ErrorKind::PermissionDenied) => LinkError::new(
            format!("`{path}` may not be opened by you"),
            "join the group that owns it, mostly `dialout`: `sudo usermod -aG dialout $USER`, then log in again",
        ),
        _ => LinkError::new(
            format!("`{path}` cannot be opened at {baud} baud: {}", error.description.to_lowercase()),
            "check that it is a serial device and takes this speed",
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAMING: &Framing = &crate::recon::DIALECT.framing;

    #[test]
    fn bytes_go_both_ways_and_only_one_may_hold_the_port() {
        let (mut master, path) = Tty::pair(FRAMING).unwrap();
        let mut slave = Tty::open(&path, 57_600, FRAMING).unwrap();
        master.send(b"\x00\xff\x11\x13#E\r\n").unwrap();
        let mut came = Vec::new();
        while came.len() < 8 {
            slave.receive(&mut came, Duration::from_millis(100)).unwrap();
        }
        assert_eq!(came, b"\x00\xff\x11\x13#E\r\n");
        let busy = Tty::open(&path, 57_600, FRAMING).err().unwrap();
        assert!(busy.message.contains("in use by another program"), "{busy}");
    }

    #[test]
    fn what_cannot_be_opened_says_why() {
        let absent = Tty::open("/dev/there-is-no-such-port", 57_600, FRAMING).err().unwrap();
        assert!(absent.message.contains("there is no port"), "{absent}");
        let file = Tty::open("/dev/null", 57_600, FRAMING).err().unwrap();
        assert!(file.message.contains("cannot be opened"), "{file}");
    }

    #[test]
    fn a_peer_that_does_not_read_holds_nobody() {
        let (mut master, path) = Tty::pair(FRAMING).unwrap();
        let line = [b'x'; 200].map(|b| b).iter().copied().chain(*b"\n").collect::<Vec<u8>>();
        for _ in 0..1000 {
            master.send(&line).unwrap();
        }
        assert!(master.rest.len() <= line.len());
        // What lay in the line is thrown away by who opens it, and whole lines follow half a one.
        let mut slave = Tty::open(&path, 57_600, FRAMING).unwrap();
        let mut came = Vec::new();
        while came.iter().filter(|b| **b == b'\n').count() < 3 {
            master.send(&line).unwrap();
            slave.receive(&mut came, Duration::from_millis(100)).unwrap();
        }
        let second = came.split(|b| *b == b'\n').nth(1).unwrap();
        assert_eq!(second.len(), 200);
    }

    #[test]
    fn a_line_that_is_gone_is_an_error() {
        let (master, path) = Tty::pair(FRAMING).unwrap();
        let mut slave = Tty::open(&path, 57_600, FRAMING).unwrap();
        drop(master);
        let error = slave.receive(&mut Vec::new(), Duration::from_millis(100)).unwrap_err();
        assert!(error.message.contains("is gone"), "{error}");
        assert!(slave.send(b"x\n").is_err());
    }
}
