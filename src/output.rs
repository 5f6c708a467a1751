//! Standard output: results, for a person or a program.

use crate::exit::Exit;
use crate::message;
use albacore_session::seen::{is_unseen, one_line, shown};
use serde::Serialize;
use std::io::{self, ErrorKind, Write};
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether a result could not be written. There is one standard output, and so one of these.
static FAILED: AtomicBool = AtomicBool::new(false);

/// Lines of a result, each of which stays one, whatever others wrote that is put on it.
#[derive(Default)]
pub struct Lines(String);

impl Lines {
    /// Adds a line.
    pub fn add(&mut self, line: &str) {
        self.0.push_str(&one_line(line));
        self.0.push('\n');
    }

    /// Prints them.
    pub fn print(&self) {
        print_raw(&self.0);
    }
}

/// Prints a result for a person: what cannot be seen is written out, for texts of scripts, vehicles and files are in it.
pub fn print(text: &str) {
    print_raw(&shown(text));
}

/// Prints what has been made to be seen, or is data for a program.
pub fn print_raw(text: &str) {
    told(std::io::stdout().lock().write_all(text.as_bytes()));
}

/// Takes what became of something printed. A closed pipe is silent: nobody wants to know. Any other failure is said, once, and is
/// a failure of the program.
pub fn told(printed: io::Result<()>) {
    if let Err(error) = printed.and_then(|()| std::io::stdout().lock().flush())
        && error.kind() != ErrorKind::BrokenPipe
        && !FAILED.swap(true, Ordering::Relaxed)
    {
        message::error(&format!("the result cannot be written to standard output: {error}"), None);
    }
}

/// Prints a result as one JSON object.
pub fn print_json(result: &impl Serialize) {
    match json(result) {
        Ok(text) => print_raw(&text),
        Err(error) => {
            FAILED.store(true, Ordering::Relaxed);
            message::error(&format!("the result cannot be written as JSON: {error}"), None);
        }
    }
}

/// A value as JSON, for the output or a file: what cannot be seen in its texts is written as escapes.
pub fn json(value: &impl Serialize) -> serde_json::Result<String> {
    serde_json::to_string_pretty(value).map(|text| seen_json(&text) + "\n")
}

/// How the program ends: a result that was lost is a failure.
pub fn exit(exit: Exit) -> Exit {
    if FAILED.load(Ordering::Relaxed) { Exit::Failed } else { exit }
}

/// JSON in which texts hold nothing unseen: the same values, more of them written as escapes.
fn seen_json(json: &str) -> String {
    let mut out = String::with_capacity(json.len());
    for c in json.chars() {
        if is_unseen(c) && c != '\n' {
            let mut units = [0; 2];
            out.extend(c.encode_utf16(&mut units).iter().map(|unit| format!("\\u{unit:04x}")));
        } else {
            out.push(c);
        }
    }
    out
}

/// The first characters of a text that has more.
pub fn beginning(text: &str, chars: usize) -> Option<&str> {
    text.char_indices().nth(chars).map(|(end, _)| &text[..end])
}
