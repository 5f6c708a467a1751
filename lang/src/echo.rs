//! What is found missing only because something could not be read: no second mistake.

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::source::{Sources, Span};
use crate::syntax::Unread;
use std::collections::{BTreeMap, BTreeSet};

/// Findings that nothing has a name: what could not be read may have declared it.
const NAMES: [Code; 9] = [
    Code::NamesUnknown,
    Code::NamesMember,
    Code::TypesUnknown,
    Code::UnitsUnknown,
    Code::RulesUnknown,
    Code::ScenariosUnknown,
    Code::ScenariosClause,
    Code::MissionsRequires,
    Code::TestsMission,
];

/// Findings that a declaration lacks something: what could not be read of it may be just that.
const PARTS: [Code; 14] = [
    Code::TypesResult,
    Code::TypesIfValue,
    Code::TypesMatch,
    Code::RulesStart,
    Code::RulesUnreachable,
    Code::RulesEnding,
    Code::FlowResult,
    Code::ChannelsAmend,
    Code::ChannelsEnds,
    Code::MissionsArea,
    Code::MissionsRecovery,
    Code::MissionsWithin,
    Code::TestsRun,
    Code::TimeInstantLoop,
];

/// Words after which a name is declared, inside a declaration.
const DECLARING: [&str; 8] = ["let", "var", "memory", "signal", "behavior", "area", "for", "clause"];

/// The names that unreadable text may have declared.
pub struct Echoes<'a> {
    /// Those of whole declarations, known everywhere.
    anywhere: BTreeSet<&'a str>,
    /// Those of parts of a declaration, known in it.
    inside: BTreeMap<Span, BTreeSet<&'a str>>,
}

impl<'a> Echoes<'a> {
    pub fn of(unread: &[Unread], sources: &'a Sources) -> Self {
        let mut echoes = Echoes { anywhere: BTreeSet::new(), inside: BTreeMap::new() };
        for u in unread {
            let text = sources.text(u.span);
            match u.item {
                None => echoes.anywhere.extend(words(text)),
                Some(item) => echoes.inside.entry(item).or_default().extend(declared(text)),
            }
        }
        echoes
    }

    /// Whether a finding may only miss what could not be read.
    pub fn holds_back(&self, finding: &Diagnostic, sources: &Sources) -> bool {
        let span = finding.span();
        let mut items = self.inside.iter().filter(|(item, _)| holds(**item, span));
        if NAMES.contains(&finding.code) {
            let known: Vec<_> = items.map(|(_, names)| names).chain([&self.anywhere]).collect();
            return words(sources.text(span)).any(|name| known.iter().any(|names| names.contains(name)));
        }
        PARTS.contains(&finding.code) && items.next().is_some()
    }
}

fn holds(outer: Span, inner: Span) -> bool {
    outer.file == inner.file && outer.start <= inner.start && inner.end <= outer.end
}

/// The names that a part of a declaration may declare: a word before them says so, or a type after them.
fn declared(text: &str) -> Vec<&str> {
    let mut names = Vec::new();
    let mut before = "";
    let mut rest = text;
    while let Some(word) = words(rest).next() {
        let at = rest.find(word).unwrap_or(0);
        rest = &rest[at + word.len()..];
        if DECLARING.contains(&before) || rest.trim_start().starts_with(':') {
            names.push(word);
        }
        before = word;
    }
    names
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|word| !word.is_empty())
}
