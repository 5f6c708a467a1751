//! Brackets and `else if`: that they fit, and how deep they go.

use super::{NESTING_MAX, Scanner};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use std::collections::BTreeMap;

/// A bracket that is open.
pub(super) struct Open {
    pub bracket: char,
    pub at: usize,
    /// The `else if` of the statement in which it stands: each nests its blocks one deeper.
    pub chained: usize,
}

/// The brackets that are open, from the outermost in. The innermost of a kind is known: there may be as many as there are bytes,
/// and each that closes asks for it.
#[derive(Default)]
pub(super) struct Brackets {
    open: Vec<Open>,
    /// Where those of each kind stand among all.
    of_kind: BTreeMap<char, Vec<usize>>,
}

impl Brackets {
    pub fn last(&self) -> Option<&Open> {
        self.open.last()
    }

    pub fn len(&self) -> usize {
        self.open.len()
    }

    pub fn is_empty(&self) -> bool {
        self.open.is_empty()
    }

    /// The level of the innermost of a kind.
    pub fn innermost(&self, bracket: char) -> Option<usize> {
        self.of_kind.get(&bracket)?.last().copied()
    }

    fn push(&mut self, open: Open) {
        self.of_kind.entry(open.bracket).or_default().push(self.open.len());
        self.open.push(open);
    }

    fn split_off(&mut self, level: usize) -> Vec<Open> {
        let inside = self.open.split_off(level);
        for open in &inside {
            self.of_kind.entry(open.bracket).or_default().pop();
        }
        inside
    }
}

impl Scanner<'_> {
    pub(super) fn open(&mut self, bracket: char) {
        self.too_deep(self.at, 1, 1);
        self.after_else = false;
        self.open.push(Open { bracket, at: self.at, chained: std::mem::take(&mut self.chained) });
        self.at += 1;
    }

    /// Reports, once, what stands deeper than anything may; `inside` tells how deep it is in what is open.
    pub(super) fn too_deep(&mut self, at: usize, length: usize, inside: usize) {
        if self.deep {
            return;
        }
        let chained: usize = self.open.open.iter().map(|open| open.chained).sum();
        self.deep = self.open.len() + chained + self.chained + inside > NESTING_MAX;
        if self.deep {
            let span = self.span(at, at + length);
            self.findings.push(
                Diagnostic::error(Code::SyntaxNesting, span, format!("nested deeper than {NESTING_MAX} levels")).help(
                    "name a part of it with `let`, or move it into a `fn` or a `behavior`; each `else if` is a level",
                ),
            );
        }
    }

    pub(super) fn close(&mut self, bracket: char) {
        let wanted = match bracket {
            ')' => '(',
            ']' => '[',
            _ => '{',
        };
        match self.open.innermost(wanted) {
            Some(level) => {
                self.all_unclosed(level + 1);
                self.chained = self.open.split_off(level).first().map_or(0, |open| open.chained);
            }
            None => {
                let span = self.span(self.at, self.at + 1);
                self.findings.push(
                    Diagnostic::error(Code::SyntaxBracket, span, format!("this `{bracket}` closes nothing"))
                        .help(format!("remove it, or open it with `{wanted}`")),
                );
            }
        }
        self.at += 1;
    }

    /// What is open from a level on was never closed: told of the outermost, for what stands in it is open with it.
    pub(super) fn all_unclosed(&mut self, level: usize) {
        let inside = self.open.split_off(level);
        let Some(Open { bracket, at, .. }) = inside.first() else { return };
        let closer = match bracket {
            '(' => ')',
            '[' => ']',
            _ => '}',
        };
        let message = match inside.len() - 1 {
            0 => format!("this `{bracket}` is never closed"),
            1 => format!("this `{bracket}` is never closed, nor is one inside it"),
            more => format!("this `{bracket}` is never closed, nor are {more} inside it"),
        };
        self.findings.push(
            Diagnostic::error(Code::SyntaxBracket, self.span(*at, at + 1), message)
                .help(format!("add the `{closer}` that belongs to it")),
        );
    }
}
