//! `albacore report`: a run as one page that needs nothing else.

pub mod page;

use crate::exit::Exit;
use crate::made::{Comment, Made};
use crate::past::PastJournal;
use crate::{disk, message};
use albacore_session::report;
use std::path::PathBuf;

/// What the page is called in a run's folder.
pub const REPORT: &str = "report.html";

/// Show a run as one page: a map with its plume, timelines, diagrams, and every switch with its reason.
#[derive(clap::Args)]
pub struct RunReport {
    /// The folder of the run, or its journal.
    run: PathBuf,
    /// The file to write; else `report.html` in the run's folder.
    #[arg(long, value_name = "FILE.html")]
    out: Option<PathBuf>,
    /// The folder of the project, where files of data are that the script reads; else where it was run.
    #[arg(long, value_name = "FOLDER")]
    project: Option<PathBuf>,
}

impl RunReport {
    /// Writes it.
    pub fn run(&self) -> Exit {
        self.write().unwrap_or_else(|exit| exit)
    }

    fn write(&self) -> Result<Exit, Exit> {
        let past = PastJournal::open(&self.run)?;
        let (script, plan) = past.plan(self.project.as_deref())?;
        past.warn_of_changes(&plan);
        past.warn_of_clock();
        past.warn_of_no_clock("the report has the run's own time alone");
        let first_tick = past.first_tick.and_then(|moment| serde_json::to_value(moment).ok());
        let first_tick = first_tick.and_then(|moment| moment.as_str().map(str::to_string));
        let run = report(&script, &plan, &past.bytes, first_tick).map_err(|unreadable| {
            message::error(&format!("`{}`: {unreadable}", past.path.display()), None);
            Exit::Failed
        })?;
        if let Some(cut) = &run.cut {
            message::warning(cut, "the report shows what is before that, and says so");
        }
        let text = page::of(&run).map_err(|error| {
            message::error(&format!("the report cannot be made: {error}"), None);
            Exit::Failed
        })?;
        let out = self.out.clone().unwrap_or_else(|| self.beside());
        match disk::remake(&out, &Made::new(text, Comment::Markup)) {
            Ok(()) => {
                message::write(&message::line(&format!("wrote {}", out.display())));
                Ok(Exit::Well)
            }
            Err(error) => {
                message::error(&disk::not_written(&out, &error), Some("choose another file with `--out`"));
                Err(Exit::Failed)
            }
        }
    }

    /// Where it is written when nobody says.
    fn beside(&self) -> PathBuf {
        if self.run.is_dir() { self.run.join(REPORT) } else { self.run.with_file_name(REPORT) }
    }
}

#[cfg(test)]
mod tests {
    use super::RunReport;
    use std::path::Path;

    #[test]
    fn a_report_of_a_journal_lies_beside_it() {
        let report = |run: &str| RunReport { run: run.into(), out: None, project: None }.beside();
        assert_eq!(report("no/such/journal"), Path::new("no/such/report.html"));
    }
}
