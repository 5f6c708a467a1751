//! What was read as something else and is found out only later on its line: told where it stands, not where reading ended.

use super::habits::{line_end, quantity, word};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::source::Span;
use albacore_program::{Channel, Guide};

/// Words after which no colon stands, besides those of guidance.
const NO_COLON: [&str; 6] = ["within", "for", "until", "at", "on", "log"];

/// A slip on a line: where it begins there, how long it is, what it is, and how to write what is meant.
pub(super) struct Slip {
    pub start: usize,
    length: usize,
    message: String,
    help: String,
}

impl Slip {
    pub(super) fn length(&self) -> usize {
        self.length
    }

    pub(super) fn finding(self, span: Span) -> Diagnostic {
        Diagnostic::error(Code::SyntaxExpected, span, self.message).help(self.help)
    }
}

/// The slip on a line that could be read up to a place: `before` is what stands before it, `rest` what follows.
pub(super) fn slip(before: &str, rest: &str) -> Option<Slip> {
    capitals(before, rest)
        .or_else(|| dashes(before))
        .or_else(|| quotes(before, rest))
        .or_else(|| colon(before, rest))
        .or_else(|| counted(before, rest))
        .or_else(|| mutable(before, rest))
        .or_else(|| one_of(before, rest))
        .or_else(|| choice(before, rest))
        .or_else(|| per(before, rest))
}

/// The word with which a text ends, and where it begins.
fn last(text: &str) -> (usize, &str) {
    let text = text.trim_end();
    let word = text.rsplit(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or("");
    (text.len() - word.len(), word)
}

/// `x == 3 AND depth > 2 m`.
fn capitals(before: &str, rest: &str) -> Option<Slip> {
    let is_operator = |word: &str| matches!(word, "AND" | "And" | "OR" | "Or" | "NOT" | "Not");
    let (start, found) =
        Some(last(before)).filter(|(_, found)| is_operator(found)).unwrap_or((before.len(), word(rest)));
    let help = || format!("write `{}`", found.to_lowercase());
    is_operator(found).then(|| Slip {
        start,
        length: found.len(),
        message: "`and`, `or` and `not` are written in small letters".to_string(),
        help: help(),
    })
}

/// `x++`, `-- a comment`.
fn dashes(before: &str) -> Option<Slip> {
    let adjoins = |text: &str| text.ends_with(|c: char| c.is_alphanumeric() || c == '_');
    for (signs, sign) in [("++", '+'), ("--", '-')] {
        // The line goes on after it, and its end is a blank.
        if let Some((name, after)) = before.split_once(signs)
            && adjoins(name)
            && !after.starts_with(|c: char| !c.is_whitespace())
        {
            let (start, name) = (name.len(), last(name).1);
            let help = format!("an assignment names both sides: `{name} = {name} {sign} 1`");
            return Some(Slip { start, length: 2, message: "no operator counts up or down".to_string(), help });
        }
    }
    let start = before.find("--").filter(|at| before[..*at].matches('"').count().is_multiple_of(2))?;
    let begins = start == 0 || before[..start].ends_with([' ', '\t']);
    (begins && before[start + 2..].starts_with([' ', '-', '\t'])).then(|| Slip {
        start,
        length: 2,
        message: "`--` begins no comment".to_string(),
        help: "comments begin with `//`".to_string(),
    })
}

/// `"""a"""`, `f"a {x}"`.
fn quotes(before: &str, rest: &str) -> Option<Slip> {
    let inside = rest.strip_prefix('"')?;
    if before.ends_with("\"\"") {
        let inside = inside.split(['"', '\n']).next().unwrap_or("");
        return Some(Slip {
            start: before.len() - 2,
            length: 3,
            message: "a text stands on one line, between `\"` and `\"`".to_string(),
            help: format!("write `\"{inside}\"`"),
        });
    }
    let (start, letter) = last(before);
    let adjoins = before.len() == start + letter.len();
    (adjoins && matches!(letter, "f" | "F" | "r" | "u" | "b")).then(|| Slip {
        start,
        length: 1,
        message: "no letter stands before a text".to_string(),
        help: format!("leave the `{letter}` out: in every text a value stands between `{{` and `}}`"),
    })
}

/// `goto: op.center`, `within: 20 min`, `with depth: 3 m`, `at speed=1.5`.
fn colon(before: &str, rest: &str) -> Option<Slip> {
    let (_, word) = last(before);
    let is_setpoint = Channel::named(word).is_some();
    let value = rest.strip_prefix(':').or_else(|| rest.strip_prefix('=').filter(|_| is_setpoint))?;
    let before_setpoint = |w: &str| matches!(w, "with" | "at") || w == "keep" && rest.starts_with(':');
    let stands = match is_setpoint {
        true => before.split_whitespace().any(before_setpoint) && !before.contains('('),
        false => NO_COLON.contains(&word) || word != "keep" && Guide::of_verb(word).next().is_some(),
    };
    let value = line_end(value);
    if !stands || value.is_empty() || value.starts_with('=') {
        return None;
    }
    let value = match word {
        _ if is_setpoint => with_unit(word, value.split(',').next().unwrap_or("").trim()),
        "wait" | "hold" => format!("for {}", value.trim_start_matches("for ")),
        "log" => "\"…\"".to_string(),
        _ => value.to_string(),
    };
    let message = format!("`{}` does not follow `{word}`", &rest[..1]);
    Some(Slip { start: before.len(), length: 1, message, help: format!("write `{word} {value}`") })
}

/// A value with the unit that its name asks for, where it was written without one.
pub(super) fn with_unit(name: &str, value: &str) -> String {
    let unit = match name {
        "radius" | "length" | "width" | "north" | "east" | "distance" => "m",
        "heading" | "course" | "along" => "deg",
        _ => match Channel::named(name) {
            Some(channel) => channel.row().unit,
            None => return value.to_string(),
        },
    };
    if value.parse::<f64>().is_ok() { format!("{value} {unit}") } else { value.to_string() }
}

/// `3 times {`.
fn counted(before: &str, rest: &str) -> Option<Slip> {
    let count = before.trim().strip_suffix("times")?.trim();
    let is_count = !count.is_empty() && count.chars().all(|c| c.is_ascii_digit());
    (is_count && rest.starts_with('{')).then(|| Slip {
        start: before.len() - before.trim_start().len(),
        length: before.trim().len(),
        message: "a loop that counts begins with `for`".to_string(),
        help: format!("write `for n in 1..{count} {{ … }}`"),
    })
}

/// `let mut y = 3`.
fn mutable(before: &str, rest: &str) -> Option<Slip> {
    let line = format!("{before}{}", line_end(rest));
    let declared = line.trim_start().strip_prefix("let mut ")?;
    Some(Slip {
        start: line.len() - declared.len() - "mut ".len(),
        length: "mut".len(),
        message: "what `let` names never changes".to_string(),
        help: changing(declared.trim()),
    })
}

/// How what changes is declared: in a function, and where time goes by.
fn changing(declared: &str) -> String {
    let (name, value) = declared.split_once('=').map_or((declared, "…"), |(name, value)| (name.trim(), value.trim()));
    let ty = match value.parse::<f64>() {
        Ok(_) if !value.contains('.') => "Int",
        Ok(_) => "Ratio",
        Err(_) => "TYPE",
    };
    format!("write `memory {name}: {ty} = {value}` at the top, or in a function `var {name} = {value}`")
}

/// `x in [1, 2]`.
fn one_of(before: &str, rest: &str) -> Option<Slip> {
    let list = rest.strip_prefix("in")?.trim_start().strip_prefix('[')?.split_once(']')?.0;
    let (_, name) = last(before);
    let first = word(before.trim_start());
    if first == "for" || name.is_empty() {
        return None;
    }
    let cases: Vec<String> = list.split(',').map(|value| format!("{name} == {}", value.trim())).collect();
    let help = format!("write `{}`", cases.join(" or "));
    Some(Slip { start: before.len(), length: 2, message: "`in` belongs to `for`, and asks nothing".to_string(), help })
}

/// `1 if c else 2`.
fn choice(before: &str, rest: &str) -> Option<Slip> {
    let (condition, otherwise) = line_end(rest).strip_prefix("if ")?.split_once(" else ")?;
    let value = before[before.rfind(['=', '(', ',', ':'])? + 1..].trim();
    let otherwise = otherwise.split([')', ',']).next().unwrap_or("").trim();
    (!value.is_empty()).then(|| Slip {
        start: before.len(),
        length: "if".len(),
        message: "a choice begins with `if`".to_string(),
        help: format!("write `if {} {{ {value} }} else {{ {otherwise} }}`", condition.trim()),
    })
}

/// `1 m s-1`, `1 m s^-1`.
fn per(before: &str, rest: &str) -> Option<Slip> {
    let power = rest.strip_prefix('s')?;
    let power = power.strip_prefix('^').unwrap_or(power).strip_prefix('-')?;
    let seconds = match power.chars().next()? {
        '1' => "s",
        '2' => "s^2",
        _ => return None,
    };
    let (number, unit) = quantity(before).filter(|(_, unit)| !unit.is_empty())?;
    Some(Slip {
        start: before.len(),
        length: rest.len() - power.len() + 1,
        message: "a unit is one word: what it is divided by follows `/`".to_string(),
        help: format!("write `{number} {unit}/{seconds}`"),
    })
}
