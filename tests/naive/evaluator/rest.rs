//! Rules that fire in more than every fourth tick: three more for each tick with one, one less for each without.

use super::world::World;

#[derive(Default)]
pub struct Rest {
    level: i32,
    is_restless: bool,
}

impl Rest {
    pub fn tick(&mut self, w: &mut World) {
        let switch = w.events.iter().rfind(|event| event.starts_with("switch ")).cloned();
        let place = switch.as_ref().and_then(|switch| switch.split(' ').nth(2));
        self.level = if place.is_some() { 60.min(self.level + 3) } else { 0.max(self.level - 1) };
        match place {
            Some(place) if self.level == 60 && !self.is_restless => {
                self.is_restless = true;
                w.say(format!("restless {place}"));
            }
            None if self.level == 0 && self.is_restless => {
                self.is_restless = false;
                w.say("settled".into());
            }
            _ => {}
        }
    }
}
