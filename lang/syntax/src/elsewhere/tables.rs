//! Rules of switching tables, what a mission says before its body, what is derived from others, and fields that are assigned.

use super::{Habit, last_word, line_end, word, write};

/// Words with which a crossing is told elsewhere, and the sign that ours has for it.
const CROSSINGS: [(&str, &str); 14] = [
    ("rises", ">"),
    ("climbs", ">"),
    ("exceeds", ">"),
    ("above", ">"),
    ("over", ">"),
    ("greater", ">"),
    ("more", ">"),
    ("falls", "<"),
    ("drops", "<"),
    ("sinks", "<"),
    ("below", "<"),
    ("under", "<"),
    ("less", "<"),
    ("fewer", "<"),
];

/// `a -> abort on X`, `a -> b after 10 s`, `a -> b on X, then back`, `a -> b on every 10 s`, `a -> b on X do n = 1`.
pub(super) fn rule(before: &str, rest: &str) -> Option<Habit> {
    let (head, after) = before.split_once("->")?;
    let (head, after, next) = (head.trim(), after.trim(), word(rest));
    let said = |message: &str, help: String| Some(Habit { message: Some(message.to_string()), help });
    if after == "abort" && matches!(next, "on" | "when" | "if") {
        let condition = line_end(rest).trim_start_matches(next).trim();
        return said("an abort says why", format!("write `{head} -> abort \"why\" on {condition}`"));
    }
    let is_asked = |word: &str| matches!(word, "when" | "if" | "while");
    if after.split_whitespace().any(is_asked) {
        return None;
    }
    let has_on = after.split_whitespace().any(|word| word == "on");
    if !has_on && matches!(next, "after" | "becomes" | "done" | "not" | "no") {
        let message = format!("`on` is missing before `{next}`");
        return said(&message, format!("write `{head} -> {after} on {}`", line_end(rest)));
    }
    if has_on && last_word(after) == "each" {
        let to = word(after);
        return said("a rhythm begins with `every`", format!("write `{head} -> {to} on every {}`", line_end(rest)));
    }
    if has_on && rest.starts_with(',') {
        return said(
            "the parts of a rule stand without commas",
            format!("write `{} {}`", before.trim(), line_end(&rest[1..])),
        );
    }
    if has_on && after.ends_with(" do") && !next.is_empty() {
        return said("what a rule does stands between `{` and `}`", format!("write `do {{ {} }}`", line_end(rest)));
    }
    None
}

/// `depth rises above 18 m`, `depth is below 3 m`.
pub(super) fn crossing(before: &str, rest: &str) -> Option<Habit> {
    let what = last_word(before);
    let asks = before.contains(" on ") || before.contains(" until ") || before.trim_start().starts_with("on ");
    if !asks || what.is_empty() || !before.ends_with(' ') {
        return None;
    }
    let words: Vec<&str> = line_end(rest).split_whitespace().collect();
    let number = words.iter().position(|word| word.starts_with(|c: char| c.is_ascii_digit()))?;
    let sign = words[..number].iter().find_map(|word| CROSSINGS.iter().find(|(known, _)| known == word))?.1;
    let bound = words[number..].iter().take(2).copied().collect::<Vec<_>>().join(" ");
    Some(Habit {
        message: Some("values are compared by signs".to_string()),
        help: format!(
            "write `{what} {sign} {bound}`; for the moment at which that comes to hold, `becomes {what} {sign} {bound}`"
        ),
    })
}

/// `requires position fresh 5 s`, `limits depth <= 30 m`, `recovery goto op.center`.
pub(super) fn unbraced(before: &str, rest: &str) -> Option<Habit> {
    let (item, said) = (before.trim(), line_end(rest));
    if said.is_empty() || rest.starts_with(['{', ':', '=', '(']) {
        return None;
    }
    match item {
        "requires" | "limits" => write(format!("{item} {{ {said} }}")),
        "recovery" if word(said) != "within" => write(format!("recovery within 10 min {{ {said} }}")),
        _ => None,
    }
}

/// `scenario a extends b {`, `strategy a extends b {`, `scenario a = b {`, `scenario a = b(step: 2 s) with {`.
pub(super) fn derived(before: &str, rest: &str) -> Option<Habit> {
    let head = before.trim();
    let kind = word(head);
    if matches!(kind, "behavior" | "overlay" | "mission") && !head.contains(['{', '=']) && rest.starts_with('=') {
        return Some(Habit {
            message: Some("strategies, scenarios and vehicles are derived from others, nothing else is".to_string()),
            help: "call the other, with other arguments".to_string(),
        });
    }
    if !matches!(kind, "scenario" | "strategy" | "vehicle") || head.contains('{') {
        return None;
    }
    let said = |message: &str, help: String| Some(Habit { message: Some(message.to_string()), help });
    if head.contains('=') {
        return match rest.chars().next() {
            Some('(') => said(
                "what is derived takes no values here",
                format!(
                    "it has the parameters of the other: write `{head} with {{ … }}`, and `--set` gives them values"
                ),
            ),
            _ if !head.ends_with('=') && !head.ends_with("with") => {
                said("`with` is missing", format!("write `{head} with {{ … }}`"))
            }
            _ => None,
        };
    }
    let is_word = matches!(word(rest), "extends" | "from" | "with" | "of" | "like" | "inherits" | "derives");
    if !is_word && !rest.starts_with(':') {
        return None;
    }
    let base = line_end(&rest[word(rest).len()..]).trim_start_matches(':').trim();
    said("what something is derived from stands after `=`", format!("write `{head} = {base} with {{ … }}`"))
}

/// `best.at = position`, `regions[0].visits = 3`.
pub(super) fn field(before: &str, rest: &str) -> Option<Habit> {
    let (record, field) = before.trim().rsplit_once('.')?;
    let is_name = |text: &str| !text.is_empty() && text.chars().all(|c| c.is_alphanumeric() || c == '_');
    let value = line_end(rest.strip_prefix('=').filter(|rest| !rest.starts_with('='))?).trim();
    let help = match record.split_once('[') {
        None if is_name(record) => format!("write `{record} = {record} with ({field}: {value})`"),
        Some((list, _)) if is_name(list) && record.ends_with(']') => {
            format!("write `if let one = {record} {{ {record} = one with ({field}: …) }}`: it may hold nothing there")
        }
        _ => return None,
    };
    is_name(field).then(|| Habit { message: Some("a record is given anew, not a field of it".to_string()), help })
}

/// `requires { depth fresh 5 s, heading fresh 5 s }`.
pub(super) fn requirements(before: &str, rest: &str) -> Option<Habit> {
    let (head, _) = before.rsplit_once(" fresh ").filter(|(_, time)| time.trim_end().ends_with(','))?;
    let sensor = last_word(head);
    let next = word(rest);
    (!sensor.is_empty() && !next.is_empty()).then(|| Habit {
        message: None,
        help: format!("name all of one age together, `{sensor}, {next} fresh 5 s`, or write `;` between the ages"),
    })
}
