//! Forks: the same vehicle at the same moment, and from there on in two ways.

use super::moment::{Moment, Past};
use super::{Answer, Listener, Prompt, Say, wrong};
use crate::difference::deed_differences;
use albacore_trace::BehaviorTrace;
use std::collections::BTreeMap;

/// What the present is called before it has another name.
pub(super) const FIRST_FORK: &str = "main";
/// So many forks are kept at most: each holds its past.
const FORKS_MAX: usize = 16;
/// So many differences are told.
const TOLD_MAX: usize = 40;

/// A present that is kept, with its past and with what was set in it.
pub(super) struct Fork {
    now: Moment,
    past: Past,
    set: Vec<String>,
}

impl Moment {
    /// What the mission of the script did, that is under way or has ended last.
    pub(super) fn mission_trace(&self) -> Option<&BehaviorTrace> {
        let under_way = self.task.as_ref().filter(|task| task.is_mission()).map(|task| &task.trace);
        under_way.or(self.ended.as_ref().map(|ended| &ended.trace))
    }
}

impl Prompt {
    pub(super) fn fork(&mut self, name: &str, say: &mut Listener) -> Answer {
        if let Some(answer) = self.needs_simulation(say) {
            return answer;
        }
        if name == self.here || self.forks.contains_key(name) {
            return wrong(&format!("there is a fork `{name}` already"), say);
        }
        if self.forks.len() >= FORKS_MAX {
            return wrong(&format!("more than {FORKS_MAX} forks are not kept"), say);
        }
        let kept = Fork { now: self.now.clone(), past: self.past.clone(), set: self.opening.set.clone() };
        self.forks.insert(name.to_string(), kept);
        let here = &self.here;
        say(Say::Text(&format!(
            "`{name}` is kept as it is now; this is `{here}`, and `switch to {name}` goes on there"
        )));
        Answer::Done
    }

    pub(super) fn switch_to(&mut self, name: &str, say: &mut Listener) -> Answer {
        if name == self.here {
            say(Say::Text(&format!("this is `{name}`")));
            return Answer::Done;
        }
        let Some(fork) = self.forks.remove(name) else { return self.no_fork(name, say) };
        // What was set there is in force there: the script is read again with it.
        let left = Fork {
            now: std::mem::replace(&mut self.now, fork.now),
            past: std::mem::replace(&mut self.past, fork.past),
            set: self.opening.set.clone(),
        };
        let here = std::mem::replace(&mut self.here, name.to_string());
        let set = std::mem::replace(&mut self.opening.set, fork.set);
        self.forks.insert(here, left);
        if set != self.opening.set && self.load_again(say).is_none() {
            return Answer::Wrong;
        }
        say(Say::Text(&format!("{}  {}", self.now.place(), self.active())));
        Answer::Done
    }

    pub(super) fn tell_forks(&self, say: &mut Listener) {
        let moments: BTreeMap<&str, (&Moment, &[String])> = self
            .forks
            .iter()
            .map(|(name, fork)| (name.as_str(), (&fork.now, fork.set.as_slice())))
            .chain([(self.here.as_str(), (&self.now, self.opening.set.as_slice()))])
            .collect();
        for (name, (moment, set)) in moments {
            let mark = if name == self.here { "*" } else { " " };
            let set = if set.is_empty() { String::new() } else { format!("  with {}", set.join(", ")) };
            say(Say::Text(&format!("{mark} {name}  {}{set}", moment.place())));
        }
    }

    pub(super) fn compare(&self, name: &str, say: &mut Listener) -> Answer {
        let Some(other) = self.forks.get(name) else { return self.no_fork(name, say) };
        let (Some(ours), Some(theirs)) = (self.now.mission_trace(), other.now.mission_trace()) else {
            return wrong("the mission was not begun in both: nothing is to be compared", say);
        };
        let (differences, _) = deed_differences(&[ours.to_string(), theirs.to_string()]);
        let here = &self.here;
        match differences.is_empty() {
            true => say(Say::Text("the mission did the same at the same times")),
            false => say(Say::Text(&format!("- `{here}`, + `{name}`; what both did is of `{name}` later or earlier"))),
        }
        differences.iter().take(TOLD_MAX).for_each(|difference| say(Say::Text(&difference.line())));
        if differences.len() > TOLD_MAX {
            say(Say::Text(&format!("  and {} more", differences.len() - TOLD_MAX)));
        }
        for (mark, moment) in [("-", &self.now), ("+", &other.now)] {
            say(Say::Text(&format!("{mark} {}", moment.place())));
        }
        Answer::Done
    }

    fn no_fork(&self, name: &str, say: &mut Listener) -> Answer {
        let names: Vec<&str> = self.forks.keys().map(String::as_str).collect();
        let help = match names.as_slice() {
            [] => "`fork NAME` keeps the present under a name".to_string(),
            names => format!("there is {}", names.join(", ")),
        };
        say(Say::Error(&format!("there is no fork `{name}`"), Some(&help)));
        Answer::Wrong
    }
}
