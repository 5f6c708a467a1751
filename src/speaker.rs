//! A person at a terminal: lines and progress, written by a thread of their own, because a terminal may hold who writes (Ctrl-S)
//! for as long as it likes.

use crate::exit::Exit;
use crate::{interruption, message};
use albacore_session::threads::thread;
use indicatif::ProgressBar;
use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::Duration;

/// Messages that wait at most; further ones are counted.
const WAITING_MAX: usize = 1000;
/// A spinner turns once in this time, whether there is news or not.
const BEAT: Duration = Duration::from_millis(100);
/// A terminal that takes nothing for so long, when all is said, is left.
const PATIENCE: Duration = Duration::from_secs(1);

/// Who speaks to the person, and never waits: while it lives, every message of the program goes through it.
pub struct Speaker {
    queue: Option<Queue>,
    spoken: Receiver<()>,
}

/// The way to the thread that writes.
#[derive(Clone)]
struct Queue {
    sender: Sender<Said>,
    waiting: Arc<AtomicUsize>,
    unsaid: Arc<AtomicUsize>,
}

enum Said {
    Lines(String),
    /// A progress bar is made, which nobody else may touch: it draws.
    Bar(Box<dyn FnOnce() -> ProgressBar + Send>),
    /// How things stand.
    Progress(String),
}

impl Speaker {
    /// Takes what is said from here on.
    pub fn new() -> io::Result<Self> {
        let (sender, said) = channel();
        let (speaks, spoken) = channel();
        let queue = Queue { sender, waiting: Arc::default(), unsaid: Arc::default() };
        let waits = Arc::clone(&queue.waiting);
        thread("speaker").spawn(move || speak(&said, &waits, &speaks))?;
        let lines = queue.clone();
        message::hand_to(Some(Box::new(move |text| lines.say(text))));
        Ok(Speaker { queue: Some(queue), spoken })
    }

    /// Shows progress on a bar.
    pub fn shows(&self, bar: impl FnOnce() -> ProgressBar + Send + 'static) {
        if let Some(queue) = &self.queue {
            queue.put(Said::Bar(Box::new(bar)));
        }
    }

    /// Shows where things are, if nothing else is to be said.
    pub fn progress(&self, told: impl FnOnce() -> String) {
        if let Some(queue) = self.queue.as_ref().filter(|queue| queue.waiting.load(Ordering::Relaxed) == 0) {
            queue.put(Said::Progress(told()));
        }
    }

    /// Says what waits, as long as the terminal takes it; whether all was said. What is said later is written at once.
    pub fn end(mut self) -> bool {
        self.says_all()
    }

    fn says_all(&mut self) -> bool {
        if self.queue.take().is_none() {
            return true;
        }
        message::hand_to(None);
        loop {
            match self.spoken.recv_timeout(PATIENCE) {
                Ok(()) => {}
                Err(RecvTimeoutError::Disconnected) => return true,
                Err(RecvTimeoutError::Timeout) => return false,
            }
        }
    }
}

/// Whoever ends early has said why.
impl Drop for Speaker {
    fn drop(&mut self) {
        self.says_all();
    }
}

impl Queue {
    /// Says whole lines, unless a thousand messages wait already.
    fn say(&self, lines: &str) {
        if self.waiting.load(Ordering::Relaxed) >= WAITING_MAX {
            self.unsaid.fetch_add(1, Ordering::Relaxed);
            return;
        }
        let unsaid = self.unsaid.swap(0, Ordering::Relaxed);
        if unsaid > 0 {
            self.put(Said::Lines(format!("{unsaid} messages were left out here: the terminal took none\n")));
        }
        self.put(Said::Lines(lines.to_string()));
    }

    fn put(&self, said: Said) {
        self.waiting.fetch_add(1, Ordering::Relaxed);
        let _ = self.sender.send(said);
    }
}

/// Speaks until nobody has anything to say any more; tells of each that it is said.
fn speak(said: &Receiver<Said>, waiting: &AtomicUsize, speaks: &Sender<()>) {
    let mut bar = ProgressBar::hidden();
    loop {
        let said = match said.recv_timeout(BEAT) {
            Ok(said) => said,
            Err(RecvTimeoutError::Timeout) => {
                bar.tick();
                continue;
            }
            Err(RecvTimeoutError::Disconnected) => break,
        };
        match said {
            Said::Lines(lines) => bar.suspend(|| message::print(&lines)),
            Said::Bar(make) => bar = make(),
            Said::Progress(told) => bar.set_message(told),
        }
        waiting.fetch_sub(1, Ordering::Relaxed);
        let _ = speaks.send(());
    }
    bar.finish_and_clear();
}

/// Does what a terminal or a disk may hold, on a thread of its own; nothing, if it has not come to its end in time.
pub fn within<T: Send + 'static>(patience: Duration, work: impl FnOnce() -> T + Send + 'static) -> Option<T> {
    let (sender, done) = channel();
    thread("last").spawn(move || drop(sender.send(work()))).ok()?;
    done.recv_timeout(patience).ok()
}

/// Begins to hear the system's requests to end; tells where that cannot be.
pub fn hears_requests() -> Result<(), Exit> {
    interruption::hears().map_err(|why| {
        message::error(
            &format!("signals cannot be heard, and so nothing would give the vehicle back: {why}"),
            Some("close files and end other programs, or raise the limits of open files and threads"),
        );
        Exit::Failed
    })
}

/// Tells that there is no thread to be had.
pub fn no_thread(error: &io::Error) -> Exit {
    message::error(
        &format!("no thread can be started: {error}"),
        Some("end other programs, or raise the limit of threads"),
    );
    Exit::Failed
}
