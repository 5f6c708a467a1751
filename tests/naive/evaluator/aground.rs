//! Rule 17: a vehicle on the bottom, and what a mission counts as whose vehicle lies there or has lain there.

use super::mission::Evaluator;

/// One that has lain there for so long while the mission drove it is stranded: 30 s.
const STRANDED_TICKS: u64 = 300;
/// One that lies there for so long in all was not only launched from there: 10 s.
const LAUNCHED_TICKS: u64 = 100;

#[derive(Default)]
pub(super) struct Aground {
    lies: bool,
    /// For how many ticks it has lain there while it was driven.
    driven: u64,
    /// It was driven and swam in the last tick; it came down on the bottom while it was driven.
    swam: bool,
    struck: bool,
    /// The least depth at which it has lain, m.
    pub least: Option<f64>,
}

impl Evaluator<'_> {
    pub(super) fn feel_bottom(&mut self, lies: bool) {
        let (drives, depth) = (self.w.control.drives(), self.w.depth().unwrap_or(0.0));
        let aground = &mut self.aground;
        aground.lies = lies;
        aground.driven += u64::from(drives && lies);
        aground.struck |= drives && lies && aground.swam;
        aground.swam = drives && !lies;
        if lies {
            aground.least = Some(aground.least.map_or(depth, |least: f64| least.min(depth)));
        }
    }
}

impl Aground {
    pub fn is_stranded(&self) -> bool {
        self.driven > STRANDED_TICKS
    }

    /// How a mission was aground that would end so.
    pub fn spoils(&self, outcome: &str) -> Option<&'static str> {
        match outcome {
            "completed" | "timed_out" | "aborted" if self.lies => Some("lies on"),
            "completed" if self.struck => Some("struck"),
            "completed" if self.driven >= LAUNCHED_TICKS => Some("has lain on"),
            _ => None,
        }
    }
}
