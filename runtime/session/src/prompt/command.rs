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
  back 30 s        go back in time; what was under way then is so again
  stop             end what is under way (Ctrl-C does so while it is driven)
  behavior         what is active, from outside in
  names            what has a name, with its value: in a mission its signals and memories too
  quit             leave (Ctrl-D)";

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
    Step(u64),
    /// One of these words, and something with it that makes no sense: what is wrong, and how it is used.
    Misused(&'static str, &'static str),
    /// For a time as it was typed, or to the end.
    Run(Option<&'a str>),
    Back(&'a str),
}

/// The command that a text is, if it is one. All else is the language's.
pub fn of(text: &str) -> Option<Command<'_>> {
    let text = text.trim();
    let (word, rest) = text.split_once(char::is_whitespace).map_or((text, ""), |(word, rest)| (word, rest.trim()));
    // `step = 3 m` and `run + x` are the language's; `run -3 s` is meant as a command.
    let negative = rest.starts_with('-') && rest[1..].starts_with(|c: char| c.is_ascii_digit());
    let has_value = negative || rest.starts_with(|c: char| c.is_alphanumeric() || c == '(' || c == '_');
    Some(match (word, rest) {
        ("help" | "?", "") => Command::Help,
        ("quit" | "exit", "") => Command::Quit,
        ("behavior", "") => Command::Behavior,
        ("names", "") => Command::Names,
        ("start", "") => Command::Start,
        ("stop", "") => Command::Stop,
        ("step", "") => Command::Step(1),
        ("step", count) if has_value => {
            let ticks = count.parse().ok().filter(|ticks| (1..=TICKS_MAX).contains(ticks));
            let help = "for example `step 10`; for a time write `run 10 s`";
            ticks.map_or(Command::Misused("`step` takes a count of ticks, from 1 to 360000", help), Command::Step)
        }
        ("run", "") => Command::Run(None),
        ("run" | "back", _) if negative => {
            Command::Misused("time goes by in one direction", "`run 30 s` goes on, `back 30 s` goes back")
        }
        ("run", time) if has_value => Command::Run(Some(time)),
        ("back", "") => Command::Misused("how far back?", "for example `back 30 s`"),
        ("back", time) if has_value => Command::Back(time),
        ("load" | "open", _) if has_value || rest.starts_with(['"', '.', '/']) => {
            let help = "leave, and open the prompt with it: `albacore repl FILE.alb`; `use NAME` imports a module";
            Command::Misused("a script is not loaded at the prompt", help)
        }
        ("quit" | "exit" | "help" | "names" | "stop" | "start", _) if has_value => {
            Command::Misused("this command stands alone on its line", "`help` lists the commands")
        }
        _ => return None,
    })
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
        for language in ["behavior b { hold for 1 s }", "step + 3 m", "step = 3", "run = 3", "goto home", "2 m", ""] {
            assert_eq!(of(language), None, "{language}");
        }
    }
}
