//! What is found missing only because something could not be read: no second mistake.

use crate::diagnostic::Diagnostic;
use crate::source::{Sources, Span};
use crate::syntax::Unread;

/// Findings that nothing has a name: what could not be read may have declared it.
const NAMES: [&str; 9] = [
    "names::unknown",
    "names::member",
    "types::unknown",
    "units::unknown",
    "rules::unknown",
    "scenarios::unknown",
    "scenarios::clause",
    "missions::requires",
    "tests::mission",
];

/// Findings that a declaration lacks something: what could not be read of it may be just that.
const PARTS: [&str; 14] = [
    "types::result",
    "types::if_value",
    "types::match",
    "rules::start",
    "rules::unreachable",
    "rules::ending",
    "flow::result",
    "channels::amend",
    "channels::ends",
    "missions::area",
    "missions::recovery",
    "missions::within",
    "tests::run",
    "time::instant_loop",
];

/// Words after which a name is declared, inside a declaration.
const DECLARING: [&str; 8] = ["let", "var", "memory", "signal", "behavior", "area", "for", "clause"];

/// Whether a finding may only miss what could not be read.
pub fn is_echo(finding: &Diagnostic, unread: &[Unread], sources: &Sources) -> bool {
    let span = finding.span();
    if NAMES.contains(&finding.code) {
        let name = sources.text(span);
        return unread.iter().any(|u| {
            let text = sources.text(u.span);
            u.item.is_none_or(|item| holds(item, span))
                && words(name).any(|name| may_declare(text, name, u.item.is_none()))
        });
    }
    PARTS.contains(&finding.code) && unread.iter().any(|u| u.item.is_some_and(|item| holds(item, span)))
}

fn holds(outer: Span, inner: Span) -> bool {
    outer.file == inner.file && outer.start <= inner.start && inner.end <= outer.end
}

/// Whether a text may declare a name: a whole declaration any name in it, a part of one what a word or a type says.
fn may_declare(text: &str, name: &str, whole: bool) -> bool {
    let mut before = "";
    let mut rest = text;
    while let Some(word) = words(rest).next() {
        let at = rest.find(word).unwrap_or(0);
        rest = &rest[at + word.len()..];
        if word == name && (whole || DECLARING.contains(&before) || rest.trim_start().starts_with(':')) {
            return true;
        }
        before = word;
    }
    false
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|word| !word.is_empty())
}
