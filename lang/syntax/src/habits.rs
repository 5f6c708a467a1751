//! What other languages and other pens write here, and how ours writes it: the help of a message about unreadable text.

use albacore_program::Channel;

/// What to say instead of what was expected, when a habit shows; the message may stay as it is.
pub(super) struct Habit {
    /// What is wrong, where that can be said better than by what was expected.
    pub message: Option<String>,
    /// How it is written.
    pub help: String,
}

/// The habit behind a text that could be read up to a place: `before` is what stands before it on its line, `rest` what
/// follows. `expected` tells what the grammar would have taken.
pub(super) fn habit(before: &str, rest: &str, expected: &str) -> Option<Habit> {
    let only = |help: &str| Some(Habit { message: None, help: help.to_string() });
    let signs = [
        ("→", "write `->`"),
        ("≤", "write `<=`"),
        ("≥", "write `>=`"),
        ("≠", "write `!=`"),
        ("×", "write `*`"),
        ("·", "write `*`"),
        ("÷", "write `/`"),
        ("−", "write the minus of the keyboard, `-`"),
        ("–", "write the minus of the keyboard, `-`"),
        ("“", "texts stand between straight quotes, `\"`"),
        ("”", "texts stand between straight quotes, `\"`"),
        ("„", "texts stand between straight quotes, `\"`"),
        ("‘", "texts stand between straight quotes, `\"`"),
        ("’", "texts stand between straight quotes, `\"`; minutes of arc are written `'`"),
        ("&&", "write `and`"),
        ("||", "write `or`"),
        ("!", "write `not`"),
        ("===", "write `==`"),
        ("=>", "write `->`"),
        ("->", "a rule is `A -> B on X`, in a strategy or a mission"),
        ("'", "texts stand between `\"`"),
        ("#", "comments begin with `//`"),
        (
            "%",
            "comments begin with `//`, `%` is the unit percent; for the remainder of whole numbers write `a - b * floor(a / b)`",
        ),
    ];
    if before.trim_start().starts_with("use ") {
        return only(
            "modules are named by words and dots, from the project's folder: `use search`, `use folder.search`",
        );
    }
    if let Some(habit) = super::elsewhere::statement(before, rest, expected) {
        return Some(habit);
    }
    if let Some((_, help)) = signs.iter().find(|(sign, _)| rest.starts_with(sign)) {
        return only(help);
    }
    if let Some(habit) = sentence(before, rest).or_else(|| unfinished(before, rest)) {
        return Some(habit);
    }
    if rest.starts_with('=') {
        return match before.trim_end().strip_suffix(['+', '-', '*', '/']) {
            Some(_) => only("an assignment names both sides: `n = n + 1`"),
            None if expected.contains("`{`") => only("to compare write `==`"),
            None => None,
        };
    }
    if let Some(word) = before.split_whitespace().next_back().filter(|word| ["wait", "hold"].contains(word))
        && rest.starts_with(|c: char| c.is_ascii_digit() || c == '(')
    {
        let time = rest.split(['\n', ';', '}']).next().unwrap_or("").trim();
        let time = time.strip_prefix('(').and_then(|t| t.strip_suffix(')')).unwrap_or(time);
        return Some(Habit {
            message: Some(format!("`for` is missing after `{word}`")),
            help: format!("write `{word} for {time}`"),
        });
    }
    number(before, rest).or_else(|| setpoint(before, rest, expected)).or_else(|| crowded(rest))
}

/// A whole line of another language.
fn sentence(before: &str, rest: &str) -> Option<Habit> {
    let only = |help: &str| Some(Habit { message: None, help: help.to_string() });
    let mut words = before.split_whitespace();
    let (first, last) = (words.next().unwrap_or(""), before.split_whitespace().next_back().unwrap_or(""));
    let next: String = rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
    if matches!(next.as_str(), "elif" | "elsif" | "elseif") {
        return only("write `else if`");
    }
    if ["seconds", "minutes", "hours", "metres", "meters", "degrees", "knots"].contains(&next.as_str()) {
        return only("a quantity is a number and a unit, such as `10 min`");
    }
    if rest.starts_with('=') && last.ends_with("==") {
        return only("write `==`");
    }
    if rest.starts_with('>') && last.ends_with('=') {
        return only(if rest.contains(" on ") { "a rule is `A -> B on X`: write `->`" } else { "write `>=`" });
    }
    if before.contains("->") && [last, next.as_str()].iter().any(|word| ["when", "if", "while"].contains(word)) {
        return only("a rule is `A -> B on X`: write `on`");
    }
    if next == "then" && before.contains("if ") {
        return only("leave `then` out: `if X { … }`");
    }
    if rest.starts_with(':') && before.contains("range(") {
        return only("write `for i in 0..<3 { … }`");
    }
    if rest.starts_with(':') && rest[1..].trim_start_matches([' ', '\t', '\r']).starts_with('\n') {
        return only("a block stands between `{` and `}`");
    }
    if first == "report" && last == "report" && !next.is_empty() {
        return Some(Habit {
            message: Some("a report has a name, which is a text".to_string()),
            help: format!("write `{}`", super::elsewhere::unquoted_report(&next, line_end(rest))),
        });
    }
    if first == "expect" && last == "never" {
        return only("write `expect always not (…)`");
    }
    if first == "expect" && matches!(last, "eventually" | "sometime" | "sometimes" | "ever") {
        return only("write `expect once …`: at some tick of each run");
    }
    if first == "run" && before.contains(" seeds ") && (rest.starts_with(',') || is_digits(last)) {
        return only("seeds are a range, with both its ends: `seeds 1..3`");
    }
    if first == "run" && !(before.contains(" in ") && before.contains(" seeds ")) {
        return only("write `run MISSION in SCENARIO seeds 1..20`");
    }
    None
}

/// `record NAME { }`: how it is written with something in it.
pub(super) fn nothing_inside(before: &str, rest: &str) -> Option<&'static str> {
    let (head, _) = before.rsplit_once('{').filter(|(_, inside)| inside.trim().is_empty() && rest.starts_with('}'))?;
    match word(head.rsplit('\n').next()?.trim_start()) {
        "record" => Some("a record has a field at least: `record NAME { field: TYPE }`"),
        "payload" => Some("a payload has an action at least: `payload NAME { ACTION() -> Bool }`"),
        "enum" => Some("an enum has a word at least: `enum NAME { ONE, OTHER }`"),
        _ => None,
    }
}

/// A statement of ours that goes on as another language's, or not at all.
fn unfinished(before: &str, rest: &str) -> Option<Habit> {
    let (first, last) = (word(before.trim_start()), before.split_whitespace().next_back().unwrap_or(""));
    let help = match (first, last, word(rest)) {
        ("finish", "finish", "mission" | "behavior" | "strategy") => {
            "`finish` stands alone: in a behavior it ends that, in the body of a mission the mission"
        }
        ("let" | "var", _, "") if rest.starts_with('=') && last.ends_with(':') => "a value follows `=`: `let x = 5 m`",
        ("after", _, "") if rest.starts_with('{') => {
            "let time go by with `wait for 5 s`, and write what comes then after it; on a rule or a reaction it is `on after 5 s`"
        }
        ("every", _, "") if rest.starts_with('{') => {
            "beside a body it is a reaction, which stands before that: `on every 10 min { … }`; a body does it in a loop: `loop { wait for 10 min; … }`"
        }
        ("ask", _, _) | (_, "ask", _) => "write `ask PAYLOAD.ACTION() within 10 s`; a payload takes no arguments",
        (_, last, "") if rest.starts_with(']') && last.contains("Map[") => {
            "say how many cells it has at most: `Map[Ratio; 400]`"
        }
        ("report", last, _) if last.ends_with(',') && !rest.starts_with(|c: char| c.is_alphabetic()) => {
            "what follows the first value has a label each: `report \"NAME\": position, depth: depth`"
        }
        ("record", _, "every") => "how often is a rate: `record temperature at 0.1 Hz` is every ten seconds",
        ("record", _, "") if rest.starts_with('.') => "an input is recorded whole: with all that it tells",
        ("record", last, "") if last != "at" => "say how often: `record temperature, salinity at 1 Hz`",
        ("for", _, "") if rest.starts_with(',') => {
            "a loop names one value, `for x in LIST { … }`, and of a map its place too: `for x at place in MAP { … }`"
        }
        ("wait" | "hold" | "keep" | "steer" | "goto" | "loiter", _, "while") => {
            "what lasts while X holds ends when it does not: `until not (X)`"
        }
        (_, "and" | "or", "for") => "what has to hold for so long stands in parentheses: `(X for 5 s)`",
        (_, _, "between") => "write both bounds: `x > 3 m and x < 5 m`",
        ("hold", "hold", next) if next.starts_with(|c: char| c.is_alphabetic()) && !super::words::is_reserved(next) => {
            "`hold` keeps the place where it begins: go there first, `goto POINT`"
        }
        _ => return None,
    };
    Some(Habit { message: None, help: help.to_string() })
}

/// `memory q = 3`: where its name ends, and what to say.
pub(super) fn untyped_memory(clause: &str) -> Option<(usize, Habit)> {
    let after = clause.strip_prefix("memory ")?.trim_start();
    let name = &after[..after.find(|c: char| !c.is_alphanumeric() && c != '_')?];
    let begins = after[name.len()..].trim_start();
    let end = clause.len() - after.len() + name.len();
    (!name.is_empty() && begins.starts_with('=') && !begins.starts_with("==")).then(|| {
        let habit = Habit {
            message: Some(format!("of what type is `{name}`?")),
            help: format!("write `memory {name}: TYPE = …`, with `Int`, `Length`, `Point` or another type"),
        };
        (end, habit)
    })
}

/// `var q`, `let q`, `var q: [Point; 3]`: where its name ends, and what to say.
pub(super) fn valueless(clause: &str) -> Option<(usize, Habit)> {
    let kind = ["var", "let"].into_iter().find(|kind| word(clause) == *kind)?;
    let after = clause[kind.len()..].trim_start_matches([' ', '\t']);
    let name = word(after);
    let end = clause.len() - after.len() + name.len();
    let is_list = |ty: &str| ty.starts_with('[') && ty.ends_with("]") && ty.contains(';') && !ty.contains('=');
    let listed = after[name.len()..].trim_start().strip_prefix(':').map(str::trim).filter(|ty| is_list(ty));
    (!name.is_empty() && (line_end(after) == name || listed.is_some())).then(|| {
        let message = Some(format!("`{name}` has no value"));
        let help = match listed {
            Some(ty) => format!("write `{kind} {name}: {ty} = []`"),
            None => format!("write `{kind} {name} = …`"),
        };
        (end, Habit { message, help })
    })
}

/// How the remainder of whole numbers is written.
const REMAINDER: &str = "for the remainder of whole numbers write `a - b * floor(a / b)`";

fn is_digits(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit())
}

/// Two numbers in a row, or a number of another base.
fn number(before: &str, rest: &str) -> Option<Habit> {
    let last = before.split_whitespace().next_back()?;
    if let Some(digits) = last.strip_prefix("0x") {
        let help = match u64::from_str_radix(digits, 16) {
            Ok(number) => format!("write `{number}`"),
            Err(_) => "write it with the digits 0 to 9".to_string(),
        };
        return Some(Habit { message: Some(format!("`{last}` is no number: numbers are decimal")), help });
    }
    if let Some(whole) = last.strip_suffix('.').filter(|whole| is_digits(whole)) {
        return Some(Habit {
            message: Some("digits follow the point of a number".to_string()),
            help: format!("write `{whole}` or `{whole}.0`"),
        });
    }
    if rest.starts_with('_') && is_digits(last) && before.ends_with(last) {
        let digits: String = rest.chars().take_while(|c| c.is_ascii_digit() || *c == '_').collect();
        return Some(Habit {
            message: Some("the digits of a number stand without `_` between them".to_string()),
            help: format!("write `{last}{}`", digits.replace('_', "")),
        });
    }
    let (number, unit) = quantity(before)?;
    if matches!(unit, "mod" | "rem") {
        return Some(Habit {
            message: Some("there is no remainder operator".to_string()),
            help: REMAINDER.to_string(),
        });
    }
    let goes_on = rest.starts_with(|c: char| c.is_alphanumeric() || c == '_');
    if unit == "%" && goes_on {
        return Some(Habit {
            message: Some(format!("`{number} %` is a ratio, {number} percent: there is no remainder operator")),
            help: REMAINDER.to_string(),
        });
    }
    let next: String = rest.chars().take_while(|c| c.is_ascii_digit() || *c == '.').collect();
    if next.is_empty() || unit.is_empty() || unit.starts_with('°') {
        return None;
    }
    let after = rest[next.len()..].trim_start();
    let its_unit: String = after.chars().take_while(|c| c.is_alphanumeric() || "/^%°".contains(*c)).collect();
    let (north, east) = (unit.trim_start_matches('°'), word(after.trim_start_matches(['°', ' '])));
    if matches!(north, "N" | "S") && matches!(east, "E" | "W") {
        let message = Some("the degrees of a position are written with their sign".to_string());
        return Some(Habit { message, help: format!("write `{number}°{north} {next}°{east}`") });
    }
    let message = Some(format!("a quantity is one number and one unit: `{next}` cannot follow `{number} {unit}`"));
    let help = if its_unit.is_empty() {
        format!("write one number, such as `{number}.5 {unit}`")
    } else {
        format!("add them: `{number} {unit} + {next} {its_unit}`")
    };
    Some(Habit { message, help })
}

/// The number and the unit with which a text ends.
pub(super) fn quantity(text: &str) -> Option<(&str, &str)> {
    let text = text.trim_end();
    let unit = text.rfind(|c: char| c.is_ascii_digit()).map(|at| text[at + 1..].trim_start())?;
    let rest = text[..text.len() - unit.len()].trim_end();
    let number = &rest[rest.trim_end_matches(|c: char| c.is_ascii_digit() || c == '.').len()..];
    let is_unit = unit == "%" || unit.chars().all(|c| c.is_alphanumeric() || "/^°".contains(c));
    (!number.is_empty() && is_unit).then_some((number, unit))
}

/// A setpoint without the word before it.
fn setpoint(before: &str, rest: &str, expected: &str) -> Option<Habit> {
    let channel = |word: &str| Channel::named(word).map(|channel| channel.row().name);
    let first = word(rest);
    let has_setpoints = before.split_whitespace().any(|word| word == "with" || word == "at");
    // `goto p with speed 3 m/s`
    if let Some(setpoints) = rest.strip_prefix("with ").map(line_end)
        && !before.trim().is_empty()
        && channel(word(setpoints)).is_some()
    {
        let message = Some("what a maneuver keeps follows `at`".to_string());
        return Some(Habit {
            message,
            help: format!("write `at {setpoints}`, or `with {setpoints}` on a line before it"),
        });
    }
    // `report "x": position, depth`
    if word(before.trim_start()) == "report" {
        let is_field = before.trim_end().ends_with(',') && channel(first).is_some();
        return is_field
            .then(|| Habit { message: None, help: format!("a field has a label: write `{first}: {first}`") });
    }
    // `goto p speed 3 m/s`, `goto p speed: 3 m/s`
    if let Some(channel) = channel(first) {
        let value = rest[first.len()..].trim_start().trim_start_matches(':');
        let value = value.split(['\n', ';', ',', '{', '}']).next().unwrap_or("").trim();
        return Some(if has_setpoints {
            Habit {
                message: Some(format!("a comma is missing before `{channel}`")),
                help: format!("write `, {channel} {value}`"),
            }
        } else {
            Habit {
                message: Some(format!("`at` is missing before `{channel}`")),
                help: format!("write `at {channel} {value}`"),
            }
        });
    }
    // `let a = depth as Length`
    if first == "as" {
        return Some(Habit {
            message: Some("nothing is converted: a value has the dimension of its unit".to_string()),
            help: format!("leave `{}` out", line_end(rest)),
        });
    }
    // `goto p, speed 3 m/s`
    let (head, last) = before.trim_end().rsplit_once([' ', ','])?;
    let value = rest.split(['\n', ';', ',', '{', '}']).next().unwrap_or("").trim();
    if let Some(channel) = channel(last)
        && !has_setpoints
        && !head.trim().is_empty()
    {
        return Some(Habit {
            message: Some(format!("`at` is missing before `{channel}`")),
            help: format!("write `at {channel} {value}` in place of `, {channel} {value}`"),
        });
    }
    if expected.starts_with("`depth`") { unnamed_setpoint(rest, value) } else { None }
}

/// The value of a setpoint without its name, after `at`.
fn unnamed_setpoint(rest: &str, value: &str) -> Option<Habit> {
    // `goto p at 1,5 m/s`
    if let Some((whole, decimals)) = line_end(rest).split_once(',')
        && whole.chars().all(|c| c.is_ascii_digit())
        && let Some((_, unit)) = quantity(decimals).filter(|_| decimals.starts_with(|c: char| c.is_ascii_digit()))
    {
        let channel = if unit.contains('/') || unit.starts_with("kn") { "speed" } else { "depth" };
        return Some(Habit {
            message: Some("decimals follow a point, not a comma".to_string()),
            help: format!("write `at {channel} {whole}.{decimals}`, for example"),
        });
    }
    // `goto p at 3 m/s`
    if rest.starts_with(|c: char| c.is_ascii_digit()) {
        let channel = match quantity(value) {
            Some((_, unit)) if !unit.contains('/') && !unit.starts_with("kn") => "depth",
            _ => "speed",
        };
        // `goto p at 2 m/s speed`
        let (named, value) = match value.rsplit_once(' ') {
            Some((value, last)) if ["depth", "altitude", "speed"].contains(&last) => (Some(last), value),
            _ => (None, value),
        };
        let help = match named {
            Some(channel) => format!("the channel comes first: `at {channel} {value}`"),
            None => format!("say what `{value}` is: `at {channel} {value}`, for example"),
        };
        return Some(Habit { message: None, help });
    }
    None
}

/// The word that a text begins with.
pub(super) fn word(text: &str) -> &str {
    text.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or("")
}

/// What is left of a line.
pub(super) fn line_end(text: &str) -> &str {
    text.split(['\n', ';', '{', '}']).next().unwrap_or("").trim()
}

/// Two statements on one line.
fn crowded(rest: &str) -> Option<Habit> {
    if rest.starts_with("log(") {
        return Some(Habit { message: None, help: "the natural logarithm is `ln(x)`; `log` tells".to_string() });
    }
    super::words::begins_clause(word(rest))
        .then(|| Habit { message: None, help: "a statement begins on a line of its own, or after `;`".to_string() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantities_are_found_at_the_end() {
        assert_eq!(quantity("wait for 1 h "), Some(("1", "h")));
        assert_eq!(quantity("x + 4.5 % "), Some(("4.5", "%")));
        assert_eq!(quantity("3m"), Some(("3", "m")));
        assert_eq!(quantity("36°10.8'N 75°44 "), Some(("44", "")));
        assert_eq!(quantity("goto p "), None);
    }
}
