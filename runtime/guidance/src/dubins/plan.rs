//! Finds the paths between two poses from their turning circles.
//!
//! With s = 1 for a right and -1 for a left turn, the circle of a pose has its centre s R to the right of it, and a
//! vehicle on the circle heads psi where it stands s R to the left of the centre. Everything below follows from these
//! two.

use super::{Path, Pose, Word, Words};
use albacore_geometry::Heading;
use albacore_geometry::math::{TAU, asin, atan2};

/// A smaller radius, in metres, counts as this one.
const RADIUS_MIN_M: f64 = 1e-6;

/// An arc this near to a whole turn, in radians, is no arc: rounding put its end a hair before its start.
const ARC_SNAP: f64 = 1e-9;

/// Circles whose centres are this near, in turning radii, are one circle.
const COINCIDENT: f64 = 1e-9;

/// Circles that touch may be this much too near, relative to the distance at which they touch.
const TOUCHING: f64 = 1e-12;

/// A later word must be this many metres shorter to be preferred, so that rounding does not choose between equals.
const TIE_M: f64 = 1e-9;

/// The path of one word from `start` to `goal` with arcs of `radius` metres, or `None` where the word does not reach.
///
/// LSL and RSR always do; LSR and RSL while their circles do not overlap; RLR and LRL up to four radii between the
/// circles.
pub fn path(start: Pose, goal: Pose, radius: f64, word: Word) -> Option<Path> {
    // The comparison also sends NaN to the minimum.
    let radius = if radius > RADIUS_MIN_M { radius } else { RADIUS_MIN_M };
    let lengths = match word.turns() {
        [first, 0.0, last] => with_line(start, goal, radius, first, last)?,
        [outer, ..] => with_arc(start, goal, radius, outer)?,
    };
    Some(Path { start, radius, word, lengths })
}

/// The shortest path from `start` to `goal` by one of the `words`, with arcs of `radius` metres.
pub fn shortest(start: Pose, goal: Pose, radius: f64, words: Words) -> Path {
    let outer = Path { start, radius: RADIUS_MIN_M, word: Word::Lsl, lengths: [0.0; 3] };
    let first = path(start, goal, radius, Word::Lsl).unwrap_or(outer);
    let others = words.members().iter().filter_map(|&word| path(start, goal, radius, word));
    others.fold(first, |best, next| if next.length() < best.length() - TIE_M { next } else { best })
}

/// The three lengths of arc, straight line, arc.
fn with_line(start: Pose, goal: Pose, radius: f64, first: f64, last: f64) -> Option<[f64; 3]> {
    let between = goal.center(last, radius) - start.center(first, radius);
    let distance = between.length();
    // Seen along the line, the second centre lies this far to the right of the first: 0 or +-2 R.
    let offset = (last - first) * radius;
    if distance < offset.abs() * (1.0 - TOUCHING) {
        return None;
    }
    let (heading, line) = if offset == 0.0 && distance <= COINCIDENT * radius {
        // One circle: the line has shrunk to nothing and its direction with it. The first arc is then left out.
        (start.heading, 0.0)
    } else {
        let line = (distance * distance - offset * offset).max(0.0).sqrt();
        (between.toward() - atan2(offset, line), line)
    };
    Some([radius * arc(start.heading, heading, first), line, radius * arc(heading, goal.heading, last)])
}

/// The three lengths of arc, opposite arc, arc. Of the two circles that touch both outer ones the path takes the one on
/// which it turns by more than half: by less is never the shortest.
fn with_arc(start: Pose, goal: Pose, radius: f64, outer: f64) -> Option<[f64; 3]> {
    let between = goal.center(outer, radius) - start.center(outer, radius);
    let distance = between.length();
    if distance > 4.0 * radius * (1.0 + TOUCHING) {
        return None;
    }
    if distance <= COINCIDENT * radius {
        // One circle: the middle arc is a whole turn, and a whole turn is none.
        return Some([0.0, 0.0, radius * arc(start.heading, goal.heading, outer)]);
    }
    // The middle centre is 2 R from both others, so their distance is the chord 4 R sin(middle / 2).
    let middle = TAU - 2.0 * asin(distance / (4.0 * radius));
    let chord = between.toward();
    let (from, to) = (chord + outer * middle / 2.0, chord - outer * middle / 2.0);
    Some([radius * arc(start.heading, from, outer), radius * middle, radius * arc(to, goal.heading, outer)])
}

/// The angle in [0, 2 pi) turned from one heading to another by going right (`turn` = 1) or left (-1) only.
fn arc(from: Heading, to: Heading, turn: f64) -> f64 {
    let angle = Heading::from_radians(turn * (to.radians() - from.radians())).radians();
    if angle > TAU - ARC_SNAP { 0.0 } else { angle }
}
