//! `albacore fmt`: scripts in the one style.

use crate::exit::Exit;
use crate::{disk, interruption, message, output};
use albacore_session::{Source, Sources};
use similar::TextDiff;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::Ordering;

/// So many lines of a difference are shown.
const SHOWN_MAX: usize = 20;

/// Lay out scripts in the one style.
#[derive(clap::Args)]
pub struct Fmt {
    /// Scripts, or folders with scripts at any depth; `-` is standard input, laid out to standard output.
    #[arg(value_name = "PATH", default_value = ".")]
    paths: Vec<PathBuf>,
    /// Write nothing: list what would change, and end with 1 if anything would.
    #[arg(long)]
    check: bool,
}

impl Fmt {
    /// Formats each script; the worst of them decides.
    pub fn run(&self) -> Exit {
        // Who interrupts has every script whole, and no temporary file. Nobody waits for standard input.
        let waits = self.paths.iter().any(|path| path.as_os_str() == "-");
        let interrupted = if waits { Arc::default() } else { interruption::flag() };
        let mut exits = Vec::new();
        for path in &self.paths {
            if path.as_os_str() == "-" {
                exits.push(self.standard_input().unwrap_or_else(|exit| exit));
                continue;
            }
            let mut scripts = Vec::new();
            if let Err(exit) = gather(path, &mut scripts) {
                exits.push(exit);
            }
            scripts.sort();
            for script in scripts {
                if interrupted.load(Ordering::Relaxed) {
                    return Exit::NotWell;
                }
                exits.push(self.file(&script).unwrap_or_else(|exit| exit));
            }
        }
        exits.into_iter().max_by_key(|exit| *exit as u8).unwrap_or(Exit::Well)
    }

    fn standard_input(&self) -> Result<Exit, Exit> {
        let mut text = String::new();
        std::io::stdin().lock().read_to_string(&mut text).map_err(|error| {
            message::error(&format!("standard input cannot be read: {error}"), None);
            Exit::Usage
        })?;
        let source = Source { name: "<stdin>".into(), text: text.into() };
        let formatted = formatted(&source)?;
        if self.check {
            return Ok(check(&source, &formatted));
        }
        output::print(&formatted);
        Ok(Exit::Well)
    }

    fn file(&self, path: &Path) -> Result<Exit, Exit> {
        let source = albacore_session::read(path).map_err(|error| {
            message::error(&error.message, error.help.as_deref());
            Exit::Usage
        })?;
        let formatted = formatted(&source)?;
        if self.check {
            return Ok(check(&source, &formatted));
        }
        if *formatted == *source.text {
            return Ok(Exit::Well);
        }
        // What a link points to is written, and the link stays.
        let written = std::fs::canonicalize(path).and_then(|file| disk::whole(&file, &formatted));
        written.map(|()| Exit::Well).map_err(|error| {
            message::error(&format!("`{}` cannot be written: {error}", path.display()), None);
            Exit::Failed
        })
    }
}

/// The text in the one style; else what cannot be read in it is said.
fn formatted(source: &Source) -> Result<String, Exit> {
    let mut sources = Sources::default();
    let file = sources.add(source.clone());
    albacore_session::format(file, &source.text).map_err(|mut findings| {
        albacore_session::settle(&mut findings);
        message::findings(&findings, &sources);
        Exit::Script
    })
}

/// Says what would change.
fn check(source: &Source, formatted: &str) -> Exit {
    if *formatted == *source.text {
        return Exit::Well;
    }
    let diff = TextDiff::from_lines(&*source.text, formatted).unified_diff().context_radius(1).to_string();
    let mut text = format!("{} is not formatted\n", source.name);
    diff.lines().take(SHOWN_MAX).for_each(|line| text.push_str(&format!("    {line}\n")));
    let more = diff.lines().count().saturating_sub(SHOWN_MAX);
    if more > 0 {
        text.push_str(&format!("    and {more} more lines\n"));
    }
    output::print(&text);
    Exit::NotWell
}

/// A script itself, or those of a folder and the folders in it. What is hidden is left alone, and no link is followed.
fn gather(path: &Path, scripts: &mut Vec<PathBuf>) -> Result<(), Exit> {
    if !path.is_dir() {
        scripts.push(path.to_path_buf());
        return Ok(());
    }
    let unreadable = |error| {
        message::error(&format!("`{}` cannot be read: {error}", path.display()), None);
        Exit::Failed
    };
    let mut exit = Ok(());
    for entry in std::fs::read_dir(path).map_err(unreadable)? {
        let entry = entry.map_err(unreadable)?;
        let kind = entry.file_type().map_err(unreadable)?;
        if entry.file_name().to_string_lossy().starts_with('.') {
            continue;
        }
        let inside = entry.path();
        if kind.is_dir() {
            exit = exit.and(gather(&inside, scripts));
        } else if kind.is_file() && inside.extension().is_some_and(|e| e == "alb") {
            scripts.push(inside);
        }
    }
    exit
}
