//! Whether the altitude is an echo of the bottom: of one the altitude becomes less as the vehicle dives.
//!
//! A sounder that tells the same however deep the vehicle is, to some centimetres, hears nothing, or itself. While the vehicle is
//! told to go deeper and does, an altitude that hardly becomes less is not believed any more, until it has changed and time has passed: one
//! that is told late is true once the vehicle has been level for longer than it is late. Where the bottom falls away as fast as the
//! vehicle dives it is true all the same: then the dive ends, the altitude grows, and is believed again.
//! What a vehicle keeps, by altitude or by the limit of one, may well stay the same: nothing is said of it.

use albacore_vehicle::{Command, Vertical};

/// A dive of so many metres tells whether the altitude follows it.
const DIVE_M: f64 = 1.5;
/// ... by this share of it at least.
const FOLLOWS_SHARE: f64 = 0.25;
/// An altitude that has changed by so much, m, tells of something again.
const CHANGES_M: f64 = 0.5;
/// ... once so many ticks have gone by: 15 s.
const SETTLES_TICKS: u64 = 150;
/// A vehicle that is told to go deeper by no more than this, m, keeps what it has.
const KEEPS_M: f64 = 0.5;

/// What is known of the echoes.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sounding {
    depth: Option<f64>,
    dive: Option<Dive>,
    /// What it has told since it is not believed, the least and the most, m, and since when that is.
    disbelieved: Option<((f64, f64), u64)>,
    told: Option<Told>,
}

/// A dive under way: depth and altitude where it began, m.
#[derive(Clone, Copy, Debug)]
struct Dive {
    depth: f64,
    altitude: f64,
}

/// What is told of the echoes.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Told {
    NoLess(f64),
    Changes,
}

impl Sounding {
    /// Takes in a depth that is believed.
    pub fn dive(&mut self, depth: f64) {
        self.depth = Some(depth);
    }

    /// Whether an altitude can be an echo, `command` being what the vehicle follows.
    pub fn believes(&mut self, tick: u64, altitude: f64, command: Option<&Command>) -> bool {
        let Some(depth) = self.depth.filter(|_| altitude.is_finite()) else { return true };
        if let Some((range, since)) = self.disbelieved {
            let range = wider(range, altitude);
            let changes = range.1 - range.0 >= CHANGES_M && tick >= since + SETTLES_TICKS;
            self.disbelieved = (!changes).then_some((range, since));
            self.dive = None;
            if changes {
                self.told = Some(Told::Changes);
            }
            return changes;
        }
        let dives = match command.map(|command| command.vertical) {
            Some(Vertical::Depth(goal)) => goal - depth > KEEPS_M,
            Some(Vertical::Altitude(goal)) => altitude - goal > KEEPS_M,
            None => false,
        };
        let dive = self.dive.filter(|dive| depth >= dive.depth).unwrap_or(Dive { depth, altitude });
        let (dived, fell) = (depth - dive.depth, dive.altitude - altitude);
        self.dive = dives.then_some(dive);
        if !dives || dived < DIVE_M {
            return true;
        }
        // What follows is looked at anew: it may fail in the middle of a dive.
        self.dive = None;
        let follows = fell >= FOLLOWS_SHARE * dived;
        if !follows {
            self.disbelieved = Some(((altitude, altitude), tick));
            self.told = Some(Told::NoLess(dived));
        }
        follows
    }

    /// What is to be told of it, since this was last asked.
    pub fn take_told(&mut self) -> Option<String> {
        self.told.take().map(|told| match told {
            Told::NoLess(dived) => format!("rejected: altitude, no less after a dive of {dived:.1} m"),
            Told::Changes => String::from("believed: altitude, changes again"),
        })
    }
}

/// A range with another altitude in it.
fn wider((least, most): (f64, f64), altitude: f64) -> (f64, f64) {
    (least.min(altitude), most.max(altitude))
}

#[cfg(test)]
mod tests;
