//! What of a snapshot is believed, in one place between vehicle and mission: simulated or at the end of a link.
//!
//! The watch looks at all that came and steers nothing, with one exception: an altitude that it knows to be stuck is withheld, so
//! that the limits of the mission take the bottom for lost. So is one that does not follow a dive, or is told of a vehicle that lies on the bottom. The gate withholds what cannot
//! have happened, until it persists. What is withheld stays in the snapshot, marked, so that a journal holds all that came and all that was believed.

use crate::gate::Gate;
use crate::sounding::Sounding;
use crate::vigil::{Kind, Sight, Vigil};
use albacore_vehicle::channels::{ALTITUDE, DEPTH, WATER_DEPTH};
use albacore_vehicle::{Command, Snapshot};

/// What is believed in one run: a function of what came and what was commanded.
#[derive(Clone, Debug, Default)]
pub struct Trust {
    vigil: Vigil,
    gate: Gate,
    sounding: Sounding,
}

impl Trust {
    /// Looks at what came in a tick, `command` being the last that was sent, and withholds what is not believed of it; gives what a
    /// person should hear.
    pub fn look(&mut self, tick: u64, snapshot: &mut Snapshot, command: Option<&Command>) -> Vec<String> {
        let mut told: Vec<String> = Vec::new();
        told.extend(self.vigil.look(tick, snapshot, command).iter().map(ToString::to_string));
        let altitude_is_stuck = self.vigil.sees(Sight::Stuck(Kind::Altitude));
        // The depth of the water is the sum of the two.
        let mut water_is_doubtful = altitude_is_stuck;
        let aground = snapshot.aground;
        for sample in &mut snapshot.samples {
            let believed = match sample.channel {
                WATER_DEPTH => !water_is_doubtful,
                ALTITUDE if altitude_is_stuck => false,
                channel => self.gate.believes(tick, channel, sample.reading),
            };
            let believed = match sample.channel {
                DEPTH if believed && sample.reading[0].is_finite() => {
                    self.sounding.dive(sample.reading[0]);
                    true
                }
                ALTITUDE => believed && self.sounding.believes(tick, sample.reading[0], command, aground),
                _ => believed,
            };
            if !believed {
                water_is_doubtful |= matches!(sample.channel, DEPTH | ALTITUDE);
                sample.withhold();
            }
        }
        told.extend(self.gate.take_told().iter().map(ToString::to_string));
        told.extend(self.sounding.take_told());
        told
    }
}
