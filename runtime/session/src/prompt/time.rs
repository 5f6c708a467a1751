//! Time at the prompt: it goes by, and back.

use super::command::TICKS_MAX;
use super::until::Until;
use super::{Answer, Listener, Prompt, Say, wrong};
use albacore_lang::prompt::{Left, Line};
use albacore_program::number;
use albacore_vehicle::TICK_S;
use std::sync::atomic::{AtomicBool, Ordering};

impl Prompt {
    /// Lets time go by until what is under way ends, or what is waited for comes, but so many ticks at most.
    pub(super) fn drive(&mut self, ticks: u64, mut until: Until, interrupted: &AtomicBool, say: &mut Listener) {
        let was_busy = self.now.task.is_some();
        let last = self.now.tick + ticks;
        while self.now.tick < last {
            if interrupted.swap(false, Ordering::Relaxed) {
                self.stopped = true;
                return self.stop(say);
            }
            if until.has_come(self) {
                break;
            }
            if self.now.is_over {
                say(Say::Text("the journal ends here"));
                break;
            }
            match self.advance(say) {
                Ok(has_ended) if has_ended || self.has_lost_link => break,
                Ok(_) => {}
                Err(error) => return self.lose_link(&error, say),
            }
        }
        let is_busy = was_busy && self.now.task.is_some();
        let on = match until.told() {
            Some(told) => told,
            None if is_busy && ticks == TICKS_MAX => "  still under way".to_string(),
            None => String::new(),
        };
        say(Say::Text(&format!("{}{on}", self.now.place())));
    }

    /// Goes back in time: to the moment before, and on from there as it was. What has got a name since keeps it.
    pub(super) fn back(&mut self, ticks: u64, say: &mut Listener) -> Answer {
        if let Some(answer) = self.needs_simulation(say) {
            return answer;
        }
        let to = self.now.tick.saturating_sub(ticks);
        let Some(mut moment) = self.past.before(to) else {
            let earliest = self.past.earliest();
            let lived = (self.now.tick - earliest) as f64 * TICK_S;
            let most = number::fixed(lived, 1);
            let what = format!("time goes back {most} s at most from here");
            let help = match lived > 0.0 {
                true => format!("`back {most} s` goes back to the earliest moment that is remembered"),
                false => "this is the earliest moment".to_string(),
            };
            say(Say::Error(&what, Some(&help)));
            return Answer::Wrong;
        };
        while moment.tick < to {
            if let Err(error) = moment.step(&mut |_| {}) {
                return wrong(&error.to_string(), say);
            }
        }
        moment.keep_names(self.now.names().to_vec());
        self.now = moment;
        self.past.forget_after(to);
        let under_way = self.now.task.as_ref().map_or("", |_| "  under way again: `run` lets it go on");
        say(Say::Text(&format!("{}{under_way}", self.now.place())));
        Answer::Done
    }

    /// A time typed after `run` or `back`, in ticks, at least one.
    pub(super) fn ticks(&mut self, text: &str, say: &mut Listener) -> Option<u64> {
        let known = self.known();
        let read = self.loaded.lines.read(&*self.loaded.files, text, &known, self.origin());
        if !read.findings.is_empty() {
            say(Say::Findings(&read.findings, self.loaded.lines.sources()));
        }
        let drive = match read.line? {
            Line::Value(drive) if drive.value.as_ref().is_some_and(Left::is_duration) => drive,
            _ => {
                say(Say::Error("this takes a time", Some("for example `run 5 min`, `back 30 s`")));
                return None;
            }
        };
        match self.value(&drive, &known) {
            Ok((_, value)) => {
                let seconds = value.words.first().copied().unwrap_or(0.0);
                let ticks = (seconds / TICK_S - 1e-9).ceil();
                if (1.0..=TICKS_MAX as f64).contains(&ticks) {
                    return Some(ticks as u64);
                }
                say(Say::Error("this takes a time between 100 ms and 10 h", None));
            }
            Err(what) => say(Say::Error(&what, None)),
        }
        None
    }
}
