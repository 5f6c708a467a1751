//! The pass before the grammar: takes comments out, decides which newlines end a statement, and bounds nesting.
//!
//! The text that comes out has the same length as the one that went in, so that every span stays true. A comment and a
//! newline that ends nothing become blanks; the grammar then needs one rule for blanks and one for the end of a statement.

use super::errors::begins_item;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::source::{FileId, Span};

/// Brackets, blocks and `else if` may be nested this deep, on every machine and in every build.
pub const NESTING_MAX: usize = 64;

/// Words that begin an item of a file. An item stands at the left margin, which is how an unclosed brace is found.
const ITEM_WORDS: [&str; 13] = [
    "use", "const", "enum", "record", "unit", "input", "clause", "fn", "strategy", "overlay", "mission", "scenario",
    "test",
];

/// Words after which a line goes on.
const OPEN_WORDS: [&str; 9] = ["and", "or", "not", "toward", "else", "on", "do", "becomes", "no"];

/// A comment of the source.
#[derive(Clone, Debug, PartialEq)]
pub struct Comment {
    /// Where it stands, slashes included.
    pub span: Span,
}

/// The text for the grammar, and what was found on the way.
#[derive(Clone, Debug)]
pub struct Scanned {
    /// As long as the source, byte for byte.
    pub text: String,
    /// The comments, in order.
    pub comments: Vec<Comment>,
    /// Brackets that do not fit, characters that deceive.
    pub findings: Vec<Diagnostic>,
    /// The text ends where more must follow: in an open bracket, or after an operator.
    pub goes_on: bool,
}

/// Prepares a source for the grammar.
pub fn scan(file: FileId, source: &str) -> Scanned {
    let mut scanner = Scanner {
        file,
        source,
        out: source.as_bytes().to_vec(),
        at: 0,
        open: Vec::new(),
        chained: 0,
        after_else: false,
        deep: false,
        last: Last::Nothing,
        comments: Vec::new(),
        findings: Vec::new(),
    };
    scanner.run();
    let goes_on = !scanner.open.is_empty() || scanner.last == Last::Goes;
    scanner.all_unclosed(0);
    let text = String::from_utf8(scanner.out).unwrap_or_default();
    Scanned { text, comments: scanner.comments, findings: scanner.findings, goes_on }
}

/// What stood last on the line: decides whether a newline ends the statement.
#[derive(Clone, Copy, PartialEq)]
enum Last {
    Nothing,
    Goes,
    Ends,
}

/// A bracket that is open.
struct Open {
    bracket: char,
    at: usize,
    /// The `else if` of the statement in which it stands: each nests its blocks one deeper.
    chained: usize,
}

struct Scanner<'a> {
    file: FileId,
    source: &'a str,
    out: Vec<u8>,
    at: usize,
    open: Vec<Open>,
    /// How many `else if` the statement that is being read has outside the innermost bracket.
    chained: usize,
    after_else: bool,
    /// Nested too deep, which has been said.
    deep: bool,
    last: Last,
    comments: Vec<Comment>,
    findings: Vec<Diagnostic>,
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
            match c {
                '\n' => self.newline(),
                '/' if self.rest().starts_with("//") => self.comment(),
                '/' if self.rest().starts_with("/*") => self.bracketed_comment(),
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
                    self.last = Last::Ends;
                }
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
        let in_brackets = matches!(self.open.last(), Some(Open { bracket: '(' | '[', .. }));
        let goes_on = in_brackets || self.last == Last::Goes || self.next_word_is("else") || self.block_on_next_line();
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
        let block = self.open.iter().rposition(|open| open.bracket == '{').map_or(0, |at| at + 1);
        let level = if ITEM_WORDS.contains(&word.as_str()) { 0 } else { block };
        if self.open.len() > level && begins_item(&word) {
            self.all_unclosed(level);
            self.chained = 0;
            // The newline before this item was swallowed when a round bracket was open: give it back.
            if self.at > 0 && self.source.as_bytes()[self.at - 1] == b'\n' {
                self.out[self.at - 1] = b'\n';
            }
            self.last = Last::Nothing;
        }
    }

    /// What comes next that is no blank, newline or comment.
    fn next(&self) -> &'a str {
        let mut rest = self.rest();
        loop {
            rest = rest.trim_start();
            match rest.strip_prefix("//") {
                Some(comment) => rest = comment.split_once('\n').map_or("", |(_, after)| after),
                None => return rest,
            }
        }
    }

    fn next_word_is(&self, word: &str) -> bool {
        let after = self.next().strip_prefix(word);
        after.is_some_and(|after| !after.starts_with(|c: char| c.is_alphanumeric() || c == '_'))
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
        self.comments.push(Comment { span: self.span(start, end) });
        self.blank(start, end);
        self.at = end;
    }

    /// `/* … */` is taken out like a comment, so that what it says is not read as a script.
    fn bracketed_comment(&mut self) {
        let start = self.at;
        let length = self.rest().find("*/").map_or(2, |at| at + 2);
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
        let length: usize =
            self.rest().chars().take_while(|c| c.is_alphanumeric() || *c == '_').map(char::len_utf8).sum();
        let word = &self.source[self.at..self.at + length];
        // After a dot any word is a field's name: `flow.toward`.
        let is_field = self.source[..self.at].ends_with('.');
        // `else if` without end would nest without end.
        if word == "if" && self.after_else {
            self.chained += 1;
            self.too_deep(self.at, length, 0);
        }
        self.after_else = word == "else" && !is_field;
        self.last = if OPEN_WORDS.contains(&word) && !is_field { Last::Goes } else { Last::Ends };
        self.at += length;
    }

    fn open(&mut self, bracket: char) {
        self.too_deep(self.at, 1, 1);
        self.after_else = false;
        self.open.push(Open { bracket, at: self.at, chained: std::mem::take(&mut self.chained) });
        self.at += 1;
    }

    /// Reports, once, what stands deeper than anything may; `inside` tells how deep it is in what is open.
    fn too_deep(&mut self, at: usize, length: usize, inside: usize) {
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

    fn close(&mut self, bracket: char) {
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
    fn all_unclosed(&mut self, level: usize) {
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

    fn deceptive(&mut self, c: char, at: usize) {
        let span = self.span(at, at + c.len_utf8());
        self.findings.push(
            Diagnostic::error(
                Code::SyntaxDeceptive,
                span,
                format!("the invisible character U+{:04X} stands here", c as u32),
            )
            .help("delete it: it makes the script read differently from what runs"),
        );
    }
}

/// Characters that change how a script looks and not what it means: bidirectional controls, zero-width, control codes.
fn deceives(c: char) -> bool {
    matches!(c, '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2060}'..='\u{2069}' | '\u{feff}')
        || (c.is_control() && !matches!(c, '\n' | '\r' | '\t'))
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
    fn an_unclosed_bracket_does_not_swallow_the_next_item() {
        let scanned = scan(FileId(0), "mission a {\n  goto (1 m\n}\nmission b {\n}\n");
        assert_eq!(scanned.findings.len(), 1);
        assert!(scanned.text.contains("\nmission b"), "{:?}", scanned.text);
    }
}
