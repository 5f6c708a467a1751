//! Positions on the globe as others write them, and how ours are written.

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::source::Span;

/// How many decimals of a minute are kept where seconds are turned into them: 2 mm.
const MINUTE_DECIMALS: usize = 6;

/// An angle on the globe, as it was written.
struct Angle<'a> {
    degrees: &'a str,
    minutes: Option<String>,
    /// The letter, upper case; none where a sign says the same.
    letter: Option<char>,
    negative: bool,
}

/// A position that others would read in a line, around the place where ours could not be read on: where in the line it
/// begins, how long it is, and how it is written here.
pub(super) fn foreign(before: &str, rest: &str) -> Option<(usize, usize, String)> {
    let line = format!("{before}{}", rest.split(['\n', ';', '{', '}']).next().unwrap_or(""));
    let starts = line.char_indices().filter(|(at, c)| {
        let inside = line[..*at].ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == '.' || c == '-');
        *at <= before.len() && !inside && (c.is_ascii_digit() || matches!(c, '-' | 'N' | 'S' | 'E' | 'W'))
    });
    starts
        .filter_map(|(at, _)| position(&line[at..]).map(|(length, ours)| (at, length, ours)))
        .find(|(at, length, ours)| at + length >= before.len() && line[*at..*at + *length] != *ours)
}

/// What to say of a position of others.
pub(super) fn finding(span: Span, ours: &str) -> Diagnostic {
    Diagnostic::error(Code::SyntaxExpected, span, "this position cannot be read")
        .help(format!("write `{ours}`: latitude, a blank, longitude, each with `°` and its letter"))
}

/// The position that a text begins with: its length, and how it is written here.
pub(super) fn position(text: &str) -> Option<(usize, String)> {
    let (first, rest) = angle(text)?;
    let rest = rest.trim_start_matches([' ', '\t', ',', '/']);
    let (second, rest) = angle(rest)?;
    let length = text.len() - rest.len();
    // Two bare numbers are a position only where both have decimals, as no count and no index has.
    let bare = |a: &Angle<'_>| a.degrees.contains('.') && a.minutes.is_none();
    let ends = |rest: &str| !rest.trim_start().starts_with(|c: char| c.is_alphanumeric() || c == '%');
    let (latitude, longitude) = match (first.letter, second.letter) {
        (Some('N' | 'S'), Some('E' | 'W')) => (first, second),
        (Some('E' | 'W'), Some('N' | 'S')) => (second, first),
        // Two bare numbers are a position only where both have decimals, as no count and no index has.
        (None, None) if bare(&first) && bare(&second) && ends(rest) => (first, second),
        _ => return None,
    };
    Some((length, format!("{} {}", latitude.ours(['N', 'S'], 90.0)?, longitude.ours(['E', 'W'], 180.0)?)))
}

impl Angle<'_> {
    /// As it is written here, if it can be one of these directions.
    fn ours(&self, letters: [char; 2], degrees_max: f64) -> Option<String> {
        let letter = self.letter.unwrap_or(letters[0]);
        let letter = if self.negative { letters[usize::from(letter == letters[0])] } else { letter };
        let in_range = self.degrees.parse::<f64>().is_ok_and(|degrees| degrees <= degrees_max);
        let minutes = self.minutes.as_ref().map(|minutes| format!("{minutes}'")).unwrap_or_default();
        in_range.then(|| format!("{}°{minutes}{letter}", self.degrees))
    }
}

/// The angle that a text begins with, and what follows it.
fn angle(text: &str) -> Option<(Angle<'_>, &str)> {
    let (before, text) = letter(text);
    let (negative, text) = text.strip_prefix('-').map_or((false, text), |rest| (true, rest));
    let (degrees, mut rest) = number(text)?;
    rest = sign(rest, &["°", "º", "deg", "d"]);
    let mut minutes = None;
    if let Some((written, after)) = number(rest).filter(|_| !degrees.contains('.')) {
        let (mut value, after) = (written.to_string(), sign(after, &["''", "'", "′", "’", "min", "m"]));
        rest = after;
        if let Some((seconds, after)) = number(rest).filter(|_| !written.contains('.')) {
            let whole = written.parse::<f64>().ok()? + seconds.parse::<f64>().ok()? / 60.0;
            let text = format!("{whole:.MINUTE_DECIMALS$}");
            value = text.trim_end_matches('0').trim_end_matches('.').to_string();
            rest = sign(after, &["\"", "''", "″", "”", "sec", "s"]);
        }
        minutes = Some(value);
    }
    let (after, rest) = if before.is_none() { letter(rest) } else { (None, rest) };
    Some((Angle { degrees, minutes, letter: before.or(after), negative }, rest))
}

/// One of the four directions, which no name begins with.
fn letter(text: &str) -> (Option<char>, &str) {
    let begins = text.trim_start_matches([' ', '\t']);
    let mut chars = begins.chars();
    let found = chars.next().map(|c| c.to_ascii_uppercase()).filter(|c| matches!(c, 'N' | 'S' | 'E' | 'W'));
    let ends = !chars.as_str().starts_with(|c: char| c.is_alphabetic() || c == '_');
    match found {
        Some(letter) if ends => (Some(letter), chars.as_str().trim_start_matches([' ', '\t'])),
        _ => (None, text),
    }
}

/// The unsigned number that a text begins with.
fn number(text: &str) -> Option<(&str, &str)> {
    let text = text.trim_start_matches([' ', '\t']);
    let end = text.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(text.len());
    let (number, rest) = text.split_at(end);
    number.parse::<f64>().is_ok().then_some((number, rest))
}

/// What follows the first of these signs that a text begins with; the text itself where none does.
fn sign<'a>(text: &'a str, signs: &[&str]) -> &'a str {
    let begins = text.trim_start_matches([' ', '\t']);
    signs.iter().find_map(|sign| begins.strip_prefix(sign)).unwrap_or(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_of_others_are_understood() {
        let ours = |text: &str| position(text).map(|(_, ours)| ours);
        let decimal = Some("36.18°N 75.74°W".to_string());
        for text in [
            "36.18N, 75.74W",
            "36.18 N 75.74 W",
            "36.18° N, 75.74° W",
            "N36.18 W75.74",
            "36.18, -75.74",
            "36.18n/75.74w",
            "75.74W 36.18N",
            "-75.74°E 36.18°N",
            "36.18°N -75.74°E",
            "36.18, -75.74)",
        ] {
            assert_eq!(ours(text), decimal, "{text}");
        }
        for text in [
            "36°10.8'N, 75°44.4'W",
            "36 10.8N 75 44.4W",
            "36°10'48\"N 75°44'24\"W",
            "36 10 48 N 75 44 24 W",
            "N36°10.8' W75°44.4'",
            "36°10'48''N 75°44'24''W",
            "75°44.4'W 36°10.8'N",
            "36d10m48sN 75d44m24sW",
        ] {
            assert_eq!(ours(text), Some("36°10.8'N 75°44.4'W".to_string()), "{text}");
        }
        for text in ["1, 2", "1.5, 2", "3 m, 4 m", "95.5N 10.1E", "36.18N", "1.5 N", "n 1"] {
            assert_eq!(ours(text), None, "{text}");
        }
    }
}
