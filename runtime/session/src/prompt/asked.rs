//! `why`: the conditions that were tried in a tick.

use super::{Answer, Listener, Prompt, Say, wrong};
use albacore_program::number;

impl Prompt {
    /// Tells the conditions of the last tick, or of that of a time since the beginning.
    pub(super) fn why(&mut self, time: Option<&str>, say: &mut Listener) -> Answer {
        let tick = match time {
            None => match self.now.tick.checked_sub(1) {
                Some(tick) => tick,
                None => return wrong("no tick has gone by", say),
            },
            Some(text) => match self.ticks(text, say) {
                Some(tick) => tick,
                None => return Answer::Wrong,
            },
        };
        if tick >= self.now.tick {
            return wrong("that has not been yet", say);
        }
        let Some(mut moment) = self.past.before(tick) else {
            return wrong("that moment is not remembered any more", say);
        };
        while moment.tick < tick {
            if let Err(error) = moment.step(&mut |_| {}) {
                return wrong(&error.to_string(), say);
            }
        }
        let Some(task) = &mut moment.task else {
            say(Say::Text(&format!("{}  nothing was under way", number::seconds(tick).trim_start())));
            return Answer::Done;
        };
        let (_, tried) = task.machine.step_asked(&moment.snapshot);
        let tried = task.trace.tried(&tried);
        say(Say::Text(&format!("{}  {}", number::seconds(tick).trim_start(), Prompt::active_in(task))));
        if tried.is_empty() {
            say(Say::Text("no rule was there to be tried"));
        }
        tried.iter().flat_map(|condition| condition.lines()).for_each(|line| say(Say::Text(&line)));
        Answer::Done
    }
}
