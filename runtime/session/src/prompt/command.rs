//! The words that only the prompt knows.

/// What `help` prints.
pub const HELP: &str = "\
what a script can say:
  2 m/s * 10 s                       an expression: its value
  position, chemical, flow           what is sensed now
  goto point(north: 100 m, east: 20 m)   a statement: driven to its end
  steer 90 deg                       one without an end: begun, and goes on with `run`
  let home = position                a name for a value
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
    /// Something after `step` that is no count.
    Miscounted,
    /// For a time as it was typed, or to the end.
    Run(Option<&'a str>),
    Back(&'a str),
}

/// The command that a text is, if it is one. All else is the language's.
pub fn of(text: &str) -> Option<Command<'_>> {
    let text = text.trim();
    let (word, rest) = text.split_once(char::is_whitespace).map_or((text, ""), |(word, rest)| (word, rest.trim()));
    // `step = 3 m` and `run.x` are no commands.
    let has_time = rest.starts_with(|c: char| c.is_alphanumeric() || c == '(' || c == '_');
    Some(match (word, rest) {
        ("help" | "?", "") => Command::Help,
        ("quit" | "exit", "") => Command::Quit,
        ("behavior", "") => Command::Behavior,
        ("names", "") => Command::Names,
        ("start", "") => Command::Start,
        ("stop", "") => Command::Stop,
        ("step", "") => Command::Step(1),
        ("step", count) if count.starts_with(|c: char| c.is_ascii_digit()) => {
            let ticks = count.parse().ok().filter(|ticks| (1..=TICKS_MAX).contains(ticks));
            ticks.map_or(Command::Miscounted, Command::Step)
        }
        ("run", "") => Command::Run(None),
        ("run", time) if has_time => Command::Run(Some(time)),
        ("back", time) if has_time => Command::Back(time),
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
        assert_eq!(of("step 0"), Some(Command::Miscounted));
        assert_eq!(of("behavior"), Some(Command::Behavior));
        for language in
            ["behavior b { hold for 1 s }", "step + 3 m", "step = 3", "run = 3", "goto home", "2 m", "", "back"]
        {
            assert_eq!(of(language), None, "{language}");
        }
    }
}
