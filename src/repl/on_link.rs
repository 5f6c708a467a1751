//! The prompt of a vehicle at the end of a link. It has a thread of its own, which drives while a line is typed and is held by no terminal:
//! what comes of a line goes back to who typed it, and what happens meanwhile to who prints it above the line.

use super::hear;
use crate::exit::Exit;
use crate::speaker::within;
use crate::{interruption, message};
use albacore_session::prompt::{Answer, OpenError, Opening, Prompt, Say};
use albacore_session::seen::shown;
use albacore_session::threads::thread;
use albacore_session::{Called, Diagnostic, Sources};
use std::cell::Cell;
use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, SyncSender, TryRecvError, channel, sync_channel};
use std::time::Duration;

/// So many lines wait to be printed above what is typed; more are left out while a terminal takes none.
const WAITING_MAX: usize = 1000;
/// No longer line is read while a vehicle waits for its commands.
const LINE_BYTES_MAX: usize = 1 << 16;
/// A look for the next line, where no vehicle is to be looked after any more.
const LOOK: Duration = Duration::from_millis(50);

/// A terminal has so long for what is said in the end.
const LAST_WORDS: Duration = Duration::from_secs(1);

/// What is asked of the prompt.
enum Request {
    Enter(String),
    Complete(String, usize),
    Leave,
}

/// What comes of it.
enum Reply {
    Said(Heard),
    /// Whether the person has interrupted it, too.
    Entered(Answer, bool),
    Words(usize, Vec<String>),
    Left(Exit),
}

/// What the prompt says, on its way to who prints it.
enum Heard {
    Text(String),
    Findings(Vec<Diagnostic>, Sources),
    Error(String, Option<String>),
    File(String, String),
    Page(String),
}

impl Heard {
    fn of(said: Say) -> Self {
        match said {
            Say::Text(text) => Heard::Text(text.to_string()),
            Say::Findings(findings, sources) => Heard::Findings(findings.to_vec(), sources.clone()),
            Say::Error(what, help) => Heard::Error(what.to_string(), help.map(str::to_string)),
            Say::File(path, text) => Heard::File(path.to_string(), text.to_string()),
            Say::Page(code) => Heard::Page(code.to_string()),
        }
    }

    fn say(&self) -> Say<'_> {
        match self {
            Heard::Text(text) => Say::Text(text),
            Heard::Findings(findings, sources) => Say::Findings(findings, sources),
            Heard::Error(what, help) => Say::Error(what, help.as_deref()),
            Heard::File(path, text) => Say::File(path, text),
            Heard::Page(code) => Say::Page(code),
        }
    }
}

/// A prompt on another thread, as the person's side sees it.
pub struct LinkedPrompt {
    requests: Sender<Request>,
    replies: Receiver<Reply>,
    greeting: String,
    /// How the session has ended.
    left: Cell<Option<Exit>>,
    was_stopped: Cell<bool>,
}

/// Prints what happens while a line is typed, given as whole lines.
pub type Above = Box<dyn FnMut(&str) + Send>;

impl LinkedPrompt {
    /// Opens the prompt for a vehicle that was heard. `interrupted` stops what is under way, and ends a session whose lines nobody types.
    pub fn open(
        opening: Opening,
        vehicle: Called,
        interrupted: Arc<AtomicBool>,
        is_typed: bool,
    ) -> io::Result<Result<(Self, Meanwhile), OpenError>> {
        let (requests, asked) = channel();
        let (replies, replied) = channel();
        let (opens, opened) = channel();
        let (lines, meanwhile) = sync_channel(WAITING_MAX);
        let is_over = interruption::flag();
        thread("prompt").spawn(move || {
            let prompt = match Prompt::on_link(opening, vehicle) {
                Ok(prompt) => prompt,
                Err(error) => return drop(opens.send(Err(error))),
            };
            let _ = opens.send(Ok(prompt.greeting()));
            Driver { prompt, lines, left_out: 0, interrupted, is_over, is_typed, replies }.drive(&asked);
        })?;
        let greeting = match opened.recv() {
            Ok(Ok(greeting)) => greeting,
            Ok(Err(error)) => return Ok(Err(error)),
            Err(_) => return Err(io::Error::other("the thread of the prompt has ended")),
        };
        Ok(Ok((
            LinkedPrompt { requests, replies: replied, greeting, left: Cell::default(), was_stopped: Cell::default() },
            Meanwhile(meanwhile),
        )))
    }

    /// What is loaded, in one line.
    pub fn greeting(&self) -> &str {
        &self.greeting
    }

    /// Does what was typed, and prints what comes of it. None: the prompt is over.
    pub fn enter(&self, text: &str) -> Option<Answer> {
        // Who has left has said how, and is heard here.
        let _ = self.requests.send(Request::Enter(text.to_string()));
        loop {
            match self.replies.recv().ok()? {
                Reply::Said(heard) => hear(heard.say()),
                Reply::Entered(answer, was_stopped) => {
                    self.was_stopped.set(was_stopped);
                    return Some(answer);
                }
                Reply::Words(..) => {}
                Reply::Left(exit) => {
                    self.left.set(Some(exit));
                    return None;
                }
            }
        }
    }

    /// Whether the person has interrupted what was entered last.
    pub fn was_stopped(&self) -> bool {
        self.was_stopped.get()
    }

    /// What a line may go on with.
    pub fn complete(&self, line: &str, at: usize) -> (usize, Vec<String>) {
        let nothing = (at, Vec::new());
        if self.requests.send(Request::Complete(line.to_string(), at)).is_err() {
            return nothing;
        }
        match self.replies.recv() {
            Ok(Reply::Words(begin, words)) => (begin, words),
            Ok(Reply::Left(exit)) => {
                self.left.set(Some(exit));
                nothing
            }
            _ => nothing,
        }
    }

    /// Gives the vehicle back; how the session ends.
    pub fn leave(&self) -> Exit {
        if let Some(exit) = self.left.get() {
            return exit;
        }
        let _ = self.requests.send(Request::Leave);
        while let Ok(reply) = self.replies.recv() {
            match reply {
                Reply::Said(heard) => hear(heard.say()),
                Reply::Left(exit) => return exit,
                Reply::Entered(..) | Reply::Words(..) => {}
            }
        }
        Exit::Failed
    }
}

/// What happens while nothing is asked.
pub struct Meanwhile(Receiver<String>);

impl Meanwhile {
    /// Prints it on a thread of its own, which a terminal may hold.
    pub fn print(self, mut above: Above) -> io::Result<()> {
        thread("printer").spawn(move || self.0.into_iter().for_each(|lines| above(&lines)))?;
        Ok(())
    }
}

/// Why a session is over.
enum Left {
    ByPerson,
    /// The system asks the program to end, or Ctrl-C does, where nobody types: whoever waits for the next line waits on.
    ByRequest,
    /// Ctrl-C in a line that nobody typed.
    Interrupted,
}

/// The side of the vehicle.
struct Driver {
    prompt: Prompt,
    lines: SyncSender<String>,
    left_out: u64,
    interrupted: Arc<AtomicBool>,
    is_over: Arc<AtomicBool>,
    /// A person types, and goes on after Ctrl-C.
    is_typed: bool,
    replies: Sender<Reply>,
}

impl Driver {
    /// Drives until the person leaves, or the system asks the program to end. A panic is a fault of the interpreter, and still no reason to
    /// leave a vehicle without its release.
    fn drive(mut self, asked: &Receiver<Request>) {
        let lived = catch_unwind(AssertUnwindSafe(|| self.live(asked)));
        let by_request = matches!(lived, Ok(Left::ByRequest));
        let (replies, mut told) = (self.replies.clone(), Vec::new());
        let released = self.prompt.leave(&mut |said| told.push(Heard::of(said)));
        if lived.is_err() {
            told.push(Heard::Error("the interpreter has panicked: report this".to_string(), None));
        }
        let exit = match released {
            Ok(()) if lived.is_ok() && !self.prompt.has_lost_link() => match lived {
                Ok(Left::ByPerson) => Exit::Well,
                _ => Exit::NotWell,
            },
            Ok(()) => Exit::Failed,
            Err(error) => {
                told.push(Heard::Error(error.to_string(), None));
                Exit::Failed
            }
        };
        if by_request {
            // A terminal may hold who writes.
            super::terminal::restore();
            within(LAST_WORDS, move || told.iter().for_each(|heard| hear(heard.say())));
            std::process::exit(exit as i32);
        }
        told.into_iter().for_each(|heard| _ = replies.send(Reply::Said(heard)));
        let _ = replies.send(Reply::Left(exit));
    }

    /// Goes on until somebody leaves.
    fn live(&mut self, asked: &Receiver<Request>) -> Left {
        loop {
            if self.is_over.load(Ordering::Relaxed) {
                return Left::ByRequest;
            }
            let is_interrupted = self.interrupted.swap(false, Ordering::Relaxed);
            // The next of lines that nobody types would set it in motion again, and may never come.
            if is_interrupted && !self.is_typed {
                return Left::ByRequest;
            }
            if is_interrupted && self.prompt.is_busy() {
                let never = AtomicBool::new(false);
                self.meanwhile(|prompt, say| _ = prompt.enter("stop", &never, say));
            }
            let request = match self.prompt.has_lost_link() {
                true => asked.recv_timeout(LOOK).map_err(|error| match error {
                    RecvTimeoutError::Timeout => TryRecvError::Empty,
                    RecvTimeoutError::Disconnected => TryRecvError::Disconnected,
                }),
                false => asked.try_recv(),
            };
            match request {
                Ok(Request::Enter(text)) if text.len() > LINE_BYTES_MAX => {
                    let what = format!("a line for a vehicle at the end of a link has {LINE_BYTES_MAX} bytes at most");
                    let help = "declare it in the script: the vehicle is told nothing while a line is read".to_string();
                    let _ = self.replies.send(Reply::Said(Heard::Error(what, Some(help))));
                    let _ = self.replies.send(Reply::Entered(Answer::Wrong, false));
                }
                Ok(Request::Enter(text)) => {
                    let replies = self.replies.clone();
                    let mut say = |said: Say| _ = replies.send(Reply::Said(Heard::of(said)));
                    let answer = self.prompt.enter(&text, &self.interrupted, &mut say);
                    if self.prompt.was_stopped() && !self.is_typed {
                        return Left::Interrupted;
                    }
                    let _ = self.replies.send(Reply::Entered(answer, self.prompt.was_stopped()));
                }
                Ok(Request::Complete(line, at)) => {
                    let (begin, words) = self.prompt.complete(&line, at);
                    let _ = self.replies.send(Reply::Words(begin, words));
                }
                Ok(Request::Leave) | Err(TryRecvError::Disconnected) => return Left::ByPerson,
                Err(TryRecvError::Empty) => self.meanwhile(Prompt::idle),
            }
        }
    }

    /// What is said while nobody asks is printed above the line that is being typed; it is left out where nobody takes it.
    fn meanwhile(&mut self, work: impl FnOnce(&mut Prompt, &mut dyn FnMut(Say))) {
        let mut said = Vec::new();
        work(&mut self.prompt, &mut |say: Say| said.push(Heard::of(say)));
        for heard in said {
            let mut text = match heard {
                Heard::Text(text) => shown(&text) + "\n",
                Heard::Error(what, help) => shown(&message::error_text(&what, help.as_deref())),
                Heard::Findings(..) | Heard::File(..) | Heard::Page(_) => continue,
            };
            if self.left_out > 0 {
                text = format!("{} lines were left out here: the terminal took none\n{text}", self.left_out);
            }
            match self.lines.try_send(text) {
                Ok(()) => self.left_out = 0,
                Err(_) => self.left_out += 1,
            }
        }
    }
}
