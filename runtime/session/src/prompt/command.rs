//! The words that only the prompt knows.

/// What `help` prints.
pub const HELP: &str = "\
what a script can say:
  2 m/s * 10 s                       an expression: its value
  position, chemical, flow           what is sensed now
  goto point(north: 100 m, east: 20 m)   a statement: driven to its end
  steer 90 deg                       one without an end: begun, and goes on with `run`
  let home = position                a name for a value
  var count = 0                      one that can be assigned: count = count + 1
  with depth 5 m, speed 2 m/s        what holds for all that follows
  use search; fn …; behavior … { }   declarations, known from then on
and beside it:
  start            begin the mission of the script
  step, step 10    let ticks go by
  run 5 min, run   let time go by; until what is under way ends
  run until X      until a condition holds, or a behavior of this name is entered
  back 30 s        go back in time; what was under way then is so again
  stop             end what is under way (Ctrl-C does so while it is driven)
  release          give a vehicle at the end of a link back, and listen on
  behavior         what is active, from outside in
  why, why 751 s   the conditions that were tried in the last tick, or then: what they are made of
  set lambda = 4 s change a parameter: the mission is run again from its start to now
  unset lambda     the same with it as it was before `set`
  reload           the same with the script as it is in its file now
  fork NAME        keep all that is now under a name, and go on
  switch to NAME   go on there; what is left is kept, at first under the name `main`
  forks            what is kept
  compare NAME     what the mission did there and not here
  plot chemical, depth           what expressions were, over time
  plot chemical to FILE.svg      the same as a picture
  save test \"NAME\" to FILE.alb   the mission as it was run here, as a test
  explain CODE     what the code of an error or a warning means
  names            what has a name, with its value: in a mission its signals and memories too
  quit             leave (Ctrl-D)";

/// The words with which a command begins.
pub const WORDS: [&str; 20] = [
    "start", "step", "run", "back", "stop", "release", "behavior", "why", "set", "unset", "reload", "fork", "switch",
    "forks", "compare", "plot", "save", "explain", "names", "help",
];

/// Time goes by this many ticks at most before the prompt comes back: ten hours.
pub const TICKS_MAX: u64 = 360_000;

/// Something that the prompt itself does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Command<'a> {
    Help,
    Quit,
    Behavior,
    Names,
    Start,
    Stop,
    Release,
    Step(u64),
    /// One of these words, and something with it that makes no sense: what is wrong, and how it is used.
    Misused(&'static str, &'static str),
    /// For a time as it was typed, or to the end.
    Run(Option<&'a str>),
    /// Until a condition holds, or a behavior is entered.
    RunUntil(&'a str),
    Back(&'a str),
    /// The last tick, or that of a time as it was typed.
    Why(Option<&'a str>),
    /// A parameter and its value, as they were typed.
    Set(&'a str, &'a str),
    /// A parameter that was set.
    Unset(&'a str),
    Reload,
    Fork(&'a str),
    SwitchTo(&'a str),
    Forks,
    Compare(&'a str),
    /// Expressions, and the file that the picture goes to.
    Plot(&'a str, Option<&'a str>),
    /// The name of the test, and its file.
    SaveTest(&'a str, &'a str),
    Explain(&'a str),
}

/// The command that a text is, if it is one. All else is the language's.
pub fn of(text: &str) -> Option<Command<'_>> {
    let text = text.trim();
    let (word, rest) = text.split_once(char::is_whitespace).map_or((text, ""), |(word, rest)| (word, rest.trim()));
    // `step = 3 m` and `run + x` are the language's; `run -3 s` is meant as a command.
    let negative = rest.starts_with('-') && rest[1..].starts_with(|c: char| c.is_ascii_digit());
    let has_value = negative || rest.starts_with(|c: char| c.is_alphanumeric() || c == '(' || c == '_');
    if let Some(command) = alone(word).filter(|_| rest.is_empty()) {
        return Some(command);
    }
    Some(match (word, rest) {
        ("step", count) if has_value => {
            let ticks = count.parse().ok().filter(|ticks| (1..=TICKS_MAX).contains(ticks));
            let help = "for example `step 10`; for a time write `run 10 s`";
            ticks.map_or(Command::Misused("`step` takes a count of ticks, from 1 to 360000", help), Command::Step)
        }
        ("run" | "back", _) if negative => {
            Command::Misused("time goes by in one direction", "`run 30 s` goes on, `back 30 s` goes back")
        }
        ("run", _) if until(rest).is_some() => match until(rest) {
            Some("") | None => {
                Command::Misused("until what?", "for example `run until chemical > 5 %`, `run until track_in`")
            }
            Some(condition) => Command::RunUntil(condition),
        },
        ("run", time) if has_value => Command::Run(Some(time)),
        ("back", "") => Command::Misused("how far back?", "for example `back 30 s`"),
        ("back", time) if has_value => Command::Back(time),
        ("load" | "open", _) if has_value || rest.starts_with(['"', '.', '/']) => {
            let help = "leave, and open the prompt with it: `albacore repl FILE.alb`; `use NAME` imports a module";
            Command::Misused("a script is not loaded at the prompt", help)
        }
        ("set", _) if has_value => match rest.split_once('=') {
            Some((name, value)) if is_path(name.trim()) && !value.trim().is_empty() => {
                Command::Set(name.trim(), value.trim())
            }
            _ => Command::Misused("which parameter, and what value?", "for example `set lambda = 4 s`"),
        },
        ("unset", name) if is_path(name) => Command::Unset(name),
        ("unset", _) if rest.is_empty() || has_value => {
            Command::Misused("which parameter?", "one that was set, for example `unset lambda`")
        }
        ("fork", name) if is_path(name) => Command::Fork(name),
        ("fork", _) if rest.is_empty() || has_value || rest.starts_with('"') => {
            Command::Misused("under what name?", "one word, for example `fork before_the_turn`")
        }
        ("compare" | "explain", "") => {
            Command::Misused("with what?", "for example `compare before`, `explain units::unknown`")
        }
        ("why", _) if rest.contains(':') => {
            Command::Misused("a time at the prompt is one of its own", "for example `why 751 s`")
        }
        ("compare", name) if is_path(name) => Command::Compare(name),
        ("switch", to) if to.strip_prefix("to ").is_some_and(|name| is_path(name.trim())) => {
            Command::SwitchTo(to.strip_prefix("to ").unwrap_or(to).trim())
        }
        ("why", time) if has_value => Command::Why(Some(time)),
        ("plot", "") => Command::Misused("plot what?", "for example `plot chemical, depth`"),
        ("plot", _) if has_value => match rest.rsplit_once(" to ") {
            Some((what, file)) => Command::Plot(what.trim(), Some(file.trim())),
            None => Command::Plot(rest, None),
        },
        ("save", _) if rest.starts_with("test") => saved(rest).unwrap_or(Command::Misused(
            "a test needs a name and a script of its own",
            "for example `save test \"it turns\" to turns.alb`",
        )),
        ("explain", code) if has_value => Command::Explain(code),
        ("quit" | "exit" | "help" | "names" | "stop" | "release" | "start" | "reload" | "forks", _) if has_value => {
            Command::Misused("this command stands alone on its line", "`help` lists the commands")
        }
        _ => return None,
    })
}

/// A command of one word.
fn alone(word: &str) -> Option<Command<'static>> {
    Some(match word {
        "help" | "?" => Command::Help,
        "quit" | "exit" => Command::Quit,
        "behavior" => Command::Behavior,
        "names" => Command::Names,
        "start" => Command::Start,
        "stop" => Command::Stop,
        "release" => Command::Release,
        "step" => Command::Step(1),
        "run" => Command::Run(None),
        "why" => Command::Why(None),
        "reload" => Command::Reload,
        "forks" => Command::Forks,
        _ => return None,
    })
}

/// What stands behind `until`.
fn until(rest: &str) -> Option<&str> {
    let after = rest.strip_prefix("until")?;
    (after.is_empty() || after.starts_with(char::is_whitespace)).then(|| after.trim())
}

/// Whether a text is a name, or names with dots between them.
fn is_path(text: &str) -> bool {
    let is_name = |name: &str| {
        name.starts_with(|c: char| c.is_alphabetic() || c == '_')
            && name.chars().all(|c| c.is_alphanumeric() || c == '_')
    };
    text.split('.').all(is_name)
}

/// `test "NAME" to FILE`.
fn saved(rest: &str) -> Option<Command<'_>> {
    let (name, file) = rest.strip_prefix("test")?.trim().strip_prefix('"')?.split_once('"')?;
    let file = file.trim().strip_prefix("to ")?.trim().trim_matches('"');
    (!name.trim().is_empty() && file.len() > ".alb".len() && file.ends_with(".alb"))
        .then_some(Command::SaveTest(name, file))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_are_told_from_the_language() {
        assert_eq!(of(" run 5 min "), Some(Command::Run(Some("5 min"))));
        assert_eq!(of("run"), Some(Command::Run(None)));
        assert_eq!(of("step 3"), Some(Command::Step(3)));
        for misused in ["step 0", "step -1", "step 10 s", "run -3 s", "back", "quit now", "load box.alb"] {
            assert!(matches!(of(misused), Some(Command::Misused(..))), "{misused}");
        }
        assert_eq!(of("behavior"), Some(Command::Behavior));
        assert_eq!(of("run until altitude < 3 m"), Some(Command::RunUntil("altitude < 3 m")));
        assert_eq!(of("run until_then"), Some(Command::Run(Some("until_then"))));
        assert_eq!(of("set lambda = 4 s"), Some(Command::Set("lambda", "4 s")));
        assert_eq!(of("set cpt_2005.beta=30 deg"), Some(Command::Set("cpt_2005.beta", "30 deg")));
        assert_eq!(of("unset lambda"), Some(Command::Unset("lambda")));
        assert_eq!(of("switch to main"), Some(Command::SwitchTo("main")));
        assert_eq!(of("plot chemical, depth to a.svg"), Some(Command::Plot("chemical, depth", Some("a.svg"))));
        assert_eq!(of("save test \"it turns\" to t.alb"), Some(Command::SaveTest("it turns", "t.alb")));
        for misused in [
            "set lambda",
            "set 3 = 4",
            "unset",
            "unset a = 3",
            "compare",
            "fork",
            "plot",
            "save test turns",
            "run until",
            "reload box.alb",
        ] {
            assert!(matches!(of(misused), Some(Command::Misused(..))), "{misused}");
        }
        for language in [
            "behavior b { hold for 1 s }",
            "step + 3 m",
            "step = 3",
            "run = 3",
            "goto home",
            "2 m",
            "",
            "set = 3",
            "unset = 3",
            "why = 3",
            "fork = 2 m",
            "plot = 3 m",
        ] {
            assert_eq!(of(language), None, "{language}");
        }
    }
}
