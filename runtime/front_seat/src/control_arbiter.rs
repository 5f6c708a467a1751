//! How a vehicle's own computer answers who asks to drive it.

use albacore_vehicle::Control;
use serde::{Deserialize, Serialize};

/// The answers. Times are seconds since tick 0; none is never.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Handover {
    /// How long it takes to give way, s.
    pub after: f64,
    /// Whether it refuses.
    pub refuses: bool,
    /// Whether it never answers.
    pub silent: bool,
    /// When it stops listening to who drives, s.
    pub suspends: Option<f64>,
    /// For how long, s.
    pub lasting: Option<f64>,
    /// When it takes control back from who drives by then, s.
    pub takes_back: Option<f64>,
    /// From when on it offers to be driven, s.
    pub offers: Option<f64>,
}

/// Who drives, as the computer sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Guest {
    /// Nobody but itself.
    None,
    /// One has asked, this many seconds after tick 0.
    Asks(f64),
    /// One drives, since then.
    Drives(f64),
    /// One was sent away, with this answer.
    Gone(Control),
}

/// The computer's side of a handover.
#[derive(Clone, Debug)]
pub(crate) struct ControlArbiter {
    handover: Handover,
    guest: Guest,
}

impl ControlArbiter {
    /// One that nobody has come to.
    pub fn new(handover: Handover) -> Self {
        ControlArbiter { handover, guest: Guest::None }
    }

    /// Whether it gives way at once.
    pub fn is_open(&self) -> bool {
        self.handover == Handover::default()
    }

    /// Whether a guest drives.
    pub fn is_passed(&self) -> bool {
        matches!(self.guest, Guest::Drives(_))
    }

    /// Somebody asks to drive, at a time in seconds; who asks again waits no longer for it.
    pub fn ask(&mut self, now: f64) {
        if matches!(self.guest, Guest::None | Guest::Gone(_)) {
            self.guest = Guest::Asks(now);
        }
    }

    /// Who asks has waited long enough, and takes that for a no.
    pub fn turn_away(&mut self) {
        if let Guest::Asks(_) = self.guest {
            self.guest = Guest::Gone(Control::Refused);
        }
    }

    /// The guest is gone: he has given the vehicle back, or is heard no more.
    pub fn leave(&mut self) {
        self.guest = Guest::None;
    }

    /// Who drives at a time in seconds. A vehicle whose own mission is over lets nobody drive any more.
    pub fn answer(&mut self, now: f64, is_over: bool) -> Control {
        let h = &self.handover;
        let since = |at: Option<f64>, begun: f64| at.is_some_and(|at| begun < at && now >= at);
        let suspended = h.suspends.zip(h.lasting).map(|(at, lasting)| at..at + lasting);
        match self.guest {
            Guest::None if h.offers.is_some_and(|at| now >= at) => Control::Offered,
            Guest::None => Control::Monitoring,
            Guest::Asks(_) if h.refuses || is_over => self.send_away(Control::Refused),
            Guest::Asks(_) if h.silent => Control::Requesting,
            Guest::Asks(begun) if now - begun < h.after => Control::Requesting,
            Guest::Asks(_) => {
                self.guest = Guest::Drives(now);
                Control::InControl
            }
            Guest::Drives(begun) if since(h.takes_back, begun) => self.send_away(Control::Released),
            Guest::Drives(_) if suspended.is_some_and(|suspended| suspended.contains(&now)) => Control::Suspended,
            Guest::Drives(_) => Control::InControl,
            Guest::Gone(answer) => answer,
        }
    }

    fn send_away(&mut self, answer: Control) -> Control {
        self.guest = Guest::Gone(answer);
        answer
    }
}
