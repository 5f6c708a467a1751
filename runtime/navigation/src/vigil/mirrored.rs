//! Whose zigzag it is that depth and altitude show: of a vehicle that is held by a noisy altitude the depth's is the vehicle's own, not
//! the noise of its gauge, and ends when it is held by its depth; and so the altitude's of one that is held by a noisy depth. Then each
//! shows the other's, mirrored, or follows what the other was: noise of its own does neither.

use super::Heard;

/// The means are taken over so many changes ...
const CHANGES: u64 = 300;
/// ... and tell nothing before so many.
const CHANGES_MIN: u64 = 30;
/// The zigzag is the vehicle's if this share of it is mirrored, or follows: all of it is mirrored where an altitude is commanded; a half
/// is, or follows, where the altitude is commanded that belongs to a greatest depth ...
const SHARE: f64 = 0.3;
/// ... and by no chance: by so many standard deviations of what changes show that have nothing to do with one another.
const SIGMAS: f64 = 4.0;

/// Depth and altitude of the last tick that told both, m, and what their changes have to do with one another.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Mirrored {
    last: Option<[f64; 2]>,
    /// The last changes of both.
    before: [f64; 2],
    depth: Changes,
    altitude: Changes,
}

/// Means of the changes of one, as far as there were any.
#[derive(Clone, Copy, Debug, Default)]
struct Changes {
    count: u64,
    /// Of the squares of its own, and of the other's.
    own: f64,
    others: f64,
    /// Of the products with those of the other at the same time, and just before.
    mirrored: f64,
    follows: f64,
}

impl Mirrored {
    pub fn look(&mut self, heard: &Heard) {
        let Some((depth, altitude)) = heard.depth.zip(heard.altitude) else { return };
        let now = [depth.reading[0], altitude.reading[0]];
        let Some(last) = self.last.replace(now) else { return };
        let [depth, altitude] = [now[0] - last[0], now[1] - last[1]];
        let [depth_before, altitude_before] = std::mem::replace(&mut self.before, [depth, altitude]);
        self.depth.learn(depth, altitude, altitude_before);
        self.altitude.learn(altitude, depth, depth_before);
    }

    /// Whether the changes of the depth are those of the vehicle.
    pub fn moves_depth(&self) -> bool {
        self.depth.are_the_vehicles()
    }

    /// Whether the changes of the altitude are those of the vehicle.
    pub fn moves_altitude(&self) -> bool {
        self.altitude.are_the_vehicles()
    }
}

impl Changes {
    fn learn(&mut self, own: f64, other: f64, other_before: f64) {
        if own == 0.0 {
            return;
        }
        self.count += 1;
        let share = 1.0 / self.count.min(CHANGES) as f64;
        self.own += share * (own * own - self.own);
        self.others += share * (other * other - self.others);
        self.mirrored += share * (own * other - self.mirrored);
        self.follows += share * (own * other_before - self.follows);
    }

    fn are_the_vehicles(&self) -> bool {
        let chance = SIGMAS * (self.own * self.others / self.count.min(CHANGES) as f64).sqrt();
        let shown = self.follows.abs().max(-self.mirrored);
        self.count >= CHANGES_MIN && shown > (SHARE * self.own).max(chance)
    }
}
