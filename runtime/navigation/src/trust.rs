//! What of a snapshot is believed, in one place between vehicle and mission: simulated or at the end of a link.
//!
//! The watch looks at all that came and steers nothing, with one exception: an altitude that it knows to be stuck is withheld, so
//! that the limits of the mission take the bottom for lost. The gate withholds what cannot have happened, until it persists. An
//! altitude that does not follow a dive, or is told of a vehicle that lies on the bottom or has a stuck depth, is doubted: limits
//! do without it, and inputs take it, for down a slope a good one looks the same. So is a position that the watch sees anything
//! against: no survey tells the depth of the water there. All of it stays in the snapshot, marked, so that a
//! journal holds what came and what was believed.

use crate::gate::Gate;
use crate::health::{Anomaly, HealthMonitor};
use crate::sounding::Sounding;
use albacore_vehicle::measurements::{ALTITUDE, DEPTH, POSITION, info};
use albacore_vehicle::{Command, Sample, Snapshot};

/// What speaks against a position.
const MISPLACED: [Anomaly; 4] =
    [Anomaly::Stuck(POSITION), Anomaly::Jumps(POSITION), Anomaly::SpeedAgainstPosition, Anomaly::CourseAgainstPosition];

/// What samples are held against in a tick.
#[derive(Clone, Copy)]
struct Look<'a> {
    tick: u64,
    command: Option<&'a Command>,
    aground: bool,
    depth_is_stuck: bool,
    altitude_is_stuck: bool,
    is_misplaced: bool,
}

/// What is believed in one run: a function of what came and what was commanded.
#[derive(Clone, Debug, Default)]
pub struct Trust {
    health: HealthMonitor,
    gate: Gate,
    sounding: Sounding,
}

impl Trust {
    /// Looks at what came in a tick, `command` being the last that was sent, and marks what is not believed of it; gives what a
    /// person should hear.
    pub fn look(&mut self, tick: u64, snapshot: &mut Snapshot, command: Option<&Command>) -> Vec<String> {
        let mut events: Vec<String> = Vec::new();
        events.extend(self.health.look(tick, snapshot, command).iter().map(ToString::to_string));
        let altitude_is_stuck = self.health.sees(Anomaly::Stuck(ALTITUDE));
        let look = Look {
            tick,
            command,
            aground: snapshot.aground,
            // Depth and altitude tell of one another: with a depth that stands still nothing is known of the bottom.
            depth_is_stuck: self.health.sees(Anomaly::Stuck(DEPTH)),
            altitude_is_stuck,
            is_misplaced: MISPLACED.iter().any(|anomaly| self.health.sees(*anomaly)),
        };
        let mut doubtful: Vec<u16> = altitude_is_stuck.then_some(ALTITUDE).into_iter().collect();
        // What is made of others is doubtful with them, and so it is looked at after them.
        let mut some_are_made = false;
        for made in [false, true] {
            if made && !some_are_made {
                break;
            }
            for sample in &mut snapshot.samples {
                let sources = info(sample.origin()).sources;
                if sources.is_empty() == made {
                    some_are_made |= !made;
                    continue;
                }
                if sources.iter().any(|source| doubtful.contains(source)) || !self.believes(sample, &look) {
                    doubtful.push(sample.measurement);
                    sample.withhold();
                } else if !self.sounds(sample, &look)
                    || look.depth_is_stuck && sample.measurement == ALTITUDE
                    || look.is_misplaced && sample.measurement == POSITION
                {
                    sample.doubt();
                }
            }
        }
        events.extend(self.gate.take_events().iter().map(ToString::to_string));
        events.extend(self.sounding.take_event());
        events
    }

    /// Whether a sample is believed that is made of nothing doubtful.
    fn believes(&mut self, sample: &Sample, look: &Look) -> bool {
        (!look.altitude_is_stuck || sample.measurement != ALTITUDE)
            && self.gate.believes(look.tick, sample.measurement, sample.reading)
    }

    /// Whether a sample that the gate believes can be what the sounder hears.
    fn sounds(&mut self, sample: &Sample, look: &Look) -> bool {
        let number = sample.reading[0];
        match sample.measurement {
            DEPTH if number.is_finite() => self.sounding.dive(number),
            ALTITUDE => return self.sounding.believes(look.tick, number, look.command, look.aground),
            _ => {}
        }
        true
    }
}

#[cfg(test)]
mod tests;
