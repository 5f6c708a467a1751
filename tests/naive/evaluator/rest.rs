//! Rules that fire in more than every fourth tick: three more for each tick with one, one less for each without. And rules that leave what they
//! had wait as soon as that goes on, five times in a row.

use super::world::World;

#[derive(Default)]
pub struct Rest {
    level: i32,
    is_restless: bool,
    before: Option<(String, String)>,
    went_on: Option<String>,
    at_once: i32,
    is_starved: bool,
}

impl Rest {
    pub fn tick(&mut self, w: &mut World) {
        let word = |event: &str, at: usize| event.split(' ').nth(at).unwrap_or_default().to_string();
        let switch = w.events.iter().rfind(|event| event.starts_with("switch ")).cloned();
        let switch = switch.map(|event| (word(&event, 2), word(&event, 1)));
        self.level = if switch.is_some() { 60.min(self.level + 3) } else { 0.max(self.level - 1) };
        let mut earlier = self.went_on.take();
        for event in &w.events {
            if event.starts_with("resume ") {
                self.went_on = Some(word(event, 1));
            } else if event.starts_with("switch ") {
                let now = (word(event, 2), word(event, 1));
                let left = self.went_on.take().or(earlier.take());
                let is_again = left.as_ref() == Some(&now.1) && self.before.as_ref() == Some(&now);
                self.at_once = if is_again { 5.min(self.at_once + 1) } else { 0 };
                self.before = Some(now);
            }
        }
        if earlier.is_some() {
            self.at_once = 0;
        }
        let told = self.is_restless || self.is_starved;
        self.is_restless = self.level == 60 || self.is_restless && (self.level > 0 || switch.is_some());
        self.is_starved = self.at_once == 5 || self.is_starved && self.at_once > 0;
        match switch {
            Some((place, _)) if !told && (self.is_restless || self.is_starved) => w.say(format!("restless {place}")),
            _ if told && !self.is_restless && !self.is_starved => w.say("settled".into()),
            _ => {}
        }
    }
}
