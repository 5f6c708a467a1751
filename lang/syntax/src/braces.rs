//! Where brackets do not fit, the margins tell which one is missing: it is told at its place, and read as if it stood
//! there, so that nothing else of the declaration is lost.
//!
//! Only a declaration whose brackets do not fit is looked at: in any other the margins mean nothing.

use super::errors::line_begins_item;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::source::{FileId, Span};

/// A source with the brackets that were missing, byte for byte as long, and what was found.
pub(super) struct Mended {
    pub text: String,
    pub findings: Vec<Diagnostic>,
}

/// A bracket that is open, and the margin of the line on which it stands.
struct Open {
    bracket: u8,
    at: usize,
    margin: usize,
}

/// One line: where it and what stands on it begin and end.
struct Line {
    begin: usize,
    start: usize,
    end: usize,
}

impl Line {
    fn margin(&self) -> usize {
        self.start - self.begin
    }
}

struct Mender {
    file: FileId,
    /// The source, with blanks for its comments and its texts.
    bare: Vec<u8>,
    out: Vec<u8>,
    open: Vec<Open>,
    findings: Vec<Diagnostic>,
}

/// Mends a source that holds no comments.
pub(super) fn mend(file: FileId, source: &str) -> Mended {
    let bare = without_texts(source);
    let lines = lines(&bare);
    let mut mender = Mender { file, out: source.as_bytes().to_vec(), bare, open: Vec::new(), findings: Vec::new() };
    let mut declarations = declarations(&mender.bare, &lines).into_iter().peekable();
    while let Some(lines) = declarations.next() {
        let next = declarations.peek().map(|next| next[0].start);
        if !fits(&mender.bare[lines[0].begin..lines[lines.len() - 1].end]) {
            mender.declaration(lines, next);
        }
    }
    Mended { text: String::from_utf8(mender.out).unwrap_or_default(), findings: mender.findings }
}

impl Mender {
    fn declaration(&mut self, lines: &[Line], next: Option<usize>) {
        let mut last_end = lines[0].start;
        // Where nothing is indented the margins show nothing: what is open at the end is what was not closed.
        if lines.iter().all(|line| line.margin() == 0) {
            for line in lines {
                self.brackets_of(line, line.start);
                last_end = line.end;
            }
            return self.close_from(0, last_end, next);
        }
        for (index, line) in lines.iter().enumerate() {
            let closes = matches!(self.bare[line.start], b')' | b']' | b'}');
            // What is open and began no further in than this line was to be closed before it.
            let outside = |open: &Open| open.margin < line.margin() || (closes && open.margin == line.margin());
            let level = self.open.iter().rposition(outside).map_or(0, |at| at + 1);
            let mut from = line.start;
            // Of several that close on one line the margin shows nothing: each closes the innermost that is open.
            let several = self.closers(line).count() > 1;
            if !several {
                self.close_from(level, last_end, Some(line.start));
            }
            if closes && !several && self.open.last().is_none_or(|open| open.margin != line.margin()) {
                self.opener_missing(&lines[..index], line);
                from += 1;
            }
            self.brackets_of(line, from);
            last_end = line.end;
        }
        self.close_from(0, last_end, next);
    }

    /// The closers with which a line begins.
    fn closers(&self, line: &Line) -> impl Iterator<Item = usize> {
        let front = (line.start..line.end).take_while(|&at| matches!(self.bare[at], b')' | b']' | b'}' | b' '));
        front.filter(|&at| self.bare[at] != b' ')
    }

    fn brackets_of(&mut self, line: &Line, from: usize) {
        let front = self.closers(line).last().unwrap_or(line.start);
        for at in from..line.end {
            let byte = self.bare[at];
            match byte {
                b'(' | b'[' | b'{' => self.open.push(Open { bracket: byte, at, margin: line.margin() }),
                b')' | b']' | b'}' => {
                    // A block that began on another line ends at the front of one.
                    let here = |open: &Open| at <= front || byte != b'}' || open.at >= line.start;
                    let fitting = |open: &Open| closer(open.bracket) == byte && here(open);
                    match self.open.iter().rposition(fitting) {
                        Some(level) => {
                            self.close_from(level + 1, at, Some(at));
                            self.open.pop();
                        }
                        None => {
                            self.out[at] = b' ';
                            self.closes_nothing(at);
                        }
                    }
                }
                _ => {}
            }
        }
    }

    /// What is open from a level on is closed in the gap between two tokens, if there is room.
    fn close_from(&mut self, level: usize, gap: usize, next: Option<usize>) {
        let missing = self.open.split_off(level);
        let Some(outermost) = missing.first() else { return };
        // A round bracket is closed on its line, unless its line ends with it.
        let line_ends = |at: usize| self.bare[at..].iter().skip(1).find(|b| **b != b' ').is_none_or(|b| *b == b'\n');
        let same_line =
            !self.bare[outermost.at..gap].contains(&b'\n') || (outermost.bracket != b'{' && !line_ends(outermost.at));
        let end = next.unwrap_or(self.out.len());
        // A block of its own line is closed behind what stands there; then the line must end.
        let parted = self.bare[gap..end].contains(&b'\n') && next.is_some();
        if gap + missing.len() + usize::from(parted) <= end {
            self.out[gap..end].fill(b' ');
            for (at, open) in (gap..).zip(missing.iter().rev()) {
                self.out[at] = closer(open.bracket);
            }
            if parted {
                self.out[gap + missing.len()] = b'\n';
            }
        }
        let sign = outermost.bracket as char;
        let inside = match missing.len() - 1 {
            0 => String::new(),
            1 => ", nor is one inside it".to_string(),
            more => format!(", nor are {more} inside it"),
        };
        let never = format!("this `{sign}` is never closed{inside}");
        let opened = self.span(outermost.at);
        let add = closer(outermost.bracket) as char;
        self.findings.push(if same_line {
            Diagnostic::error(Code::SyntaxBracket, opened, never).help(format!("add the `{add}` that belongs to it"))
        } else {
            // Behind the last token before the gap.
            let place = self.span(gap.saturating_sub(1));
            let message = match missing.len() {
                1 => format!("a `{add}` is missing after this"),
                more => format!("{more} brackets are never closed: a `{add}` is missing after this"),
            };
            Diagnostic::error(Code::SyntaxBracket, place, message)
                .label(opened, never)
                .help(format!("write `{add}` on a line of its own, as far in as the line that it closes"))
        });
    }

    /// A line begins with what closes, and nothing that begins as far in is open: a line above lacks its bracket.
    fn opener_missing(&mut self, above: &[Line], line: &Line) {
        let at = line.start;
        let opener = match self.bare[at] {
            b')' => b'(',
            b']' => b'[',
            _ => b'{',
        };
        let head = above.iter().rposition(|head| head.margin() <= line.margin());
        let head = head.map(|index| &above[index]).filter(|head| head.margin() == line.margin());
        let opens = |head: &&Line| self.bare[head.start..head.end].iter().any(u8::is_ascii_alphabetic);
        match head.filter(opens).map(|head| head.end) {
            // The newline behind it gives its place.
            Some(end) if end < at => {
                self.out[end] = opener;
                let (opener, closer) = (opener as char, self.bare[at] as char);
                self.findings.push(
                    Diagnostic::error(
                        Code::SyntaxBracket,
                        self.span(end.saturating_sub(1)),
                        format!("a `{opener}` is missing after this"),
                    )
                    .label(self.span(at), format!("this `{closer}` closes nothing"))
                    .help(format!("end the line with `{opener}`")),
                );
            }
            _ => {
                self.out[at] = b' ';
                self.closes_nothing(at);
            }
        }
    }

    fn closes_nothing(&mut self, at: usize) {
        let (closer, opener) = match self.bare[at] {
            b')' => (')', '('),
            b']' => (']', '['),
            _ => ('}', '{'),
        };
        self.findings.push(
            Diagnostic::error(Code::SyntaxBracket, self.span(at), format!("this `{closer}` closes nothing"))
                .help(format!("remove it, or open it with `{opener}`")),
        );
    }

    fn span(&self, at: usize) -> Span {
        // A character may be longer than a byte.
        let start = (0..=at).rev().find(|&i| self.out[i] & 0xC0 != 0x80).unwrap_or(at);
        Span { file: self.file, start: start as u32, end: at as u32 + 1 }
    }
}

fn closer(opener: u8) -> u8 {
    match opener {
        b'(' => b')',
        b'[' => b']',
        _ => b'}',
    }
}

/// A source with blanks for its texts: brackets in them are none.
fn without_texts(source: &str) -> Vec<u8> {
    let mut bare = source.as_bytes().to_vec();
    let (mut in_text, mut escaped) = (false, false);
    for byte in &mut bare {
        match *byte {
            b'\n' => in_text = false,
            b'"' if !escaped => in_text = !in_text,
            _ if in_text => {
                escaped = *byte == b'\\' && !escaped;
                // No blank, so that a line ends where its text does.
                *byte = b'_';
                continue;
            }
            _ => {}
        }
        escaped = false;
    }
    bare
}

/// The lines on which something stands.
fn lines(text: &[u8]) -> Vec<Line> {
    let mut begin = 0;
    let mut lines = Vec::new();
    for line in text.split(|&byte| byte == b'\n') {
        let content = line.trim_ascii();
        let start = begin + (line.len() - line.trim_ascii_start().len());
        if !content.is_empty() {
            lines.push(Line { begin, start, end: start + content.len() });
        }
        begin += line.len() + 1;
    }
    lines
}

/// The lines of each declaration: one begins at the left margin.
fn declarations<'a>(text: &[u8], lines: &'a [Line]) -> Vec<&'a [Line]> {
    let begins = |line: &Line| {
        line.margin() == 0 && std::str::from_utf8(&text[line.start..line.end]).is_ok_and(line_begins_item)
    };
    let starts: Vec<usize> = (0..lines.len()).filter(|&at| at == 0 || begins(&lines[at])).collect();
    let ends = starts.iter().skip(1).copied().chain([lines.len()]);
    starts.iter().zip(ends).map(|(&start, end)| &lines[start..end]).collect()
}

/// Whether each bracket has its own.
fn fits(text: &[u8]) -> bool {
    let mut open = Vec::new();
    for &byte in text {
        match byte {
            b'(' | b'[' | b'{' => open.push(closer(byte)),
            b')' | b']' | b'}' if open.pop() != Some(byte) => return false,
            _ => {}
        }
    }
    open.is_empty()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(source: &str, expected: &str, messages: &[&str]) {
        let mended = mend(FileId(0), source);
        assert_eq!(mended.text.len(), source.len());
        assert_eq!(mended.text, expected);
        let said: Vec<&str> = mended.findings.iter().map(|f| f.message.as_str()).collect();
        assert_eq!(said, messages);
    }

    #[test]
    fn a_block_ends_where_its_margin_does() {
        check(
            "fn f {\n  if a {\n    b\n  c\n}\n",
            "fn f {\n  if a {\n    b}\n c\n}\n",
            &["a `}` is missing after this"],
        );
        check("fn f {\n  a\n\nfn g {\n}\n", "fn f {\n  a}\nfn g {\n}\n", &["a `}` is missing after this"]);
        check("fn f {\n  on a { b\n  c\n}\n", "fn f {\n  on a { b}\n c\n}\n", &["this `{` is never closed"]);
    }

    #[test]
    fn a_head_without_its_brace_gets_one() {
        check("fn f \n  a\n}\n", "fn f{\n  a\n}\n", &["a `{` is missing after this"]);
        check("fn f\n  a: B,\n) {\n}\n", "fn f(  a: B,\n) {\n}\n", &["a `(` is missing after this"]);
        check("fn f {\n  on a b }\n}\n", "fn f {\n  on a b  \n}\n", &["this `}` closes nothing"]);
    }

    #[test]
    fn several_closers_on_a_line_close_what_is_open() {
        check(
            "fn f {\n  if a {\n    if b {\n      c\n}}\n}\n\n}\n",
            "fn f {\n  if a {\n    if b {\n      c\n}}\n}\n\n \n",
            &["this `}` closes nothing"],
        );
        check(
            "fn f {\n  if a {\n    if b {\n      c\n}}\n",
            "fn f {\n  if a {\n    if b {\n      c\n}}}",
            &["a `}` is missing after this"],
        );
    }

    #[test]
    fn where_nothing_is_indented_the_order_of_brackets_counts() {
        check(
            "fn f {\nloop {\nif a {\nb\n}\n}\n\nfn g {\n}\n",
            "fn f {\nloop {\nif a {\nb\n}\n}}\nfn g {\n}\n",
            &["a `}` is missing after this"],
        );
        check("fn f {\nif a {\nb\n}\n}\n}\n", "fn f {\nif a {\nb\n}\n}\n \n", &["this `}` closes nothing"]);
    }

    #[test]
    fn a_clause_at_the_margin_begins_no_declaration() {
        let scenario = "scenario s {\nvehicle(kinematic)\nflow(a)\n}\n";
        check(scenario, scenario, &[]);
    }

    #[test]
    fn margins_mean_nothing_where_brackets_fit() {
        let odd = "fn f {\n if a {\nb\n      }\n}\n";
        check(odd, odd, &[]);
    }
}
