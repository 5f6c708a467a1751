//! `--review`: snapshots that are new or changed, one by one, each as a difference and a question.

use super::Testing;
use super::snapshots::verdict;
use crate::output::{Lines, print_raw};
use crate::{interruption, message};
use albacore_session::TestRun;
use similar::{ChangeTag, TextDiff};
use std::io::{BufRead, IsTerminal, Read};
use std::path::Path;

/// Lines around a change that are shown with it.
const CONTEXT: usize = 3;
/// An answer is no longer than this, in bytes.
const ANSWER_BYTES_MAX: u64 = 1024;

/// What a person says to a snapshot.
pub enum Answer {
    /// Write it.
    Accept,
    /// Leave what is there.
    Leave,
    /// Leave it, and end the review.
    Quit,
}

/// Shows how a run differs from its snapshot, and asks whether to accept it. The end of the input quits.
pub fn ask(testing: &Testing, file: &Path, run: &TestRun, stored: Option<&str>, trace: &str) -> Answer {
    show(file, run, stored, trace);
    // Ctrl-C ends the program at once while nothing but an answer is awaited: all that was accepted is written.
    interruption::nobody_looks();
    let answer = answer();
    if !testing.is_stopped() {
        let _ = interruption::flag();
    }
    answer
}

fn show(file: &Path, run: &TestRun, stored: Option<&str>, trace: &str) {
    let mut lines = Lines::default();
    let what = stored.map_or("there is no snapshot yet", |stored| verdict(stored, trace));
    lines.add(&format!("review  {run}: {what}  ({})", file.display()));
    let diff = TextDiff::from_lines(stored.unwrap_or_default(), trace);
    for hunk in diff.unified_diff().context_radius(CONTEXT).iter_hunks() {
        lines.add(&format!("          {}", hunk.header()));
        for change in hunk.iter_changes() {
            let sign = match change.tag() {
                ChangeTag::Delete => '-',
                ChangeTag::Insert => '+',
                ChangeTag::Equal => ' ',
            };
            lines.add(format!("          {sign} {}", change.value().trim_end_matches(['\r', '\n'])).trim_end());
        }
    }
    lines.print();
}

fn answer() -> Answer {
    let mut input = std::io::stdin().lock();
    loop {
        print_raw("        accept it? y (yes), n (leave it), q (quit): ");
        let mut line = Vec::new();
        let read = input.by_ref().take(ANSWER_BYTES_MAX).read_until(b'\n', &mut line);
        // What is typed ends the line by itself.
        if !std::io::stdin().is_terminal() || line.is_empty() {
            print_raw("\n");
        }
        if let Err(error) = &read {
            message::error(&format!("no answer can be read: {error}"), None);
        }
        match line.trim_ascii() {
            _ if line.is_empty() => return Answer::Quit,
            b"y" | b"Y" | b"yes" => return Answer::Accept,
            b"n" | b"N" | b"no" => return Answer::Leave,
            b"q" | b"Q" | b"quit" => return Answer::Quit,
            _ => {}
        }
    }
}
