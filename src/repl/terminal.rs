//! The terminal as it was before a line was edited in it, for who ends the program in the middle of one.

#[cfg(unix)]
mod unix {
    use nix::sys::termios::{FlushArg, SetArg, Termios, tcflush, tcgetattr, tcsetattr};
    use std::os::fd::AsRawFd;
    use std::sync::Mutex;

    static BEFORE: Mutex<Option<Termios>> = Mutex::new(None);

    /// Remembers how the terminal is.
    pub fn remember() {
        if let (Ok(now), Ok(mut before)) = (tcgetattr(std::io::stdin().as_raw_fd()), BEFORE.lock()) {
            *before = Some(now);
        }
    }

    /// Forgets what was typed and not read yet.
    pub fn discard() {
        let _ = tcflush(std::io::stdin().as_raw_fd(), FlushArg::TCIFLUSH);
    }

    /// Makes it so again.
    pub fn restore() {
        if let Ok(before) = BEFORE.lock()
            && let Some(before) = &*before
        {
            let _ = tcsetattr(std::io::stdin().as_raw_fd(), SetArg::TCSANOW, before);
        }
    }
}

#[cfg(unix)]
pub use unix::{discard, remember, restore};

/// There is no such thing.
#[cfg(not(unix))]
pub fn remember() {}

/// There is no such thing.
#[cfg(not(unix))]
pub fn discard() {}

/// There is no such thing.
#[cfg(not(unix))]
pub fn restore() {}
