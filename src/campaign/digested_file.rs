//! A file that a campaign adds to, and that nobody else may have changed or replaced in the meantime.

use super::table::TableError;
use crate::disk;
use crate::synced::Synced;
use albacore_session::Digest;
use std::fs::File;
use std::io::{self, Write};
use std::path::PathBuf;

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

    /// What it holds: what was written.
    pub fn text(&mut self) -> Result<Vec<u8>, TableError> {
        if !self.is_as_left()? {
            return Err(TableError::Changed(self.path.clone()));
        }
        let read = || -> io::Result<Option<Vec<u8>>> {
            let is_there = disk::is_at(self.file(), &self.path)?;
            is_there.then(|| std::fs::read(&self.path)).transpose()
        };
        match read() {
            Ok(Some(text)) if digest(Digest::new(), &text) == self.digest => Ok(text),
            Ok(Some(_)) => Err(TableError::Changed(self.path.clone())),
            Ok(None) => Err(TableError::Gone(self.path.clone())),
            Err(error) => Err(TableError::Disk(self.path.clone(), error)),
        }
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
