//! What to say of text that the grammar cannot read: what was found, what was expected, in the language's own terms.

use super::build::{Bad, Place};
use super::habits::{self, habit, line_end, nothing_inside, untyped_memory, valueless};
use super::words::{self, begins_item};
use super::{Grammar, Rule, elsewhere, places, slips};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::other_languages;
use crate::source::{FileId, Span};
use albacore_program::Channel;
use albacore_wording::either;
use pest::Parser;
use pest::error::{Error, ErrorVariant, InputLocation};
use std::collections::BTreeSet;

/// Whether a line at the left margin begins an item: `vehicle ours {` does, and `vehicle(…)` is a clause of a scenario, `record depth at 1 Hz`
/// one of a mission.
pub(super) fn line_begins_item(line: &str) -> bool {
    let first = habits::word(line);
    let after = line[first.len()..].trim_start_matches([' ', '\t']);
    begins_item(first) && !after.starts_with('(') && !(first == "record" && names_inputs(after))
}

/// Whether what follows on `record` are inputs, and not the name of a type and its fields.
pub(super) fn names_inputs(after: &str) -> bool {
    let rest = after[habits::word(after).len()..].trim_start_matches([' ', '\t']);
    rest.starts_with(',') || habits::word(rest) == "at"
}

/// `record` says two things: what a mission records, and of what a record is made. Which stands where the other belongs, and what to say.
fn misplaced_record(place: Place, word: &str, after: &str) -> Option<(&'static str, &'static str)> {
    let after_name = after[habits::word(after).len()..].trim_start_matches([' ', '\t']);
    match place {
        _ if word != "record" => None,
        Place::Item if names_inputs(after) => Some((
            "what is recorded is said by a mission, a strategy or a behavior",
            "move it to the top of one; a type of your own is `record NAME { FIELD: TYPE }`",
        )),
        Place::Clause if after_name.starts_with('{') => Some((
            "a type is declared outside every block",
            "move it to the left margin; inputs are recorded by `record temperature, salinity at 1 Hz`",
        )),
        _ => None,
    }
}

/// The names that a text declares, of what is called as a statement or as a value.
pub(super) fn callable(text: &str) -> BTreeSet<&str> {
    let heads = text.lines().filter_map(|line| {
        let (kind, name) = line.trim_start().split_once(' ')?;
        words::declares_with_arguments(kind).then(|| habits::word(name.trim_start()))
    });
    heads.collect()
}

/// Looks again at a stretch that was passed over, with the rule that belongs there, for the exact place.
pub(super) fn of_bad_stretch(file: FileId, text: &str, callable: &BTreeSet<&str>, bad: &Bad) -> Diagnostic {
    let (start, end) = (bad.span.start as usize, bad.span.end as usize);
    let stretch = &text[start..end];
    let (rule, first_words): (_, Vec<&str>) = match bad.place {
        Place::Item | Place::Head => (Rule::item_only, words::of_items().collect()),
        Place::Clause => (Rule::clause_only, words::of_clauses().collect()),
        Place::TestClause => (Rule::test_clause_only, words::of_tests().collect()),
    };
    // A word of the language is the worse mistake.
    let nameable = |(end, habit)| {
        let name = stretch[..end].rsplit([' ', '\t']).next().unwrap_or_default();
        (!words::is_reserved(name)).then_some((end, habit))
    };
    let word: String = stretch.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
    if let Some((end, habit)) = untyped_memory(stretch).or_else(|| nameable(valueless(stretch)?)) {
        let span = Span { file, start: start as u32, end: (start + end) as u32 };
        return Diagnostic::error(Code::SyntaxExpected, span, habit.message.unwrap_or_default()).help(habit.help);
    }
    if let Some((message, help)) =
        misplaced_record(bad.place, &word, stretch[word.len()..].trim_start_matches([' ', '\t']))
    {
        let span = Span { file, start: start as u32, end: (start + word.len()) as u32 };
        return Diagnostic::error(Code::SyntaxMisplaced, span, message).help(help);
    }
    let error = Grammar::parse(rule, stretch).err();
    let offset = error.as_ref().map_or(0, |e| match e.location {
        InputLocation::Pos(at) | InputLocation::Span((at, _)) => at,
    });
    // A first word that nothing begins with is the mistake itself, wherever the grammar gave up.
    let begins = first_words.contains(&word.as_str());
    let after_word = stretch[word.len()..].trim_start();
    if !begins && !word.is_empty() && offset <= word.len() + (stretch.len() - word.len() - after_word.len()) {
        let span = Span { file, start: start as u32, end: (start + word.len()) as u32 };
        let finding = match bad.place {
            Place::Item => {
                Diagnostic::error(Code::SyntaxItem, span, format!("`{word}` begins nothing that a file holds"))
            }
            _ => Diagnostic::error(Code::SyntaxClause, span, format!("`{word}` begins no statement")),
        };
        if let Some(help) = other_languages::repeated(&word, after_word) {
            return finding.help(help);
        }
        if words::stands_between(&word) {
            let mend = match words::goes_on_after(&word) {
                true => format!("end that line with `{word}`, and it goes on here"),
                false => "write this at its end".to_string(),
            };
            return Diagnostic::error(Code::SyntaxClause, span, format!("`{word}` stands at the beginning of a line"))
                .help(format!("the line before has ended its statement: {mend}"));
        }
        if let Some(help) =
            other_languages::help(&word).map(str::to_string).or_else(|| other_languages::command(&word, after_word))
        {
            return finding.help(help);
        }
        if let Some(habit) = elsewhere::absence(&word, after_word) {
            return finding.help(habit.help);
        }
        if after_word.starts_with(":=") {
            return finding.help(format!("write `let {word} = …`, or `{word} = …` for a `memory`"));
        }
        if callable.contains(word.as_str()) {
            let given = if after_word.starts_with(['(', ':', '=']) { "…" } else { line_end(after_word) };
            return finding.help(format!("what is called has its arguments in brackets: `{word}({given})`"));
        }
        return match albacore_wording::nearest(&word, first_words.iter().copied()) {
            Some(near) => finding.help(format!("did you mean `{near}`?")),
            None if bad.place == Place::Item => {
                finding.help("a file holds behaviors, strategies, missions, scenarios, …")
            }
            None => finding
                .help(format!("after a name comes `=`, `(`, or in a switching table `->`; not {}", found(after_word))),
        };
    }
    match error {
        Some(error) => in_row(bad.place, &word, finding(file, stretch, start, &error)),
        None => Diagnostic::error(Code::SyntaxClause, bad.span, "this cannot stand here")
            .help("one statement a line: separate two with a newline or `;`"),
    }
}

/// What is wrong with a row of a test's table is told with how one is written.
fn in_row(place: Place, word: &str, finding: Diagnostic) -> Diagnostic {
    match place {
        Place::TestClause if word == "with" => {
            finding.help("a row of the table names parameters of the mission: `with NAME: VALUE, NAME: VALUE`")
        }
        _ => finding,
    }
}

/// The finding for the grammar's own error, its place shifted by where the stretch begins.
pub(super) fn finding(file: FileId, text: &str, start: usize, error: &Error<Rule>) -> Diagnostic {
    let offset = match error.location {
        InputLocation::Pos(at) | InputLocation::Span((at, _)) => at.min(text.len()),
    };
    match &error.variant {
        ErrorVariant::ParsingError { positives, .. } => unexpected(file, text, start, offset, &expectation(positives)),
        // The grammar's own guard against what nests without a bracket: `if if if …`.
        ErrorVariant::CustomError { .. } => {
            let span = Span {
                file,
                start: (start + offset) as u32,
                end: (start + offset + token(&text[offset..]).len()) as u32,
            };
            Diagnostic::error(Code::SyntaxNesting, span, "this is nested too deep to be read")
                .help("name its inner parts with `let`, or make functions of them")
        }
    }
}

/// The finding for a stretch, which begins in its file at `start`, that could be read up to an offset, where something else was expected.
pub(super) fn unexpected(file: FileId, text: &str, start: usize, offset: usize, expected: &str) -> Diagnostic {
    let rest = &text[offset..];
    let token = token(rest);
    let span = Span { file, start: (start + offset) as u32, end: (start + offset + token.len()) as u32 };
    let before = text[..offset].rsplit(['\n', ';', '{']).next().unwrap_or("");
    if let Some(slip) = slips::slip(before, rest) {
        let at = start + offset - before.len() + slip.start;
        let span = Span { file, start: at as u32, end: (at + slip.length()) as u32 };
        return slip.finding(span);
    }
    let wants_name = expected.split([',', ' ']).any(|word| word == "name");
    if wants_name && words::is_reserved(token) {
        return Diagnostic::error(Code::SyntaxReserved, span, format!("`{token}` is a word of the language, no name"))
            .help("choose another name; as a field or a label it may stand");
    }
    let message = if expected.is_empty() {
        format!("{} cannot stand here", found(rest))
    } else {
        format!("expected {expected}, found {}", found(rest))
    };
    if let Some((begins, length, ours)) = places::foreign(before, rest) {
        let at = start + offset - before.len() + begins;
        let span = Span { file, start: at as u32, end: (at + length) as u32 };
        return places::finding(span, &ours);
    }
    if let Some(help) = nothing_inside(&text[..offset], rest) {
        return Diagnostic::error(Code::SyntaxExpected, span, message).help(help);
    }
    match habit(before, rest, expected) {
        Some(habit) => Diagnostic::error(Code::SyntaxExpected, span, habit.message.unwrap_or(message)).help(habit.help),
        None => match missing_comma(before, rest, token) {
            Some(help) => {
                Diagnostic::error(Code::SyntaxExpected, span, format!("expected `,` or an operator, found `{token}`"))
                    .help(help)
            }
            None if is_position(before, rest) => places::finding(span, &places::Ours::Half),
            None => Diagnostic::error(Code::SyntaxExpected, span, message),
        },
    }
}

/// Whether what cannot be read stands in a position on the globe, or directly after one.
fn is_position(before: &str, rest: &str) -> bool {
    let word = before.rsplit([' ', '(', '=']).next().unwrap_or("");
    let last = before.trim_end().rsplit([' ', '(', '=']).next().unwrap_or("");
    let next = rest.split([' ', ',', ')', '\n']).next().unwrap_or("");
    word.contains('°') || next.contains('°') || last.contains('°')
}

/// How to part two values that stand side by side: in brackets, or the second with a label.
fn missing_comma(before: &str, rest: &str, token: &str) -> Option<String> {
    let ends_value = |c: char| c.is_alphanumeric() || matches!(c, '_' | ')' | ']' | '%');
    let begins_value = token.starts_with(|c: char| c.is_alphanumeric() || c == '_') && !words::is_reserved(token);
    if !begins_value || !before.trim_end().ends_with(ends_value) {
        return None;
    }
    if rest[token.len()..].trim_start().starts_with(':') {
        return Some(format!("write a comma between them: `, {token}: …`"));
    }
    let open = before.matches(['(', '[']).count() > before.matches([')', ']']).count();
    open.then(|| "write a comma between two arguments or elements".to_string())
}

/// The word or sign at the front of a text.
fn token(rest: &str) -> &str {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let length = match rest.chars().next() {
        None | Some('\n') => 0,
        Some(c) if is_word(c) => rest.find(|c| !is_word(c)).unwrap_or(rest.len()),
        Some(c) => c.len_utf8(),
    };
    &rest[..length]
}

fn found(rest: &str) -> String {
    match token(rest.trim_start_matches([' ', '\t', '\r'])) {
        "" if rest.trim().is_empty() => "the end".to_string(),
        "" => "the end of the line".to_string(),
        token => format!("`{token}`"),
    }
}

/// The rules that the grammar would have taken, as kinds of things, each once.
fn expectation(rules: &[Rule]) -> String {
    let mut kinds: Vec<String> = Vec::new();
    // Few loops name a place: who has forgotten `in` is not sent to it.
    let in_loop = rules.contains(&Rule::kw_in);
    for &rule in rules.iter().filter(|rule| !(in_loop && **rule == Rule::kw_at)) {
        let kind = kind(rule);
        if !kind.is_empty() && !kinds.contains(&kind) {
            kinds.push(kind);
        }
    }
    // A value is expected wherever an expression may go on: an operator is then no news.
    if kinds.len() > 1 {
        kinds.retain(|k| k != "an operator" && k != "the end");
    }
    if kinds.len() > 5 {
        kinds.truncate(5);
        kinds.push("something else".to_string());
    }
    match kinds.as_slice() {
        [] => String::new(),
        [one] => one.clone(),
        [rest @ .., last] => format!("{} or {last}", rest.join(", ")),
    }
}

fn kind(rule: Rule) -> String {
    use Rule::*;
    let kind = match rule {
        EOI | sep => "the end",
        name | label | path => "a name",
        quantity | number | expr | operand | cond | condition | geodetic | paren | list | if_expr | match_expr
        | neg | pos | not | no | becomes | after | every | new | kw_not | kw_no | kw_becomes | kw_after | kw_every
        | w_new | v_true | v_false | v_none | v_done | hole_expr | arg => "a value",
        unit => "a unit",
        text | text_part | hole => "a text",
        op_else | op_or | op_and | op_eq | op_ne | op_le | op_ge | op_lt | op_gt | op_add | op_sub | op_toward
        | op_mul | op_div | op_pow | kw_toward | kw_and | kw_or | args | member | index => "an operator",
        block | test_block => "`{`",
        params => "`(`",
        arrow => "`->`",
        colon => "`:`",
        range | range_op => "`..`",
        ty | name_ty | list_ty | map_ty | behavior_ty => "a type",
        param | clause_param => "a parameter, `NAME: TYPE`",
        field => "a field, `NAME: TYPE`",
        labelled => "a field, `NAME: VALUE`",
        dim_op | maybe | order | dim_factor => "",
        default => "`=`",
        setpoint | channel => return either(Channel::ALL.map(|of| of.row().name)),
        mod_for | kw_for => "`for`",
        mod_until | kw_until => "`until`",
        mod_within | kw_within => "`within`",
        mod_at | kw_at => "`at`",
        then_back => "`then back`",
        do_block => "`do`",
        target => "a behavior, `finish` or `abort`",
        overlay_kind => "`amends` or `sets`",
        require => "an input",
        asked => "what is asked, `PAYLOAD.ACTION()`",
        action => "an action, `NAME() -> Bool`",
        other => return words::of_rule(other).map(|word| format!("`{word}`")).unwrap_or_default(),
    };
    kind.to_string()
}
