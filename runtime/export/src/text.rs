//! Numbers, times and texts as the formats have them: the one place where any of them becomes text.

use albacore_program::{calendar, number};
use std::fmt::Write;

/// Digits of a degree of latitude and longitude behind the point: a centimetre.
const GLOBE_DECIMALS: u8 = 7;

/// A number to nine digits; none of what is not finite.
pub fn number(x: f64) -> Option<String> {
    x.is_finite().then(|| number::digits(x))
}

/// Degrees of latitude or longitude.
pub fn degrees(x: f64) -> String {
    let text = number::fixed(x, GLOBE_DECIMALS);
    text.trim_end_matches('0').trim_end_matches('.').to_string()
}

/// The seconds of a tick since the first.
pub fn seconds(tick: u64) -> String {
    number::seconds(tick).trim_end_matches(" s").trim_start().to_string()
}

/// A moment in milliseconds since the beginning of 1970, as ISO 8601 has it: all in one form, which programs take for granted.
pub fn moment(ms: i64) -> String {
    let whole = calendar::written(ms.div_euclid(1000) as f64);
    whole.strip_suffix('Z').map(|whole| format!("{whole}.{:03}Z", ms.rem_euclid(1000))).unwrap_or(whole.clone())
}

/// A text in quotes, as JSON has it.
pub fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

/// A text within XML.
pub fn xml(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            // XML has no such characters, escaped or not.
            c if c.is_control() && !matches!(c, '\n' | '\t') => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

/// A text that a spreadsheet would compute stands behind a `'`, which makes it a text there. Numbers are numbers. Where a comma
/// stands in numbers, a spreadsheet parts cells at semicolons.
pub fn no_formula(cell: &str) -> String {
    let part = |part: &str| {
        let is_number = part.parse::<f64>().is_ok_and(f64::is_finite);
        let said = part.trim_start_matches(|c: char| c.is_whitespace() || c == '"');
        let starts_one = said.starts_with(['=', '+', '-', '@', '\u{ff1d}', '\u{ff0b}', '\u{ff0d}', '\u{ff20}']);
        if starts_one && !is_number { format!("'{part}") } else { part.to_string() }
    };
    cell.split(';').map(part).collect::<Vec<_>>().join(";")
}

/// The members of a JSON object, as they are added.
#[derive(Default)]
pub struct Members(String);

impl Members {
    /// A text.
    pub fn text(&mut self, name: &str, text: &str) {
        self.raw(name, &quoted(text));
    }

    /// A number, if it is one.
    pub fn number(&mut self, name: &str, x: f64) {
        if let Some(number) = number(x) {
            self.raw(name, &number);
        }
    }

    /// JSON as it is.
    pub fn raw(&mut self, name: &str, json: &str) {
        let comma = if self.0.is_empty() { "" } else { "," };
        // Memory takes everything.
        let _ = write!(self.0, "{comma}{}:{json}", quoted(name));
    }

    /// The object.
    pub fn object(&self) -> String {
        format!("{{{}}}", self.0)
    }
}
