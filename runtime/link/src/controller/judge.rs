//! Who drives, by the status that the vehicle reports.

use super::round_trip::Moment;
use super::{Controller, Given, Want};
use crate::status::{Phase, Status};
use albacore_vehicle::{Control, REQUEST_TICKS, TICK_S};

/// What was asked of a vehicle and not answered for so many ticks will not be: no link is driven over that is slower.
const ANSWER_TICKS: u64 = 25;
/// A vehicle that says in so many states, one after the other, that we do not drive has left: where a message has a sum of 8 bits,
/// one wrong message in 256 passes it.
const LEFT_LINES: u64 = 3;

impl Controller {
    /// Who drives, by the status that the vehicle reports.
    pub(super) fn judge(&mut self, tick: u64) -> Control {
        if self.lost {
            return Control::TimedOut;
        }
        let status = self.status;
        let active = status.is_active;
        let driven = matches!(self.control, Control::InControl | Control::Suspended);
        let since = match self.want {
            Want::Drive { since } => since,
            // In override although we have not asked: it hands over of its own accord, or to another.
            Want::Listen if active && status.phase == Phase::InMission => return Control::Offered,
            Want::GiveBack { given, again } => {
                let given = given.hear(status);
                if !self.is_taken(given, status) {
                    self.want = Want::GiveBack { given, again };
                    return if again { Control::Requesting } else { Control::Monitoring };
                }
                self.want = Want::Listen;
                if !again {
                    return Control::Monitoring;
                }
                self.take_over();
                return Control::Requesting;
            }
            Want::Listen | Want::Leave(_) => return Control::Monitoring,
        };
        let suspended = status.is_suspended();
        if driven && (1..LEFT_LINES).contains(&self.left) {
            return self.control;
        }
        match (status.phase, self.control) {
            (_, ended @ (Control::Released | Control::Refused)) => ended,
            (Phase::Over, _) if driven => self.end(Control::Released, "the vehicle's own mission is over"),
            (Phase::Over, _) if self.over >= LEFT_LINES => {
                self.end(Control::Refused, "the vehicle's own mission is over: nothing can be overridden")
            }
            _ if driven && suspended => Control::Suspended,
            (Phase::InMission, _) if active && !suspended => Control::InControl,
            _ if driven && self.ours >= LEFT_LINES => {
                let late = self.late.cost_us_the_vehicle(self.tick).map_or(String::new(), |why| format!(": {why}"));
                self.end(Control::Released, &format!("the vehicle has left override by itself{late}"))
            }
            // By its own clock or the host's.
            (phase, _) if self.round_trip.between(since, Moment { tick, ..self.moment() }) > REQUEST_TICKS => {
                let why = match phase {
                    Phase::PreLaunch => "it is not launched yet",
                    Phase::Suspended => "its mission is suspended",
                    _ if status.is_forbidden => "it says that override is not allowed",
                    _ => "it says that its mission goes on",
                };
                let seconds = REQUEST_TICKS as f64 * TICK_S;
                self.end(Control::Refused, &format!("the vehicle did not let us drive for {seconds} s: {why}"))
            }
            _ => {
                self.ours = 0;
                Control::Requesting
            }
        }
    }

    /// Whether the vehicle has taken back what was given, by its latest word.
    pub(super) fn is_taken(&self, given: Given, status: Status) -> bool {
        let is_old = !given.driven && self.round_trip.between(given.since, self.moment()) <= ANSWER_TICKS;
        !is_old && status.is_free()
    }

    fn end(&mut self, control: Control, why: &str) -> Control {
        self.notice(why.to_string());
        control
    }
}

impl Given {
    /// The same after another word of the vehicle.
    pub(super) fn hear(self, status: Status) -> Self {
        Given { driven: self.driven || status.is_active, ..self }
    }
}
