//! Parameters that are set and scripts that are read again while their mission is under way: it is run again from its start, as if
//! it had always been so.

use super::moment::Task;
use super::opening::{Loaded, OpenError};
use super::{Answer, Listener, Prompt, Say, wrong};
use crate::difference::deed_differences;
use crate::kept::{set_again, unset};
use std::sync::atomic::{AtomicBool, Ordering};

/// So many differences from what it did before are told.
const TOLD_MAX: usize = 5;

impl Prompt {
    pub(super) fn set(&mut self, name: &str, value: &str, interrupted: &AtomicBool, say: &mut Listener) -> Answer {
        let set = set_again(&self.opening.set, &[format!("{name}={value}")], self.mission_name());
        self.change_set(set, interrupted, say)
    }

    pub(super) fn unset(&mut self, name: &str, interrupted: &AtomicBool, say: &mut Listener) -> Answer {
        let set = unset(&self.opening.set, name, self.mission_name());
        if set == self.opening.set {
            let help = match self.opening.set.as_slice() {
                [] => "`set lambda = 4 s` sets one".to_string(),
                set => format!("set is {}", set.join(", ")),
            };
            say(Say::Error(&format!("`{name}` is not set"), Some(&help)));
            return Answer::Wrong;
        }
        self.change_set(set, interrupted, say)
    }

    fn mission_name(&self) -> &str {
        self.loaded.mission.as_ref().map_or("", |program| program.mission.name.as_str())
    }

    fn change_set(&mut self, set: Vec<String>, interrupted: &AtomicBool, say: &mut Listener) -> Answer {
        let before = std::mem::replace(&mut self.opening.set, set);
        let answer = self.change(interrupted, say);
        if answer != Answer::Done {
            self.opening.set = before;
        }
        answer
    }

    pub(super) fn reload(&mut self, interrupted: &AtomicBool, say: &mut Listener) -> Answer {
        if self.now.vehicle.is_past() {
            let help =
                "`set lambda = 4 s` changes a parameter; `albacore replay RUN --script FILE.alb` takes another script";
            say(Say::Error("the script of a run that is over is as it was", Some(help)));
            return Answer::Wrong;
        }
        if self.opening.script.is_none() {
            let help = "open the prompt with a script: `albacore repl MISSION.alb`";
            say(Say::Error("there is no script to be read again", Some(help)));
            return Answer::Wrong;
        }
        self.change(interrupted, say)
    }

    /// Reads the script again, and runs its mission again if it is under way.
    fn change(&mut self, interrupted: &AtomicBool, say: &mut Listener) -> Answer {
        if self.is_on_link() && self.now.task.as_ref().is_some_and(Task::is_mission) {
            let help = "`stop` it, change it, and `start` it anew";
            say(Say::Error("a mission under way on a vehicle is not changed", Some(help)));
            return Answer::Wrong;
        }
        let Some(before) = self.load_again(say) else { return Answer::Wrong };
        let under_way = self.now.task.as_ref().filter(|task| task.is_mission()).map(|task| task.began);
        // A run that is over has its mission alone, which is not begun again.
        let over = self.now.ended.as_ref().filter(|_| self.now.vehicle.is_past()).map(|ended| ended.began);
        let Some(began) = under_way.or(over) else {
            say(Say::Text("from the next `start` on"));
            return Answer::Done;
        };
        match self.run_again(began, interrupted) {
            Ok(told) => {
                told.iter().for_each(|line| say(Say::Text(line)));
                let under_way = if self.now.task.is_some() { "" } else { "  the mission is over" };
                say(Say::Text(&format!("{}{under_way}", self.now.place())));
                Answer::Done
            }
            Err(what) => {
                self.loaded = before;
                wrong(&what, say)
            }
        }
    }

    /// Reads the script again as it is in its file, with what is set, and all lines that were entered; gives what was there before. None:
    /// what is in the way has been said, and all is as it was.
    pub(super) fn load_again(&mut self, say: &mut Listener) -> Option<Loaded> {
        let loaded = match self.opening.load() {
            Ok(loaded) => loaded,
            Err(OpenError::File(error)) => {
                say(Say::Error(&error.message, error.help.as_deref()));
                return None;
            }
            Err(OpenError::Script(found)) => {
                say(Say::Findings(&found.0, &found.1));
                return None;
            }
            Err(OpenError::Asked(what, help)) => {
                say(Say::Error(&what, help.as_deref()));
                return None;
            }
        };
        if loaded.scenario != self.loaded.scenario {
            let help = "leave, and open the prompt with it: `albacore repl FILE.alb --set NAME=VALUE`";
            say(Say::Error("this changes the world, which has begun", Some(help)));
            return None;
        }
        let origin = |loaded: &Loaded| loaded.mission.as_ref().and_then(|program| program.mission.origin);
        if self.is_on_link() && origin(&loaded) != origin(&self.loaded) {
            let help = "leave, and open the prompt again: the link's positions count from where the area was";
            say(Say::Error("this changes where the mission's frame lies on the globe", Some(help)));
            return None;
        }
        let before = std::mem::replace(&mut self.loaded, loaded);
        let entered = std::mem::take(&mut self.entered);
        for text in &entered {
            let mut is_wrong = false;
            self.line(text, &AtomicBool::new(false), &mut |said| match said {
                Say::Text(_) => {}
                Say::Findings(findings, _) if findings.iter().all(|f| f.severity != crate::Severity::Error) => {}
                other => {
                    is_wrong = true;
                    say(other);
                }
            });
            if is_wrong {
                say(Say::Error("a line that was typed before means nothing in the script as it is now", None));
                (self.loaded, self.entered) = (before, entered);
                return None;
            }
        }
        self.look_ahead();
        Some(before)
    }

    /// Runs the mission again from the tick in which it began to the present one; tells what it did otherwise.
    fn run_again(&mut self, began: u64, interrupted: &AtomicBool) -> Result<Vec<String>, String> {
        let missing = || "the moment in which the mission began is not remembered any more".to_string();
        let mut moment = self.past.before(began).filter(|moment| moment.tick == began).ok_or_else(missing)?;
        let program = self.loaded.mission.clone().ok_or("the script has no mission any more")?;
        let name = program.mission.name.clone();
        let machine = self.machine_in(&moment, program)?;
        moment.task = Some(Task::mission(machine, &name));
        let mut past = self.past.clone();
        past.forget_after(began);
        past.pin(&moment);
        while moment.tick < self.now.tick && !moment.is_over {
            if interrupted.swap(false, Ordering::Relaxed) {
                return Err("interrupted: all is as it was".to_string());
            }
            let is_over = moment.step(&mut |_| {}).map_err(|error| error.to_string())?;
            match is_over {
                true => past.pin(&moment),
                false => past.note(&moment),
            }
        }
        let traces =
            [&self.now, &moment].map(|moment| moment.mission_trace().map_or_else(String::new, |t| t.to_string()));
        let (differences, _) = deed_differences(&traces);
        let mut told = match differences.first() {
            None => vec!["run again from its start: the same up to now".to_string()],
            Some(_) => vec!["run again from its start (- before, + now):".to_string()],
        };
        told.extend(differences.iter().take(TOLD_MAX).map(|difference| difference.line()));
        if differences.len() > TOLD_MAX {
            told.push(format!("  and {} more", differences.len() - TOLD_MAX));
        }
        moment.keep_names(self.now.names().to_vec());
        (self.now, self.past) = (moment, past);
        Ok(told)
    }
}
