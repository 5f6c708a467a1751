//! A person at a terminal: lines and progress, written by a thread of their own, because a terminal may hold who writes (Ctrl-S)
//! for as long as it likes.

use crate::exit::Exit;
use crate::message;
use indicatif::ProgressBar;
use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread::Builder;
use std::time::Duration;

/// Lines that wait at most; further ones are counted.
const LINES_MAX: usize = 1000;
/// A terminal that takes nothing for so long, when all is said, is left.
const PATIENCE: Duration = Duration::from_secs(1);

/// Who speaks to the person, and never waits.
pub struct Speaker {
    sender: Sender<Said>,
    waiting: Arc<AtomicUsize>,
    unsaid: usize,
    spoken: Receiver<()>,
}

enum Said {
    Line(String),
    /// Seconds, and what is under way.
    Progress(u64, String),
}

impl Speaker {
    /// With a progress bar, which nobody else may touch.
    pub fn new(bar: ProgressBar) -> io::Result<Self> {
        let (sender, said) = channel();
        let (speaks, spoken) = channel();
        let waiting = Arc::new(AtomicUsize::new(0));
        let waits = Arc::clone(&waiting);
        Builder::new().name("speaker".into()).spawn(move || speak(&bar, &said, &waits, &speaks))?;
        Ok(Speaker { sender, waiting, unsaid: 0, spoken })
    }

    /// Says whole lines, unless a thousand wait already.
    pub fn say(&mut self, lines: &str) {
        if self.waiting.load(Ordering::Relaxed) >= LINES_MAX {
            self.unsaid += 1;
            return;
        }
        if self.unsaid > 0 {
            let unsaid = std::mem::take(&mut self.unsaid);
            self.put(Said::Line(format!("{unsaid} messages were left out here: the terminal took none\n")));
        }
        self.put(Said::Line(lines.to_string()));
    }

    /// Shows where things are, if nothing else is to be said.
    pub fn progress(&mut self, seconds: u64, doing: impl FnOnce() -> String) {
        if self.waiting.load(Ordering::Relaxed) == 0 {
            self.put(Said::Progress(seconds, doing()));
        }
    }

    /// Says what waits, as long as the terminal takes it; whether all was said.
    pub fn end(self) -> bool {
        let Speaker { sender, spoken, .. } = self;
        drop(sender);
        loop {
            match spoken.recv_timeout(PATIENCE) {
                Ok(()) => {}
                Err(RecvTimeoutError::Disconnected) => return true,
                Err(RecvTimeoutError::Timeout) => return false,
            }
        }
    }

    fn put(&self, said: Said) {
        self.waiting.fetch_add(1, Ordering::Relaxed);
        let _ = self.sender.send(said);
    }
}

/// Speaks until nobody has anything to say any more; tells of each that it is said.
fn speak(bar: &ProgressBar, said: &Receiver<Said>, waiting: &AtomicUsize, speaks: &Sender<()>) {
    for said in said {
        match said {
            Said::Line(lines) => bar.suspend(|| message::write(&lines)),
            Said::Progress(seconds, doing) => {
                bar.set_position(seconds);
                bar.set_message(doing);
            }
        }
        waiting.fetch_sub(1, Ordering::Relaxed);
        let _ = speaks.send(());
    }
    bar.finish_and_clear();
}

/// Does what a terminal or a disk may hold, on a thread of its own; nothing, if it has not come to its end in time.
pub fn within<T: Send + 'static>(patience: Duration, work: impl FnOnce() -> T + Send + 'static) -> Option<T> {
    let (sender, done) = channel();
    Builder::new().name("last".into()).spawn(move || drop(sender.send(work()))).ok()?;
    done.recv_timeout(patience).ok()
}

/// Tells that there is no thread to be had.
pub fn no_thread(error: &io::Error) -> Exit {
    message::error(
        &format!("no thread can be started: {error}"),
        Some("end other programs, or raise the limit of threads"),
    );
    Exit::Failed
}
