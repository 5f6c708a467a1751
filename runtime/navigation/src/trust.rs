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
        // Depth and altitude tell of one another: with a depth that stands still nothing is known of the bottom.
        let depth_is_stuck = self.health.sees(Anomaly::Stuck(DEPTH));
        let is_misplaced = MISPLACED.iter().any(|anomaly| self.health.sees(*anomaly));
        // What is made of others is doubtful with them, and so it is looked at after them.
        let altitude_is_stuck = self.health.sees(Anomaly::Stuck(ALTITUDE));
        let mut doubtful: Vec<u16> = altitude_is_stuck.then_some(ALTITUDE).into_iter().collect();
        let sources = |sample: &Sample| info(sample.origin()).sources;
        for made in [false, true] {
            for sample in snapshot.samples.iter_mut().filter(|sample| sources(sample).is_empty() != made) {
                let believed = !sources(sample).iter().any(|source| doubtful.contains(source))
                    && (!altitude_is_stuck || sample.measurement != ALTITUDE)
                    && self.gate.believes(tick, sample.measurement, sample.reading);
                if !believed {
                    doubtful.push(sample.measurement);
                    sample.withhold();
                } else if !self.sounds(tick, sample, command, snapshot.aground)
                    || depth_is_stuck && sample.measurement == ALTITUDE
                    || is_misplaced && sample.measurement == POSITION
                {
                    sample.doubt();
                }
            }
        }
        events.extend(self.gate.take_events().iter().map(ToString::to_string));
        events.extend(self.sounding.take_event());
        events
    }

    /// Whether a sample that the gate believes can be what the sounder hears.
    fn sounds(&mut self, tick: u64, sample: &Sample, command: Option<&Command>, aground: bool) -> bool {
        let number = sample.reading[0];
        match sample.measurement {
            DEPTH if number.is_finite() => self.sounding.dive(number),
            ALTITUDE => return self.sounding.believes(tick, number, command, aground),
            _ => {}
        }
        true
    }
}

#[cfg(test)]
mod tests;
