//! Whose zigzag it is that the depth shows: of a vehicle that is held by a noisy altitude it is the vehicle's own, not the noise of its
//! gauge, and ends when it is held by its depth. Then the altitude shows it too, mirrored, or the depth follows what the altitude was:
//! noise of the gauge does neither.

use super::Heard;
use super::noise::share;

/// The means are taken over so many changes of the depth ...
const CHANGES: u64 = 300;
/// ... and tell nothing before so many.
const CHANGES_MIN: u64 = 30;
/// The zigzag is the vehicle's if this share of it is mirrored, or follows: all of it is mirrored where an altitude is commanded; a half
/// is, or follows, where the altitude is commanded that belongs to a greatest depth ...
const SHARE: f64 = 0.3;
/// ... and by no chance: by so many standard deviations of what changes show that have nothing to do with one another.
const SIGMAS: f64 = 4.0;

/// Depth and altitude of the last tick that told both, m, and means of their changes.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Mirrored {
    last: Option<(f64, f64)>,
    changes: u64,
    /// The last change of the altitude.
    altitude: f64,
    /// Means of the squares.
    depths: f64,
    altitudes: f64,
    /// Means of the products of the depth's changes with those of the altitude at the same time, and just before.
    mirrored: f64,
    follows: f64,
}

impl Mirrored {
    pub fn look(&mut self, heard: &Heard) {
        let Some((depth, altitude)) = heard.depth.zip(heard.altitude) else { return };
        let now = (depth.reading[0], altitude.reading[0]);
        let Some(last) = self.last.replace(now) else { return };
        let (depth, altitude) = (now.0 - last.0, now.1 - last.1);
        let before = std::mem::replace(&mut self.altitude, altitude);
        if depth == 0.0 {
            return;
        }
        self.changes += 1;
        let share = share(self.changes, CHANGES);
        self.depths += share * (depth * depth - self.depths);
        self.altitudes += share * (altitude * altitude - self.altitudes);
        self.mirrored += share * (depth * altitude - self.mirrored);
        self.follows += share * (depth * before - self.follows);
    }

    /// Whether the changes of the depth are those of the vehicle.
    pub fn is_the_vehicles(&self) -> bool {
        let own = self.follows.abs().max(-self.mirrored);
        // A root is asked for where it matters.
        let chance = || SIGMAS * (self.depths * self.altitudes / self.changes.min(CHANGES) as f64).sqrt();
        self.changes >= CHANGES_MIN && own > SHARE * self.depths && own > chance()
    }
}
