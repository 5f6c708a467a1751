//! A vehicle at the end of a link. Its time goes on while nobody types: whoever waits for the next line calls [`Prompt::idle`] again and
//! again. What was told of it is kept, so that `why` and `plot` go through the past as in simulation; nothing of the past is driven again.

use super::moment::{Moment, RECENT_TICKS};
use super::opening::Opening;
use super::vehicle::{LinkedVehicle, PromptVehicle};
use super::{Answer, Listener, OpenError, Prompt, Say};
use albacore_machine::Machine;
use albacore_program::senses;
use albacore_vehicle::{Control, TICK_S, Vehicle, VehicleError};

/// So long is listened before the first line, for what the vehicle tells once a second to be known in it: 2 s.
const LISTEN_TICKS: u64 = 20;

/// What is left when nothing is heard any more.
const LOST: &str =
    "what was told of it is still there for `why` and `plot`; leave, and open the prompt again, to call it again";

impl Prompt {
    /// Opens a prompt for a vehicle at the end of a link, which was heard and drives itself; `opening.link` names it.
    pub fn on_link(opening: Opening, vehicle: Box<dyn Vehicle + Send>) -> Result<Self, OpenError> {
        let loaded = opening.load()?;
        let listens = || {
            let mut now = Moment::of_link(LinkedVehicle::new(vehicle))?;
            (0..LISTEN_TICKS).try_for_each(|_| now.sense())?;
            Ok(now)
        };
        let now = listens().map_err(|error: VehicleError| OpenError::Asked(error.to_string(), None))?;
        Ok(Prompt::beginning(opening, loaded, now))
    }

    /// Whether the vehicle is at the end of a link.
    pub fn is_on_link(&self) -> bool {
        self.now.vehicle.is_linked()
    }

    /// Whether the vehicle at the end of the link is not heard any more.
    pub fn has_lost_link(&self) -> bool {
        self.has_lost_link
    }

    /// Whether something is under way.
    pub fn is_busy(&self) -> bool {
        self.now.task.is_some()
    }

    /// Lets a tick go by if the time of the vehicle at the end of the link has come to it. Some hundredths of a second go by at most.
    pub fn idle(&mut self, say: &mut Listener) {
        if !self.is_on_link() || self.has_lost_link {
            return;
        }
        let waits = self.now.is_decided();
        let is_due = match self.now.vehicle.port().filter(|_| waits) {
            Some(vehicle) => vehicle.ready(),
            None => Ok(true),
        };
        match is_due {
            Ok(false) => {}
            Ok(true) => match self.advance(say) {
                Ok(false) => {}
                Ok(true) => say(Say::Text(&self.now.place())),
                Err(error) => self.lose_link(&error, say),
            },
            Err(error) => self.lose_link(&error, say),
        }
    }

    /// Lets a tick go by; whether what was under way has ended in it.
    pub(super) fn advance(&mut self, say: &mut Listener) -> Result<bool, VehicleError> {
        let PromptVehicle::Linked(_) = self.now.vehicle else {
            let has_ended = self.now.step(&mut |line| say(Say::Text(line)))?;
            match has_ended {
                true => self.past.pin(&self.now),
                false => self.past.note(&self.now),
            }
            return Ok(has_ended);
        };
        if self.now.is_decided() {
            self.now.sense()?;
            if let PromptVehicle::Linked(vehicle) = &self.now.vehicle {
                self.past.forget_before(vehicle.first());
            }
            self.past.note(&self.now);
        }
        let has_ended = self.now.decide(&mut |line| say(Say::Text(line)))?;
        if has_ended {
            self.past.pin(&self.now);
        }
        if self.now.has_left() {
            self.now.give_back()?;
        }
        if self.now.is_adrift() {
            self.now.give_back()?;
            let what = "the vehicle tells neither heading nor depth, and cannot be told to lie still: it is given back";
            say(Say::Error(what, None));
        }
        if self.now.snapshot.control == Control::TimedOut {
            self.has_lost_link = true;
            say(Say::Error("the link is lost", Some(LOST)));
        }
        Ok(has_ended)
    }

    /// Nothing more is heard of the vehicle.
    pub(super) fn lose_link(&mut self, error: &VehicleError, say: &mut Listener) {
        self.now.put(None);
        self.has_lost_link |= self.is_on_link();
        say(Say::Error(&error.to_string(), self.has_lost_link.then_some(LOST)));
    }

    /// Gives the vehicle back, and listens on.
    pub(super) fn release(&mut self, say: &mut Listener) -> Answer {
        if !self.is_on_link() {
            say(Say::Error(
                "there is no link, and nobody to give the vehicle back to",
                Some("`stop` ends what is under way"),
            ));
            return Answer::Wrong;
        }
        if let Some(answer) = self.is_beyond_reach(say) {
            return answer;
        }
        if self.now.task.is_some() {
            self.stop(say);
        }
        match self.now.give_back() {
            Ok(true) => say(Say::Text("the vehicle is given back: its own computer drives it, and we listen")),
            Ok(false) => say(Say::Text("the vehicle drives itself already")),
            Err(error) => self.lose_link(&error, say),
        }
        Answer::Done
    }

    /// Ends what is under way, and withdraws a request for control that was not answered yet.
    pub(super) fn stop_on_link(&mut self, say: &mut Listener) {
        self.now.put(None);
        self.past.pin(&self.now);
        let control = self.now.snapshot.control;
        let is_ours = matches!(control, Control::InControl | Control::Suspended);
        if self.has_lost_link {
            return say(Say::Error("the link is lost: nothing can be stopped", Some(LOST)));
        }
        if !self.now.is_asked() {
            return say(Say::Text("nothing of ours is under way: the vehicle drives itself"));
        }
        if !is_ours && let Err(error) = self.now.give_back() {
            return self.lose_link(&error, say);
        }
        match is_ours {
            true => say(Say::Text(&format!("{}  stopped", self.now.place()))),
            false => say(Say::Text("control is not asked for any more: the vehicle drives itself")),
        }
    }

    /// Why a statement is not begun on a vehicle at the end of a link, if it is not.
    pub(super) fn cannot_begin(&self, machine: &Machine) -> Option<String> {
        if !self.is_on_link() {
            return None;
        }
        let program = machine.program();
        if let Some(action) = program.asks.first() {
            return Some(format!("this asks `{action}` of a payload, and no link carries that"));
        }
        let is_missing = |name: &&str| {
            program.inputs.iter().position(|input| input.name == *name).is_some_and(|at| !machine.has_sample(at as u32))
        };
        let missing = [senses::POSITION, senses::HEADING].into_iter().find(is_missing)?;
        Some(untold(missing))
    }

    /// Refuses what can be done with a vehicle alone whose time goes back.
    pub(super) fn needs_simulation(&self, say: &mut Listener) -> Option<Answer> {
        if !self.is_on_link() {
            return None;
        }
        let help = "open the prompt without `--link` for a simulated vehicle; `why` and `plot` tell of what has been";
        say(Say::Error("a vehicle at the end of a link does not go back in time", Some(help)));
        Some(Answer::Wrong)
    }

    /// Ends the session: the vehicle is given back, which takes some seconds at most. An error says that it has not said so.
    pub fn leave(&mut self, say: &mut Listener) -> Result<(), VehicleError> {
        self.now.put(None);
        let was_ours = matches!(self.now.snapshot.control, Control::InControl | Control::Suspended);
        let Some(vehicle) = self.now.vehicle.port().filter(|_| self.opening.link.is_some()) else { return Ok(()) };
        let released = vehicle.release();
        vehicle.notices().iter().for_each(|notice| say(Say::Text(&format!("vehicle  {notice}"))));
        if was_ours && released.is_ok() {
            say(Say::Text("the vehicle has taken control back"));
        }
        released
    }

    /// A vehicle that is not heard does nothing.
    pub(super) fn is_beyond_reach(&self, say: &mut Listener) -> Option<Answer> {
        if !self.has_lost_link {
            return None;
        }
        say(Say::Error("the link is lost", Some(LOST)));
        Some(Answer::Wrong)
    }
}

/// Why nothing is known of an input of a vehicle at the end of a link.
pub(super) fn untold(name: &str) -> String {
    format!("`{name}` was not told, or not believed, for {} s", RECENT_TICKS as f64 * TICK_S)
}
