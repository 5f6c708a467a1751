//! Where a position lies along a path, and how far off it.

use super::{Path, Pose};
use albacore_geometry::Point;
use albacore_geometry::math::PI;

/// The foot of a position on a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    /// Metres along the path.
    pub distance: f64,
    /// Metres from the path to the position, positive to the left of it.
    pub left: f64,
}

impl Path {
    /// Projects a position on the path, looking only ahead of `from` metres along it.
    ///
    /// A path may cross itself and come near its own start again, so the foot is found piece by piece onward from
    /// where the last one was, and never moves back.
    pub fn project(&self, position: Point, from: f64) -> Projection {
        let mut begin = 0.0;
        let mut pose = self.start;
        let mut found = Projection { distance: 0.0, left: 0.0 };
        for (turn, length) in self.pieces() {
            // Not `clamp`, which panics on a bound that is not a number.
            let skipped = (from - begin).max(0.0).min(length);
            let foot = skipped + ahead(pose.advanced(turn, self.radius, skipped), turn, self.radius, position).max(0.0);
            found = Projection { distance: begin + foot.min(length), left: left_of(pose, turn, self.radius, position) };
            if foot < length {
                break;
            }
            pose = pose.advanced(turn, self.radius, length);
            begin += length;
        }
        found
    }
}

/// Metres from a pose to the foot of a position on the line or circle through the pose, within half a turn of it.
fn ahead(pose: Pose, turn: f64, radius: f64, position: Point) -> f64 {
    if turn == 0.0 {
        return (position - pose.point).along(pose.heading);
    }
    let heading = (position - pose.center(turn, radius)).toward() + turn * PI / 2.0;
    turn * (heading - pose.heading) * radius
}

/// Metres by which a position is left of the line or circle through a pose.
fn left_of(pose: Pose, turn: f64, radius: f64, position: Point) -> f64 {
    if turn == 0.0 {
        return -(position - pose.point).right_of(pose.heading);
    }
    turn * (position.distance(pose.center(turn, radius)) - radius)
}
