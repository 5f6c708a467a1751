//! `albacore repl`: a simulated vehicle that does what is typed.

use crate::campaign::seeds;
use crate::exit::Exit;
use crate::interruption;
use crate::made::{Comment, Made};
use crate::message;
use crate::output;
use crate::past::PastJournal;
use crate::plan::{Choice, Faults};
use crate::{disk, explain};
use albacore_session::journal::is_beginning;
use albacore_session::prompt::{Answer, OpenError, Opening, PastTicks, Prompt, Say, WordKind};
use rustyline::completion::Completer;
use rustyline::error::ReadlineError;
use rustyline::highlight::{CmdKind, Highlighter};
use rustyline::hint::Hinter;
use rustyline::history::MemHistory;
use rustyline::validate::{ValidationContext, ValidationResult, Validator};
use rustyline::{Context, Editor, Helper};
use std::borrow::Cow;
use std::cell::RefCell;
use std::io::{BufRead, IsTerminal, Read};
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// A line that goes on in so many others is taken as it is: it is no script.
const LINES_AT_ONCE_MAX: usize = 1_000;

/// A line is no longer than this, in bytes; no more are read before it is taken as it is.
const LINE_BYTES_MAX: u64 = 1 << 20;

/// A journal is known by so many of its bytes.
const MAGIC_BYTES: u64 = 4;

/// What to do about bytes that are no text.
const NOT_UTF8: &str = "it is left out; type it again, or send it as UTF-8";

/// Drive a simulated vehicle line by line; without a script, in still water.
#[derive(clap::Args)]
pub struct Repl {
    /// A script whose names are known, and whose mission `start` begins; or the folder of a run that is over, or its journal.
    #[arg(value_name = "FILE.alb|RUN")]
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
        let past = match self.script.as_deref().filter(|path| is_run(path)).map(|path| self.past(path)) {
            Some(Ok(past)) => Some(past),
            Some(Err(exit)) => return exit,
            None => None,
        };
        let opening = Opening {
            script: self.script.clone(),
            mission: self.choice.mission.clone(),
            scenario: self.choice.scenario.clone(),
            seed: past.as_ref().map_or(self.seed, |(_, seed)| *seed),
            set: self.choice.set.clone(),
            faults,
            past: past.map(|(past, _)| Arc::new(past)),
        };
        let mut prompt = match Prompt::open(opening) {
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
        if std::io::stdin().is_terminal() { typed(prompt, &interrupted) } else { piped(&mut prompt, &interrupted) }
    }
}

impl Repl {
    /// The run that is over, and its seed.
    fn past(&self, path: &Path) -> Result<(PastTicks, u64), Exit> {
        let Choice { mission, scenario, .. } = &self.choice;
        if mission.is_some() || scenario.is_some() || !self.faults.texts.is_empty() {
            let help = "leave out `--mission`, `--in` and `--fault`; `--set` changes a parameter of its mission";
            message::error("a run that is over has its mission and its world", Some(help));
            return Err(Exit::Usage);
        }
        let journal = PastJournal::open(path)?;
        let (past, ending) = PastTicks::read(journal.reader()?, journal.script.clone());
        journal.warn_of_end(&ending);
        Ok((past, journal.header.seed))
    }
}

/// Whether a path is a folder, or begins as a journal does.
fn is_run(path: &Path) -> bool {
    let mut begins = Vec::new();
    let file =
        std::fs::metadata(path).ok().filter(|found| found.is_file()).and_then(|_| std::fs::File::open(path).ok());
    let read = file.map(|file| file.take(MAGIC_BYTES).read_to_end(&mut begins));
    path.is_dir() || read.is_some() && begins.len() as u64 == MAGIC_BYTES && is_beginning(&begins)
}

/// Lines from a person.
fn typed(prompt: Prompt, interrupted: &AtomicBool) -> Exit {
    let prompt = Rc::new(RefCell::new(prompt));
    let mut editor: Editor<Lines, MemHistory> = match Editor::with_history(Default::default(), MemHistory::new()) {
        Ok(editor) => editor,
        Err(error) => {
            message::error(&format!("the terminal cannot be used: {error}"), Some("give the lines through a pipe"));
            return Exit::Failed;
        }
    };
    editor.set_helper(Some(Lines(Rc::clone(&prompt))));
    hear(Say::Text(&prompt.borrow().greeting()));
    loop {
        match editor.readline("> ") {
            Ok(text) => {
                // What cannot be remembered is typed again.
                let _ = editor.add_history_entry(text.as_str());
                if prompt.borrow_mut().enter(&text, interrupted, &mut hear) == Answer::Quit {
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
        Say::File(path, text) => write(Path::new(path), text),
        Say::Page(code) => _ = explain::explain(Some(code)),
    }
}

/// Writes what was asked for: a script where nothing is yet, a picture also over one that was made so.
fn write(path: &Path, text: &str) {
    let is_picture = text.starts_with("<svg");
    let written = match is_picture {
        true => disk::remake(path, &Made::new(text.to_string(), Comment::Markup)),
        false => disk::keep(path, text.as_bytes()),
    };
    match written {
        Ok(()) => output::print(&format!("written to {}\n", path.display())),
        Err(error) => message::error(&disk::not_written(path, &error), Some("choose another file")),
    }
}

/// A line as it is typed: it goes on while a bracket is open, is completed by names, and shown in colour.
#[derive(Helper)]
struct Lines(Rc<RefCell<Prompt>>);

impl Completer for Lines {
    type Candidate = String;

    fn complete(&self, line: &str, at: usize, _: &Context<'_>) -> rustyline::Result<(usize, Vec<String>)> {
        Ok(self.0.borrow_mut().complete(line, at))
    }
}

impl Hinter for Lines {
    type Hint = String;

    /// The rest of the only word that it can be.
    fn hint(&self, line: &str, at: usize, _: &Context<'_>) -> Option<String> {
        if at < line.len() || !line.ends_with(|c: char| c.is_alphanumeric() || c == '_') {
            return None;
        }
        let (begin, words) = self.0.borrow_mut().complete(line, at);
        match words.as_slice() {
            [only] => only.get(at - begin..).map(String::from),
            _ => None,
        }
    }
}

impl Highlighter for Lines {
    fn highlight<'l>(&self, line: &'l str, _: usize) -> Cow<'l, str> {
        if std::env::var_os("NO_COLOR").is_some() {
            return line.into();
        }
        let coloured = |(word, kind): (&str, WordKind)| match kind {
            WordKind::Word => format!("\x1b[1;34m{word}\x1b[0m"),
            WordKind::Number => format!("\x1b[36m{word}\x1b[0m"),
            WordKind::Text => format!("\x1b[32m{word}\x1b[0m"),
            WordKind::Comment => format!("\x1b[2m{word}\x1b[0m"),
            WordKind::Plain => word.to_string(),
        };
        Prompt::highlighted(line).into_iter().map(coloured).collect::<String>().into()
    }

    fn highlight_hint<'h>(&self, hint: &'h str) -> Cow<'h, str> {
        if std::env::var_os("NO_COLOR").is_some() { hint.into() } else { format!("\x1b[2m{hint}\x1b[0m").into() }
    }

    fn highlight_char(&self, _: &str, _: usize, _: CmdKind) -> bool {
        true
    }
}

impl Validator for Lines {
    fn validate(&self, context: &mut ValidationContext) -> rustyline::Result<ValidationResult> {
        let goes_on = Prompt::goes_on(context.input());
        Ok(if goes_on { ValidationResult::Incomplete } else { ValidationResult::Valid(None) })
    }
}
