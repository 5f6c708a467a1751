//! The pass before the grammar: takes comments out, decides which newlines end a statement, and bounds nesting.
//!
//! The text that comes out has the same length as the one that went in, so that every span stays true. A comment and a
//! newline that ends nothing become blanks; the grammar then needs one rule for blanks and one for the end of a statement.

mod nesting;

use super::braces;
use super::confusables::{self, deceives};
use super::errors::line_begins_item;
use super::words::{self, begins_item};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::source::{FileId, Span};
use nesting::{Brackets, Open};
use std::collections::BTreeSet;

/// Brackets, blocks and `else if` may be nested this deep, on every machine and in every build.
pub const NESTING_MAX: usize = 64;

/// The text for the grammar, and what was found on the way.
#[derive(Clone, Debug)]
pub struct Scanned {
    /// As long as the source, byte for byte.
    pub text: String,
    /// The comments, in order, slashes included.
    pub comments: Vec<Span>,
    /// Brackets that do not fit, characters that deceive, letters of no name.
    pub findings: Vec<Diagnostic>,
    /// Where declarations begin, in which nothing outside them is open; the first is the beginning of the text.
    pub starts: Vec<usize>,
    /// The text ends where more must follow: in an open bracket, or after an operator.
    pub goes_on: bool,
}

/// Prepares a source for the grammar.
pub fn scan(file: FileId, source: &str) -> Scanned {
    let (source, lone_return) = confusables::with_line_feeds(source);
    let source = source.as_ref();
    let mut scanner = Scanner {
        file,
        source,
        out: source.as_bytes().to_vec(),
        at: 0,
        open: Brackets::default(),
        chained: 0,
        after_else: false,
        after_block: false,
        deep: false,
        last: Last::Nothing,
        comments: Vec::new(),
        findings: Vec::new(),
        foreign: BTreeSet::new(),
        starts: vec![0],
        next_at: 0,
        no_comment_ends: false,
    };
    if let Some(at) = lone_return {
        scanner.findings.push(confusables::lone_return(scanner.span(at, at + 1)));
    }
    scanner.run();
    let goes_on = !scanner.open.is_empty() || scanner.last == Last::Goes;
    scanner.all_unclosed(0);
    let text = String::from_utf8(scanner.out).unwrap_or_default();
    Scanned { text, comments: scanner.comments, findings: scanner.findings, starts: scanner.starts, goes_on }
}

impl Scanned {
    /// Whether each bracket has its own.
    pub(super) fn brackets_fit(&self) -> bool {
        self.findings.iter().all(|finding| finding.code != Code::SyntaxBracket)
    }
}

/// The same for a source whose brackets may not fit: those that the margins show to be missing are put in.
pub(super) fn scan_mended(file: FileId, source: &str) -> Scanned {
    let scanned = scan(file, source);
    let (source, _) = confusables::with_line_feeds(source);
    let found = |code: Code| scanned.findings.iter().any(|f| f.code == code);
    if !found(Code::SyntaxBracket) || found(Code::SyntaxNesting) {
        return scanned;
    }
    let mut bare = source.as_bytes().to_vec();
    for comment in &scanned.comments {
        bare[comment.start as usize..comment.end as usize].fill(b' ');
    }
    let mended = braces::mend(file, &String::from_utf8(bare).unwrap_or_default());
    if mended.findings.is_empty() {
        return scanned;
    }
    let again = scan(file, &mended.text);
    // A bracket is told where it is missing, and of the rest what was first seen.
    let others = scanned.findings.into_iter().filter(|f| f.code != Code::SyntaxBracket);
    Scanned {
        text: again.text,
        starts: again.starts,
        findings: mended.findings.into_iter().chain(others).collect(),
        ..scanned
    }
}

/// What stood last on the line: decides whether a newline ends the statement.
#[derive(Clone, Copy, PartialEq)]
enum Last {
    Nothing,
    Goes,
    Ends,
}

struct Scanner<'a> {
    file: FileId,
    source: &'a str,
    out: Vec<u8>,
    at: usize,
    open: Brackets,
    /// How many `else if` the statement that is being read has outside the innermost bracket.
    chained: usize,
    after_else: bool,
    /// Whether the last that is no blank, newline or comment is `}`.
    after_block: bool,
    /// Nested too deep, which has been said.
    deep: bool,
    last: Last,
    comments: Vec<Span>,
    findings: Vec<Diagnostic>,
    /// The words that have letters of no name.
    foreign: BTreeSet<&'a str>,
    starts: Vec<usize>,
    /// What comes next begins here, when that has been looked for.
    next_at: usize,
    /// No `*/` follows.
    no_comment_ends: bool,
}

impl<'a> Scanner<'a> {
    fn run(&mut self) {
        if self.source.starts_with('\u{feff}') {
            self.blank(0, 3);
            self.at = 3;
        }
        self.margin();
        while let Some(c) = self.rest().chars().next() {
            let start = self.at;
            let is_code = !c.is_whitespace()
                && !["//", "/*"].iter().any(|begin| self.rest().starts_with(begin))
                && !self.begins_foreign_comment();
            match c {
                '\n' => self.newline(),
                '/' if self.rest().starts_with("//") => self.comment(),
                '/' if self.rest().starts_with("/*") => self.bracketed_comment(),
                '-' if self.begins_foreign_comment() => self.foreign_comment(),
                '"' => self.text(),
                '(' | '[' | '{' => {
                    self.open(c);
                    self.last = Last::Nothing;
                }
                ')' | ']' | '}' => {
                    self.close(c);
                    self.last = Last::Ends;
                }
                c if c.is_alphanumeric() || c == '_' => self.word(),
                '+' | '-' | '*' | '/' | '^' | '=' | '<' | '>' | ',' | ':' => {
                    self.at += 1;
                    self.last = Last::Goes;
                }
                ' ' | '\t' | '\r' => self.at += 1,
                c if deceives(c) => {
                    self.at += c.len_utf8();
                    self.deceptive(c, start);
                }
                c => {
                    if c == ';' {
                        self.chained = 0;
                    }
                    self.at += c.len_utf8();
                    self.look_alike(start, self.at);
                    self.last = Last::Ends;
                }
            }
            if is_code {
                self.after_block = c == '}';
            }
        }
    }

    fn rest(&self) -> &'a str {
        self.source.get(self.at..).unwrap_or("")
    }

    fn span(&self, start: usize, end: usize) -> Span {
        Span { file: self.file, start: start as u32, end: end as u32 }
    }

    fn blank(&mut self, start: usize, end: usize) {
        self.out[start..end].fill(b' ');
    }

    fn newline(&mut self) {
        let goes_on = self.in_round_brackets()
            || (self.last == Last::Goes && !self.next_begins())
            || self.next_goes_on()
            || self.block_on_next_line();
        if goes_on {
            self.blank(self.at, self.at + 1);
        } else {
            self.last = Last::Nothing;
            self.chained = 0;
        }
        self.at += 1;
        self.margin();
    }

    /// At the left margin: an item here means that whatever is open was never closed.
    fn margin(&mut self) {
        let word: String = self.rest().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
        // In a strategy a behavior may stand at the margin too; in round brackets nothing is declared.
        let block = self.open.innermost('{').map_or(0, |at| at + 1);
        let level = if words::begins_outer_item(&word) { 0 } else { block };
        if self.open.len() > level && line_begins_item(self.rest()) {
            self.all_unclosed(level);
            self.chained = 0;
            // The newline before this item was swallowed when a round bracket was open: give it back.
            if self.at > 0 && self.source.as_bytes()[self.at - 1] == b'\n' {
                self.out[self.at - 1] = b'\n';
            }
            self.last = Last::Nothing;
        }
        let parted = self.at > 0 && self.out[self.at - 1] == b'\n';
        if parted && self.open.is_empty() && begins_item(&word) {
            self.starts.push(self.at);
        }
    }

    /// What comes next that is no blank, newline or comment.
    fn next(&mut self) -> &'a str {
        // Many lines without anything ask for the same.
        if self.at < self.next_at {
            return self.source.get(self.next_at..).unwrap_or("");
        }
        let next = self.find_next();
        self.next_at = self.source.len() - next.len();
        next
    }

    fn find_next(&self) -> &'a str {
        let mut rest = self.rest();
        loop {
            rest = rest.trim_start();
            match rest.strip_prefix("//") {
                Some(comment) => rest = comment.split_once('\n').map_or("", |(_, after)| after),
                None => return rest,
            }
        }
    }

    /// The next line begins what can be no part of this one, however this one ends.
    fn next_begins(&mut self) -> bool {
        let next = self.next();
        let length = next.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(next.len());
        let at_margin = self.source[..self.source.len() - next.len()].ends_with('\n');
        words::begins_afresh(&next[..length])
            || (at_margin && begins_item(&next[..length]) && next[length..].starts_with(' '))
    }

    /// `else` goes on with the line before, but for a field of that name, which follows no block: `else: Side`.
    fn next_goes_on(&mut self) -> bool {
        let Some(after) = self.next().strip_prefix("else") else { return false };
        let is_word = !after.starts_with(|c: char| c.is_alphanumeric() || c == '_');
        is_word && (self.after_block || !after.trim_start().starts_with(':'))
    }

    /// A `{` on a line of its own belongs to the line before: told once, and read as if it stood there.
    fn block_on_next_line(&mut self) -> bool {
        let next = self.next();
        if self.last != Last::Ends || !next.starts_with('{') {
            return false;
        }
        let at = self.source.len() - next.len();
        let span = self.span(at, at + 1);
        if self.findings.last().is_none_or(|f| f.span() != span) {
            self.findings.push(
                Diagnostic::error(Code::LayoutBrace, span, "this `{` stands on a line of its own")
                    .help("write it at the end of the line before"),
            );
        }
        true
    }

    fn comment(&mut self) {
        let length = self.rest().find('\n').unwrap_or(self.rest().len());
        let (start, end) = (self.at, self.at + length);
        if let Some((offset, c)) = self.rest()[..length].char_indices().find(|&(_, c)| deceives(c)) {
            self.deceptive(c, start + offset);
        }
        self.comments.push(self.span(start, end));
        self.blank(start, end);
        self.at = end;
    }

    /// `-- …` on a line of its own: as in Lua, SQL or Ada. In round brackets the line before goes on, and it may be a sign and a sign.
    fn begins_foreign_comment(&self) -> bool {
        let begins = ["-- ", "---", "--\t", "--\n", "--\r"].iter().any(|begin| self.rest().starts_with(begin));
        let before = self.source[..self.at].trim_end_matches([' ', '\t', '\u{feff}']);
        begins && (before.is_empty() || before.ends_with('\n')) && !self.in_round_brackets()
    }

    /// It is taken out like a comment, so that what it says is not read as a script.
    fn foreign_comment(&mut self) {
        let length = self.rest().find('\n').unwrap_or(self.rest().len());
        let (start, end) = (self.at, self.at + length);
        self.findings.push(
            Diagnostic::error(Code::LayoutComment, self.span(start, start + 2), "`--` begins no comment")
                .help("comments begin with `//`"),
        );
        self.blank(start, end);
        self.at = end;
    }

    fn in_round_brackets(&self) -> bool {
        matches!(self.open.last(), Some(Open { bracket: '(' | '[', .. }))
    }

    /// `/* … */` is taken out like a comment, so that what it says is not read as a script.
    fn bracketed_comment(&mut self) {
        let start = self.at;
        let end = if self.no_comment_ends { None } else { self.rest().find("*/") };
        self.no_comment_ends = end.is_none();
        let length = end.map_or(2, |at| at + 2);
        self.findings.push(
            Diagnostic::error(Code::LayoutComment, self.span(start, start + 2), "comments begin with `//`")
                .help("write `//` at the front of each of its lines, and leave `/*` and `*/` out"),
        );
        for byte in &mut self.out[start..start + length] {
            if *byte != b'\n' {
                *byte = b' ';
            }
        }
        self.at += length;
    }

    fn text(&mut self) {
        let start = self.at;
        let mut escaped = false;
        let mut length = 1;
        let mut closed = false;
        // How deep a hole `{ }` is nested: what stands in it is read like any expression.
        let mut hole = 0_usize;
        let mut chained = 0;
        for c in self.rest().chars().skip(1) {
            if c == '\n' {
                break;
            }
            if deceives(c) {
                self.deceptive(c, start + length);
            }
            match c {
                '{' if !escaped => hole += 1,
                '(' | '[' if hole > 0 => hole += 1,
                '}' | ')' | ']' => hole = hole.saturating_sub(1),
                _ => {}
            }
            if hole == 0 {
                chained = 0;
            } else {
                chained += usize::from(self.rest()[length..].starts_with("else"));
                self.too_deep(start + length, c.len_utf8(), hole + chained);
            }
            length += c.len_utf8();
            if c == '"' && !escaped {
                closed = true;
                break;
            }
            escaped = c == '\\' && !escaped;
        }
        self.at = start + length;
        self.last = Last::Ends;
        if closed && hole > 0 {
            let span = self.span(start, self.at);
            self.findings.push(
                Diagnostic::error(Code::SyntaxText, span, "this text ends inside its `{ }`")
                    .help("close it with `}`, or write `\\{` for the sign itself; no `\"` stands inside `{ }`"),
            );
        }
        if !closed {
            let span = self.span(start, self.at);
            self.findings.push(
                Diagnostic::error(Code::SyntaxText, span, "this text is not closed")
                    .help("end it with `\"` on the same line"),
            );
        }
    }

    fn word(&mut self) {
        let is_of_word = |c: &char| c.is_alphanumeric() || *c == '_' || confusables::combines(*c);
        let length: usize = self.rest().chars().take_while(is_of_word).map(char::len_utf8).sum();
        self.look_alike(self.at, self.at + length);
        let word = &self.source[self.at..self.at + length];
        self.foreign_letters(word);
        // After a dot any word is a field's name: `flow.toward`.
        let is_field = self.source[..self.at].ends_with('.');
        // `else if` without end would nest without end.
        if word == "if" && self.after_else {
            self.chained += 1;
            self.too_deep(self.at, length, 0);
        }
        self.after_else = word == "else" && !is_field;
        self.last = if words::goes_on_after(word) && !is_field { Last::Goes } else { Last::Ends };
        self.at += length;
    }

    /// A word with letters that no name has is told where it first stands, and read as a name with others.
    fn foreign_letters(&mut self, word: &'a str) {
        let is_foreign = |c: char| !c.is_ascii() && (c.is_alphabetic() || confusables::combines(c));
        // `µm` is a unit.
        let is_unit = word.starts_with('µ') && word.chars().skip(1).all(|c| c.is_ascii());
        if is_unit || !word.contains(is_foreign) || word.chars().any(|c| confusables::meant(c).is_some()) {
            return;
        }
        let mut at = self.at;
        for c in word.chars() {
            if is_foreign(c) {
                // Two such letters should stay two, and no word of the language has a capital.
                self.out[at..at + c.len_utf8()].iter_mut().for_each(|byte| *byte = b'A' + *byte % 26);
            }
            at += c.len_utf8();
        }
        if self.foreign.insert(word) {
            let finding =
                Diagnostic::error(Code::SyntaxExpected, self.span(self.at, at), format!("`{word}` is no name"));
            self.findings.push(finding.help("a name is made of the letters a to z, of digits and of `_`"));
        }
    }

    fn deceptive(&mut self, c: char, at: usize) {
        let span = self.span(at, at + c.len_utf8());
        self.findings.push(confusables::invisible(c, span));
    }

    /// A letter, digit, sign or blank in code that looks like another: what is seen is not what is read.
    fn look_alike(&mut self, start: usize, end: usize) {
        let chars = self.source.get(start..end).unwrap_or("").char_indices();
        let found = chars.filter_map(|(offset, c)| Some((start + offset, c, confusables::meant(c)?))).next();
        if let Some((at, c, meant)) = found {
            let span = self.span(at, at + c.len_utf8());
            self.findings.push(confusables::look_alike(c, meant, span));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(source: &str, expected: &str) {
        let scanned = scan(FileId(0), source);
        assert_eq!(scanned.text.len(), source.len());
        assert_eq!(scanned.text, expected, "findings: {:?}", scanned.findings);
    }

    #[test]
    fn a_newline_ends_a_statement_or_nothing() {
        check("a\nb", "a\nb");
        check("f(a,\n  b)\nc", "f(a,   b)\nc");
        check("a +\nb", "a + b");
        check("{ a }\nelse { b }", "{ a } else { b }");
        check("x on\ny", "x on y");
        check("a -> b\nc", "a -> b\nc");
        check("x = flow.toward\ny", "x = flow.toward\ny");
    }

    #[test]
    fn comments_become_blanks() {
        check("a // b\nc", "a     \nc");
        check("goto p // é\n", "goto p      \n");
        check("log \"a // b\"", "log \"a // b\"");
    }

    #[test]
    fn a_lone_carriage_return_ends_a_line_and_is_told_once() {
        let returns = |source| {
            let findings = scan(FileId(0), source).findings;
            findings.iter().map(|f| (f.code, f.span().start)).collect::<Vec<_>>()
        };
        check("a // b\rc", "a     \nc");
        check("a // b\r\nc", "a      \nc");
        assert_eq!(returns("a // b\rc\rd"), [(Code::SyntaxDeceptive, 6)]);
        assert_eq!(returns("log \"a\"\r"), [(Code::SyntaxDeceptive, 7)]);
        assert_eq!(returns("a\r\r\nb"), [(Code::SyntaxDeceptive, 1)]);
        assert_eq!(returns("a\r\nb // c\r\n"), []);
    }

    #[test]
    fn an_unclosed_bracket_does_not_swallow_the_next_item() {
        let scanned = scan(FileId(0), "mission a {\n  goto (1 m\n}\nmission b {\n}\n");
        assert_eq!(scanned.findings.len(), 1);
        assert!(scanned.text.contains("\nmission b"), "{:?}", scanned.text);
    }
}
