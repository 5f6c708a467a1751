//! What befalls the vehicle that its crew must hear of: it runs aground, or into a place where it must not be.

use crate::world::bottom::NoGo;
use albacore_geometry::{Area, Point};

/// So many notices wait to be taken; later ones are dropped.
const NOTICES_MAX: usize = 64;

/// Who watches.
#[derive(Clone, Debug)]
pub struct Incidents {
    aground: bool,
    zones: Vec<Zone>,
    notices: Vec<String>,
}

#[derive(Clone, Debug)]
struct Zone {
    name: String,
    area: Area,
    entered: bool,
}

impl Incidents {
    /// Nothing has happened yet.
    pub fn new(zones: &[NoGo]) -> Incidents {
        let zone = |zone: &NoGo| Zone { name: zone.name.clone(), area: zone.area.clone(), entered: false };
        Incidents { aground: false, zones: zones.iter().map(zone).collect(), notices: Vec::new() }
    }

    /// The vehicle is here now, in so much water (m), and lies on the bottom or not. Each incident is told once, and its end.
    pub fn observe(&mut self, at: Point, water: f64, aground: bool) {
        let place = || format!("{} m north, {} m east", tenths(at.north), tenths(at.east));
        let mut told = Vec::new();
        if aground != self.aground {
            let what = if aground { "grounded" } else { "came free of the bottom" };
            told.push(format!("{what} at {}, in {} m of water", place(), tenths(water)));
            self.aground = aground;
        }
        for zone in &mut self.zones {
            let inside = zone.area.contains(at);
            if inside != zone.entered {
                let what = if inside { "entered" } else { "left" };
                told.push(format!("{what} the no-go zone `{}` at {}", zone.name, place()));
                zone.entered = inside;
            }
        }
        let room = NOTICES_MAX.saturating_sub(self.notices.len());
        self.notices.extend(told.into_iter().take(room));
    }

    /// Whether the vehicle lies on the bottom.
    pub fn is_aground(&self) -> bool {
        self.aground
    }

    /// Something else has happened.
    pub fn notice(&mut self, text: &str) {
        if self.notices.len() < NOTICES_MAX {
            self.notices.push(text.to_string());
        }
    }

    /// What has happened since this was last asked.
    pub fn take(&mut self) -> Vec<String> {
        std::mem::take(&mut self.notices)
    }
}

/// A number with one decimal, and no sign before a zero.
fn tenths(metres: f64) -> String {
    format!("{:.1}", (10.0 * metres).round() / 10.0 + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use albacore_geometry::{Area, Heading};

    #[test]
    fn each_incident_is_told_once_and_so_is_its_end() {
        let area = Area::rectangle(Point::new(50.0, 0.0), Heading::NORTH, 20.0, 20.0);
        let mut incidents = Incidents::new(&[NoGo { name: "wreck".into(), area }]);
        for (north, aground) in [(0.0, false), (39.0, false), (40.0, false), (45.0, true), (45.0, true), (61.0, false)]
        {
            incidents.observe(Point::new(north, -0.01), 4.0, aground);
        }
        let told = [
            "entered the no-go zone `wreck` at 40.0 m north, 0.0 m east",
            "grounded at 45.0 m north, 0.0 m east, in 4.0 m of water",
            "came free of the bottom at 61.0 m north, 0.0 m east, in 4.0 m of water",
            "left the no-go zone `wreck` at 61.0 m north, 0.0 m east",
        ];
        assert_eq!(incidents.take(), told);
        assert!(incidents.take().is_empty());
    }
}
