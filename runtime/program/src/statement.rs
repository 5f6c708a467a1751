//! Statements that tell when they begin: in the words of the script, with how far the loops around them are.

use crate::Slot;
use serde::{Deserialize, Serialize};

/// Words that the beginning of a statement tells of each loop around it: which round it is, counted from 1; of how many, or 0
/// where nobody knows beforehand; and the number that the loop counts, where it counts through a range.
pub const ROUND_WORDS: usize = 3;

/// A statement that takes time, and tells when it begins.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Statement {
    /// What it is told as.
    pub parts: Vec<StatementPart>,
    /// `file:line`.
    pub place: String,
    /// The loops around it, from outside in.
    pub loops: Vec<Loop>,
    /// It calls an activity, whose entering tells it; this tells the rounds alone.
    pub is_call: bool,
}

/// A part of what a statement is told as.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum StatementPart {
    /// As written.
    Text(String),
    /// Which round of a loop it is: `row 7 of 12`.
    Round(u32),
    /// The number that a loop counts.
    Count(u32),
}

/// A loop around a statement.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Loop {
    /// What a round of it is called.
    pub name: String,
    /// Where its rounds are.
    pub rounds: Rounds,
}

/// Where the rounds of a loop are counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Rounds {
    /// So many have begun.
    Begun(Slot),
    /// So many are behind it, of so many.
    Behind(Slot, Slot),
    /// It counts, from here, to there.
    Range {
        /// The number that it is at.
        at: Slot,
        /// The first.
        first: Slot,
        /// The last, or where it ends before.
        end: Slot,
        /// Whether the end is its last.
        inclusive: bool,
    },
}

impl Statement {
    /// What the innermost loop around it that walks something is at, such as `row 7`.
    pub fn walked(&self, words: &[f64]) -> Option<String> {
        let at = self.loops.iter().rposition(|around| matches!(around.rounds, Rounds::Behind(..)))?;
        Some(format!("{} {}", self.loops.get(at)?.name, words.get(at * ROUND_WORDS)?))
    }

    /// What it is told as, with the words of its loops; without them whatever its rounds are.
    pub fn told(&self, words: &[f64]) -> String {
        let round = |at: u32| words.get(at as usize * ROUND_WORDS..)?.first_chunk::<ROUND_WORDS>();
        let mut told = String::new();
        for part in &self.parts {
            match part {
                StatementPart::Text(text) => told.push_str(text),
                StatementPart::Round(at) => {
                    let name = self.loops.get(*at as usize).map_or("?", |around| &around.name);
                    told.push_str(&match round(*at) {
                        Some([number, 0.0, _]) => format!("{name} {number}"),
                        Some([number, count, _]) => format!("{name} {number} of {count}"),
                        None => name.to_string(),
                    });
                }
                StatementPart::Count(at) => {
                    told.push_str(&round(*at).map_or("…".to_string(), |[.., count]| count.to_string()))
                }
            }
        }
        told
    }
}
