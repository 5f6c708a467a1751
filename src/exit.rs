//! Exit codes.

use std::process::ExitCode;

/// How the program ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// All well.
    Well = 0,
    /// The mission or a test did not end well, a campaign was interrupted, or a script is not formatted.
    NotWell = 1,
    /// Wrong usage: files, names or options that do not exist.
    Usage = 2,
    /// The script has errors.
    Script = 3,
    /// The vehicle or the disk failed.
    Failed = 4,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> ExitCode {
        ExitCode::from(exit as u8)
    }
}
