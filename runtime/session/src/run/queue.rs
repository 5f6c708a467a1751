//! A queue with a bound in bytes between a driver, which never waits, and a writer, which may.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::Duration;

/// The end of a queue into which is put.
pub(super) struct Feed<T> {
    sender: Sender<(usize, T)>,
    waiting: Arc<AtomicUsize>,
    most: usize,
    is_full: bool,
}

/// The end of a queue from which is taken.
pub(super) struct Intake<T> {
    receiver: Receiver<(usize, T)>,
    waiting: Arc<AtomicUsize>,
}

/// A queue in which so many bytes may wait.
pub(super) fn queue<T>(most: usize) -> (Feed<T>, Intake<T>) {
    let (sender, receiver) = channel();
    let waiting = Arc::new(AtomicUsize::new(0));
    (Feed { sender, waiting: Arc::clone(&waiting), most, is_full: false }, Intake { receiver, waiting })
}

impl<T> Feed<T> {
    /// Whether so many bytes more may wait. A queue that was full takes nothing before half of it is free: one gap is better
    /// than many.
    pub fn has_room(&mut self, bytes: usize) -> bool {
        let waiting = self.waiting.load(Ordering::Relaxed);
        let most = if self.is_full { self.most / 2 } else { self.most };
        self.is_full = waiting != 0 && waiting + bytes > most;
        !self.is_full
    }

    /// Puts in, room or not. Nobody may be there any more to take it: then nobody wants it.
    pub fn put(&self, bytes: usize, item: T) {
        self.waiting.fetch_add(bytes, Ordering::Relaxed);
        let _ = self.sender.send((bytes, item));
    }
}

impl<T> Intake<T> {
    /// What comes next, if it comes within a while.
    pub fn take(&self, wait: Duration) -> Result<T, RecvTimeoutError> {
        let (bytes, item) = self.receiver.recv_timeout(wait)?;
        self.waiting.fetch_sub(bytes, Ordering::Relaxed);
        Ok(item)
    }

    /// How many bytes wait, for who looks on from elsewhere.
    pub fn level(&self) -> Arc<AtomicUsize> {
        Arc::clone(&self.waiting)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_queue_takes_nothing_before_half_of_it_is_free() {
        let (mut feed, intake) = queue(10);
        assert!(feed.has_room(100), "an empty queue takes what is larger than it");
        for item in 0..10 {
            assert!(feed.has_room(1));
            feed.put(1, item);
        }
        for left in [9, 8, 7, 6, 5] {
            assert!(!feed.has_room(1), "{left} and one wait");
            intake.take(Duration::ZERO).unwrap();
        }
        assert!(!feed.has_room(1));
        intake.take(Duration::ZERO).unwrap();
        assert!(feed.has_room(1));
        feed.put(1, 10);
        assert!(feed.has_room(5));
    }
}
