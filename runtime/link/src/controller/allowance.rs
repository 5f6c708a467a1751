//! How much of what a vehicle brings about is told: as many lines as a person can want. It may say something else in every line.

/// Lines that are told at once.
const LINES_MAX: i64 = 100;
/// Ticks in which that grows again by a line.
const LINE_TICKS: u64 = 10;
/// Bytes that count as a line.
const LINE_BYTES: usize = 200;
/// After too much was said, it is told again when there is room for so many lines.
const AGAIN_AT: i64 = LINES_MAX / 10;

/// What may still be told, and what was not.
#[derive(Clone, Copy, Debug)]
pub(super) struct Allowance {
    /// Lines; below zero a debt.
    left: i64,
    untold: u64,
}

impl Default for Allowance {
    fn default() -> Self {
        Allowance { left: LINES_MAX, untold: 0 }
    }
}

impl Allowance {
    /// A tick goes by. Says what was not told, when telling begins again.
    pub fn tick(&mut self, tick: u64) -> Option<String> {
        if tick.is_multiple_of(LINE_TICKS) {
            self.left = (self.left + 1).min(LINES_MAX);
        }
        if self.left < AGAIN_AT { None } else { self.end() }
    }

    /// Says what was not told, if anything.
    pub fn end(&mut self) -> Option<String> {
        let untold = std::mem::take(&mut self.untold);
        (untold > 0).then(|| format!("{untold} more notices of the vehicle were not written"))
    }

    /// The text, if it may be told; the first that may not is announced in its place.
    pub fn admit(&mut self, text: String) -> Option<String> {
        if self.left > 0 && self.untold == 0 {
            self.left -= text.len().div_ceil(LINE_BYTES).max(1) as i64;
            return Some(text);
        }
        self.untold += 1;
        (self.untold == 1).then(|| "the vehicle says too much: it is counted, and no longer written".to_string())
    }
}
