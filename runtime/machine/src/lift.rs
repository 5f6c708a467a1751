//! Way for a vehicle that is deeper than its limits allow and does not rise: fins lift nothing that stands still, or creeps.

use crate::Event;
use crate::state::Run;
use albacore_program::Program;
use albacore_vehicle::TICK_S;
use serde::{Deserialize, Serialize};

/// A vehicle sinks that is deeper than it may be by so much, m, or whose altitude is low, and has not risen by so much in so long, s.
const SUNK_M: f64 = 1.0;
const RISEN_M: f64 = 0.5;
const PATIENCE_S: f64 = 5.0;
/// ... or so long, s, if its altitude is low: a hull takes ten seconds to be lifted.
const PATIENCE_LOW_S: f64 = 2.0;
/// It is lifted until it is no deeper than this below where it may be, m ...
const LIFTED_M: f64 = 0.2;
/// ... or has not risen by as much in so long, s, by which time it will not.
const IN_VAIN_S: f64 = 30.0;
/// The speed through the water at which fins lift a hull, m/s.
const LIFT_SPEED: f64 = 1.5;

/// What is known of a vehicle that is deeper than it may be.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) enum Lift {
    /// It is not, or not by much.
    #[default]
    Clear,
    /// By how much it is too deep, m, and the tick from which that has to become less.
    Deep { by: f64, since: u64 },
    /// It did not: it makes way, and has to rise from there, or from the depth at which it was, m.
    Lifted { by: f64, depth: f64, since: u64 },
    /// It made way in vain, so much too deep, m.
    InVain { by: f64 },
}

impl Run {
    /// The speed through the water that a vehicle makes which is asked to make so much, m/s. More, if it is deeper than its limits allow
    /// and does not rise; as far as the limit of speed lets it.
    pub fn lift(&mut self, asked: f64, p: &Program) -> f64 {
        let speed = LIFT_SPEED.min(self.state.limits.speed.1);
        let before = self.state.lift;
        if let Some(too_deep) = self.too_deep(p).filter(|_| speed > 0.0) {
            let patience = match (self.is_low(), too_deep > SUNK_M) {
                (true, _) => Some(PATIENCE_LOW_S),
                (false, sunk) => sunk.then_some(PATIENCE_S),
            };
            self.state.lift = before.after(self.state.tick, too_deep, self.depth(), patience);
        }
        let lifted = self.state.lift.is_lifted();
        if lifted != before.is_lifted() {
            self.events.push(match self.state.lift {
                Lift::InVain { .. } => Event::LiftedInVain,
                _ if lifted => Event::Lifted(speed),
                _ => Event::Risen,
            });
        }
        if lifted { asked.max(speed) } else { asked }
    }
}

impl Lift {
    /// Whether there is nothing to be done, or not yet.
    pub fn is_patient(self) -> bool {
        matches!(self, Lift::Clear | Lift::Deep { .. })
    }

    fn is_lifted(self) -> bool {
        matches!(self, Lift::Lifted { .. })
    }

    /// Where it may be rises with the bottom: who rises more slowly than that makes no way in vain.
    fn after(self, tick: u64, too_deep: f64, depth: f64, patience: Option<f64>) -> Lift {
        let lasts = |since: u64| tick.saturating_sub(since) as f64 * TICK_S;
        match self {
            Lift::Lifted { .. } | Lift::InVain { .. } if too_deep <= LIFTED_M => Lift::Clear,
            Lift::Lifted { by, depth: before, .. } if too_deep <= by - RISEN_M || depth <= before - RISEN_M => {
                Lift::Lifted { by: too_deep, depth, since: tick }
            }
            Lift::Lifted { since, .. } if lasts(since) > IN_VAIN_S => Lift::InVain { by: too_deep },
            Lift::Lifted { .. } => self,
            Lift::InVain { by } if too_deep <= by + SUNK_M => self,
            Lift::Deep { by, since } if patience.is_some() && too_deep > by - RISEN_M => {
                if patience.is_some_and(|patience| lasts(since) > patience) {
                    Lift::Lifted { by: too_deep, depth, since: tick }
                } else {
                    self
                }
            }
            _ if patience.is_some() => Lift::Deep { by: too_deep, since: tick },
            _ => Lift::Clear,
        }
    }
}
