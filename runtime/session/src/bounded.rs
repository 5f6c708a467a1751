//! Reading with a bound: what others put in a file's place may be a device, a pipe, or larger than memory.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Why there are no bytes.
#[derive(Debug, thiserror::Error)]
pub enum Unread {
    /// The system says why.
    #[error("{}", crate::files::plain(.0))]
    System(#[from] io::Error),
    /// A folder, or a device or a pipe, which would answer without end, or never.
    #[error("it is {0}")]
    NoFile(&'static str),
    /// There are more than are read.
    #[error("it is larger than {0} bytes")]
    Large(u64),
}

/// The bytes of an ordinary file, so many at most.
pub fn read_file(path: &Path, bytes_max: u64) -> Result<Vec<u8>, Unread> {
    let found = std::fs::metadata(path)?;
    if !found.is_file() {
        return Err(Unread::NoFile(if found.is_dir() { "a folder" } else { "no ordinary file" }));
    }
    read_all(File::open(path)?, bytes_max)
}

/// All that there is to read, so many bytes at most. A file may grow after it was measured, and one of the system's has no length.
pub fn read_all(from: impl Read, bytes_max: u64) -> Result<Vec<u8>, Unread> {
    let mut bytes = Vec::new();
    from.take(bytes_max.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > bytes_max { Err(Unread::Large(bytes_max)) } else { Ok(bytes) }
}
