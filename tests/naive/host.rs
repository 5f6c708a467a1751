//! A vehicle that runs a plan of its own: who asks to drive it is let, refused, or left without an answer, as chance has it.

use crate::random::Random;
use albacore_geometry::Heading;
use albacore_vehicle::{Command, Control, Vertical};

/// What it does by its own plan.
pub const PLAN: Command = Command::new(Heading::NORTH, 0.3, Vertical::Depth(4.0));

pub struct Host {
    random: Random,
    control: Control,
    /// What it will say next, and in how many ticks.
    next: Option<(u64, Control)>,
}

impl Host {
    pub fn new(seed: u64) -> Self {
        Host { random: Random::new(seed, 5), control: Control::Monitoring, next: None }
    }

    /// Who drives in the coming tick.
    pub fn tick(&mut self) -> Control {
        if self.next.is_none() {
            self.next = self.intention();
        }
        match &mut self.next {
            Some((0, control)) => {
                self.control = *control;
                self.next = None;
            }
            Some((ticks, _)) => *ticks -= 1,
            None => {}
        }
        self.control
    }

    /// What it may do of its own accord.
    fn intention(&mut self) -> Option<(u64, Control)> {
        let after = self.random.bits() % 20;
        match (self.control, self.random.below(60)) {
            (Control::Monitoring, 0 | 1) => Some((after, Control::Offered)),
            (Control::Offered, 0..4) => Some((after, Control::Monitoring)),
            (Control::InControl, 0..5) => Some((after / 2, Control::Released)),
            (Control::InControl, 5..15) => Some((after / 4, Control::Suspended)),
            (Control::InControl, 15) if after < 5 => Some((after, Control::Monitoring)),
            (Control::Suspended, 0..9) => Some((after / 2, Control::InControl)),
            (Control::Suspended, 9) => Some((after, Control::Released)),
            (Control::Released | Control::Refused, 0..3) => Some((after, Control::Monitoring)),
            _ => None,
        }
    }

    pub fn take_over(&mut self) {
        let was_offered = self.control == Control::Offered;
        self.control = Control::Requesting;
        let (soon, later) = (self.random.bits() % 4, self.random.bits() % 25);
        self.next = match self.random.below(20) {
            _ if was_offered && soon > 0 => Some((0, Control::InControl)),
            0..8 => Some((soon, Control::InControl)),
            8..11 => Some((later, Control::InControl)),
            11..15 => Some((soon, Control::Refused)),
            15 => Some((later, Control::Refused)),
            // It did not answer for 30 s.
            _ => Some((300, Control::Refused)),
        };
    }

    pub fn give_back(&mut self) {
        self.control = Control::Monitoring;
        self.next = None;
    }
}
