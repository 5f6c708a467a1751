//! `albacore repl`: a simulated vehicle that does what is typed.

use crate::campaign::seeds;
use crate::exit::Exit;
use crate::interruption;
use crate::message;
use crate::output;
use crate::plan::{Choice, Faults};
use albacore_session::prompt::{Answer, OpenError, Opening, Prompt, Say};
use rustyline::error::ReadlineError;
use rustyline::history::MemHistory;
use rustyline::validate::{ValidationContext, ValidationResult, Validator};
use rustyline::{Completer, Editor, Helper, Highlighter, Hinter};
use std::io::{BufRead, IsTerminal, Read};
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// A line that goes on in so many others is taken as it is: it is no script.
const LINES_AT_ONCE_MAX: usize = 1_000;

/// A line is no longer than this, in bytes; no more are read before it is taken as it is.
const LINE_BYTES_MAX: u64 = 1 << 20;

/// What to do about bytes that are no text.
const NOT_UTF8: &str = "it is left out; type it again, or send it as UTF-8";

/// Drive a simulated vehicle line by line; without a script, in still water.
#[derive(clap::Args)]
pub struct Repl {
    /// A script whose names are known, and whose mission `start` begins.
    #[arg(value_name = "FILE.alb")]
    script: Option<PathBuf>,
    #[command(flatten)]
    choice: Choice,
    #[command(flatten)]
    faults: Faults,
    /// The seed of all that is random.
    #[arg(long, default_value_t = 1, value_parser = seeds::one, allow_negative_numbers = true)]
    seed: u64,
}

impl Repl {
    /// Does what is typed until the person leaves.
    pub fn run(&self) -> Exit {
        let faults = match self.faults.read() {
            Ok(faults) => faults,
            Err(exit) => return exit,
        };
        let opening = Opening {
            script: self.script.as_deref(),
            mission: self.choice.mission.as_deref(),
            scenario: self.choice.scenario.as_deref(),
            seed: self.seed,
            set: &self.choice.set,
            faults,
        };
        let mut prompt = match Prompt::open(&opening) {
            Ok(prompt) => prompt,
            Err(OpenError::File(error)) => {
                message::error(&error.message, error.help.as_deref());
                return Exit::Usage;
            }
            Err(OpenError::Script(found)) => {
                message::findings(&found.0, &found.1);
                return Exit::Script;
            }
            Err(OpenError::Asked(what, help)) => {
                message::error(&what, help.as_deref());
                return Exit::Usage;
            }
        };
        let interrupted = interruption::ctrl_c();
        if std::io::stdin().is_terminal() { typed(&mut prompt, &interrupted) } else { piped(&mut prompt, &interrupted) }
    }
}

/// Lines from a person.
fn typed(prompt: &mut Prompt, interrupted: &AtomicBool) -> Exit {
    let mut editor: Editor<Lines, MemHistory> = match Editor::with_history(Default::default(), MemHistory::new()) {
        Ok(editor) => editor,
        Err(error) => {
            message::error(&format!("the terminal cannot be used: {error}"), Some("give the lines through a pipe"));
            return Exit::Failed;
        }
    };
    editor.set_helper(Some(Lines));
    hear(Say::Text(&prompt.greeting()));
    loop {
        match editor.readline("> ") {
            Ok(text) => {
                // What cannot be remembered is typed again.
                let _ = editor.add_history_entry(text.as_str());
                if prompt.enter(&text, interrupted, &mut hear) == Answer::Quit {
                    return Exit::Well;
                }
            }
            Err(ReadlineError::Interrupted) => hear(Say::Text("`quit` or Ctrl-D leaves")),
            Err(ReadlineError::Eof) => return Exit::Well,
            Err(ReadlineError::Io(error)) if error.kind() == std::io::ErrorKind::InvalidData => {
                message::error("what was typed is no text in UTF-8", Some(NOT_UTF8));
            }
            Err(error) => {
                message::error(&format!("the terminal cannot be read: {error}"), None);
                return Exit::Failed;
            }
        }
    }
}

/// Lines from a pipe or a file: the same, without the greeting; that one of them was wrong is told at the end.
fn piped(prompt: &mut Prompt, interrupted: &AtomicBool) -> Exit {
    let mut exit = Exit::Well;
    let mut text = String::new();
    let mut input = std::io::stdin().lock();
    for number in 1.. {
        let mut line = Vec::new();
        let over = match input.by_ref().take(LINE_BYTES_MAX + 1).read_until(b'\n', &mut line) {
            Ok(bytes) if bytes as u64 > LINE_BYTES_MAX => {
                message::error(&format!("line {number} of standard input is longer than {LINE_BYTES_MAX} bytes"), None);
                return Exit::Script;
            }
            Ok(bytes) => bytes == 0,
            Err(error) => {
                message::error(&format!("standard input cannot be read: {error}"), None);
                return Exit::Failed;
            }
        };
        match String::from_utf8(line) {
            Ok(line) => text.push_str(&line),
            Err(_) => {
                message::error(&format!("line {number} of standard input is no text in UTF-8"), Some(NOT_UTF8));
                exit = Exit::Script;
            }
        }
        let is_short = text.len() as u64 <= LINE_BYTES_MAX && text.lines().count() < LINES_AT_ONCE_MAX;
        if !over && is_short && Prompt::goes_on(&text) {
            continue;
        }
        match prompt.enter(text.trim_end(), interrupted, &mut hear) {
            Answer::Quit => return exit,
            Answer::Wrong => exit = Exit::Script,
            Answer::Done => {}
        }
        text.clear();
        if over {
            break;
        }
    }
    exit
}

/// Answers go to standard output, what is wrong to standard error; a closed pipe is silent.
fn hear(said: Say) {
    match said {
        Say::Text(text) => output::print(&format!("{text}\n")),
        Say::Findings(findings, sources) => message::findings(findings, sources),
        Say::Error(what, help) => message::error(what, help),
    }
}

/// A line goes on while a bracket is open.
#[derive(Completer, Helper, Highlighter, Hinter)]
struct Lines;

impl Validator for Lines {
    fn validate(&self, context: &mut ValidationContext) -> rustyline::Result<ValidationResult> {
        let goes_on = Prompt::goes_on(context.input());
        Ok(if goes_on { ValidationResult::Incomplete } else { ValidationResult::Valid(None) })
    }
}
