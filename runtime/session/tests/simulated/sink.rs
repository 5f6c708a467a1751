//! Where a run's journal is written, to look at.

#![expect(clippy::unwrap_used, reason = "nobody panics while the bytes are held")]

use std::io;
use std::sync::{Arc, Mutex};

/// A sink whose bytes can be looked at, and which fails from one of its writes on.
#[derive(Clone, Default)]
pub struct Sink {
    bytes: Arc<Mutex<Vec<u8>>>,
    writes_left: Option<usize>,
}

impl Sink {
    /// One that fails after so many writes, if any.
    pub fn with_writes(writes_left: Option<usize>) -> Self {
        Sink { writes_left, ..Sink::default() }
    }

    /// What has been written.
    pub fn bytes(&self) -> Vec<u8> {
        self.bytes.lock().unwrap().clone()
    }
}

impl io::Write for Sink {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let mut taken = self.bytes.lock().unwrap();
        let fits = match &mut self.writes_left {
            Some(0) => return Err(io::ErrorKind::StorageFull.into()),
            // A disk that gets full takes a part of the last write, and then nothing.
            Some(left) => {
                *left -= 1;
                if *left == 0 { bytes.len() / 2 } else { bytes.len() }
            }
            None => bytes.len(),
        };
        taken.extend(&bytes[..fits]);
        Ok(fits)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
