//! Which comment belongs to what.

use crate::source::{FileId, Span};
use std::collections::BTreeMap;

/// The comments of a source, by what they may belong to.
pub struct Comments<'a> {
    source: &'a str,
    /// `//!` lines before the first declaration.
    of_file: Vec<&'a str>,
    /// `///` groups, by where the line below them begins; with the place of their own beginning.
    above: BTreeMap<usize, Group<'a>>,
    /// Comments behind something on its line, by where they begin.
    behind: BTreeMap<usize, &'a str>,
    /// Where comments for a page begin that can belong to nothing.
    stray: Vec<usize>,
}

/// Lines of `///` that follow one another.
struct Group<'a> {
    start: usize,
    lines: Vec<&'a str>,
}

impl<'a> Comments<'a> {
    /// `first` is where the first declaration begins.
    pub fn new(source: &'a str, comments: impl Iterator<Item = Span>, first: usize) -> Self {
        let mut sorted = Comments {
            source,
            of_file: Vec::new(),
            above: BTreeMap::new(),
            behind: BTreeMap::new(),
            stray: Vec::new(),
        };
        let mut last_of_file = None;
        for comment in comments {
            let (start, end) = (comment.start as usize, comment.end as usize);
            let text = source.get(start..end).unwrap_or("").trim_end();
            let is_alone = sorted.line_before(start).trim().is_empty();
            if let Some(line) = text.strip_prefix("//!") {
                if !is_alone || start > first {
                    sorted.stray.push(start);
                    continue;
                }
                // A blank line between two parts is one on the page too.
                if last_of_file.is_some_and(|last| source.get(last..start).unwrap_or("").matches('\n').count() > 1) {
                    sorted.of_file.push("");
                }
                last_of_file = Some(end);
                sorted.of_file.push(line);
            } else if let Some(line) = text.strip_prefix("///").filter(|line| !line.starts_with('/')) {
                if !is_alone {
                    sorted.stray.push(start);
                    continue;
                }
                // The group above goes on when it was waiting for this very line.
                let above = sorted.above.remove(&start);
                let mut lines = above.unwrap_or(Group { start, lines: Vec::new() });
                lines.lines.push(line);
                match sorted.below(end) {
                    Some(next) => {
                        sorted.above.insert(next, lines);
                    }
                    None => sorted.stray.push(lines.start),
                }
            } else if !is_alone {
                sorted.behind.insert(start, text.trim_start_matches('/').trim());
            }
        }
        sorted
    }

    /// What stands on a line before a place.
    fn line_before(&self, at: usize) -> &'a str {
        self.source.get(..at).unwrap_or("").rsplit('\n').next().unwrap_or("")
    }

    /// Where the next line begins, after its blanks; none if it is empty.
    fn below(&self, end: usize) -> Option<usize> {
        let rest = self.source.get(end..)?;
        let next = end + rest.find('\n')? + 1;
        let line = self.source.get(next..)?.split('\n').next()?;
        let blanks = line.len() - line.trim_start().len();
        (!line.trim().is_empty()).then_some(next + blanks)
    }

    /// What `//!` says.
    pub fn of_file(&self) -> String {
        text(&self.of_file)
    }

    /// What `///` says of that which begins at a place; after this it belongs to that.
    pub fn above(&mut self, at: u32) -> String {
        self.above.remove(&(at as usize)).map(|group| text(&group.lines)).unwrap_or_default()
    }

    /// What is said behind a place, on its line.
    pub fn behind(&self, at: u32) -> String {
        let at = at as usize;
        let line = self.source.get(at..).and_then(|rest| rest.split('\n').next()).map_or(0, str::len);
        self.behind.range(at..=at + line).next().map(|(_, text)| (*text).to_string()).unwrap_or_default()
    }

    /// What has belonged to nothing.
    pub fn stray(&self, file: FileId) -> Vec<Span> {
        let mut starts: Vec<usize> = self.above.values().map(|g| g.start).chain(self.stray.iter().copied()).collect();
        starts.sort_unstable();
        let line = |start: usize| self.source.get(start..).and_then(|s| s.split('\n').next()).map_or(0, str::len);
        starts.into_iter().map(|s| Span { file, start: s as u32, end: (s + line(s)) as u32 }).collect()
    }
}

/// Lines without the blank after their slashes.
fn text(lines: &[&str]) -> String {
    let lines: Vec<&str> = lines.iter().map(|line| line.strip_prefix(' ').unwrap_or(line).trim_end()).collect();
    lines.join("\n").trim().to_string()
}
