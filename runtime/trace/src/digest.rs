//! The digest: 64 bits that tell two full-rate runs apart.

mod form;

use serde::Serialize;

/// An odd number with well-mixed bits: the fraction of the golden ratio.
const MULTIPLIER: u64 = 0x9e37_79b9_7f4a_7c15;
/// Where every digest begins: the first digits of pi, in hexadecimal.
const START: u64 = 0x243f_6a88_85a3_08d3;

/// A running hash over the words of a run.
///
/// Each step is a bijection of the state for a given word, and of the word for a given state: two runs that differ in a
/// single word always differ in their digest, others but for one case in 2^64. Words are numbers, not bytes, so the result
/// is the same on every machine. It guards against accidents; it is no cryptographic hash and proves nothing against intent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Digest {
    state: u64,
    words: u64,
}

impl Default for Digest {
    fn default() -> Self {
        Digest::new()
    }
}

impl Digest {
    /// The digest of nothing yet.
    pub const fn new() -> Self {
        Digest { state: START, words: 0 }
    }

    /// Takes a word in.
    #[inline]
    pub fn word(&mut self, word: u64) {
        // The sign and the exponent of a float are its top bits; a product only carries upward. Hence the shift before it.
        let mut state = self.state ^ word;
        state ^= state >> 32;
        state = state.wrapping_mul(MULTIPLIER);
        self.state = state ^ (state >> 29);
        self.words += 1;
    }

    /// Takes a number in. Zeros of either sign are one number, and so is all that is not a number: those bits depend on
    /// the machine and on the order of the operands, not on the run.
    #[inline]
    pub fn number(&mut self, x: f64) {
        let canonical = if x.is_nan() { f64::NAN.to_bits() & !(1 << 63) } else { (x + 0.0).to_bits() };
        self.word(canonical);
    }

    /// Takes numbers in, one after the other. Their count is not part of it.
    #[inline]
    pub fn numbers(&mut self, xs: &[f64]) {
        xs.iter().for_each(|&x| self.number(x));
    }

    /// Takes a text in: its length in bytes, then its bytes, eight to a word.
    pub fn text(&mut self, text: &str) {
        self.bytes(text.as_bytes());
    }

    /// Takes bytes in, as those of a text.
    pub fn bytes(&mut self, bytes: &[u8]) {
        self.word(bytes.len() as u64);
        for chunk in bytes.chunks(8) {
            self.word(chunk.iter().rev().fold(0, |word, &byte| (word << 8) | u64::from(byte)));
        }
    }

    /// Takes a value in, part by part (`form.rs` states how).
    ///
    /// # Errors
    ///
    /// It holds a list whose length is not known beforehand.
    pub fn value_of(&mut self, value: &impl Serialize) -> Result<(), std::fmt::Error> {
        value.serialize(self)
    }

    /// The digest of all that was taken in so far.
    pub fn value(&self) -> u64 {
        let mut end = *self;
        end.word(self.words);
        end.word(START);
        end.state
    }
}

/// Sixteen hexadecimal digits.
impl std::fmt::Display for Digest {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:016x}", self.value())
    }
}
