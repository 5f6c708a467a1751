//! Source files and places in them.

use std::fmt;
use std::sync::{Arc, OnceLock};

/// A source larger than this, in bytes, is refused.
pub const SOURCE_BYTES_MAX: usize = 8 * 1024 * 1024;

/// Which source file of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FileId(pub u32);

/// A stretch of bytes in a source file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    /// The file.
    pub file: FileId,
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}

impl Span {
    /// From the beginning of one span to the end of another in the same file.
    pub fn to(self, other: Span) -> Span {
        Span { file: self.file, start: self.start, end: other.end.max(self.start) }
    }

    /// Whether another span lies in this one.
    pub fn holds(self, inner: Span) -> bool {
        self.file == inner.file && self.start <= inner.start && inner.end <= self.end
    }
}

/// Something with its place in the source.
#[derive(Clone, Debug, PartialEq)]
pub struct Spanned<T> {
    /// What stands there.
    pub node: T,
    /// Where it stands.
    pub span: Span,
}

/// A source file: what it is called in messages, and its text.
#[derive(Clone, Debug)]
pub struct Source {
    /// Path as the user would write it, or a name in angle brackets for what is no file.
    pub name: Arc<str>,
    /// The text.
    pub text: Arc<str>,
}

/// All sources of a program.
#[derive(Clone, Debug, Default)]
pub struct Sources {
    files: Vec<Source>,
    /// Those that make the program, in the order in which they were taken.
    listed: Vec<FileId>,
    /// Where the lines of each file begin: a place is looked up, for there may be as many as there are lines.
    lines: Vec<Arc<[u32]>>,
    /// The digest of each file, once somebody has asked for it.
    digests: Vec<OnceLock<u64>>,
}

impl Sources {
    /// Adds a file.
    pub fn add(&mut self, source: Source) -> FileId {
        let file = self.reserve(source);
        self.list(file);
        file
    }

    /// Gives a file its id, before it is known whether it is part of the program, and after which others.
    pub fn reserve(&mut self, source: Source) -> FileId {
        let ends = source.text.match_indices('\n').map(|(at, _)| at as u32 + 1);
        self.lines.push(std::iter::once(0).chain(ends).collect());
        self.files.push(source);
        self.digests.push(OnceLock::new());
        FileId((self.files.len() - 1) as u32)
    }

    /// Takes a file into the program that has its id already.
    pub fn list(&mut self, file: FileId) {
        self.listed.push(file);
    }

    /// The file of an id.
    pub fn get(&self, id: FileId) -> &Source {
        &self.files[id.0 as usize]
    }

    /// A digest of a file's text, which is made once: each of the tests of a script asks for it. Who asks says how, and always the same.
    pub fn digest(&self, id: FileId, of: impl FnOnce(&str) -> u64) -> u64 {
        *self.digests[id.0 as usize].get_or_init(|| of(&self.get(id).text))
    }

    /// All files of the program, by their ids.
    pub fn ids(&self) -> impl Iterator<Item = FileId> {
        self.listed.iter().copied()
    }

    /// All files of the program, in the order in which they were taken into it.
    pub fn iter(&self) -> impl Iterator<Item = &Source> {
        self.listed.iter().map(|file| self.get(*file))
    }

    /// The text of a span.
    pub fn text(&self, span: Span) -> &str {
        self.get(span.file).text.get(span.start as usize..span.end as usize).unwrap_or("")
    }

    /// Line and column of a span's start, both counted from 1, the column in characters.
    pub fn line_column(&self, span: Span) -> (usize, usize) {
        let line = self.line(span);
        let begin = self.lines[span.file.0 as usize][line - 1];
        let before = self.text(Span { start: begin, end: span.start, ..span });
        (line, before.chars().count() + 1)
    }

    /// The length in bytes of the line on which a span begins.
    pub fn line_length(&self, span: Span) -> usize {
        let (line, starts) = (self.line(span), &self.lines[span.file.0 as usize]);
        let end = starts.get(line).map_or(self.get(span.file).text.len(), |next| *next as usize - 1);
        end - starts[line - 1] as usize
    }

    /// The line on which a span begins, counted from 1.
    fn line(&self, span: Span) -> usize {
        self.lines[span.file.0 as usize].partition_point(|start| *start <= span.start)
    }

    /// `file:line` of a span, as traces print it: without its folders, so that a trace is the same wherever the script lies.
    pub fn place(&self, span: Span) -> String {
        let name = &self.get(span.file).name;
        let file = name.rsplit(['/', '\\']).next().unwrap_or(name);
        format!("{file}:{}", self.line(span))
    }
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name)
    }
}
