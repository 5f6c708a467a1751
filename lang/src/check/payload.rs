//! Payloads: what aboard can be asked to do something, and `ask`.

use super::{Checker, Def};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{Action, ClauseArg, Payload};
use crate::source::Span;
use crate::syntax::tree::{self, PayloadAction};
use crate::types::Type;
use std::collections::BTreeSet;

/// The clause by which scenarios say how payloads answer.
const CLAUSE: &str = "payload";
/// What an `ask` ends with, in the library's inputs.
const ANSWER: &str = "Answer";

impl Checker<'_> {
    pub(super) fn declare_payload(&mut self, m: usize, name: &tree::Name, actions: &[PayloadAction]) {
        let mut known: Vec<(String, Span)> = Vec::new();
        for PayloadAction { name: action, .. } in actions {
            self.names_used.define(action, "an action");
            if let Some((_, first)) = known.iter().find(|(other, _)| *other == action.node) {
                let message = format!("there are two actions `{}`", action.node);
                let finding = Diagnostic::error(Code::NamesTwice, action.span, message).label(*first, "the first");
                self.report(finding.help("choose another name, or leave it out"));
            }
            known.push((action.node.clone(), action.span));
        }
        self.hir.payloads.push(Payload { name: name.node.clone(), actions: known });
        self.define(m, name, Def::Payload(self.hir.payloads.len() - 1));
    }

    /// What is measured is an input: an action tells whether it was done.
    pub(super) fn payload_answers(&mut self, m: usize, actions: &[PayloadAction]) {
        for PayloadAction { name, result } in actions {
            let ty = self.written_type(m, result);
            if ty != Type::Bool && ty != Type::Unknown {
                let message = format!("`{}` is answered with a Bool: whether it was done", name.node);
                let help = format!("write `{}() -> Bool`; what a payload measures is an `input`", name.node);
                self.report(Diagnostic::error(Code::TypesMismatch, result.span, message).help(help));
            }
        }
    }

    /// What scenarios say of payloads that no script declares: a slip, where any is declared, for nothing asks them.
    pub(super) fn payloads_are_declared(&mut self) {
        let known = self.hir.payloads.iter().flat_map(|payload| {
            let actions = payload.actions.iter().map(|(action, _)| format!("{}.{action}", payload.name));
            std::iter::once(payload.name.clone()).chain(actions)
        });
        let known: BTreeSet<String> = known.collect();
        if known.is_empty() {
            return;
        }
        let clauses = self.hir.scenarios.iter().flat_map(|scenario| &scenario.clauses);
        let named = clauses.filter(|clause| clause.name == CLAUSE).filter_map(|clause| clause.args.first());
        let unknown = named.filter_map(|(_, arg)| match arg {
            ClauseArg::Value(value) => {
                Some((value.literal_text()?, value.span)).filter(|(name, _)| !known.contains(name))
            }
            _ => None,
        });
        for (name, span) in unknown.collect::<BTreeSet<_>>() {
            let finding = Diagnostic::warning(
                Code::ScenariosUnknown,
                span,
                format!("no payload is declared that answers `{name}`"),
            );
            let help = self.suggestion(&name, known.iter().map(String::as_str));
            self.report(match help {
                Some(help) => finding.help(help),
                None => finding,
            });
        }
    }

    /// `ask camera.start() within 10 s`.
    pub(super) fn ask(&mut self, ask: &tree::Ask, timed: &tree::Timed) -> Option<Action> {
        self.ask_is_bounded(timed);
        let (path, action) = (&ask.payload, &ask.action);
        let id = match self.resolve(self.scope.module, path).cloned() {
            Some(Def::Payload(id)) => id,
            other => {
                let message = match other {
                    Some(def) => format!("`{}` is {}, no payload", path.text(), def.what()),
                    None => format!("there is no payload `{}`", path.text()),
                };
                let known: Vec<String> = self.hir.payloads.iter().map(|payload| payload.name.clone()).collect();
                let help = match self.suggestion(&path.text(), known.iter().map(String::as_str)) {
                    Some(help) => help,
                    None => {
                        format!("declare it in the file: `payload {} {{ {}() -> Bool }}`", path.text(), action.node)
                    }
                };
                self.report(Diagnostic::error(Code::NamesUnknown, path.span, message).help(help));
                return None;
            }
        };
        let Payload { name, actions } = self.hir.payloads[id].clone();
        let Some(at) = actions.iter().position(|(other, _)| *other == action.node) else {
            let message = format!("the payload `{name}` has no action `{}`", action.node);
            let finding = Diagnostic::error(Code::NamesMember, action.span, message);
            self.report(match self.suggestion(&action.node, actions.iter().map(|(other, _)| other.as_str())) {
                Some(help) => finding.help(help),
                None => finding,
            });
            return None;
        };
        self.names_used.refer(action.span, actions[at].1);
        Some(Action::Ask(id, at))
    }

    /// Nobody knows whether an answer comes: `within` bounds the wait, and nothing else ends it.
    fn ask_is_bounded(&mut self, timed: &tree::Timed) {
        if timed.within.is_none() {
            let finding = Diagnostic::error(Code::TimeAsk, timed.span, "this may wait for its answer for ever");
            self.report(finding.help("say for how long: `ask camera.start() within 10 s`"));
        }
        let at = timed.at.first().map(|first| first.channel.span.to(first.value.span));
        let others = [timed.duration.as_ref().map(|e| e.span), timed.until.as_ref().map(|e| e.span), at];
        for span in others.into_iter().flatten() {
            let finding = Diagnostic::error(Code::TimeAsk, span, "an `ask` ends with its answer, and commands nothing");
            self.report(finding.help("leave this out: `within` bounds the wait"));
        }
    }

    /// The type of what an `ask` ends with.
    pub(super) fn answer_type(&self) -> Type {
        // A script may have a record of that name too.
        let preludes = self.preludes_with.get(ANSWER).into_iter().flatten();
        let mut known = preludes.filter_map(|&m| match self.names[m].get(ANSWER) {
            Some(&Def::Record(id)) => Some(Type::Record(id)),
            _ => None,
        });
        known.next().unwrap_or(Type::Unknown)
    }
}
