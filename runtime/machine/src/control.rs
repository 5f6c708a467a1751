//! Who drives: rule 18. A mission drives from its start, or is a guest of its vehicle and drives in its overrides alone.

use crate::state::{Asked, ControlRequest, Run};
use crate::{Event, Outcome};
use albacore_program::{Channel, OverrideEnd, Program};
use albacore_vehicle::{Command, Control};

impl Run {
    /// Takes in who drives now, and lets the input `control` show it.
    pub fn hear_control(&mut self, control: Control) {
        if control != self.state.control {
            self.state.control = control;
            self.events.push(Event::Control(control));
        }
        if let Some(at) = self.senses.control {
            self.tell(at, number(control));
        }
    }

    /// The command of this tick, when there is anybody to obey it.
    pub fn command_if_ours(&mut self, p: &Program) -> Option<Command> {
        self.drives().then(|| self.give_command(p))
    }

    /// The command with speed 0, for this tick alone.
    pub fn still_command(&mut self, p: &Program) -> Command {
        let overridden = std::mem::take(&mut self.state.overridden.speed);
        self.state.asked.speed = overridden.unwrap_or(self.state.asked.speed);
        self.state.way_back = None;
        let before = self.state.asked;
        self.state.asked.speed = 0.0;
        let command = self.give_command(p);
        self.state.asked = before;
        command
    }

    /// Whether the vehicle obeys the mission.
    pub fn drives(&self) -> bool {
        self.state.wish == ControlRequest::Drive && self.state.control == Control::InControl
    }

    /// Whether the vehicle is ours, though an override may not have heard of that yet.
    pub fn is_ours(&self) -> bool {
        self.state.wish != ControlRequest::Listen && self.state.control == Control::InControl
    }

    /// Rule 6: at the very start the present heading and depth, speed 0.
    pub fn stand(&mut self) {
        self.state.stands = true;
        self.state.filtered = self.heading();
        self.state.asked = Asked::still(self.heading(), self.depth());
    }

    /// An override asks for control, unless it waits for the vehicle to offer it.
    pub fn ask_for_control(&mut self, offered: bool) {
        if !offered {
            self.state.wish = ControlRequest::Ask;
            self.asks = true;
        }
    }

    /// What became of the question: whether the vehicle is ours, and whether it has refused.
    pub fn answer(&mut self, offered: bool) -> (bool, bool) {
        let has_asked = self.state.wish != ControlRequest::Listen;
        match self.state.control {
            Control::InControl => (has_asked, false),
            Control::Refused => (false, has_asked),
            Control::Offered if offered => {
                self.state.wish = ControlRequest::Ask;
                (false, false)
            }
            _ => (false, false),
        }
    }

    /// From here on commands are sent.
    pub fn take(&mut self) {
        self.state.wish = ControlRequest::Drive;
        self.stand();
    }

    /// Whether a vehicle that was ours does not listen for a while, and whether it is ours no longer.
    pub fn driven(&self) -> (bool, bool) {
        if self.state.wish != ControlRequest::Drive {
            return (false, false);
        }
        let suspended = self.state.control == Control::Suspended;
        (suspended, !suspended && self.state.control != Control::InControl)
    }

    /// An override is left: control is given back, and nothing is amended or limited any more.
    pub fn give_back(&mut self, p: &Program) {
        self.state.wish = ControlRequest::Listen;
        let mut chain = Vec::new();
        self.chain(p, &mut |id, base| chain.push((id, base)));
        // What they keep stays, for a recovery that goes on driving.
        self.end_amendments(p, &chain);
        let limited = std::mem::take(&mut self.state.limited);
        for (channel, limited) in Channel::ALL.into_iter().zip(limited) {
            if limited {
                self.events.push(Event::LimitedEnded(channel));
            }
        }
    }

    /// Why and how the run ends when nobody reads that an override did not end by itself.
    pub fn desert(&mut self, end: OverrideEnd) -> bool {
        let (why, outcome) = match end {
            OverrideEnd::Completed => return false,
            OverrideEnd::Refused => ("the vehicle would not be overridden", Outcome::Refused),
            OverrideEnd::NoAnswer => ("no answer to an override", Outcome::LinkLost),
            OverrideEnd::TakenBack => ("the vehicle took control back", Outcome::ReleasedByVehicle),
            OverrideEnd::TimedOut => ("an override was cut off", Outcome::TimedOut),
        };
        self.abort = Some(why.to_string());
        self.deserted = Some(outcome);
        true
    }
}

/// The place of a state in the library's `enum Control`.
fn number(control: Control) -> f64 {
    f64::from(match control {
        Control::Disconnected => 0u8,
        Control::Monitoring => 1,
        Control::Offered => 2,
        Control::Requesting => 3,
        Control::InControl => 4,
        Control::Released => 5,
        Control::Refused => 6,
        Control::Suspended => 7,
        Control::TimedOut => 8,
    })
}
