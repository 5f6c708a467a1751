//! `albacore export`: a run as files that other programs read. Which formats there are is told by one table, that of `albacore-export`.

use crate::exit::Exit;
use crate::output::Lines;
use crate::past::PastJournal;
use crate::{disk, message};
use albacore_session::export::{FORMATS, Format};
use albacore_session::journal::Ending;
use albacore_session::{Changes, ExportedRun, exported};
use clap::{Arg, ArgAction, ArgMatches, Args, Command, FromArgMatches};
use std::io;
use std::path::{Path, PathBuf};

/// The folder in the run's folder where nobody names another.
const FOLDER: &str = "export";

/// Write a run for other programs: as a table, on a map, or as a log.
#[derive(clap::Args)]
pub struct Export {
    /// The folder of the run, or its journal.
    run: PathBuf,
    #[command(flatten)]
    formats: Chosen,
    /// The folder for the files; else `export` in the run's folder.
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
    /// Write files anew that are there already.
    #[arg(long)]
    replace: bool,
    /// The script that was run, where the journal does not hold it.
    #[arg(long, value_name = "SCRIPT.alb")]
    script: Option<PathBuf>,
    /// The folder of the project, where files of data are that the script reads; else where it was run.
    #[arg(long, value_name = "FOLDER")]
    project: Option<PathBuf>,
}

/// The formats that were chosen: an option for each row of the table.
struct Chosen(Vec<&'static Format>);

impl FromArgMatches for Chosen {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        Ok(Chosen(FORMATS.iter().filter(|format| matches.get_flag(format.name)).collect()))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Chosen::from_arg_matches(matches)?;
        Ok(())
    }
}

impl Args for Chosen {
    fn augment_args(command: Command) -> Command {
        let option = |format: &Format| {
            let help = format!("{}: `{}`", format.about, format.file);
            Arg::new(format.name).long(format.name).help(help).action(ArgAction::SetTrue)
        };
        command.args(FORMATS.iter().map(option))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Chosen::augment_args(command)
    }
}

impl Export {
    /// Writes the files.
    pub fn run(&self) -> Exit {
        self.export().map_or_else(|exit| exit, |()| Exit::Well)
    }

    fn export(&self) -> Result<(), Exit> {
        let formats = &self.formats.0;
        if formats.is_empty() {
            let all = listed(FORMATS.iter());
            message::error("no format is chosen", Some(&format!("choose one or several: {all}")));
            return Err(Exit::Usage);
        }
        let past = PastJournal::open(&self.run)?;
        let folder = self.out.clone().unwrap_or_else(|| beside(&self.run));
        if !self.replace {
            formats.iter().try_for_each(|format| is_free(&folder.join(format.file)))?;
        }
        let changes = Changes { script: self.script.as_deref(), ..Changes::default() };
        let (_, plan) = past.changed(&changes, self.project.as_deref())?;
        past.warn_of_changes(&plan);
        if plan.frame().is_none() {
            on_globe(formats)?;
        }
        if formats.iter().any(|format| format.has_clock) {
            past.warn_of_clock();
            past.warn_of_no_clock("its first tick is told as 1970-01-01T00:00:00Z");
        }
        let epoch_ms = past.first_tick.map(|first| first.unix_ms());
        let exported = exported(&plan, &past.bytes, epoch_ms).map_err(|unreadable| {
            message::error(&unreadable.to_string(), None);
            Exit::Failed
        })?;
        warn(&exported);
        self.write(&folder, &exported)
    }

    fn write(&self, folder: &Path, exported: &ExportedRun) -> Result<(), Exit> {
        let is_new = !folder.exists();
        std::fs::create_dir_all(folder).map_err(|error| unwritten(folder, &error))?;
        let mut lines = Lines::default();
        let mut written = Ok(());
        for format in &self.formats.0 {
            let (path, bytes) = (folder.join(format.file), (format.make)(&exported.run));
            let kept = if self.replace { disk::replace(&path, &bytes).map(drop) } else { disk::keep(&path, &bytes) };
            written = kept.map_err(|error| unwritten(&path, &error));
            if written.is_err() {
                break;
            }
            lines.add(&path.display().to_string());
        }
        if written.is_err() && is_new {
            // One that holds files stays.
            let _ = disk::remove_empty(folder);
        }
        lines.print();
        written
    }
}

/// The folder for a run's exports.
fn beside(run: &Path) -> PathBuf {
    if run.is_dir() { run.join(FOLDER) } else { run.with_file_name(FOLDER) }
}

fn is_free(path: &Path) -> Result<(), Exit> {
    if path.symlink_metadata().is_err() {
        return Ok(());
    }
    let help = "choose another folder with `--out`, or give `--replace` to write it anew";
    message::error(&format!("`{}` is there already", path.display()), Some(help));
    Err(Exit::Usage)
}

/// Says which formats have no place for a mission in a plane of its own.
fn on_globe(formats: &[&'static Format]) -> Result<(), Exit> {
    let on_globe = listed(formats.iter().copied().filter(|format| format.is_on_globe));
    if on_globe.is_empty() {
        return Ok(());
    }
    let others = listed(FORMATS.iter().filter(|format| !format.is_on_globe));
    let help =
        format!("{others} need none; else give a corner of its area as latitude and longitude, and run it again");
    message::error(&format!("the mission has no place on the globe, which {on_globe} must have"), Some(&help));
    Err(Exit::Usage)
}

fn listed(formats: impl Iterator<Item = &'static Format>) -> String {
    formats.map(|format| format!("`--{}`", format.name)).collect::<Vec<_>>().join(", ")
}

/// Says what is not in the files.
fn warn(exported: &ExportedRun) {
    let ticks = exported.run.ticks.len();
    let help = format!("the files hold what is whole before that: {ticks} ticks");
    match &exported.ending {
        Ending::Complete(_) => {}
        Ending::CutShort(flaw) => message::warning(&format!("the journal is cut short {flaw}"), &help),
        Ending::Damaged(flaw) => message::warning(&format!("the journal is damaged {flaw}"), &help),
    }
    if exported.samples_left_out > 0 {
        let samples = exported.samples_left_out;
        message::warning(
            &format!("{samples} samples are in no column"),
            "four of a tick have columns; the journal has all",
        );
    }
    if exported.more_reports > 0 {
        let more = exported.more_reports;
        message::warning(
            &format!("{more} more reports are not listed"),
            "`reported` tells the first 10,000; the trace has all",
        );
    }
}

fn unwritten(path: &Path, error: &io::Error) -> Exit {
    message::error(&disk::not_written(path, error), Some("choose another folder with `--out`"));
    Exit::Failed
}
