//! One of the three goals of an override: what is asked, whether the vehicle has taken it up, and when it is said again.

use super::message::{SpeedGoal, ToVehicle};
use albacore_geometry::math::radians;
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
/// How far what the vehicle holds may be from what was asked: what a goal that moves comes to while it is on its way. In
/// degrees (the command filter lets a heading turn by 10 a second), m, and m/s.
const HEADING_SLACK_DEG: f64 = 10.0;
const HEIGHT_SLACK: f64 = 0.5;
const SPEED_SLACK: f64 = 0.2;

/// A goal: what is asked, and what the vehicle says that it holds.
#[derive(Clone, Debug, Default)]
pub(super) struct Goal {
    pub asked: Option<ToVehicle>,
    /// The tick in which it was asked last.
    last: u64,
    /// What was sent last, and in which tick.
    pub sent: Option<(String, u64)>,
    /// What the vehicle reported last.
    pub held: Option<ToVehicle>,
    /// The last tick in which the two agreed.
    agreed: u64,
    told: bool,
}

impl Goal {
    /// Takes in what is asked in a tick; gives what to tell when the vehicle has not taken it up for too long.
    pub fn ask(&mut self, message: ToVehicle, now: u64) -> Option<String> {
        let begins = self.asked.is_none() || self.last + BREAK_TICKS < now;
        self.last = now;
        // A depth says nothing of an altitude.
        self.held = self.held.take().filter(|held| discriminant(held) == discriminant(&message));
        let agree = self.held.as_ref().is_some_and(|held| agree(held, &message));
        let asked = self.asked.insert(message);
        if agree || begins {
            self.agreed = now;
            self.told = false;
        }
        if self.told || now - self.agreed <= IGNORED_TICKS {
            return None;
        }
        self.told = true;
        let holds = self.held.as_ref().map(|held| format!(" and says `#{held}`")).unwrap_or_default();
        Some(format!("the vehicle does not follow `#{asked}`{holds}; it may be protecting itself"))
    }

    /// The text to send, if it is time: it has changed, was not taken up, or was sent half a second ago.
    pub fn due(&self, now: u64) -> Option<String> {
        let asked = self.asked.as_ref().filter(|_| self.last == now)?.to_string();
        let Some((sent, tick)) = &self.sent else { return Some(asked) };
        let again = if self.agreed == now { AGAIN_TICKS } else { UNCONFIRMED_TICKS };
        (*sent != asked || now - tick >= again).then_some(asked)
    }
}

/// Whether what the vehicle holds is what was asked.
fn agree(held: &ToVehicle, asked: &ToVehicle) -> bool {
    match (held, asked) {
        (ToVehicle::Heading(a), ToVehicle::Heading(b)) => (*a - *b).abs() <= radians(HEADING_SLACK_DEG),
        (ToVehicle::Depth(a), ToVehicle::Depth(b)) | (ToVehicle::Altitude(a), ToVehicle::Altitude(b)) => {
            (a - b).abs() <= HEIGHT_SLACK
        }
        (ToVehicle::Speed(SpeedGoal::MetresPerSecond(a)), ToVehicle::Speed(SpeedGoal::MetresPerSecond(b))) => {
            (a - b).abs() <= SPEED_SLACK
        }
        _ => false,
    }
}
