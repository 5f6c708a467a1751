//! What a script says of itself: its declarations as they are written, and the comments that belong to them.
//!
//! `///` belongs to what begins on the line below it, `//!` at the top to the whole file. What stands behind a parameter or
//! a behavior on its own line belongs to that.

mod comments;
mod declaration;
mod written;

use crate::diagnostic::has_error;
use crate::source::{FileId, Source, Span};
use crate::tree::Item;
use comments::Comments;
use written::Written;

/// A script's page.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Page {
    /// What `//!` says.
    pub text: String,
    /// What others can use or run, in order.
    pub declarations: Vec<Declaration>,
    /// What its tests are called.
    pub tests: Vec<String>,
    /// Comments for a page that belong to nothing.
    pub stray: Vec<Span>,
}

/// One declaration.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Declaration {
    /// The word that it begins with: `strategy`.
    pub word: &'static str,
    /// Its name.
    pub name: String,
    /// What `///` says.
    pub text: String,
    /// As it is written; of what has statements, all before its `{`.
    pub written: String,
    /// What it takes.
    pub params: Vec<Param>,
    /// What it gives or finishes with.
    pub result: Option<String>,
    /// Of a mission: where, how long, with what limits, as it is written.
    pub terms: Option<String>,
    /// The behaviors declared in it.
    pub behaviors: Vec<Behavior>,
    /// Its switching table as it is written, below the signals that it may speak of.
    pub table: Option<String>,
}

/// A parameter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Param {
    /// Its name.
    pub name: String,
    /// Its type.
    pub ty: String,
    /// Its value when none is given.
    pub default: Option<String>,
    /// The values that it may have.
    pub range: Option<String>,
    /// What is said of it.
    pub text: String,
}

/// A behavior of a strategy or a mission.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Behavior {
    /// Its name.
    pub name: String,
    /// What is said of it.
    pub text: String,
}

/// The page of a script without mistakes; of any other there is nothing to tell.
pub fn page(source: &Source) -> Option<Page> {
    let file = FileId(0);
    let parsed = crate::parse(file, &source.text);
    let spans: Vec<Span> = parsed.concrete.root(&source.text).inner().map(|item| item.span()).collect();
    if has_error(&parsed.findings) || spans.len() != parsed.file.items.len() {
        return None;
    }
    let written = Written::new(&source.text);
    let first = spans.first().map_or(source.text.len(), |span| span.start as usize);
    let mut comments = Comments::new(&source.text, parsed.concrete.comments(), first);
    let (mut declarations, mut tests) = (Vec::new(), Vec::new());
    for (item, span) in parsed.file.items.iter().zip(spans) {
        match item {
            Item::Test(test) => tests.push(written.of(test.name.span).trim_matches('"').to_string()),
            item => declarations.extend(declaration::declaration(item, span, &written, &mut comments)),
        }
    }
    let text = comments.of_file();
    Some(Page { text, declarations, tests, stray: comments.stray(file) })
}

#[cfg(test)]
mod tests;
