//! Paths of bounded curvature between two poses: three pieces, each an arc of the turning circle or a straight line.
//!
//! After L. E. Dubins, "On curves of minimal length with a constraint on average curvature", Amer. J. Math. 79
//! (1957). The 2005 paper (appendix A.3) uses the four words with a straight line in the middle; they are the default
//! here.

mod plan;
mod project;

pub use plan::{path, shortest};
pub use project::Projection;

use crate::words::{Reader, Writer};
use albacore_geometry::math::PI;
use albacore_geometry::{Heading, Point, Vector};

/// A place and the direction of travel through it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Where.
    pub point: Point,
    /// Which way.
    pub heading: Heading,
}

/// The kinds of the three pieces: `L` an arc to the left, `S` a straight line, `R` an arc to the right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say all there is to say")]
pub enum Word {
    Lsl,
    Rsr,
    Lsr,
    Rsl,
    Rlr,
    Lrl,
}

/// Which words a path may be chosen from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Words {
    /// The four with a straight line in the middle: the 2005 paper's choice, simple, but at times not the shortest.
    #[default]
    Csc,
    /// All six: the shortest path there is.
    Full,
}

/// A path of three pieces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Path {
    /// Where it begins.
    pub start: Pose,
    /// The radius of its arcs in metres.
    pub radius: f64,
    /// The kinds of its pieces.
    pub word: Word,
    /// The lengths of its pieces in metres; an absent piece has length zero.
    pub lengths: [f64; 3],
}

impl Pose {
    /// The pose after so many metres on an arc to the right (`turn` = 1), to the left (-1) or straight on (0).
    pub(crate) fn advanced(self, turn: f64, radius: f64, distance: f64) -> Pose {
        if turn == 0.0 {
            return Pose { point: self.point + distance * self.heading.unit(), heading: self.heading };
        }
        let heading = self.heading + turn * distance / radius;
        Pose { point: self.center(turn, radius) - (turn * radius) * starboard(heading), heading }
    }

    /// The centre of the turning circle to the right (`turn` = 1) or left (-1).
    pub(crate) fn center(self, turn: f64, radius: f64) -> Point {
        self.point + (turn * radius) * starboard(self.heading)
    }
}

impl Word {
    /// Every word, the paper's four first.
    pub const ALL: [Word; 6] = [Word::Lsl, Word::Rsr, Word::Lsr, Word::Rsl, Word::Rlr, Word::Lrl];

    /// For each piece: 1 turns right, -1 turns left, 0 runs straight.
    pub fn turns(self) -> [f64; 3] {
        match self {
            Word::Lsl => [-1.0, 0.0, -1.0],
            Word::Rsr => [1.0, 0.0, 1.0],
            Word::Lsr => [-1.0, 0.0, 1.0],
            Word::Rsl => [1.0, 0.0, -1.0],
            Word::Rlr => [1.0, -1.0, 1.0],
            Word::Lrl => [-1.0, 1.0, -1.0],
        }
    }
}

impl Words {
    /// The words of the set.
    pub fn members(self) -> &'static [Word] {
        match self {
            Words::Csc => &[Word::Lsl, Word::Rsr, Word::Lsr, Word::Rsl],
            Words::Full => &Word::ALL,
        }
    }
}

impl Path {
    /// How many words the path takes.
    pub const WORDS: usize = 8;

    /// Its length in metres.
    pub fn length(&self) -> f64 {
        self.lengths[0] + self.lengths[1] + self.lengths[2]
    }

    /// The pose so many metres along; the first before the start, the last beyond the end.
    pub fn pose_at(&self, distance: f64) -> Pose {
        let mut pose = self.start;
        let mut left = distance.max(0.0);
        for (turn, length) in self.pieces() {
            let run = left.min(length);
            pose = pose.advanced(turn, self.radius, run);
            left -= run;
        }
        pose
    }

    /// The turn and the length of each piece.
    pub(crate) fn pieces(&self) -> [(f64, f64); 3] {
        let ([a, b, c], [l, m, n]) = (self.word.turns(), self.lengths);
        [(a, l), (b, m), (c, n)]
    }

    /// The path as plain numbers.
    #[inline]
    pub fn to_words(self) -> [f64; Self::WORDS] {
        let word = Word::ALL.iter().position(|&w| w == self.word).unwrap_or(0);
        Writer::new()
            .point(self.start.point)
            .heading(self.start.heading)
            .number(self.radius)
            .number(word as f64)
            .numbers(&self.lengths)
            .finish()
    }

    /// The path back from its numbers.
    #[inline]
    pub fn from_words(words: &[f64; Self::WORDS]) -> Self {
        let mut reader = Reader::new(words);
        Path {
            start: Pose { point: reader.point(), heading: reader.heading() },
            radius: reader.number(),
            word: Word::ALL.get(reader.number() as usize).copied().unwrap_or(Word::Lsl),
            lengths: reader.numbers(),
        }
    }
}

/// The unit vector to the right of a heading.
fn starboard(heading: Heading) -> Vector {
    (heading + PI / 2.0).unit()
}
