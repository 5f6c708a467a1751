//! What the controller says: who is to drive, its goals, and that it is there.

use super::late::Late;
use super::round_trip::Moment;
use super::{Controller, ControllerMessage, Given, Want};
use crate::set_point::SetPoint;
use albacore_vehicle::{Command, Control};

/// Who commands nothing says this often that it is there.
const KEEP_ALIVE_TICKS: u64 = 10;
/// A vehicle that has left us without an answer for so long may not be reading, or its line is slower than we speak: what is said then
/// waits in a queue, and is old when it is heard. One that hears nothing for so long leaves by itself; lines that are lost now and then
/// leave no such gap.
const UNANSWERED_TICKS: u64 = 50;
/// It is told something this often, the newest: a tick before it would be told that we are there.
const SELDOM_TICKS: u64 = KEEP_ALIVE_TICKS - 1;

impl Controller {
    /// Says now and then that we are here, where the mission stands still, or has not begun, and commands nothing. After late ticks
    /// a command comes first, if one comes: where every tick that speaks follows late ones, states being rare, none has come by the
    /// next.
    pub(super) fn keep_alive(&mut self, tick: u64, was_late: bool) {
        if tick.saturating_sub(self.spoke) < KEEP_ALIVE_TICKS {
            return;
        }
        let gives_way = was_late && self.control == Control::InControl && self.gave_way <= self.spoke;
        if gives_way {
            self.gave_way = tick;
        } else {
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
                self.say(&ControllerMessage::TakeOver);
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
                let given = Given { since: self.moment(), driven: self.has_driven() };
                self.want = Want::GiveBack { given, again: false };
                self.control = Control::Monitoring;
                self.say(&ControllerMessage::GiveBack);
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
            // Nobody is late in a tick of which the vehicle said nothing, its next state being the last that came.
            let is_gap = self.heard.len() == 1 && self.heard.front().is_some_and(|next| next.tick > self.next_tick);
            if !is_gap {
                self.late.add(computed);
            }
            let told = if self.has_warned {
                None
            } else {
                self.late.slow_warning(self.tick, self.side.dialect().timeout_ticks)
            };
            if let Some(told) = told {
                self.has_warned = true;
                self.notice(told);
            }
            return;
        }
        if !self.is_ours() {
            return;
        }
        if let Some(told) = std::mem::take(&mut self.late).summary() {
            self.notice(told);
        }
        let (now, moment) = (self.next_tick, self.moment());
        let command = Command { heading: self.round_trip.marked(command.heading, moment), ..*command };
        for set_point in SetPoint::of(&command) {
            if let Some(ignored) = self.goals[set_point.place()].ask(set_point, now, &*self.side) {
                self.notice_of_vehicle(ignored);
            }
        }
        if std::mem::take(&mut self.begins_again) {
            return self.say(&ControllerMessage::Begin);
        }
        // Something else was said in this tick.
        if self.spoke + 1 == now || self.waits_for_answer(now - 1) {
            return;
        }
        let side = &*self.side;
        let due = self.goals.iter_mut().filter_map(|goal| Some((goal.due(now, side)?, goal.asked?, goal)));
        let Some((text, asked, goal)) = due.min_by_key(|(_, _, goal)| goal.sent.as_ref().map(|(_, tick)| *tick)) else {
            return;
        };
        goal.sent = Some((text, now));
        if let SetPoint::Heading(heading) = asked {
            self.round_trip.sent(heading, moment);
        }
        self.say(&ControllerMessage::SetPoint(asked, command));
    }

    /// What was said last was not sent.
    pub fn take_back(&mut self) {
        self.round_trip.take_back(self.moment());
        self.begins_again = true;
        self.goals.iter_mut().for_each(|goal| goal.sent = None);
    }

    /// Says that we are here, without asking for anything.
    pub fn hello(&mut self) {
        self.say(&ControllerMessage::KeepAlive);
    }

    /// Gives control back: call it now and then until it is true, which it is when the vehicle's status says so. Who never asked
    /// for control has none to give.
    pub fn release(&mut self) -> bool {
        let heard = self.heard.drain(..).next_back().map(|heard| heard.status);
        self.notices.extend(self.allowance.end());
        match self.want {
            Want::Listen => return true,
            // What was heard before we asked is no answer.
            Want::Drive { .. } => self.want = Want::Leave(Given { since: self.moment(), driven: self.has_driven() }),
            Want::GiveBack { given, .. } => self.want = Want::Leave(given),
            Want::Leave(given) => {
                if let Some(status) = heard {
                    let given = given.hear(status);
                    if self.is_taken(given, status) {
                        self.control = Control::Released;
                        return true;
                    }
                    self.want = Want::Leave(given);
                }
            }
        }
        self.say(&ControllerMessage::GiveBack);
        false
    }

    pub(super) fn say(&mut self, what: &ControllerMessage) {
        self.spoke = self.next_tick.saturating_sub(1);
        self.side.say(what, &mut self.out);
    }
}
