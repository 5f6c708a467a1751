//! What is asked and told without time going by: `why`, the conditions that were tried in a tick, and texts with values in them.

use super::{Answer, Line, Listener, Prompt, Say, wrong};
use albacore_machine::Event;
use albacore_program::number;
use albacore_vehicle::{Control, Snapshot};

impl Prompt {
    /// Tells a text with values in it, which stands alone on its line, as `log` would; none for any other line.
    pub(super) fn told(&mut self, text: &str, say: &mut Listener) -> Option<Answer> {
        let text = text.trim();
        let is_text = text.starts_with('"') && text.ends_with('"') && text.contains('{');
        let known = self.known();
        let read = match is_text {
            true => self.loaded.lines.read(&*self.loaded.files, &format!("log {text}"), &known, self.origin()),
            false => return None,
        };
        let Some(Line::Statements(drive)) = read.line else {
            say(Say::Findings(&read.findings, self.loaded.lines.sources()));
            return Some(Answer::Wrong);
        };
        let mut machine = match self.machine(&drive, &known) {
            Ok(machine) => machine,
            Err(what) => return Some(wrong(&what, say)),
        };
        machine.step(&Snapshot { control: Control::InControl, ..self.now.snapshot.clone() });
        let logged = machine.events().iter().find_map(|event| match event {
            Event::Logged(text) => Some(text.as_str()),
            _ => None,
        });
        logged.into_iter().for_each(|text| say(Say::Text(text)));
        Some(Answer::Done)
    }

    /// Tells the conditions of the last tick, or of that of a time since the beginning.
    pub(super) fn why(&mut self, time: Option<&str>, say: &mut Listener) -> Answer {
        // What has ended in this very tick was tried in it.
        let ended_now = self.now.ended.as_ref().is_some_and(|ended| ended.at == self.now.tick) || self.now.is_over;
        let next = self.now.tick + u64::from(ended_now || self.now.is_decided());
        let tick = match time {
            None => match next.checked_sub(1) {
                Some(tick) => tick,
                None => return wrong("no tick has gone by", say),
            },
            Some(text) => match self.ticks(text, say) {
                Some(tick) => tick,
                None => return Answer::Wrong,
            },
        };
        if tick >= next {
            return wrong("that has not been yet", say);
        }
        let is_end = ended_now && tick == self.now.tick;
        let Some(mut moment) = self.past.before(if is_end { tick.saturating_sub(1) } else { tick }) else {
            return wrong("that moment is not remembered any more", say);
        };
        while moment.tick < tick {
            if let Err(error) = self.past.go_on(&mut moment) {
                return wrong(&error.to_string(), say);
            }
        }
        let Some(task) = &mut moment.task else {
            say(Say::Text(&format!("{}  nothing was under way", number::seconds(tick).trim_start())));
            return Answer::Done;
        };
        let (_, tried) = task.machine.step_asked(&moment.snapshot);
        let tried = task.trace.tried(&tried);
        let active = format!("{}  {}", number::seconds(tick).trim_start(), Prompt::active_in(task));
        say(Say::Text(active.trim_end()));
        if tried.is_empty() {
            say(Say::Text("no rule was there to be tried"));
        }
        tried.iter().flat_map(|condition| condition.lines()).for_each(|line| say(Say::Text(&line)));
        Answer::Done
    }
}
