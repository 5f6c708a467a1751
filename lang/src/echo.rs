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

/// Whether a finding may only miss what could not be read.
pub fn is_echo(finding: &Diagnostic, unread: &[Unread], sources: &Sources) -> bool {
    let span = finding.span();
    if NAMES.contains(&finding.code) {
        let name = sources.text(span);
        return unread.iter().any(|u| {
            u.item.is_none_or(|item| holds(item, span)) && words(sources.text(u.span)).any(|w| words(name).any(|n| n == w))
        });
    }
    PARTS.contains(&finding.code) && unread.iter().any(|u| u.item.is_some_and(|item| holds(item, span)))
}

fn holds(outer: Span, inner: Span) -> bool {
    outer.file == inner.file && outer.start <= inner.start && inner.end <= outer.end
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|word| !word.is_empty())
}
