//! `albacore fmt`: scripts in the one style.

use crate::exit::Exit;
use crate::{disk, message, output};
use albacore_session::{Source, Sources};
use similar::{DiffOp, TextDiff};
use std::borrow::Cow;
use std::path::{Path, PathBuf};

/// So many lines of a difference are shown.
const SHOWN_MAX: usize = 20;
/// So many lines are compared, from the first that differs.
const COMPARED_MAX: usize = 200;
/// So many characters of a line are shown.
const CHARS_MAX: usize = 400;

/// Format scripts.
#[derive(clap::Args)]
pub struct Fmt {
    /// Scripts, or folders with scripts at any depth, whose links are passed over; `-` formats standard input to standard output.
    #[arg(value_name = "PATH", default_value = ".")]
    paths: Vec<PathBuf>,
    /// Write nothing: list what would change, and exit with 1 if anything would.
    #[arg(long)]
    check: bool,
}

impl Fmt {
    /// Formats each script; the worst of them decides.
    pub fn run(&self) -> Exit {
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
                exits.push(self.file(&script).unwrap_or_else(|exit| exit));
            }
        }
        exits.into_iter().max_by_key(|exit| *exit as u8).unwrap_or(Exit::Well)
    }

    fn standard_input(&self) -> Result<Exit, Exit> {
        let source = albacore_session::read_input(std::io::stdin().lock()).map_err(|error| {
            message::error(&error.message, error.help.as_deref());
            Exit::Usage
        })?;
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
        match disk::rewrite(path, Some(&source.text), &formatted) {
            Ok(others) => {
                message::parted(path, others);
                Ok(Exit::Well)
            }
            Err(error) => {
                message::error(&disk::not_written(path, &error), None);
                Err(Exit::Failed)
            }
        }
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
    let mut text = message::line(&format!("{} is not formatted", source.name));
    text.push_str(&difference(&source.text, formatted));
    output::print(&text);
    Exit::NotWell
}

/// The first lines of what differs between two texts. A comparison of the whole is quadratic where every line changes.
fn difference(old: &str, new: &str) -> String {
    let (old, new, is_all) = compared(old, new);
    let diff = TextDiff::from_lines(old, new).unified_diff().context_radius(1).to_string();
    let mut text: String = diff.lines().take(SHOWN_MAX).map(|line| format!("    {}\n", bounded(line))).collect();
    match diff.lines().count().saturating_sub(SHOWN_MAX) {
        _ if !is_all => text.push_str("    and more lines\n"),
        0 => {}
        more => text.push_str(&format!("    and {more} more lines\n")),
    }
    text
}

/// A line, or as much of it as a terminal can show.
fn bounded(line: &str) -> Cow<'_, str> {
    let cut = |beginning| format!("{beginning}… ({} bytes)", line.len()).into();
    output::beginning(line, CHARS_MAX).map_or(line.into(), cut)
}

/// The parts of two texts that are compared, and whether they are all of them: up to some lines behind the first that differs.
/// Where they are cut, the lines behind the last that they share are left out: their fellows may be in what was cut off.
fn compared<'a>(old: &'a str, new: &'a str) -> (&'a str, &'a str, bool) {
    let alike = old.lines().zip(new.lines()).take_while(|(a, b)| a == b).count();
    let head = |text: &'a str, lines: usize| {
        let length = text.split_inclusive('\n').take(lines).map(str::len).sum::<usize>();
        text.get(..length).unwrap_or(text)
    };
    let (some_old, some_new) = (head(old, alike + COMPARED_MAX), head(new, alike + COMPARED_MAX));
    if some_old.len() == old.len() && some_new.len() == new.len() {
        return (old, new, true);
    }
    let shared = TextDiff::from_lines(some_old, some_new).ops().iter().rev().find_map(|op| match op {
        DiffOp::Equal { old_index, new_index, len } => Some((old_index + len, new_index + len)),
        _ => None,
    });
    match shared.filter(|(old, new)| *old > alike && *new > alike) {
        Some((a, b)) => (head(some_old, a), head(some_new, b), false),
        None => (some_old, some_new, false),
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A text in which every line changes takes no more than a few lines' work.
    #[test]
    fn only_the_first_of_many_lines_that_differ_are_compared() {
        let many = |blank: &str| (0..30_000).map(|i| format!("let{blank}a{i} = {i}\n")).collect::<String>();
        let (old, new) = (many("  "), many(" "));
        let (a, b, is_all) = compared(&old, &new);
        assert_eq!((a.lines().count(), b.lines().count(), is_all), (COMPARED_MAX, COMPARED_MAX, false));
        let told = difference(&old, &new);
        assert!(told.starts_with("    @@ -1,200 +1,200 @@\n    -let  a0 = 0\n"), "{told}");
        assert_eq!((told.lines().count(), told.ends_with("    and more lines\n")), (SHOWN_MAX + 1, true), "{told}");
    }

    /// A line of megabytes is shown by its beginning.
    #[test]
    fn of_a_line_without_end_the_beginning_is_shown() {
        let long = format!("log \"{}\"", "é".repeat(2_000_000));
        let told = difference(&format!("{long} \n"), &format!("{long}\n"));
        assert!(told.lines().all(|line| line.chars().count() < 450) && told.contains("é… (4000008 bytes)\n"), "{told}");
    }

    /// What is cut off is not told as deleted or added.
    #[test]
    fn where_a_comparison_ends_nothing_seems_to_change() {
        let lines = |n: usize| (0..n).map(|i| format!("{i}\n")).collect::<String>();
        let (old, new) = (lines(1000), format!("first\n{}", lines(1000)));
        assert_eq!(difference(&old, &new), "    @@ -1 +1,2 @@\n    +first\n     0\n    and more lines\n");
        assert_eq!(difference(&lines(3), &lines(4)), "    @@ -3 +3,2 @@\n     2\n    +3\n");
    }
}
