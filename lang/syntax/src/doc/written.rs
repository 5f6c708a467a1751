//! Stretches of a source as a reader wants them: without the blanks of the place that they stand in.

use crate::source::Span;
use crate::tree::Block;

/// A source to take stretches from.
pub struct Written<'a>(&'a str);

impl<'a> Written<'a> {
    pub fn new(source: &'a str) -> Self {
        Written(source)
    }

    /// A stretch on one line.
    pub fn of(&self, span: Span) -> String {
        self.between(span.start, span.end).split_whitespace().collect::<Vec<_>>().join(" ")
    }

    /// A stretch with its lines, as if it stood at the left margin.
    pub fn lines(&self, span: Span) -> String {
        let text = self.between(span.start, span.end).trim_end();
        let before = self.between(0, span.start);
        let line = before.rsplit('\n').next().unwrap_or(before);
        let margin = line.len() - line.trim_start().len();
        let flush = |line: &str| {
            let blanks = line.len() - line.trim_start_matches(' ').len();
            line.get(blanks.min(margin)..).unwrap_or("").trim_end().to_string()
        };
        let mut lines = text.split('\n');
        let first = lines.next().unwrap_or("").trim_end().to_string();
        std::iter::once(first).chain(lines.map(flush)).collect::<Vec<_>>().join("\n")
    }

    /// All of a declaration before its block.
    pub fn head(&self, span: Span, body: &Block) -> String {
        self.lines(Span { end: body.span.start, ..span })
    }

    /// From one place to another.
    pub fn between(&self, start: u32, end: u32) -> &'a str {
        self.0.get(start as usize..end as usize).unwrap_or("")
    }
}
