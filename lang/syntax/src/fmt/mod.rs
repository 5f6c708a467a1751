//! One style for all scripts: text to text, with every comment kept and the tree as it was.
//!
//! `to_document` goes through what the grammar has read and makes documents: words, and where lines may end. `print` chooses where
//! they do end. `align` then puts into columns what stands under one another. Three things are the author's and stay:
//! line ends where a line may end, blank lines, and whether declarations that follow one another are aligned.

mod align;
mod document;
mod print;
mod table;
mod to_document;

use crate::Parsed;
use crate::diagnostic::{Diagnostic, has_error};
use crate::source::FileId;

/// No line is wider, unless nothing in it can be broken, or it is a row of a switching table.
const WIDTH: usize = 120;

/// How much deeper each block stands.
const INDENT: usize = 4;

/// The layout of a layout is nearly always the same; where an author's columns end after one, it is so after two.
const ROUNDS_MAX: usize = 4;

/// Formats a script; one that cannot be read is not touched, and what is wrong with it is given instead.
pub fn format(file: FileId, source: &str) -> Result<String, Vec<Diagnostic>> {
    let mut text = source.to_string();
    for _ in 0..ROUNDS_MAX {
        let laid_out = lay_out(file, &text)?;
        if laid_out == text {
            break;
        }
        text = laid_out;
    }
    Ok(text)
}

fn lay_out(file: FileId, source: &str) -> Result<String, Vec<Diagnostic>> {
    let parsed = crate::parse(file, source);
    if has_error(&parsed.findings) {
        return Err(parsed.findings);
    }
    let mut lines = print::print(&to_document::file(source, &parsed.concrete));
    table::align(&mut lines);
    align::declarations(&mut lines);
    align::comments(&mut lines);
    let formatted: String = lines.iter().map(print::Line::text).collect();
    // Better not formatted than not the same script: a fault of ours must not reach a person's file.
    let again = crate::parse(file, &formatted);
    let is_whole = !has_error(&again.findings) && again.file.items.len() == parsed.file.items.len();
    Ok(if is_whole && words(&again, &formatted) == words(&parsed, source) { formatted } else { source.to_string() })
}

/// What comments say.
fn words<'a>(parsed: &Parsed, text: &'a str) -> Vec<&'a str> {
    parsed
        .concrete
        .comments()
        .filter_map(|comment| text.get(comment.start as usize..comment.end as usize))
        .map(str::trim_end)
        .collect()
}
