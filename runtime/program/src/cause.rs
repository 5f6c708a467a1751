//! Why an activity was left, and how an override ended.

use serde::{Deserialize, Serialize};

/// Why an activity was left.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Cause {
    /// It came to its own end.
    Done,
    /// A rule of its table left it.
    Rule,
    /// `for` or `until` ended the statement that called it.
    Until,
    /// `within` cut it off.
    TimedOut,
    /// Something outside it ended.
    Preempted,
    /// The mission was aborted.
    Aborted,
    /// Of an override: the vehicle would not let us drive.
    Refused,
    /// Of an override: the vehicle did not answer in time.
    NoAnswer,
    /// Of an override: the vehicle took control back.
    TakenBack,
}

/// Words of the answer to an `ask`: how it ended, and its value.
pub const ANSWER_WORDS: u32 = 2;

/// How an override, or an `ask`, ended; in code its number, in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum OverrideEnd {
    /// Its block came to its end, or `for` or `until` ended it.
    Completed,
    /// The vehicle would not let us drive.
    Refused,
    /// The vehicle did not answer in time.
    NoAnswer,
    /// The vehicle took control back.
    TakenBack,
    /// `within` cut it off.
    TimedOut,
}

impl OverrideEnd {
    /// Its number in code.
    pub fn number(self) -> f64 {
        f64::from(self as u8)
    }

    /// The end of a number; what is none counts as its own.
    pub fn from_number(number: f64) -> Self {
        let ends = [Self::Completed, Self::Refused, Self::NoAnswer, Self::TakenBack, Self::TimedOut];
        ends.into_iter().find(|end| end.number() == number).unwrap_or(Self::Completed)
    }
}
