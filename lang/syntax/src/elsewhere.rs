//! Whole statements as other languages, and other crews, write them.

mod tables;
mod texts;

pub(super) use texts::unquoted_report;

use super::habits::{Habit, line_end, quantity, word};
use albacore_program::{Channel, Ends, Guide};

/// Words that a block follows.
const BEFORE_BLOCK: [&str; 16] = [
    "if", "else", "while", "for", "loop", "on", "behavior", "strategy", "overlay", "mission", "recovery", "limits",
    "requires", "fn", "scenario", "test",
];

/// The habit behind a statement that could be read up to a place; `expected` tells what the grammar would have taken.
pub(super) fn statement(before: &str, rest: &str, expected: &str) -> Option<Habit> {
    tables::rule(before, rest)
        .or_else(|| tables::derived(before, rest))
        .or_else(|| tables::crossing(before, rest))
        .or_else(|| tables::unbraced(before, rest))
        .or_else(|| tables::requirements(before, rest))
        .or_else(|| tables::field(before, rest))
        .or_else(|| counted(before, rest))
        .or_else(|| result(before, rest, expected))
        .or_else(|| block(before, rest, expected))
        .or_else(|| arm(before, rest, expected))
        .or_else(|| lambda(before, rest))
        .or_else(|| record(rest, expected))
        .or_else(|| comparison(before, rest))
        .or_else(|| decimals(before, rest))
        .or_else(|| direction(before, rest))
        .or_else(|| bearing(before, rest))
        .or_else(|| pair(before, rest))
        .or_else(|| bracketed(before, rest))
        .or_else(|| lasting(before, rest))
        .or_else(|| label(before, rest))
        .or_else(|| texts::text(before, rest))
        .or_else(|| texts::format(before, rest, expected))
        .or_else(|| head(before, rest, expected))
        .or_else(|| valueless(before, rest))
        .or_else(|| texts::empty_hole(before, rest))
        .or_else(|| operator(before, rest))
}

fn write(what: impl Into<String>) -> Option<Habit> {
    Some(Habit { message: None, help: format!("write `{}`", what.into()) })
}

fn last_word(text: &str) -> &str {
    text.trim_end().rsplit(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or("")
}

/// `for i = 1:10`, `for i in 1 to 10`, `for (i = 0; …)`, `loop 5 {`.
fn counted(before: &str, rest: &str) -> Option<Habit> {
    let first = word(before.trim_start());
    if first == "loop" && rest.starts_with(|c: char| c.is_ascii_digit()) {
        let count = word(rest);
        return write(format!("for n in 1..{count} {{ … }}"));
    }
    let variable = before.trim_start().strip_prefix("for")?.trim_start();
    if rest.starts_with('(') {
        return write("for i in 0..<10 { … }");
    }
    let line = format!("{variable}{}", line_end(rest));
    let range = line.split_once('=').or_else(|| line.split_once(" in "))?.1.replace(" to ", ":");
    let parts: Vec<&str> = range.split(':').map(str::trim).collect();
    let name = word(variable);
    let is_number = |part: &&str| !part.is_empty() && part.chars().all(|c| c.is_alphanumeric() || c == '_');
    match parts.as_slice() {
        [first, last] if [first, last].into_iter().all(is_number) => {
            write(format!("for {name} in {first}..{last} {{ … }}"))
        }
        _ if rest.starts_with('=') => write(format!("for {name} in 1..10 {{ … }}")),
        _ => None,
    }
}

/// `fn half(x: Length): Length {`, `fn half(x: Length) Length {`, `fn half(x: Length) {`.
fn result(before: &str, rest: &str, expected: &str) -> Option<Habit> {
    let head = before.trim();
    let first = word(head);
    if !["fn", "behavior", "strategy"].contains(&first) || !head.ends_with(')') || rest.starts_with(['-', '=']) {
        return None;
    }
    let ty = rest.strip_prefix(':');
    if ty.is_none() && expected != "`->`" {
        return None;
    }
    let ty = match line_end(ty.unwrap_or(rest)) {
        "" => "TYPE",
        ty => ty,
    };
    let message = match first {
        "fn" => "a function says of what type its result is, after `->`",
        _ => "the type of a result stands after `->`",
    };
    Some(Habit { message: Some(message.to_string()), help: format!("write `{head} -> {ty} {{`") })
}

/// A block without its braces: `if x:`, `if x log "…"`, `recovery: …`.
fn block(before: &str, rest: &str, expected: &str) -> Option<Habit> {
    let head = before.rsplit('}').next().unwrap_or(before);
    let first = word(head.trim_start());
    if first == "with" && rest.starts_with('{') {
        let kept = head.trim().trim_start_matches("with").trim();
        // An overlay follows no statement.
        let instead = match kept.contains('(') {
            true => "give what it is for a `behavior` of its own".to_string(),
            false => format!("for one statement write `steer north for 1 min at {kept}`"),
        };
        return Some(Habit {
            message: Some("`with` has no block of its own".to_string()),
            help: format!("it holds to the end of the block that it stands in; {instead}"),
        });
    }
    if !BEFORE_BLOCK.contains(&first) || matches!(first, "requires" | "limits") && before.contains('{') {
        return None;
    }
    let head = head.trim();
    if let Some(body) = rest.strip_prefix(':').filter(|_| !head.contains("range(")) {
        let body = line_end(body);
        let message = Some("a block stands between `{` and `}`".to_string());
        let help = match body {
            "" => format!("write `{head} {{`, and `}}` on a line of its own after the block"),
            body => in_block(head, body),
        };
        return Some(Habit { message, help });
    }
    if first == "else" && rest.starts_with('{') && head != "else" {
        return write(format!("else if {} {{", head.trim_start_matches("else").trim()));
    }
    let begins_body = super::words::begins_clause(word(rest)) && word(rest) != "if" && word(rest) != "for";
    (expected.contains("`{`") && begins_body && first != "mission").then(|| Habit {
        message: Some("a block stands between `{` and `}`".to_string()),
        help: in_block(head, line_end(rest)),
    })
}

/// How a body without braces is written: an abort is a clause of its own, for a reaction takes no time.
fn in_block(head: &str, body: &str) -> String {
    match head.strip_prefix("on ").filter(|_| body.starts_with("abort")) {
        Some(condition) if body.trim() == "abort" => format!("write `abort \"why\" on {condition}`"),
        Some(condition) => format!("write `{body} on {condition}`"),
        None => format!("write `{head} {{ {body} }}`"),
    }
}

/// `depth = 18 m` in a condition.
fn comparison(before: &str, rest: &str) -> Option<Habit> {
    let first = word(before.trim_start());
    let asks = ["if", "while", "on", "abort", "expect", "signal"].contains(&first)
        || before.contains("->")
        || [" until ", " on ", "match "].iter().any(|w| before.contains(w));
    if !asks {
        return None;
    }
    let what = last_word(before);
    let is = |sign: &str| {
        let help = format!(
            "to compare write `{sign}`: `{what} {sign} …`; what is measured is hardly ever equal: `>=` or `<=`"
        );
        Some(Habit { message: None, help })
    };
    let left = before.trim_end();
    match rest {
        _ if rest.starts_with("==") => None,
        _ if rest.starts_with('=') && !left.ends_with(['<', '>', '=', '!', '~']) => is("=="),
        _ if rest.starts_with('=') && left.ends_with('~') || rest.starts_with("~=") => write("!="),
        _ if rest.starts_with('>') && left.ends_with('<') => write("!="),
        _ if word(rest) == "is" => absence(what, rest).or_else(|| is("==")),
        _ => None,
    }
}

/// `x is none`, `x is not none`: `rest` begins with `is`.
pub(super) fn absence(what: &str, rest: &str) -> Option<Habit> {
    let mut words = rest.strip_prefix("is")?.split_whitespace().map(word);
    let (sign, asked) = match words.next()? {
        "not" => ("!=", words.next()?),
        asked => ("==", asked),
    };
    let is_none = matches!(asked, "none" | "None" | "null" | "nil" | "absent");
    let help = format!(
        "write `{what} {sign} none` of what may be absent; an input never is: its age tells, `INPUT.age > 5 s`"
    );
    is_none.then_some(Habit { message: None, help })
}

/// `var q: Int`, `var q: Int?`.
fn valueless(before: &str, rest: &str) -> Option<Habit> {
    let declaration = before.trim();
    let kind = ["var", "let"].into_iter().find(|kind| word(declaration) == *kind)?;
    let (name, ty) = declaration[kind.len()..].split_once(':')?;
    let optional = rest.strip_prefix('?');
    let ends = line_end(optional.unwrap_or(rest)).is_empty() && !ty.contains('=');
    let value = if optional.is_some() { "? = none" } else { " = …" };
    ends.then(|| Habit {
        message: Some(format!("`{}` has no value", name.trim())),
        help: format!("write `{declaration}{value}`"),
    })
}

/// `sand => 1`, `true -> 1` in a `match`.
fn arm(before: &str, rest: &str, expected: &str) -> Option<Habit> {
    let truth = word(rest);
    let after = rest[truth.len()..].trim_start();
    if matches!(truth, "true" | "false" | "else") && ["=>", "->", ":"].iter().any(|sign| after.starts_with(sign)) {
        return write(format!("{truth} {{ … }}"));
    }
    let names = before.trim();
    let is_arm = expected == "`{`" && names.split(',').all(|name| name.trim() == word(name.trim()));
    (is_arm && (rest.starts_with("=>") || rest.starts_with("->"))).then(|| write(format!("{names} {{ … }}"))).flatten()
}

/// `x => x + 1`, `|x| x + 1`, `lambda x: x + 1`, `fn(x) { x + 1 }` where a value stands.
fn lambda(before: &str, rest: &str) -> Option<Habit> {
    let open = before.matches('(').count() > before.matches(')').count();
    let first = word(before.trim_start());
    let is_value = first != "fn" && open || ["let", "var", "const", "memory", "signal"].contains(&first);
    let is_arrow = rest.starts_with("=>") || rest.starts_with("->") || before.ends_with('=') && rest.starts_with('>');
    let is_bar = rest.starts_with('|') && before.trim_end().ends_with(['=', '(', ',']);
    let is_word = last_word(before) == "lambda" || word(rest) == "fn";
    (is_value && (is_arrow || is_bar || is_word)).then(|| Habit {
        message: Some("no function is a value".to_string()),
        help: "declare it with its name, `fn NAME(x: TYPE) -> TYPE { … }`, and call it: `NAME(3 m)`".to_string(),
    })
}

/// `{x: 1}` where a value stands.
fn record(rest: &str, expected: &str) -> Option<Habit> {
    let field = rest.strip_prefix('{')?.trim_start().trim_start_matches('"');
    let after = field[word(field).len()..].trim_start_matches('"').trim_start();
    (expected == "a value" && !word(field).is_empty() && after.starts_with(':')).then(|| Habit {
        message: Some("values together are a record, which has a name".to_string()),
        help: format!(
            "declare it, `record NAME {{ {0}: TYPE }}`, and make one by its name: `NAME({0}: …)`",
            word(field)
        ),
    })
}

/// `1,5 m/s`.
fn decimals(before: &str, rest: &str) -> Option<Habit> {
    let digits = |text: &str| text.chars().take_while(char::is_ascii_digit).collect::<String>();
    let (whole, part) = match rest.strip_prefix(',') {
        Some(part) => (before, part),
        None => (before.strip_suffix(',')?, rest),
    };
    let number = &whole[whole.trim_end_matches(|c: char| c.is_ascii_digit()).len()..];
    let decimals = digits(part);
    if number.is_empty() || decimals.is_empty() {
        return None;
    }
    let after = &part[decimals.len()..];
    let unit: String = after.trim_start().chars().take_while(|c| c.is_alphanumeric() || "/^%°".contains(*c)).collect();
    let quantity = format!("{number}.{decimals} {unit}");
    let message = Some("decimals follow a point, not a comma".to_string());
    Some(Habit { message, help: format!("write `{}`", quantity.trim_end()) })
}

/// `steer(east, 10 s)`: a verb as a function.
fn bracketed(before: &str, rest: &str) -> Option<Habit> {
    let verb = word(before.trim_start());
    let arguments = before.trim_start().strip_prefix(verb)?.trim_start().strip_prefix('(')?;
    let others = line_end(rest);
    let is_call = Guide::takes_arguments(verb) && !arguments.contains(['(', ')']) && rest.starts_with(',');
    is_call.then(|| Habit {
        message: Some(format!("`{verb}` is no function: its arguments stand without parentheses")),
        help: match verb {
            "steer" => format!("write `steer {arguments} for 1 min`"),
            "goto" => "write `goto PLACE`, and a place as `point(10 m, 20 m)`".to_string(),
            "loiter" => format!("write `loiter {arguments}, radius: 20 m`"),
            _ => format!("write `{verb} {arguments}{}`", others.strip_suffix(')').unwrap_or(others)),
        },
    })
}

/// `steer east 10 s`, `goto p timeout 10 s`, `loiter p max 5 min`: how long, without the word for it.
fn lasting(before: &str, rest: &str) -> Option<Habit> {
    let verb = word(before.trim_start());
    if !Guide::takes_arguments(verb)
        || [" for ", " until ", " within ", " at "].iter().any(|word| before.contains(word))
    {
        return None;
    }
    let value = line_end(rest);
    let limit = matches!(word(rest), "timeout" | "max" | "limit" | "maximum" | "before");
    let value = if limit { value[word(rest).len()..].trim_start_matches([':', '=', ' ']) } else { value };
    let (_, unit) = quantity(value).filter(|_| value.starts_with(|c: char| c.is_ascii_digit()))?;
    let is_verb_alone = last_word(before) == verb;
    let is_time = matches!(unit, "ms" | "s" | "min" | "h") && !is_verb_alone;
    let ends = Guide::of_verb(verb).any(|guide| guide.law().ends == Ends::Arrives);
    is_time.then(|| write(format!("{} {value}", if limit || ends { "within" } else { "for" }))).flatten()
}

/// `radius = 20 m`, `loiter p radius 20 m`, `steer heading 90 deg`.
fn label(before: &str, rest: &str) -> Option<Habit> {
    let verb = word(before.trim_start());
    let last = last_word(before);
    let open = before.matches('(').count() > before.matches(')').count();
    if rest.starts_with('=') && !rest.starts_with("==") && (open || Guide::takes_arguments(verb)) && verb != last {
        let value = super::slips::with_unit(last, line_end(&rest[1..]).trim_end_matches(')'));
        if !open && Channel::named(last).is_some() {
            let message = Some(format!("`at` is missing before `{last}`"));
            return Some(Habit { message, help: format!("write `at {last} {value}` in place of the comma") });
        }
        return Some(Habit {
            message: Some("an argument's name is followed by a colon".to_string()),
            help: format!("write `{last}: {value}`"),
        });
    }
    if verb == "keep" && rest.starts_with('=') {
        return write(format!("keep {last} {}", line_end(&rest[1..])));
    }
    if !Guide::takes_arguments(verb) && verb != "hold" {
        return None;
    }
    let is_setpoint = Channel::named(last).is_some();
    if before.contains('°') || is_setpoint || rest[word(rest).len()..].trim_start().starts_with(':') {
        return None;
    }
    let value = line_end(rest);
    if verb == "hold" {
        return match word(rest) {
            "position" | "station" | "here" => write("hold for 5 min"),
            "depth" | "altitude" => write(format!("hold at {value}")),
            _ => None,
        };
    }
    if verb == "steer" && matches!(last, "heading" | "course") && rest.starts_with(|c: char| c.is_ascii_digit()) {
        return write(format!("steer {}{value}", if last == "heading" { "heading: " } else { "" }));
    }
    if [" for ", " until ", " within ", " at "].iter().any(|modifier| before.contains(modifier)) {
        let help = "its arguments stand before `for`, `until`, `within` and `at`: `loiter P, radius: 20 m for 5 min`";
        return rest.starts_with(',').then(|| Habit { message: None, help: help.to_string() });
    }
    let name = word(rest);
    if Guide::of_verb(verb).flat_map(|guide| guide.law().params.iter().skip(1)).any(|param| param.name == name) {
        let value = value[name.len()..].trim_start_matches([':', '=', ' ']);
        // `loiter p, 20 m radius`
        if let (true, Some((number, unit))) = (value.is_empty(), quantity(before)) {
            return Some(Habit {
                message: None,
                help: format!("write `{name}: {}`", format!("{number} {unit}").trim_end()),
            });
        }
        return write(format!(", {name}: {value}"));
    }
    if !rest.starts_with(|c: char| c.is_ascii_digit()) || last == verb {
        return None;
    }
    match verb {
        "loiter" => write(format!(", radius: {value}")),
        "goto" => write(format!(", radius: {value}")),
        "steer" => Some(Habit {
            message: None,
            help: format!("write `steer {last} for 1 min`, or for a distance `goto position + {value} toward {last}`"),
        }),
        _ => None,
    }
}

/// `op.center + 50 m north`.
fn direction(before: &str, rest: &str) -> Option<Habit> {
    let way = Some(word(rest)).filter(|way| ["north", "south", "east", "west"].contains(way))?;
    let (number, unit) = quantity(before).filter(|(_, unit)| !unit.is_empty() && *unit != "%")?;
    let is_label = rest[way.len()..].trim_start().starts_with(':');
    (before.ends_with(' ') && !is_label).then(|| write(format!("{number} {unit} toward {way}"))).flatten()
}

/// `steer heading north`, `steer toward buoy`.
fn bearing(before: &str, rest: &str) -> Option<Habit> {
    let line = format!("{before}{rest}");
    let after = line.trim_start().strip_prefix("steer ")?.trim_start();
    let (first, value) = (word(after), line_end(after[word(after).len()..].trim_start()));
    match first {
        "heading" if !value.is_empty() => write(format!("steer heading: {value}")),
        "course" if !value.is_empty() => write(format!("steer {value}")),
        "toward" | "towards" | "to" => {
            let place = value.split(" for ").next().unwrap_or(value);
            write(format!("goto {}", if place.is_empty() { "PLACE" } else { place }))
        }
        _ => None,
    }
}

/// `goto (10 m, 20 m)`.
fn pair(before: &str, rest: &str) -> Option<Habit> {
    let (head, north) = before.rsplit_once('(')?;
    let east = rest.strip_prefix(',')?.split([')', ',', '\n']).next()?.trim();
    let is_named = head.ends_with(|c: char| c.is_alphanumeric() || c == '_');
    let is_place = |value: &str| quantity(value).is_some_and(|(_, unit)| matches!(unit, "m" | "km"));
    (!is_named && is_place(north) && is_place(east))
        .then(|| write(format!("point(north: {}, east: {east})", north.trim())))
        .flatten()
}

/// The head of a mission, its limits, what it requires, and the head of a test.
fn head(before: &str, rest: &str, expected: &str) -> Option<Habit> {
    let first = word(before.trim_start());
    if expected == "`fresh`" {
        let message = Some("how old may these samples be?".to_string());
        return Some(Habit { message, help: format!("write `{} fresh 5 s, else abort`", before.trim()) });
    }
    if before.trim() == "test" && expected == "a text" && !word(rest).is_empty() {
        let message = Some("a test has a name, which is a text".to_string());
        return Some(Habit { message, help: format!("write `test \"{}\" {{`", line_end(rest)) });
    }
    if first == "expect" && word(rest) == "for" && rest.contains('%') {
        let message = Some("the share of the runs stands before what is expected".to_string());
        return Some(Habit { message, help: "write `expect in 90 % of runs: time < 5 min`".to_string() });
    }
    if first == "expect" && word(rest) == "for" {
        let message = Some("an expectation has no `for`".to_string());
        let help = "let the mission see it: `signal long = X for 5 s`, `report \"long\": …` on it, and expect what was reported";
        return Some(Habit { message, help: help.to_string() });
    }
    if first == "mission" {
        return match word(rest) {
            "for" | "in" if before.contains("within") || word(rest) == "for" => {
                write("mission NAME in SCENARIO within 30 min {")
            }
            _ => None,
        };
    }
    let value = line_end(rest).split(',').next().unwrap_or("").trim_start_matches([':', '=', ' ']);
    let name = last_word(before);
    let bound = name.trim_start_matches("max_").trim_start_matches("min_");
    let is_limit = (Channel::named(bound).is_some() || bound == "turn_rate") && before.trim() == name;
    if is_limit && rest.starts_with(|c: char| matches!(c, ':' | '=') || c.is_ascii_digit()) {
        let sign = if name.starts_with("min_") || bound == "altitude" { ">=" } else { "<=" };
        return write(format!("{bound} {sign} {value}"));
    }
    None
}

/// Signs of other languages.
fn operator(before: &str, rest: &str) -> Option<Habit> {
    match rest {
        _ if rest.starts_with(':') && before.ends_with(|c: char| c.is_ascii_digit()) => {
            Some(Habit { message: None, help: "a time is a quantity: `5 min + 30 s`".to_string() })
        }
        _ if rest.starts_with('&') => write("and"),
        _ if rest.starts_with('|') => write("or"),
        _ if rest.starts_with('~') => write("not"),
        _ if rest.starts_with('*') && before.trim_end().ends_with('*') => write("^"),
        _ if rest.starts_with('?') => write("if X { A } else { B }"),
        _ if before.ends_with('.') && rest.starts_with('.') => {
            let (first, last) = (last_word(before.trim_end_matches('.')), word(rest.trim_start_matches(['.', '<'])));
            let message = Some("a range is no value: it stands in `for`".to_string());
            Some(Habit { message, help: format!("write `for n in {first}..{last} {{ … }}`") })
        }
        _ if rest.starts_with('.') && rest[1..].starts_with(|c: char| c.is_ascii_digit()) => {
            write(format!("0{}", line_end(rest).split([' ', ')', ',']).next().unwrap_or("")))
        }
        _ if rest.starts_with('%') && before.trim().is_empty() => {
            Some(Habit { message: None, help: "comments begin with `//`".to_string() })
        }
        _ => None,
    }
}
