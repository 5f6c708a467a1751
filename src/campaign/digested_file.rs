//! A file that a campaign adds to, and that nobody else may have changed or replaced in the meantime.

use super::table::TableError;
use crate::disk;
use crate::synced::Synced;
use albacore_session::Digest;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Write};
use std::path::PathBuf;

/// A file is read in pieces of so many bytes, and what its last line has more: a table of a million rows need not be held at once.
const PIECE: usize = 1 << 20;

/// A file with a digest of all that was written to it.
pub struct DigestedFile {
    file: Synced,
    path: PathBuf,
    digest: Digest,
    /// Why it can only be read, if so.
    forbidden: Option<io::Error>,
}

impl DigestedFile {
    /// A file that holds this text, whole lines.
    pub fn new(file: File, path: PathBuf, text: &[u8]) -> Self {
        let (file, digest) = (Synced::new(file, text.len() as u64), digest(Digest::new(), text));
        DigestedFile { file, path, digest, forbidden: None }
    }

    /// One that may turn out to be complete as it is: then nothing has to be written into it.
    pub fn known(file: File, forbidden: Option<io::Error>, path: PathBuf, text: &[u8]) -> Self {
        DigestedFile { forbidden, ..DigestedFile::new(file, path, text) }
    }

    /// An error if it can only be read.
    pub fn may_grow(&mut self) -> Result<(), TableError> {
        self.forbidden.take().map_or(Ok(()), |error| Err(TableError::Disk(self.path.clone(), error)))
    }

    /// The file itself.
    pub fn file(&self) -> &File {
        self.file.file()
    }

    /// Adds a line, whole or not at all.
    pub fn add(&mut self, line: &[u8]) -> Result<(), TableError> {
        // What the disk does not tell has not become another's.
        let is_there = disk::is_at(self.file(), &self.path);
        if !is_there.map_err(|error| TableError::Disk(self.path.clone(), error))? {
            return Err(TableError::Gone(self.path.clone()));
        }
        if !self.is_as_left()? {
            return Err(TableError::Changed(self.path.clone()));
        }
        self.file.write_whole(line).map_err(|error| TableError::Disk(self.path.clone(), error))?;
        self.digest = digest(self.digest, line);
        Ok(())
    }

    /// Sees to it that the disk has all of it.
    pub fn settle(&mut self) -> Result<(), TableError> {
        self.file.flush().map_err(|error| TableError::Disk(self.path.clone(), error))
    }

    /// The same for what was written more than a second ago.
    pub fn settle_when_due(&mut self) -> Result<(), TableError> {
        self.file.sync_when_due().map_err(|error| TableError::Disk(self.path.clone(), error))
    }

    /// Gives what it holds piece by piece, whole lines each, and tells at the end whether that is what was written.
    pub fn read(&mut self, mut take: impl FnMut(&[u8]) -> Result<(), TableError>) -> Result<(), TableError> {
        let disk = |error| TableError::Disk(self.path.clone(), error);
        if !self.is_as_left()? {
            return Err(TableError::Changed(self.path.clone()));
        }
        if !disk::is_at(self.file(), &self.path).map_err(disk)? {
            return Err(TableError::Gone(self.path.clone()));
        }
        let mut reader = BufReader::new(File::open(&self.path).map_err(disk)?);
        let (mut piece, mut found) = (Vec::new(), Digest::new());
        loop {
            piece.clear();
            while piece.len() < PIECE && reader.read_until(b'\n', &mut piece).map_err(disk)? > 0 {}
            if piece.is_empty() {
                break;
            }
            found = digest(found, &piece);
            take(&piece)?;
        }
        if found == self.digest { Ok(()) } else { Err(TableError::Changed(self.path.clone())) }
    }

    /// An error if it does not hold what was written.
    pub fn is_whole(&mut self) -> Result<(), TableError> {
        self.read(|_| Ok(()))
    }

    fn is_as_left(&self) -> Result<bool, TableError> {
        self.file.is_as_left().map_err(|error| TableError::Disk(self.path.clone(), error))
    }
}

/// A digest with the lines of a text taken in.
fn digest(mut digest: Digest, text: &[u8]) -> Digest {
    text.split_inclusive(|b| *b == b'\n').for_each(|line| digest.bytes(line));
    digest
}
