//! Positions on the globe as others write them, and how ours are written.

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::source::Span;

/// How many decimals of a minute are kept where seconds are turned into them: 2 mm.
const MINUTE_DECIMALS: usize = 6;

/// An angle on the globe, as it was written.
struct Angle {
    degrees: String,
    minutes: Option<String>,
    /// The letter, upper case; none where a sign says the same.
    letter: Option<char>,
    negative: bool,
    /// Its degrees are marked with `°`.
    marked: bool,
}

/// What a position of others is here.
#[derive(Debug, PartialEq)]
pub(super) enum Ours {
    /// This very position.
    Written(String),
    /// This very position, which was written with signs in place of letters.
    Signed(String),
    /// One of these: a sign and a letter both say the hemisphere, and which of them is meant only the writer knows.
    OneOf(Vec<String>),
    /// Half of one.
    Half,
}

/// A position that others would read in a line, around the place where ours could not be read on: where in the line it
/// begins, how long it is, and what it is here.
pub(super) fn foreign(before: &str, rest: &str) -> Option<(usize, usize, Ours)> {
    let line = format!("{before}{}", rest.split(['\n', ';', '{', '}']).next().unwrap_or(""));
    let starts = || {
        line.char_indices().filter(|(at, c)| {
            let inside = line[..*at].ends_with(|c: char| c.is_alphanumeric() || matches!(c, '_' | '.' | '-' | '+'));
            *at <= before.len() && !inside && (c.is_ascii_digit() || matches!(c, '-' | '+' | 'N' | 'S' | 'E' | 'W'))
        })
    };
    let found = |read: fn(&str) -> Option<(usize, Ours)>| {
        starts()
            .filter_map(|(at, _)| read(&line[at..]).map(|(length, ours)| (at, length, ours)))
            .find(|(at, length, ours)| at + length >= before.len() && !ours.is(&line[*at..*at + *length]))
    };
    found(position).or_else(|| found(half))
}

/// What to say of a position of others.
pub(super) fn finding(span: Span, ours: &Ours) -> Diagnostic {
    let finding = |message| Diagnostic::error(Code::SyntaxExpected, span, message);
    match ours {
        Ours::Written(ours) => finding("this position cannot be read")
            .help(format!("write `{ours}`: latitude, a blank, longitude, each with `°` and its letter")),
        Ours::Signed(ours) => finding("this position cannot be read")
            .help(format!("write `{ours}`: a letter, N or S and E or W, stands in place of the sign")),
        Ours::OneOf(choices) => finding("a sign and a letter both say the hemisphere: keep one")
            .help(format!("write the letter and no sign, whichever place is meant: `{}`", choices.join("` or `"))),
        Ours::Half => finding("this position cannot be read").help(FORM),
    }
}

/// How a position is written.
const FORM: &str = "a position is its latitude, a blank and its longitude: `36°10.8'N 75°44.4'W`, or `36.18°N 75.74°W`";

/// The position that a text begins with: its length, and what it is here.
pub(super) fn position(text: &str) -> Option<(usize, Ours)> {
    let (first, rest) = angle(text)?;
    let rest = rest.trim_start_matches([' ', '\t', ',', '/']);
    let (second, rest) = angle(rest)?;
    let length = text.len() - rest.len();
    // Two bare numbers are a position only where both have decimals, as no count and no index has.
    let bare = |a: &Angle| a.degrees.contains('.') && a.minutes.is_none();
    let ends = |rest: &str| !rest.trim_start().starts_with(|c: char| c.is_alphanumeric() || c == '%');
    let (latitude, longitude) = match (first.letter, second.letter) {
        (Some('N' | 'S'), Some('E' | 'W')) => (first, second),
        (Some('E' | 'W'), Some('N' | 'S')) => (second, first),
        // With the sign of degrees on both, and a minus for one hemisphere or the other, nothing else is meant.
        (None, None) if first.marked && second.marked && (first.negative || second.negative) => (first, second),
        // A comma between two bare numbers parts them: decimals follow a point.
        (None, None) if bare(&first) && bare(&second) && ends(rest) && points(&text[..length]) == 2 => (first, second),
        _ => return None,
    };
    let is_signed = latitude.letter.is_none() && (latitude.negative || longitude.negative);
    let (latitudes, longitudes) = (latitude.ours(['N', 'S'], 90.0)?, longitude.ours(['E', 'W'], 180.0)?);
    let mut choices: Vec<String> =
        latitudes.iter().flat_map(|north| longitudes.iter().map(move |east| format!("{north} {east}"))).collect();
    let ours = match choices.len() {
        1 if is_signed => Ours::Signed(choices.remove(0)),
        1 => Ours::Written(choices.remove(0)),
        _ => Ours::OneOf(choices),
    };
    Some((length, ours))
}

fn points(text: &str) -> usize {
    text.matches('.').count()
}

/// The latitude or longitude that a text begins with, with degrees and minutes that are written out.
fn half(text: &str) -> Option<(usize, Ours)> {
    let (angle, rest) = angle(text)?;
    let written = &text[..text.len() - rest.len()];
    let has_degrees = DEGREES[..3].iter().any(|sign| written.contains(sign));
    let is_half = has_degrees && angle.minutes.is_some() && written.ends_with(['N', 'S', 'E', 'W']);
    is_half.then_some((written.len(), Ours::Half))
}

impl Ours {
    fn is(&self, text: &str) -> bool {
        matches!(self, Ours::Written(ours) if ours == text)
    }
}

impl Angle {
    /// As it is written here, if it can be one of these directions; as each of them where a sign and a letter both say it.
    fn ours(&self, letters: [char; 2], degrees_max: f64) -> Option<Vec<String>> {
        let letter = self.letter.unwrap_or(letters[usize::from(self.negative)]);
        let in_range = self.degrees.parse::<f64>().is_ok_and(|degrees| degrees <= degrees_max);
        let minutes = self.minutes.as_ref().map(|minutes| format!("{minutes}'")).unwrap_or_default();
        let doubled = self.negative && self.letter.is_some();
        let meant = letters.iter().filter(|other| doubled || **other == letter);
        in_range.then(|| meant.map(|letter| format!("{}°{minutes}{letter}", self.degrees)).collect())
    }
}

/// How degrees are marked.
const DEGREES: [&str; 4] = ["°", "º", "deg", "d"];

/// The angle that a text begins with, and what follows it.
fn angle(text: &str) -> Option<(Angle, &str)> {
    let (before, text) = letter(text);
    let negative = text.starts_with('-');
    let (written, rest) = number(text.strip_prefix(['-', '+']).unwrap_or(text))?;
    let (mut degrees, mut minutes) = (written, None);
    let marked = ["°", "º"].iter().any(|sign| rest.trim_start().starts_with(sign));
    let mut rest = sign(rest, &DEGREES);
    if let Some((written, after)) = number(rest).filter(|_| !degrees.contains('.')) {
        let (mut value, after) = (written.clone(), sign(after, &["''", "'", "′", "’", "min", "m"]));
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
    let letter = before.or(after);
    // Receivers write the minutes directly after the degrees, `3610.8N`: no direction has so many degrees.
    let whole = degrees.find('.').unwrap_or(degrees.len());
    if letter.is_some() && minutes.is_none() && matches!(whole, 4 | 5) {
        minutes = Some(degrees.split_off(whole - 2));
        degrees = degrees.trim_start_matches('0').to_string();
    }
    Some((Angle { degrees, minutes, letter, negative, marked }, rest))
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

/// The unsigned number that a text begins with, with a point where others write a comma.
fn number(text: &str) -> Option<(String, &str)> {
    let text = text.trim_start_matches([' ', '\t']);
    let digits = |text: &str| text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
    let whole = digits(text);
    let decimals = text[whole..].strip_prefix(['.', ',']).map_or(0, digits);
    let end = if decimals > 0 { whole + 1 + decimals } else { whole };
    (whole > 0).then(|| (text[..end].replace(',', "."), &text[end..]))
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
        let ours = |text: &str| match position(text)?.1 {
            Ours::Signed(ours) => Some(Ours::Written(ours)),
            ours => Some(ours),
        };
        let decimal = Some(Ours::Written("36.18°N 75.74°W".to_string()));
        for text in [
            "36.18N, 75.74W",
            "36.18 N 75.74 W",
            "36.18° N, 75.74° W",
            "N36.18 W75.74",
            "36.18, -75.74",
            "36.18n/75.74w",
            "75.74W 36.18N",
            "36.18, -75.74)",
            "+36.18, -75.74",
            "36.18° -75.74°",
            "+36.18°, -75.74°",
            "36,18N 75,74W",
            "36,18°N, 75,74°W",
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
            "36°10,8'N 75°44,4'W",
            "36 deg 10.8 min N 75 deg 44.4 min W",
            "3610.8N 7544.4W",
            "3610.8N, 07544.4W",
            "36°10.8' -75°44.4'",
            "36°10'48\", -75°44'24\"",
        ] {
            assert_eq!(ours(text), Some(Ours::Written("36°10.8'N 75°44.4'W".to_string())), "{text}");
        }
        for text in [
            "1, 2",
            "1.5, 2",
            "3 m, 4 m",
            "95.5N 10.1E",
            "36.18N",
            "1.5 N",
            "n 1",
            "1,2,3,4]",
            "1.5,2,3,4",
            "9544.4N 10E",
        ] {
            assert_eq!(ours(text), None, "{text}");
        }
    }

    #[test]
    fn the_hemisphere_is_chosen_for_nobody() {
        let choices = |text: &str| match position(text) {
            Some((_, Ours::OneOf(choices))) => choices.join(", "),
            other => format!("{other:?}"),
        };
        for text in ["36.18N -75.74W", "36.18°N -75.74°E", "-75.74W, 36.18N", "N36.18 W-75.74"] {
            assert_eq!(choices(text), "36.18°N 75.74°E, 36.18°N 75.74°W", "{text}");
        }
        assert_eq!(choices("36°10'48\"N -75°44'24\"W"), "36°10.8'N 75°44.4'E, 36°10.8'N 75°44.4'W");
        assert_eq!(choices("-1S 2E"), "1°N 2°E, 1°S 2°E");
        assert_eq!(choices("-1S -2W"), "1°N 2°E, 1°N 2°W, 1°S 2°E, 1°S 2°W");
    }

    #[test]
    fn half_a_position_is_known() {
        let found = |text: &'static str| half(text).map(|(length, _)| &text[..length]);
        assert_eq!(found("36 deg 10.8 min N"), Some("36 deg 10.8 min N"));
        assert_eq!(found("36°10,8'N)"), Some("36°10,8'N"));
        for text in ["36.18 N", "10 s", "36 deg, 10 m", "36 deg 5 s", "5 10 m S"] {
            assert_eq!(found(text), None, "{text}");
        }
    }
}
