//! A run on a link, in real time: nothing here that may be held, a terminal or a disk, holds the driver.

use crate::exit::Exit;
use crate::interruption;
use crate::live_page::LivePage;
use crate::message;
use crate::run::{self, ResultPrinter};
use crate::run_folder::{Left, RunFolder};
use crate::speaker::{Speaker, no_thread, within};
use albacore_session::{LiveOptions, LiveRun, LiveUpdate, Run, Sink, WAITING_BYTES};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// So long the disk has for trace and picture, when the vehicle is given back.
const FILES: Duration = Duration::from_secs(10);
/// ... and the terminal for the result.
const RESULT: Duration = Duration::from_secs(2);

const CTRL_Z: &str =
    "Ctrl-Z would leave the vehicle without commands, and stops nothing here; Ctrl-C ends the mission\n";

/// What a run on a link is done with.
pub struct Live {
    /// Shows messages and progress.
    pub speaker: Speaker,
    /// The page that is served of it.
    pub page: Option<LivePage>,
    /// Where the journal goes, and what was changed for this run.
    pub journal: Option<(Sink, Vec<String>)>,
    /// Raised when the run is to end.
    pub interrupted: Arc<AtomicBool>,
    /// The run's files.
    pub kept: RunFolder,
    /// How its result is told.
    pub printer: ResultPrinter,
}

impl Live {
    /// Runs to the end, gives the vehicle back, and then waits for terminal and disk no longer than is stated.
    pub fn run(self, run: Run) -> Exit {
        let Live { speaker, page, journal, interrupted, mut kept, printer } = self;
        let stopping = interruption::ctrl_z();
        let watch = kept.watch();
        let mut report = |told: LiveUpdate<'_>| {
            if stopping.swap(false, Ordering::Relaxed) {
                message::write(CTRL_Z);
            }
            match told {
                LiveUpdate::Notice(notice) => message::write(&message::line(&format!("link: {notice}"))),
                LiveUpdate::Progress(status, active) => {
                    kept.ticks();
                    speaker.progress(|| status.line(active));
                }
                LiveUpdate::JournalFailed(error) => message::write(&kept.journal_failed(&error)),
                LiveUpdate::Nothing => {}
            }
        };
        let lived = run.live(LiveOptions { journal, interrupted, report: &mut report, waiting_bytes: WAITING_BYTES });
        let LiveRun { run, outcome, journal_stalled } = match lived {
            Ok(lived) => lived,
            Err(error) => {
                kept.never_began(&format!("no thread can be started: {error}"));
                return no_thread(&error);
            }
        };
        drop(watch);
        if journal_stalled {
            message::write(&kept.journal_stalled());
        }
        let all_said = speaker.end();
        let (summary, release_failed) = (run.summary(printer.wall_s()), run.release_failed());
        let folder = kept.path().map(Path::to_path_buf);
        let result = summary.clone();
        let files = within(FILES, move || (kept.finish(&run, &result), kept.has_failed()));
        let told = within(RESULT, move || {
            let (left, failed) = files.unwrap_or_else(|| (Left::unknown(folder, FILES), true));
            left.tell_troubles();
            let told = run::RunResult::new(&summary, left.folder.as_deref());
            printer.print(&told, outcome, &left);
            failed
        });
        if let Some(page) = page {
            page.end();
        }
        // A result that nobody could be told is a failure too.
        ResultPrinter::exit(outcome, release_failed || !all_said || told.unwrap_or(true))
    }
}
