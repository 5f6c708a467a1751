//! One of the set-points of a command: what is asked, whether the vehicle has taken it up, and when it is said again.

use super::ControllerSide;
use crate::set_point::SetPoint;
use std::mem::discriminant;

/// A goal that the vehicle has not taken up is sent again after this many ticks.
const UNCONFIRMED_TICKS: u64 = 2;
/// Every goal is sent again after this many ticks, twice a second: goals latch, but a vehicle may lose one, and it leaves who
/// is silent.
const AGAIN_TICKS: u64 = 5;
/// A goal that the vehicle has not taken up for this many ticks is one that it refuses.
const IGNORED_TICKS: u64 = 30;
/// Who has asked for nothing for this many ticks begins anew; fewer are ticks that came late.
const BREAK_TICKS: u64 = 5;

/// A goal: what is asked, and what the vehicle says that it holds.
#[derive(Clone, Debug, Default)]
pub(super) struct Goal {
    pub asked: Option<SetPoint>,
    /// The tick in which it was asked last.
    last: u64,
    /// What was sent last as it stands on the wire, and in which tick.
    pub sent: Option<(String, u64)>,
    /// What the vehicle reported last.
    pub held: Option<Held>,
    /// The last tick in which the two agreed.
    agreed: u64,
    told: bool,
}

/// What a vehicle says that it holds.
#[derive(Clone, Debug)]
pub(super) enum Held {
    /// A set-point as we ask for them.
    SetPoint(SetPoint),
    /// One of another kind or unit, in the vehicle's words: never what was asked.
    Other(String),
}

impl Goal {
    /// Takes in what is asked in a tick; gives what to tell when the vehicle has not taken it up for too long.
    pub fn ask(&mut self, set_point: SetPoint, now: u64, side: &dyn ControllerSide) -> Option<String> {
        let begins = self.asked.is_none() || self.last + BREAK_TICKS < now;
        self.last = now;
        let agree = match self.held {
            Some(Held::SetPoint(held)) if discriminant(&held) == discriminant(&set_point) => set_point.is_held_as(held),
            // A depth says nothing of an altitude.
            Some(Held::SetPoint(_)) => {
                self.held = None;
                false
            }
            Some(Held::Other(_)) | None => false,
        };
        self.asked = Some(set_point);
        if agree || begins {
            self.agreed = now;
            self.told = false;
        }
        if self.told || now - self.agreed <= IGNORED_TICKS {
            return None;
        }
        self.told = true;
        let holds = match &self.held {
            Some(Held::SetPoint(held)) => format!(" and says `{}`", side.text(*held)),
            Some(Held::Other(held)) => format!(" and says `{held}`"),
            None => String::new(),
        };
        Some(format!("the vehicle does not follow `{}`{holds}; it may be protecting itself", side.text(set_point)))
    }

    /// The text to send, if it is time: it has changed, was not taken up, or was sent half a second ago.
    pub fn due(&self, now: u64, side: &dyn ControllerSide) -> Option<String> {
        let asked = side.text(self.asked.filter(|_| self.last == now)?);
        let Some((sent, tick)) = &self.sent else { return Some(asked) };
        let again = if self.agreed == now { AGAIN_TICKS } else { UNCONFIRMED_TICKS };
        (*sent != asked || now - tick >= again).then_some(asked)
    }
}
