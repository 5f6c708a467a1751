//! One style for all scripts: text to text, with every comment kept and the tree as it was.
//!
//! `build` goes through what the grammar has read and makes documents: words, and where lines may end. `print` chooses where
//! they do end. `align` then puts into columns what stands under one another. Three things are the author's and stay:
//! line ends where a line may end, blank lines, and whether declarations that follow one another are aligned.

mod align;
mod build;
mod doc;
mod print;
mod table;

use crate::diagnostic::Diagnostic;
use crate::source::FileId;
use crate::syntax;

/// No line is wider, unless nothing in it can be broken, or it is a row of a switching table.
const WIDTH: usize = 120;

/// How much deeper each block stands.
const INDENT: usize = 4;

/// Formats a script; one that cannot be read is not touched, and what is wrong with it is given instead.
pub fn format(file: FileId, source: &str) -> Result<String, Vec<Diagnostic>> {
    let parsed = syntax::parse(file, source);
    if !parsed.findings.is_empty() {
        return Err(parsed.findings);
    }
    let doc = syntax::concrete(file, source, |pairs| build::file(source, &parsed.comments, pairs));
    let mut lines = doc.map(|doc| print::print(&doc)).unwrap_or_default();
    table::align(&mut lines);
    align::declarations(&mut lines);
    align::comments(&mut lines);
    Ok(lines.iter().map(print::Line::text).collect())
}
