//! Texts, and the statements that take one, as other languages write them.

use super::super::habits::{Habit, line_end, word};
use super::write;

/// `"at {}"`.
pub(super) fn empty_hole(before: &str, rest: &str) -> Option<Habit> {
    let line = rest.split('\n').next().unwrap_or(rest);
    let is_empty = before.trim().is_empty() && line.strip_prefix('}').is_some_and(|after| after.contains('"'));
    is_empty.then(|| Habit {
        message: Some("no value stands here".to_string()),
        help: "write the value itself between the braces: `\"at {depth}\"`".to_string(),
    })
}

/// What should be a text, or follow one.
pub(super) fn text(before: &str, rest: &str) -> Option<Habit> {
    let first = word(before.trim_start());
    if first == "abort" {
        if before.trim() == "abort" {
            if let Some(why) = rest.strip_prefix('(').and_then(quoted) {
                return write(format!("abort {why}"));
            }
            let condition = line_end(rest);
            let condition = condition.find('"').map_or(condition, |why| &condition[why..]);
            let joins = matches!(word(condition), "if" | "when" | "on" | "because");
            let condition = if joins { condition[word(condition).len()..].trim() } else { condition };
            return match condition {
                "" => write("abort \"why\""),
                why if quoted(why).is_some() => write(format!("abort {why}")),
                condition => write(format!("abort \"why\" on {condition}")),
            };
        }
        if ["if", "when"].contains(&word(rest)) {
            return write("abort \"why\" on X")
                .map(|habit| Habit { help: format!("{}: `on` in place of `{}`", habit.help, word(rest)), ..habit });
        }
    }
    if first == "report" && rest.starts_with('"') && before.matches('"').count() == 1 {
        let name = before.split('"').nth(1).unwrap_or("NAME");
        return Some(Habit {
            message: Some("what is reported follows `:`".to_string()),
            help: format!("write `{}`", report(&format!("\"{name}\""), line_end(&rest[1..]))),
        });
    }
    // `report "end": place: position`, where `place` may be a word that begins no value
    let is_first_value = first == "report" && before.matches('"').count() == 2 && !before.contains(',');
    let begins = before.trim_end().ends_with(':');
    if is_first_value && (rest.starts_with(':') || begins && unlabelled(rest).is_some()) {
        let name = before.split('"').nth(1).unwrap_or("NAME");
        return Some(Habit {
            message: Some("the first value of a report has no label".to_string()),
            help: format!("write `{}`", report(&format!("\"{name}\""), line_end(rest))),
        });
    }
    if first == "report"
        && let Some(name) = rest.strip_prefix('(').and_then(quoted)
    {
        let value = line_end(&rest[1..].trim_start()[name.len()..]);
        return write(report(name, value.trim_end_matches(')')));
    }
    let is_value = rest.starts_with(|c: char| c.is_alphabetic() || c == '_');
    if first == "log" && is_value && before.trim_end().ends_with('"') && before.matches('"').count() == 2 {
        let text = before.split('"').nth(1).unwrap_or("").trim_end();
        return Some(Habit {
            message: None,
            help: format!("one text holds it all: `log \"{text} {{{}}}\"`", line_end(rest)),
        });
    }
    if first == "log" && rest.starts_with([',', '+']) {
        let value = line_end(&rest[1..]);
        return Some(Habit { message: None, help: format!("one text holds it all: `log \"… {{{value}}}\"`") });
    }
    None
}

/// A report whose name is no text: it begins with a word.
pub(in super::super) fn unquoted_report(first: &str, written: &str) -> String {
    if let Some((value, name)) = written.rsplit_once(", ").filter(|(_, name)| quoted(name) == Some(name)) {
        return report(name, value);
    }
    let after = written.strip_prefix(first).unwrap_or(written).trim_start();
    let is_name = after.is_empty() || after.starts_with(|c: char| c == ':' || c.is_alphabetic());
    match is_name && !super::super::words::is_reserved(first) {
        true => report(&format!("\"{first}\""), if after.is_empty() { first } else { after }),
        false => report("\"NAME\"", written),
    }
}

/// A report of a name, which is quoted, with what is written behind it, if that is a value: its first value has no label.
fn report(name: &str, written: &str) -> String {
    let written = written.trim_start_matches([',', ' ', '=', ':']);
    let value = match unlabelled(written).unwrap_or(written) {
        "" => "position",
        value if is_value(value) => value,
        _ => "VALUE",
    };
    format!("report {name}: {value}")
}

/// Whether a text is one value, or values of which all but the first have labels, as far as can be told without reading it.
fn is_value(text: &str) -> bool {
    let names_in_a_row = |text: &str| {
        let mut words = text.split(' ').filter(|word| !word.is_empty());
        let is_name = |word: &&str| word.chars().all(|c| c.is_alphanumeric() || "_.".contains(c)) && !is_operator(word);
        let (firsts, seconds) = (words.clone(), words.by_ref().skip(1));
        firsts.zip(seconds).any(|(a, b)| is_name(&a) && is_name(&b) && a.starts_with(char::is_alphabetic))
    };
    let begins = word(text);
    !text.contains(['"', '{', '}']) && !super::super::words::is_reserved(begins) && !names_in_a_row(text)
}

fn is_operator(word: &str) -> bool {
    ["and", "or", "not", "else", "toward"].contains(&word)
}

/// What stands behind a label.
fn unlabelled(written: &str) -> Option<&str> {
    let label = Some(word(written)).filter(|label| !label.is_empty())?;
    written.strip_prefix(label)?.trim_start().strip_prefix(':').map(str::trim_start)
}

/// The text on one line with which something begins, with its quotes.
fn quoted(text: &str) -> Option<&str> {
    let text = text.trim_start();
    let inside = text.strip_prefix('"')?;
    let end = inside.find(['"', '\n']).filter(|end| inside[*end..].starts_with('"'))?;
    Some(&text[..end + 2])
}

/// `"{d:.2f}"`: how a value is printed is said where other languages say it.
pub(super) fn format(before: &str, rest: &str, expected: &str) -> Option<Habit> {
    let (format, after) = rest.strip_prefix(':')?.split_once('}')?;
    let is_format = format.chars().all(|c| c.is_ascii_alphanumeric() || "<>^=+-_.,% ".contains(c));
    (expected == "`else`" && is_format && after.contains('"')).then(|| Habit {
        message: Some("no format follows a value".to_string()),
        help: format!("write `{{{}}}`: quantities are printed with their unit, rounded for people", before.trim()),
    })
}
