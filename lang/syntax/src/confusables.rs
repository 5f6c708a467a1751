//! Characters that make a script look like another: what nobody sees, and what looks like a letter and is none.

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::source::Span;
use albacore_program::seen::is_unseen;
use std::borrow::Cow;

/// Cyrillic and Greek letters, and signs, beside those that they look like.
const LOOK_ALIKES: [(&str, &str); 3] = [
    ("аеорсухіјѕһԁԛԝАВЕКМНОРСТХУІЈЅ", "aeopcyxijshdqwABEKMHOPCTXYIJS"),
    ("ανορτυχκιΑΒΕΖΗΙΚΜΝΟΡΤΥΧ", "avoptuxkiABEZHIKMNOPTYX"),
    ("‐‑∕⁄", "--//"),
];

/// What changes how a script looks and not what it means, in comments and texts too: controls of the direction of writing,
/// marks without width, letters without a shape, control codes.
#[inline]
pub(super) fn deceives(c: char) -> bool {
    // Nearly all of a script is printable ASCII, of which nothing is unseen.
    !(' '..='~').contains(&c) && is_unseen(c) && !matches!(c, '\n' | '\r' | '\t')
}

/// A source whose lines all end in a line feed, each byte where it was, and the first place that had to be changed: a
/// carriage return without a line feed after it. Many editors show it as the end of a line, and no comment would end there.
pub(super) fn with_line_feeds(source: &str) -> (Cow<'_, str>, Option<usize>) {
    if !source.contains('\r') {
        return (Cow::Borrowed(source), None);
    }
    let bytes = source.as_bytes();
    let is_lone = |at: usize| bytes[at] == b'\r' && bytes.get(at + 1) != Some(&b'\n');
    let Some(first) = (0..bytes.len()).find(|&at| is_lone(at)) else { return (Cow::Borrowed(source), None) };
    let parted = source.char_indices().map(|(at, c)| if is_lone(at) { '\n' } else { c }).collect();
    (Cow::Owned(parted), Some(first))
}

pub(super) fn lone_return(span: Span) -> Diagnostic {
    let message = "a carriage return without a line feed stands here";
    Diagnostic::error(Code::SyntaxDeceptive, span, message).help(
        "save the file with line ends LF or CR LF: some editors end the line here, and others show what follows on the same line",
    )
}

/// What a character in code was meant to be, when it looks like another: a blank, a digit, a letter, a sign.
pub(super) fn meant(c: char) -> Option<char> {
    if c.is_ascii() {
        return None;
    }
    if c.is_whitespace() {
        return Some(' ');
    }
    // The wide forms stand in the order of the narrow ones.
    if let '\u{ff01}'..='\u{ff5e}' = c {
        return char::from_u32(c as u32 - 0xff01 + 0x21);
    }
    LOOK_ALIKES
        .iter()
        .find_map(|(these, those)| these.chars().zip(those.chars()).find(|(this, _)| *this == c))
        .map(|(_, as_that)| as_that)
}

/// A mark that is drawn on the letter before it.
pub(super) fn combines(c: char) -> bool {
    matches!(c, '\u{300}'..='\u{36f}')
}

pub(super) fn invisible(c: char, span: Span) -> Diagnostic {
    let message = format!("the invisible character U+{:04X} stands here", c as u32);
    Diagnostic::error(Code::SyntaxDeceptive, span, message)
        .help("delete it: it makes the script read differently from what runs")
}

pub(super) fn look_alike(c: char, meant: char, span: Span) -> Diagnostic {
    let (what, named) = match meant {
        ' ' => ("this is no plain blank".to_string(), "a plain blank".to_string()),
        meant => (format!("this looks like `{meant}`"), format!("`{meant}` from the keyboard")),
    };
    Diagnostic::error(Code::SyntaxDeceptive, span, format!("{what}, and is the character U+{:04X}", c as u32))
        .help(format!("write {named}: what only looks alike is another name"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_look_alike_has_what_it_looks_like() {
        for (these, those) in LOOK_ALIKES {
            assert_eq!(these.chars().count(), those.chars().count());
        }
        assert_eq!(meant('а'), Some('a'));
        assert_eq!(meant('３'), Some('3'));
        assert_eq!(meant('\u{a0}'), Some(' '));
        assert_eq!((meant('°'), meant('µ'), meant('é')), (None, None, None));
    }
}
