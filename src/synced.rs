//! A file whose bytes are on the disk, and not only in the system's memory, a second after they were written.

use crate::clock::now;
use std::fs::File;
use std::io::{self, ErrorKind, Write};
use std::time::Duration;

/// So long what was written may be lost with the machine's power.
const STEP: Duration = Duration::from_secs(1);

/// What became of a file that is not as it was left.
pub const WRITTEN_INTO: &str = "another program has written into it";

/// What is gathered is written when it comes to so much, bytes, or after so long.
const PIECE: usize = 64 << 10;
const GATHERED: Duration = Duration::from_millis(100);

/// Writes at once or in pieces, and lets the disk have it in steps. Who writes waits for the disk: no control loop should.
pub struct Synced {
    file: File,
    /// What is gathered, where it is, and when it is to be written.
    gathered: Option<(Vec<u8>, Duration)>,
    /// So long it is where nobody else writes into it.
    bytes: u64,
    due: Duration,
    /// Whether anything was written since the disk had all of it.
    is_new: bool,
}

impl Synced {
    /// Of an open file that holds so many bytes.
    pub fn new(file: File, bytes: u64) -> Self {
        Synced { file, gathered: None, bytes, due: now() + STEP, is_new: false }
    }

    /// The same, of what comes so fast in small parts that to write each would cost more than to make it. What is gathered is lost if
    /// the program is killed. The first part is written at once: it tells whether anything can be.
    pub fn gathering(file: File, bytes: u64) -> Self {
        let mut gathering = Synced::new(file, bytes);
        gathering.gathered = Some((Vec::with_capacity(PIECE), now()));
        gathering
    }

    /// Whether it is as long as it was left.
    pub fn is_as_left(&self) -> io::Result<bool> {
        Ok(self.file.metadata()?.len() == self.bytes)
    }

    /// The file.
    pub fn file(&self) -> &File {
        &self.file
    }

    /// Writes a piece whole or not at all. A disk that takes no more lets a file be cut.
    pub fn write_whole(&mut self, piece: &[u8]) -> io::Result<()> {
        let before = self.bytes;
        self.write_all(piece).inspect_err(|_| {
            if self.bytes > before && self.file.set_len(before).is_ok() {
                self.bytes = before;
            }
        })
    }

    /// Lets the disk have what was written, if that is a second ago.
    pub fn sync_when_due(&mut self) -> io::Result<()> {
        if now() >= self.due { self.sync() } else { Ok(()) }
    }

    fn sync(&mut self) -> io::Result<()> {
        if !std::mem::take(&mut self.is_new) {
            return Ok(());
        }
        let synced = self.file.sync_data();
        self.due = now() + STEP;
        match synced {
            // A pipe or a device has no disk behind it.
            Err(error) if matches!(error.kind(), ErrorKind::InvalidInput | ErrorKind::Unsupported) => Ok(()),
            synced => synced,
        }
    }

    fn write_at_once(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if !self.is_as_left()? {
            return Err(io::Error::other(WRITTEN_INTO));
        }
        let written = self.file.write(bytes)?;
        self.bytes += written as u64;
        self.is_new = true;
        self.sync_when_due()?;
        Ok(written)
    }

    /// Writes what is gathered. Where that fails the rest is lost.
    fn write_gathered(&mut self) -> io::Result<()> {
        let Some((gathered, _)) = &mut self.gathered else { return Ok(()) };
        let piece = std::mem::take(gathered);
        let mut rest = piece.as_slice();
        while !rest.is_empty() {
            match self.write_at_once(rest) {
                Ok(0) => return Err(ErrorKind::WriteZero.into()),
                Ok(written) => rest = &rest[written..],
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
        let mut room = piece;
        room.clear();
        self.gathered = Some((room, now() + GATHERED));
        Ok(())
    }
}

impl Write for Synced {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let Some((gathered, due)) = &mut self.gathered else { return self.write_at_once(bytes) };
        gathered.extend(bytes);
        if gathered.len() >= PIECE || now() >= *due {
            self.write_gathered()?;
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.write_gathered()?;
        self.sync()
    }
}

/// What was written last is on the disk too, when nobody has asked: nobody is left who could be told that it is not.
impl Drop for Synced {
    fn drop(&mut self) {
        let _ = self.flush();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A piece that follows another at once is on the disk a second later, though nothing is written after it.
    #[test]
    fn what_is_written_last_is_not_kept_back() {
        let mut file = Synced::new(tempfile::tempfile().unwrap(), 0);
        file.write_whole(b"first").unwrap();
        file.sync_when_due().unwrap();
        assert!(file.is_new, "its second is not over");
        file.due = now();
        file.sync_when_due().unwrap();
        assert!(!file.is_new && file.due > now());
    }

    /// What is gathered is in the file once it comes to a piece, once its time is over, and when no more comes.
    #[test]
    fn what_is_gathered_is_written_in_pieces() {
        let file = tempfile::tempfile().unwrap();
        let length = || file.metadata().unwrap().len() as usize;
        let mut gathering = Synced::gathering(file.try_clone().unwrap(), 0);
        gathering.write_all(&[1]).unwrap();
        assert_eq!(length(), 1, "the first part at once");
        let late = |gathering: &mut Synced, by: Duration| gathering.gathered.as_mut().unwrap().1 = now() + by;
        late(&mut gathering, Duration::from_secs(600));
        gathering.write_all(&[2; 10]).unwrap();
        assert_eq!(length(), 1);
        gathering.write_all(&[3; PIECE]).unwrap();
        assert_eq!(length(), 11 + PIECE);
        late(&mut gathering, Duration::ZERO);
        gathering.write_all(&[4]).unwrap();
        assert_eq!(length(), 12 + PIECE);
        late(&mut gathering, Duration::from_secs(600));
        gathering.write_all(&[5]).unwrap();
        assert_eq!(length(), 12 + PIECE);
        drop(gathering);
        assert_eq!(length(), 13 + PIECE);
    }
}
