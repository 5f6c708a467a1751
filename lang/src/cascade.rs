//! What is found missing only because something could not be read: no second mistake.

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::source::{Sources, Span};
use crate::syntax::{Unread, words};
use std::collections::{BTreeMap, BTreeSet};

/// Findings that nothing has a name: what could not be read may have declared it.
const NAMES: [Code; 10] = [
    Code::NamesUnknown,
    Code::NamesMember,
    Code::TypesUnknown,
    Code::UnitsUnknown,
    Code::RulesUnknown,
    Code::ScenariosUnknown,
    Code::ScenariosClause,
    Code::MissionsRequires,
    Code::TestsBehavior,
    Code::TestsMission,
];

/// Findings that a declaration lacks something: what could not be read of it may be just that.
const PARTS: [Code; 17] = [
    Code::TypesResult,
    Code::TypesIfValue,
    Code::TypesMatch,
    Code::RulesStart,
    Code::RulesUnreachable,
    Code::RulesEnding,
    Code::RulesForever,
    Code::FlowResult,
    Code::ChannelsAmend,
    Code::ChannelsEnds,
    Code::MissionsArea,
    Code::MissionsLimits,
    Code::MissionsRecovery,
    Code::MissionsWithin,
    Code::TestsRun,
    Code::TestsNothing,
    Code::TimeInstantLoop,
];

/// Findings of a call: what could not be read may have declared what is called, under the name of a function of ours.
const CALLS: [Code; 6] =
    [Code::TypesMismatch, Code::ArgsLabel, Code::ArgsMany, Code::ArgsMissing, Code::ArgsTwice, Code::FlowUnused];

/// The names that unreadable text may have declared.
pub struct Cascades<'a> {
    /// Those of whole declarations, known everywhere.
    anywhere: Names<'a>,
    /// Those among them that can be called.
    callable: BTreeSet<&'a str>,
    /// Those of parts of a declaration, known in it.
    inside: BTreeMap<Span, Names<'a>>,
}

/// Names that may have been declared.
#[derive(Default)]
struct Names<'a> {
    known: BTreeSet<&'a str>,
    /// Something is declared and its name is what is missing: it may be any.
    any: bool,
}

impl Names<'_> {
    fn may_hold(&self, name: &str) -> bool {
        self.any || self.known.contains(name)
    }
}

impl<'a> Cascades<'a> {
    pub fn of(unread: &[Unread], sources: &'a Sources) -> Self {
        let mut echoes = Cascades { anywhere: Names::default(), callable: BTreeSet::new(), inside: BTreeMap::new() };
        for u in unread {
            let text = sources.text(u.span);
            let names = match u.item {
                None => &mut echoes.anywhere,
                Some(item) => echoes.inside.entry(item).or_default(),
            };
            names.any |= lacks_name(text);
            match u.item {
                None => {
                    names.known.extend(words(text));
                    let named = words(text).zip(words(text).skip(1)).filter(|(word, _)| words::declares_called(word));
                    echoes.callable.extend(named.map(|(_, name)| name));
                }
                Some(_) => names.known.extend(declared(text)),
            }
        }
        echoes
    }

    /// Whether a finding may only miss what could not be read.
    pub fn holds_back(&self, finding: &Diagnostic, sources: &Sources) -> bool {
        let span = finding.span();
        let mut items = self.inside.iter().filter(|(item, _)| item.holds(span));
        if NAMES.contains(&finding.code) {
            let known: Vec<_> = items.map(|(_, names)| names).chain([&self.anywhere]).collect();
            return words(sources.text(span)).any(|name| known.iter().any(|names| names.may_hold(name)));
        }
        if CALLS.contains(&finding.code) && !self.callable.is_empty() {
            return called(span, sources).any(|name| self.callable.contains(name));
        }
        // What a mission reports, and why it is aborted, may stand in what could not be read of it.
        if finding.code == Code::TestsReport {
            return self.inside.keys().any(|item| words(sources.text(*item)).next() != Some("test"));
        }
        PARTS.contains(&finding.code) && items.next().is_some()
    }
}

/// What a stretch calls itself, and the call on its line among whose arguments it stands.
fn called(span: Span, sources: &Sources) -> impl Iterator<Item = &str> {
    let before = sources.text(Span { start: 0, end: span.start, ..span });
    let line = before.rsplit('\n').next().unwrap_or("");
    let mut closed = 0_usize;
    let open = line.char_indices().rev().find(|(_, c)| match c {
        ')' => {
            closed += 1;
            false
        }
        '(' if closed > 0 => {
            closed -= 1;
            false
        }
        c => *c == '(',
    });
    let around = open.and_then(|(at, _)| line[..at].rsplit(|c: char| !c.is_alphanumeric() && c != '_').next());
    let text = sources.text(span);
    let own = words(text).next().filter(|name| text.strip_prefix(name).is_some_and(|rest| rest.starts_with('(')));
    around.into_iter().chain(own)
}

/// The names that a part of a declaration may declare: a word before them says so, or a type after them.
fn declared(text: &str) -> Vec<&str> {
    let mut names = Vec::new();
    // A name before a block: a behavior without its first word.
    let first =
        words(text).next().filter(|first| text.strip_prefix(first).is_some_and(|t| t.trim_start().starts_with('{')));
    names.extend(first);
    let mut before = "";
    let mut rest = text;
    while let Some(word) = words(rest).next() {
        let at = rest.find(word).unwrap_or(0);
        rest = &rest[at + word.len()..];
        if words::declares_inside(before) || rest.trim_start().starts_with(':') {
            names.push(word);
        }
        before = word;
    }
    names
}

/// Whether a name is missing where one is declared: before a `:`, or after a word that declares.
fn lacks_name(text: &str) -> bool {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let without = |before: &str| before.trim_end().chars().next_back().is_none_or(|c| "({,".contains(c));
    let mut unnamed = text.match_indices(':').filter(|(at, _)| without(&text[..*at]));
    let mut rest = text;
    while let Some(word) = words(rest).next() {
        rest = &rest[rest.find(word).unwrap_or(0) + word.len()..];
        if words::declares(word) && !rest.trim_start().starts_with(is_word) {
            return true;
        }
    }
    unnamed.next().is_some()
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|word| !word.is_empty())
}
