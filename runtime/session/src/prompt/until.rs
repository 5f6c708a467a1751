//! `run until X`: time goes by until a condition holds, or a behavior is entered.

use super::command::TICKS_MAX;
use super::{Answer, Line, Listener, Prompt, Say};
use albacore_machine::{Event, Machine};
use albacore_program::Slot;
use albacore_vehicle::{Control, Snapshot};
use std::sync::atomic::AtomicBool;

/// What is waited for.
pub(super) enum Until {
    /// The end of what is under way.
    Over,
    /// That a behavior, a strategy or a mission of this name is entered.
    Entered(String, bool),
    /// That a condition holds.
    Holds(Box<Condition>),
}

/// A condition that is looked at in each tick.
pub(super) struct Condition {
    text: String,
    /// A line that waits for it.
    machine: Machine,
    /// The names of the mission that it reads, with their places in the line.
    names: Vec<(String, Slot)>,
    holds: bool,
}

impl Until {
    /// Whether it has come by now: before the tick that is sensed is commanded.
    pub fn has_come(&mut self, prompt: &Prompt) -> bool {
        match self {
            Until::Over => false,
            Until::Entered(name, has_come) => {
                let Some(task) = &prompt.now.task else { return false };
                let activities = &task.machine.program().activities;
                let is_it = |id: u32| activities.get(id as usize).is_some_and(|activity| activity.name == *name);
                *has_come |=
                    task.machine.events().iter().any(|event| matches!(event, Event::Entered(id) if is_it(*id)));
                *has_come
            }
            Until::Holds(condition) => {
                condition.look(prompt);
                condition.holds
            }
        }
    }

    /// What is told of it at the end.
    pub fn told(&self) -> Option<String> {
        let (what, has_come) = match self {
            Until::Over => return None,
            Until::Entered(name, has_come) => (format!("{name} is entered"), *has_come),
            Until::Holds(condition) => (condition.text.clone(), condition.holds),
        };
        Some(if has_come { format!("  {what}") } else { format!("  before this came: {what}") })
    }
}

impl Condition {
    fn look(&mut self, prompt: &Prompt) {
        if !self.names.is_empty() {
            let known = prompt.known();
            for (name, slot) in &self.names {
                if let Some(named) = known.iter().find(|named| named.name == *name) {
                    self.machine.put(*slot, &named.words);
                }
            }
        }
        // It is the prompt that asks, whoever drives.
        self.machine.step(&Snapshot { control: Control::InControl, ..prompt.now.snapshot.clone() });
        self.holds |= self.machine.outcome().is_some();
    }
}

impl Prompt {
    pub(super) fn run_until(&mut self, text: &str, interrupted: &AtomicBool, say: &mut Listener) -> Answer {
        if let Some(answer) = self.is_beyond_reach(say) {
            return answer;
        }
        if self.now.task.is_none() {
            let help = "a statement or `start` gives the vehicle something to do";
            say(Say::Error("nothing is under way", Some(help)));
            return Answer::Wrong;
        }
        let under_way = self.now.task.as_ref().map(|task| task.machine.program());
        let is_behavior = under_way.is_some_and(|program| program.activities.iter().any(|a| a.name == text));
        let until = match is_behavior {
            true => Until::Entered(text.to_string(), false),
            false => match self.condition(text, say) {
                Some(condition) => Until::Holds(Box::new(condition)),
                None => return Answer::Wrong,
            },
        };
        self.drive(TICKS_MAX, until, interrupted, say);
        Answer::Done
    }

    /// A line that waits for a condition.
    fn condition(&mut self, text: &str, say: &mut Listener) -> Option<Condition> {
        let known = self.known();
        let origin = self.origin();
        let asked = self.loaded.lines.read(&*self.loaded.files, text, &known, origin);
        // In brackets `for 10 s` belongs to the condition, and does not end the wait.
        let waits = format!("wait until ({text})");
        let read = self.loaded.lines.read(&*self.loaded.files, &waits, &known, origin);
        let Some(Line::Statements(drive)) = read.line else {
            match asked.findings.is_empty() {
                false => say(Say::Findings(&asked.findings, self.loaded.lines.sources())),
                true => {
                    let help =
                        "for example `run until chemical > 5 %`; of a mission under way the name of a behavior, too";
                    say(Say::Error("this is no condition", Some(help)));
                }
            }
            return None;
        };
        let machine = match self.machine(&drive, &known) {
            Ok(machine) => machine,
            Err(what) => {
                say(Say::Error(&what, None));
                return None;
            }
        };
        let is_word = |c: char| c.is_alphanumeric() || c == '_';
        let is_read = |name: &str| text.split(|c: char| !is_word(c)).any(|word| word == name);
        let names = known.iter().zip(&drive.known).filter(|(named, _)| is_read(&named.name));
        let names = names.map(|(named, slot)| (named.name.clone(), *slot)).collect();
        Some(Condition { text: text.to_string(), machine, names, holds: false })
    }
}
