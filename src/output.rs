//! Standard output: results, for a person or a program.

use crate::message;
use serde::Serialize;
use std::io::{ErrorKind, Write};
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether a result could not be written. There is one standard output, and so one of these.
static FAILED: AtomicBool = AtomicBool::new(false);

/// Prints a result. A closed pipe is silent: nobody wants to know. Any other failure is said, once, and is a failure of the
/// program.
pub fn print(text: &str) {
    let mut out = std::io::stdout().lock();
    if let Err(error) = out.write_all(text.as_bytes()).and_then(|()| out.flush())
        && error.kind() != ErrorKind::BrokenPipe
        && !FAILED.swap(true, Ordering::Relaxed)
    {
        message::error(&format!("the result cannot be written to standard output: {error}"), None);
    }
}

/// Prints a result as one JSON object.
pub fn print_json(result: &impl Serialize) {
    match serde_json::to_string_pretty(result) {
        Ok(text) => print(&(text + "\n")),
        Err(error) => {
            FAILED.store(true, Ordering::Relaxed);
            message::error(&format!("the result cannot be written as JSON: {error}"), None);
        }
    }
}

/// Whether a result was lost.
pub fn has_failed() -> bool {
    FAILED.load(Ordering::Relaxed)
}
