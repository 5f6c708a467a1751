//! Whether the files of a run keep their names while it lasts: in real time that is long, and the person should know before its end.

use super::folder::Folder;
use super::not_ours;
use crate::{disk, message};
use albacore_session::threads::thread;
use std::fs::File;
use std::io;
use std::path::PathBuf;
use std::sync::{Arc, Weak};
use std::time::Duration;

/// The time from one look to the next.
const EVERY: Duration = Duration::from_secs(1);

/// Looks on a thread of its own, which a stalled disk may hold, until this is dropped or something was told.
pub struct Watch {
    _lasts: Arc<()>,
}

impl Watch {
    pub fn begin(folder: &Folder) -> io::Result<Self> {
        let (names, lasts) = (folder.names()?, Arc::new(()));
        let until = Arc::downgrade(&lasts);
        thread("files").spawn(move || look(&names, &until))?;
        Ok(Watch { _lasts: lasts })
    }
}

fn look(names: &[(File, PathBuf)], until: &Weak<()>) {
    while until.upgrade().is_some() {
        if let Some((_, path)) = names.iter().find(|(file, path)| !disk::is_at(file, path).unwrap_or(false)) {
            let help = "the mission goes on; what it writes is where the file is now, if anywhere";
            message::write(&message::error_text(&not_ours(path), Some(help)));
            return;
        }
        std::thread::sleep(EVERY);
    }
}
