//! How much a mission may write: lines of `log` and of `report`, as many as a person can want.

use crate::Event;
use serde::{Deserialize, Serialize};

/// Lines that a mission may write at once.
pub const LINES_AT_ONCE_MAX: i64 = 1_000;
/// Lines by which that grows again in each tick.
pub const LINES_A_TICK_MAX: i64 = 1;
/// Bytes of text, or of numbers, that count as a line: a longer text counts as several.
pub const LINE_BYTES: usize = 200;
/// Bytes of one text, of a `log` or an `abort`; what is longer is cut.
pub const TEXT_BYTES_MAX: usize = 10_000;
/// Having written too much, a mission writes again when it may write so many lines.
const AGAIN_AT: i64 = LINES_AT_ONCE_MAX / 10;

/// What a mission may still write, and what it has not written.
///
/// Whoever asks while anything is left may write, however much: the debt is paid before the next. So no single text is too
/// long for it, and yet nobody writes more than `LINES_A_TICK_MAX` for long.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Allowance {
    /// Lines; below zero a debt.
    left: i64,
    /// Since the allowance was used up: what was asked for and not written.
    unwritten: Option<u64>,
    /// For each place of the program that reports, whether it has.
    reported: Vec<bool>,
}

impl Allowance {
    /// All of it, for a program with so many places that report.
    pub fn new(sites: usize) -> Self {
        Allowance { left: LINES_AT_ONCE_MAX, unwritten: None, reported: vec![false; sites] }
    }

    /// A tick goes by. Tells what was not written, when writing begins again.
    pub fn tick(&mut self) -> Option<Event> {
        self.left = (self.left + LINES_A_TICK_MAX).min(LINES_AT_ONCE_MAX);
        if self.left < AGAIN_AT { None } else { self.end() }
    }

    /// Tells what was not written, if anything.
    pub fn end(&mut self) -> Option<Event> {
        self.unwritten.take().map(Event::Unwritten)
    }

    /// Whether a line may be written. The first that may not be is announced.
    pub fn admits(&mut self, events: &mut Vec<Event>) -> bool {
        if self.left > 0 && self.unwritten.is_none() {
            return true;
        }
        if self.unwritten.is_none() {
            events.push(Event::Silenced);
        }
        self.unwritten = Some(self.unwritten.unwrap_or(0).saturating_add(1));
        false
    }

    /// Whether a place may report. Its first report always may: tests and campaigns judge a run by that.
    pub fn admits_report(&mut self, site: u32, events: &mut Vec<Event>) -> bool {
        let first = self.reported.get_mut(site as usize).is_some_and(|reported| !std::mem::replace(reported, true));
        first || self.admits(events)
    }

    /// So many bytes were written.
    pub fn pay(&mut self, bytes: usize) {
        self.left -= bytes.div_ceil(LINE_BYTES).max(1) as i64;
    }
}
