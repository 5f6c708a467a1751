//! What the checker takes the words of variables to be, as far as it is more than "any number".

use crate::{Addr, Slot};
use albacore_arithmetic::Interval;
use std::ops::Range;

/// All claims of a program.
#[derive(Clone, Debug, Default)]
pub struct Claims {
    /// What has a frame: functions and activities of the left margin.
    pub units: Vec<Unit>,
    /// Of the words of inputs, by absolute slots.
    pub inputs: Vec<Claim>,
    /// What an instruction leaves where its type says more than can be computed: after it, in the unit's frame.
    pub typed: Vec<(Addr, Claim)>,
    /// Pieces of code that no part of the program names.
    pub pieces: Vec<Addr>,
}

/// What has a frame.
#[derive(Clone, Debug, Default)]
pub struct Unit {
    /// Its code.
    pub code: Range<Addr>,
    /// The words of its frame.
    pub words: u32,
    /// Of its variables.
    pub claims: Vec<Claim>,
    /// Its variables that are lists: where they are, and how many words.
    pub lists: Vec<(Slot, u32)>,
    /// Its variables that stand for a whole tick: parameters, signals and what `let` names.
    pub standing: Vec<(Slot, u32)>,
}

/// What a word is taken to be.
#[derive(Clone, Copy, Debug)]
pub struct Claim {
    /// The word.
    pub slot: Slot,
    /// Its values.
    pub range: Interval,
    /// By its type it is a whole number.
    pub is_whole: bool,
    /// It means something only where this word is not 0.
    pub present: Option<Slot>,
    /// It belongs to a parameter: whoever calls has to keep to it.
    pub is_param: bool,
}
