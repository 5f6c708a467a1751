//! The one place where numbers become text: fixed decimals for each unit, so that traces compare line by line.

use crate::{AREA_CORNER_WORDS, Display, Shape, Text, calendar};
use albacore_geometry::{Heading, Point, math};
use albacore_vehicle::TICK_S;

/// Ticks in a second, whole so that a time is printed without any arithmetic on fractions.
const TICKS_PER_SECOND: u64 = 10;
const _: () = assert!(TICK_S * TICKS_PER_SECOND as f64 == 1.0);

/// Decimals of lengths in metres.
const METRE_DECIMALS: u8 = 1;
/// Decimals of speeds in metres per second.
const SPEED_DECIMALS: u8 = 2;
/// Decimals of angles in degrees.
const DEGREE_DECIMALS: u8 = 1;
/// Decimals of a number, and of a ratio that is no share.
pub const RATIO_DECIMALS: u8 = 3;
/// Decimals of a number that is printed briefly, and the size below which it is printed with an exponent instead.
const BRIEF_DECIMALS: u8 = 4;
const SMALL: f64 = 1e-3;
/// A list longer than this is cut, and its count is given.
const LIST_ELEMENTS_MAX: usize = 6;
/// Numbers from here on are printed with an exponent.
const PLAIN_MAX: f64 = 1e15;
/// Digits of a number that a program reads: more than any instrument of ours tells.
const DATA_DIGITS: usize = 9;
/// What stands for a number that is missing or is none.
const UNKNOWN: &str = "?";

/// A number with a fixed count of decimals. Never `-0.0`; `?` for what is not a number.
pub fn fixed(x: f64, decimals: u8) -> String {
    if x.is_nan() {
        return UNKNOWN.to_string();
    }
    if x.is_infinite() || PLAIN_MAX <= x.abs() {
        return format!("{x:e}");
    }
    let text = format!("{x:.*}", usize::from(decimals));
    // Rounding makes a negative zero of every small negative number, so the sign is looked at after it.
    match text.strip_prefix('-') {
        Some(rest) if rest.bytes().all(|b| b == b'0' || b == b'.') => rest.to_string(),
        _ => text,
    }
}

/// Units that are a power of ten in SI.
const TENS: [(f64, &str); 7] =
    [(1e-6, "e-6"), (1e-3, "e-3"), (1e-2, "e-2"), (1e-1, "e-1"), (1e2, "e2"), (1e3, "e3"), (1e6, "e6")];

/// So many of a unit that is so much in SI. Where that is a power of ten only the decimal point moves: 57 % is 0.57, to the last bit.
pub fn scaled(number: f64, scale: f64) -> f64 {
    let power = TENS.iter().find(|(ten, _)| *ten == scale);
    power.and_then(|(_, power)| format!("{number}{power}").parse().ok()).unwrap_or(number * scale)
}

/// A number for a table of data: to nine digits, without zeros at the end, and with an exponent when it is small or large.
pub fn digits(x: f64) -> String {
    let text = format!("{x:.*e}", DATA_DIGITS - 1);
    let rounded: f64 = text.parse().unwrap_or(x);
    match rounded.abs() {
        0.0 => "0".to_string(),
        size if (SMALL * SMALL..PLAIN_MAX).contains(&size) => rounded.to_string(),
        _ => format!("{rounded:e}"),
    }
}

/// The time of a tick in seconds, right-aligned in nine characters: `  412.3 s`.
pub fn seconds(tick: u64) -> String {
    format!("{:>5}.{} s", tick / TICKS_PER_SECOND, tick % TICKS_PER_SECOND)
}

/// A length in metres: `2.0 m`.
pub fn metres(length_m: f64) -> String {
    format!("{} m", fixed(length_m, METRE_DECIMALS))
}

/// A speed in metres per second: `1.50 m/s`.
pub fn metres_per_second(speed_mps: f64) -> String {
    format!("{} m/s", fixed(speed_mps, SPEED_DECIMALS))
}

/// North and east in metres: `(-405.6, 116.2) m`.
pub fn point(p: Point) -> String {
    format!("({}, {}) m", fixed(p.north, METRE_DECIMALS), fixed(p.east, METRE_DECIMALS))
}

/// A compass direction in degrees, without the unit: `291.0`. In [0, 360) as printed: 359.96 is `0.0`.
pub fn compass(angle_rad: f64) -> String {
    Printer { texts: &[], number: fixed }.compass(angle_rad)
}

/// A compass direction: `291.0 deg`.
pub fn heading(angle_rad: f64) -> String {
    format!("{} deg", compass(angle_rad))
}

/// An angle, not a direction: `-12.5 deg`.
pub fn angle(angle_rad: f64) -> String {
    format!("{} deg", fixed(math::degrees(angle_rad), DEGREE_DECIMALS))
}

fn with_unit(number: String, display: &Display) -> String {
    if display.unit.is_empty() { number } else { format!("{number} {}", display.unit) }
}

/// A value as its shape reads its words. Words that are missing are printed as `?`.
pub fn value(shape: &Shape, words: &[f64]) -> String {
    value_with(&[], shape, words)
}

/// As [`value`], for a program whose texts are known.
pub fn value_with(texts: &[Text], shape: &Shape, words: &[f64]) -> String {
    Printer { texts, number: fixed }.value(shape, words)
}

/// As [`value_with`], for a place within a text: a text as it stands, without quotes.
pub fn within_text(texts: &[Text], shape: &Shape, words: &[f64]) -> String {
    match shape {
        Shape::Text => plain(texts, words.first().copied().unwrap_or(f64::NAN)),
        Shape::Optional(inner) if words.first() == Some(&1.0) => within_text(texts, inner, tail(words, 1)),
        _ => value_with(texts, shape, words),
    }
}

/// As [`value_with`], for a person who asks for one value: as many digits as it takes, and no more: `20 m`, `0.3333 m`.
pub fn brief(texts: &[Text], shape: &Shape, words: &[f64]) -> String {
    Printer { texts, number: |x, _| shortest(x) }.value(shape, words)
}

/// A number to four decimals, and with an exponent when it is small; without zeros at the end.
fn shortest(x: f64) -> String {
    let size = x.abs();
    if !x.is_finite() || size == 0.0 || PLAIN_MAX <= size {
        return fixed(x, 0);
    }
    if size < SMALL {
        return format!("{x:.5e}").replacen(".00000e", "e", 1);
    }
    let text = fixed(x, BRIEF_DECIMALS);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_string() } else { text }
}

/// Prints values, their numbers in one way: a function of the number and of the decimals that its unit usually has.
#[derive(Clone, Copy)]
struct Printer<'a> {
    texts: &'a [Text],
    number: fn(f64, u8) -> String,
}

impl Printer<'_> {
    fn value(self, shape: &Shape, words: &[f64]) -> String {
        let word = |i: usize| words.get(i).copied().unwrap_or(f64::NAN);
        let metre = |x: f64| (self.number)(x, METRE_DECIMALS);
        let place = |i: usize| format!("({}, {}) m", metre(word(i)), metre(word(i + 1)));
        let first = word(0);
        match shape {
            Shape::Bool if first.is_nan() => UNKNOWN.to_string(),
            Shape::Bool => (first != 0.0).to_string(),
            Shape::Int => fixed(first, 0),
            // More than all of something is no share of it.
            Shape::Quantity(display) if display.unit == "%" && first.abs() > 1.0 => {
                (self.number)(first, RATIO_DECIMALS)
            }
            Shape::Quantity(display) => with_unit((self.number)(first / display.scale, display.decimals), display),
            Shape::Heading => format!("{} deg", self.compass(first)),
            Shape::Depth | Shape::Altitude => format!("{} m", metre(first)),
            Shape::Date => calendar::written(first),
            Shape::Point => place(0),
            Shape::Vector(display) => {
                let part = |i: usize| (self.number)(word(i) / display.scale, display.decimals);
                with_unit(format!("({}, {})", part(0), part(1)), display)
            }
            Shape::Line | Shape::Edge => format!("{} to {}", place(0), place(2)),
            Shape::Area(_) => match index(first) {
                Some(corners) if words.len() > corners * AREA_CORNER_WORDS as usize => {
                    format!("area of {corners} corners")
                }
                _ => UNKNOWN.to_string(),
            },
            Shape::Text if index(first).is_some_and(|i| i < self.texts.len()) => {
                format!("\"{}\"", plain(self.texts, first))
            }
            Shape::Text => plain(self.texts, first),
            Shape::Enum(variants) => {
                index(first).and_then(|i| variants.get(i)).map_or_else(|| UNKNOWN.to_string(), String::clone)
            }
            Shape::Record(name, fields) => {
                let mut at = 0;
                let fields = fields.iter().map(|(label, shape)| {
                    let field = format!("{label}: {}", self.value(shape, tail(words, at)));
                    at += shape.words() as usize;
                    field
                });
                format!("{name}({})", fields.collect::<Vec<_>>().join(", "))
            }
            Shape::Optional(_) if first.is_nan() => UNKNOWN.to_string(),
            Shape::Optional(_) if first == 0.0 => "none".to_string(),
            Shape::Optional(shape) => self.value(shape, tail(words, 1)),
            Shape::List(shape, capacity) => match index(first) {
                Some(count) => self.list(shape, count.min(*capacity as usize), tail(words, 1)),
                None => UNKNOWN.to_string(),
            },
            Shape::Map(..) => match (index(word(5)), index(word(6))) {
                (Some(rows), Some(columns)) => format!("map of {rows} x {columns} cells of {} m", metre(first)),
                _ => UNKNOWN.to_string(),
            },
        }
    }

    fn compass(self, angle_rad: f64) -> String {
        if !angle_rad.is_finite() {
            return UNKNOWN.to_string();
        }
        let text = (self.number)(Heading::from_radians(angle_rad).degrees(), DEGREE_DECIMALS);
        if text == "360" || text == "360.0" { text.replacen("36", "", 1) } else { text }
    }

    fn list(self, shape: &Shape, count: usize, words: &[f64]) -> String {
        let width = shape.words() as usize;
        let mut elements: Vec<String> =
            (0..count.min(LIST_ELEMENTS_MAX)).map(|i| self.value(shape, tail(words, i * width))).collect();
        if LIST_ELEMENTS_MAX < count {
            elements.push(format!("… {count} in all"));
        }
        format!("[{}]", elements.join(", "))
    }
}

/// A text by its index. It has no holes: such a text is no value.
pub fn plain(texts: &[Text], word: f64) -> String {
    let Some(i) = index(word) else { return UNKNOWN.to_string() };
    texts.get(i).and_then(Text::plain).unwrap_or_else(|| format!("text {i}"))
}

/// A word that counts or points, unless it is none.
fn index(word: f64) -> Option<usize> {
    (0.0..=f64::from(u32::MAX)).contains(&word).then_some(word as usize)
}

fn tail(words: &[f64], from: usize) -> &[f64] {
    words.get(from..).unwrap_or(&[])
}
