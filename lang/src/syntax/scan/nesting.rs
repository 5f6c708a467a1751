//! Brackets and `else if`: that they fit, and how deep they go.

use super::{NESTING_MAX, Scanner};
use crate::code::Code;
use crate::diagnostic::Diagnostic;

/// A bracket that is open.
pub(super) struct Open {
    pub bracket: char,
    pub at: usize,
    /// The `else if` of the statement in which it stands: each nests its blocks one deeper.
    pub chained: usize,
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
        let chained: usize = self.open.iter().map(|open| open.chained).sum();
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
        match self.open.iter().rposition(|open| open.bracket == wanted) {
            Some(index) => {
                self.all_unclosed(index + 1);
                self.chained = self.open.pop().map_or(0, |open| open.chained);
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
