//! What the controller says: who is to drive, its goals, and that it is there.

use super::late::Late;
use super::{Controller, Given, Want};
use crate::recon::frame::seal;
use crate::recon::message::{SpeedGoal, ToVehicle};
use crate::recon::round_trip::Moment;
use albacore_vehicle::{Command, Control, Vertical};

/// Who commands nothing says this often that it is there.
const KEEP_ALIVE_TICKS: u64 = 10;
/// A vehicle that has left us without an answer for so long may not be reading, or its line is slower than we speak: what is said then
/// waits in a queue, and is old when it is heard. One that hears nothing for so long leaves by itself; lines that are lost now and then
/// leave no such gap.
const UNANSWERED_TICKS: u64 = 50;
/// It is told something this often, the newest: a tick before it would be told that we are there.
const SELDOM_TICKS: u64 = KEEP_ALIVE_TICKS - 1;

impl Controller {
    /// Says now and then that we are here, where the mission stands still, or has not begun, and commands nothing.
    pub(super) fn keep_alive(&mut self, tick: u64) {
        if tick - self.spoke >= KEEP_ALIVE_TICKS {
            self.hello();
        }
    }

    /// Whether the vehicle owes us an answer, and was told something a moment ago.
    pub(super) fn waits_for_answer(&self, tick: u64) -> bool {
        let unanswered = match self.want {
            Want::Drive { since } if self.control == Control::Requesting => {
                self.round_trip.between(since, self.moment())
            }
            Want::GiveBack { given: Given { since, .. }, .. } => self.round_trip.between(since, self.moment()),
            _ => self.round_trip.waits(self.moment()),
        };
        unanswered >= UNANSWERED_TICKS && tick.saturating_sub(self.spoke) < SELDOM_TICKS
    }

    /// Asks for control; the following ticks tell how that goes.
    pub fn take_over(&mut self) {
        match &mut self.want {
            Want::Listen => {
                self.want = Want::Drive { since: Moment { tick: self.next_tick, ..self.moment() } };
                self.round_trip.begin();
                self.ours = 0;
                self.late = Late::default();
                self.say(&ToVehicle::Override(true));
            }
            // What the vehicle says of the question before would be taken for the answer to this one.
            Want::GiveBack { again, .. } => *again = true,
            Want::Drive { .. } | Want::Leave(_) => {}
        }
    }

    /// Gives control back and listens on; the following ticks say so again until the vehicle drives itself.
    pub fn give_back(&mut self) {
        match &mut self.want {
            Want::Drive { .. } => {
                let driven = self.drives() || self.control == Control::Released;
                let given = Given { since: self.moment(), driven };
                self.want = Want::GiveBack { given, again: false };
                self.control = Control::Monitoring;
                self.say(&ToVehicle::Override(false));
            }
            Want::GiveBack { again, .. } => {
                *again = false;
                self.control = Control::Monitoring;
            }
            Want::Listen | Want::Leave(_) => {}
        }
    }

    /// Sends what of a command has changed, was not taken up, or was sent half a second ago: one goal a tick, the one that has
    /// waited longest, because vehicles lose datagrams that come at once. A command of a tick that is late is not sent, nor one
    /// for a vehicle that has said meanwhile that we do not drive it.
    pub fn command(&mut self, command: &Command) {
        let computed = std::mem::take(&mut self.computed);
        if self.is_late() {
            self.late.add(computed);
            let told = if self.told_slow { None } else { self.late.told_slow(self.tick) };
            if let Some(told) = told {
                self.told_slow = true;
                self.notice(told);
            }
            return;
        }
        if !self.is_ours() {
            return;
        }
        if let Some(told) = std::mem::take(&mut self.late).told() {
            self.notice(told);
        }
        let vertical = match command.vertical {
            Vertical::Depth(depth) => ToVehicle::Depth(depth),
            Vertical::Altitude(altitude) => ToVehicle::Altitude(altitude),
        };
        let speed = ToVehicle::Speed(SpeedGoal::MetresPerSecond(command.speed));
        let (now, moment) = (self.next_tick, self.moment());
        let heading = self.round_trip.marked(command.heading, moment);
        for (i, message) in [ToVehicle::Heading(heading), speed, vertical].into_iter().enumerate() {
            if let Some(ignored) = self.goals[i].ask(message, now) {
                self.notice_of_vehicle(ignored);
            }
        }
        // Something else was said in this tick.
        if self.spoke + 1 == now || self.waits_for_answer(now - 1) {
            return;
        }
        let due = self.goals.iter_mut().filter_map(|goal| Some((goal.due(now)?, goal)));
        let Some((text, goal)) = due.min_by_key(|(_, goal)| goal.sent.as_ref().map(|(_, tick)| *tick)) else { return };
        goal.sent = Some((text.clone(), now));
        if let Some(ToVehicle::Heading(heading)) = goal.asked {
            self.round_trip.sent(heading, moment);
        }
        self.say(&text);
    }

    /// Says that we are here, without asking for anything.
    pub fn hello(&mut self) {
        self.say(&ToVehicle::KeepAlive(concat!("albacore ", env!("CARGO_PKG_VERSION")).into()));
    }

    /// Gives control back: call it now and then until it is true, which it is when the vehicle's mode says so. Who never asked
    /// for control has none to give.
    pub fn release(&mut self) -> bool {
        let heard = self.heard.drain(..).next_back().map(|heard| heard.mode);
        self.notices.extend(self.allowance.end());
        match self.want {
            Want::Listen => return true,
            // What was heard before we asked is no answer.
            Want::Drive { .. } => self.want = Want::Leave(Given { since: self.moment(), driven: self.drives() }),
            Want::GiveBack { given, .. } => self.want = Want::Leave(given),
            Want::Leave(given) => {
                if let Some(mode) = heard {
                    let given = given.hear(mode);
                    if self.is_taken(given, mode) {
                        self.control = Control::Released;
                        return true;
                    }
                    self.want = Want::Leave(given);
                }
            }
        }
        self.say(&ToVehicle::Override(false));
        false
    }

    pub(super) fn say(&mut self, message: &impl ToString) {
        self.spoke = self.next_tick.saturating_sub(1);
        self.out.extend_from_slice(seal(&message.to_string()).as_bytes());
    }
}
