//! `albacore repl`: a vehicle that does what is typed: a simulated one, or one at the end of a link.

mod on_link;
mod terminal;

use crate::called::Call;
use crate::campaign::seeds;
use crate::clock;
use crate::exit::Exit;
use crate::interruption;
use crate::made::{Comment, Made};
use crate::message;
use crate::output;
use crate::past::PastJournal;
use crate::plan::{Choice, Faults};
use crate::speaker::{hears_requests, no_thread};
use crate::{disk, explain};
use albacore_session::journal::is_beginning;
use albacore_session::prompt::{Answer, OpenError, Opening, PastTicks, Prompt, Say, WordKind};
use on_link::{Above, LinkedPrompt, Meanwhile};
use rustyline::completion::Completer;
use rustyline::error::ReadlineError;
use rustyline::highlight::{CmdKind, Highlighter};
use rustyline::hint::Hinter;
use rustyline::history::MemHistory;
use rustyline::validate::{ValidationContext, ValidationResult, Validator};
use rustyline::{Context, Editor, ExternalPrinter, Helper};
use std::borrow::Cow;
use std::cell::RefCell;
use std::io::{BufRead, IsTerminal, Read};
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// A line that goes on in so many others is taken as it is: it is no script.
const LINES_AT_ONCE_MAX: usize = 1_000;

/// A line is no longer than this, in bytes; no more are read before it is taken as it is.
const LINE_BYTES_MAX: u64 = 1 << 20;

/// A journal is known by so many of its bytes.
const MAGIC_BYTES: u64 = 4;

/// What to do about bytes that are no text.
const NOT_UTF8: &str = "it is left out; type it again, or send it as UTF-8";

/// Drive a vehicle line by line: a simulated one, without a script in still water, or one at the end of a link.
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
    /// Drive a vehicle at the end of a link instead of a simulated one: `serial:/dev/ttyUSB0?dialect=recon`,
    /// `udp:HOST:PORT?dialect=recon`. The script's mission says where on the globe. The first statement takes control.
    #[arg(long, value_name = "URL", requires = "script", conflicts_with_all = ["scenario", "texts", "seed"])]
    link: Option<String>,
    /// How many times faster than real time the vehicle at the end of the link runs.
    #[arg(long, value_name = "N", requires = "link", value_parser = clock::rate, allow_negative_numbers = true)]
    rate: Option<f64>,
}

impl Repl {
    /// Does what is typed until the person leaves.
    pub fn run(&self) -> Exit {
        if let Some(link) = &self.link {
            return self.on_link(link).unwrap_or_else(|exit| exit);
        }
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
            link: None,
            past: past.map(|(past, _)| Arc::new(past)),
        };
        let prompt = match Prompt::open(opening) {
            Ok(prompt) => prompt,
            Err(error) => return not_opened(error),
        };
        let prompt = Shared::Here(Rc::new((RefCell::new(prompt), interruption::ctrl_c())));
        if std::io::stdin().is_terminal() { typed(&prompt, None) } else { piped(&prompt) }
    }

    /// Drives a vehicle at the end of a link, and gives it back.
    fn on_link(&self, link: &str) -> Result<Exit, Exit> {
        interruption::hear_faults();
        let Some(path) = &self.script else { return Err(Exit::Usage) };
        if is_run(path) {
            message::error(
                "a run that is over has no link",
                Some("give the script of a mission, or leave out `--link`"),
            );
            return Err(Exit::Usage);
        }
        hears_requests()?;
        let script = self.choice.script(path)?;
        let mut call = Call::open(&script, path, self.choice.mission.as_deref(), link, self.rate)?;
        call.hear(&interruption::flag())?;
        let interrupted = interruption::ctrl_c_and_requests();
        let stops = interruption::ctrl_z();
        let opening = Opening {
            script: self.script.clone(),
            mission: self.choice.mission.clone(),
            set: self.choice.set.clone(),
            link: Some(call.url),
            ..Opening::default()
        };
        let is_typed = std::io::stdin().is_terminal();
        let opened =
            LinkedPrompt::open(opening, call.vehicle, interrupted, is_typed).map_err(|error| no_thread(&error))?;
        let (prompt, meanwhile) = opened.map_err(not_opened)?;
        let prompt = Shared::Linked(Rc::new((prompt, stops)));
        let exit = match is_typed {
            true => typed(&prompt, Some(meanwhile)),
            false => {
                meanwhile.print(Box::new(output::print_raw)).map_err(|error| no_thread(&error))?;
                piped(&prompt)
            }
        };
        match prompt {
            Shared::Linked(prompt) => Ok(match prompt.0.leave() {
                Exit::Well => exit,
                failed => failed,
            }),
            Shared::Here(_) => Ok(exit),
        }
    }

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

/// Tells why a prompt cannot be opened.
fn not_opened(error: OpenError) -> Exit {
    match error {
        OpenError::File(error) => {
            message::error(&error.message, error.help.as_deref());
            Exit::Usage
        }
        OpenError::Script(found) => {
            message::findings(&found.0, &found.1);
            Exit::Script
        }
        OpenError::Asked(what, help) => {
            message::error(&what, help.as_deref());
            Exit::Usage
        }
    }
}

/// A prompt, wherever it is, as those see it who type.
#[derive(Clone)]
enum Shared {
    /// On this thread, with the flag that Ctrl-C raises.
    Here(Rc<(RefCell<Prompt>, Arc<AtomicBool>)>),
    /// On another, with the flag that Ctrl-Z raises.
    Linked(Rc<(LinkedPrompt, Arc<AtomicBool>)>),
}

impl Shared {
    fn greeting(&self) -> String {
        match self {
            Shared::Here(here) => here.0.borrow().greeting(),
            Shared::Linked(linked) => linked.0.greeting().to_string(),
        }
    }

    /// Does what was typed; none: the prompt is over.
    fn enter(&self, text: &str) -> Option<Answer> {
        match self {
            Shared::Here(here) => Some(here.0.borrow_mut().enter(text, &here.1, &mut hear)),
            Shared::Linked(linked) => linked.0.enter(text),
        }
    }

    fn complete(&self, line: &str, at: usize) -> (usize, Vec<String>) {
        match self {
            Shared::Here(here) => here.0.borrow_mut().complete(line, at),
            Shared::Linked(linked) => linked.0.complete(line, at),
        }
    }

    /// Whether the person has interrupted what a vehicle at the end of a link did.
    fn was_stopped(&self) -> bool {
        matches!(self, Shared::Linked(linked) if linked.0.was_stopped())
    }

    /// Ctrl-C where a line is typed.
    fn interrupt(&self) {
        match self {
            Shared::Linked(_) => _ = self.enter("stop"),
            Shared::Here(_) => hear(Say::Text("`quit` or Ctrl-D leaves")),
        }
    }

    /// Ctrl-Z stops nothing where a vehicle would be left without commands.
    fn tell_of_ctrl_z(&self) {
        if let Shared::Linked(linked) = self
            && linked.1.swap(false, Ordering::Relaxed)
        {
            hear(Say::Text(
                "Ctrl-Z would leave the vehicle without commands, and stops nothing here; `quit` or Ctrl-D leaves",
            ));
        }
    }
}

/// Lines from a person.
fn typed(prompt: &Shared, meanwhile: Option<Meanwhile>) -> Exit {
    terminal::remember();
    let above = Arc::new(Mutex::new(Box::new(output::print_raw) as Above));
    let mut editor = match edited(prompt, &[], &above) {
        Ok(editor) => editor,
        Err(exit) => return exit,
    };
    hear(Say::Text(&prompt.greeting()));
    if let Some(meanwhile) = meanwhile {
        let above = Arc::clone(&above);
        let print = move |lines: &str| (above.lock().unwrap_or_else(PoisonError::into_inner))(lines);
        if let Err(error) = meanwhile.print(Box::new(print)) {
            return no_thread(&error);
        }
    }
    let mut history = Vec::new();
    loop {
        let line = editor.readline("> ");
        prompt.tell_of_ctrl_z();
        match line {
            Ok(text) => {
                // What cannot be remembered is typed again.
                let _ = editor.add_history_entry(text.as_str());
                let answer = prompt.enter(&text);
                history.push(text);
                if answer.is_none_or(|answer| answer == Answer::Quit) {
                    return Exit::Well;
                }
                if prompt.was_stopped() {
                    // Lines that were pasted behind the one that was stopped would set the vehicle in motion again.
                    terminal::discard();
                    editor = match edited(prompt, &history, &above) {
                        Ok(editor) => editor,
                        Err(exit) => return exit,
                    };
                }
            }
            Err(ReadlineError::Interrupted) => prompt.interrupt(),
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

/// A line editor that has read nothing yet, with the lines that were typed before; what happens meanwhile is printed above its line.
fn edited(prompt: &Shared, history: &[String], above: &Mutex<Above>) -> Result<Editor<Lines, MemHistory>, Exit> {
    let editor = Editor::with_history(Default::default(), MemHistory::new());
    let mut editor: Editor<Lines, MemHistory> = editor.map_err(|error| {
        message::error(&format!("the terminal cannot be used: {error}"), Some("give the lines through a pipe"));
        Exit::Failed
    })?;
    editor.set_helper(Some(Lines(prompt.clone())));
    history.iter().for_each(|line| _ = editor.add_history_entry(line.as_str()));
    // Where only the input is a terminal, there is no line to print above.
    if let (Shared::Linked(_), Ok(mut printer)) = (prompt, editor.create_external_printer()) {
        *above.lock().unwrap_or_else(PoisonError::into_inner) =
            Box::new(move |lines| _ = printer.print(lines.to_string()));
    }
    Ok(editor)
}

/// Lines from a pipe or a file: the same, without the greeting; that one of them was wrong is told at the end.
fn piped(prompt: &Shared) -> Exit {
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
        match prompt.enter(text.trim_end()) {
            Some(Answer::Quit) | None => return exit,
            Some(Answer::Wrong) => exit = Exit::Script,
            Some(Answer::Done) => {}
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
struct Lines(Shared);

impl Completer for Lines {
    type Candidate = String;

    fn complete(&self, line: &str, at: usize, _: &Context<'_>) -> rustyline::Result<(usize, Vec<String>)> {
        Ok(self.0.complete(line, at))
    }
}

impl Hinter for Lines {
    type Hint = String;

    /// The rest of the only word that it can be.
    fn hint(&self, line: &str, at: usize, _: &Context<'_>) -> Option<String> {
        if at < line.len() || !line.ends_with(|c: char| c.is_alphanumeric() || c == '_') {
            return None;
        }
        let (begin, words) = self.0.complete(line, at);
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
