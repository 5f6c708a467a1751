//! Way for a vehicle that is deeper than its limits allow and does not rise: fins lift nothing that stands still, or creeps.

use crate::Event;
use crate::bottom::Below;
use crate::sinking::Sinking;
use crate::state::Run;
use albacore_vehicle::{TICK_S, Vertical};
use serde::{Deserialize, Serialize};

/// A vehicle sinks that is deeper than it may be by so much, m, or whose altitude is low, and has not risen by so much in so long, s.
const SUNK_M: f64 = 1.0;
/// Who is low has less to lose.
const SUNK_LOW_M: f64 = 0.5;
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
    /// It is so deep, which has to become less from a tick on.
    Deep(Deep, u64),
    /// It did not: it makes way.
    Lifted {
        /// It has to rise from there, from a tick on.
        from: Deep,
        since: u64,
        /// It was so deep at most.
        deepest: Deep,
    },
    /// It made way in vain, when it was so deep.
    InVain(Deep),
}

/// How deep a vehicle is, as far as it is told.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Deep {
    /// By so much deeper than it may be, m.
    by: f64,
    /// The depth, m, which may be stuck.
    depth: f64,
    /// The altitude, m, if it is told.
    altitude: Option<f64>,
    is_low: bool,
}

impl Run {
    /// The speed through the water that a vehicle makes which is asked to make so much, m/s. More, if it is deeper than its limits allow
    /// and does not rise; as far as the limit of speed lets it.
    pub fn lift(&mut self, asked: f64, vertical: Vertical, below: &Below) -> f64 {
        let speed = LIFT_SPEED.min(self.state.limits.speed.1);
        let before = self.state.lift;
        let (tick, depth) = (self.state.tick, self.depth());
        // Nobody or somebody else drove before: what way has done or not is not ours.
        let is_anew = self.state.command.is_none() || tick > self.state.lift_tick + 1;
        self.state.lift_tick = tick;
        // Who dives as told does not sink.
        let sinks = match vertical {
            Vertical::Depth(told) => depth > told + SUNK_M,
            Vertical::Altitude(told) => below.sounded.is_some_and(|altitude| altitude < told - SUNK_M),
        };
        self.state.sinking = match is_anew || !sinks {
            true => Sinking::from(tick, depth),
            false => self.state.sinking.after(tick, depth),
        };
        if let Some(by) = self.too_deep(below).filter(|_| speed > 0.0) {
            let by = by + self.state.sinking.ahead();
            let now = Deep { by, depth, altitude: below.sounded, is_low: below.is_low() };
            let before = if is_anew { before.anew(tick, now) } else { before };
            self.state.lift = before.after(tick, now);
        }
        let lifted = self.state.lift.is_lifted();
        if lifted != before.is_lifted() {
            self.events.push(match self.state.lift {
                Lift::InVain(_) => Event::LiftedInVain,
                _ if lifted => Event::Lifted(speed),
                _ => Event::Risen,
            });
        }
        if lifted { asked.max(speed) } else { asked }
    }
}

impl Deep {
    /// How long it may stay as it is before the vehicle makes way, s; for ever, if it is not deep enough for that.
    fn patience(&self) -> Option<f64> {
        match (self.is_low, self.by > SUNK_M) {
            (true, _) => Some(PATIENCE_LOW_S),
            (false, sunk) => sunk.then_some(PATIENCE_S),
        }
    }

    /// Whether it has risen since. Where it may be rises with the bottom: who rises more slowly than that rises, too.
    fn has_risen_since(&self, before: Deep, rise: f64) -> bool {
        let by_altitude = self.climbed_since(before).is_some_and(|climbed| climbed >= rise);
        self.by <= before.by - rise || self.depth <= before.depth - rise || by_altitude
    }

    /// Whether it has sunk further since than way in vain is forgotten for.
    fn has_sunk_since(&self, before: Deep) -> bool {
        let fall = if self.is_low { SUNK_LOW_M } else { SUNK_M };
        self.is_deeper_than(before, fall) || self.is_low && !before.is_low
    }

    fn is_deeper_than(&self, before: Deep, fall: f64) -> bool {
        self.by > before.by + fall || self.climbed_since(before).is_some_and(|climbed| climbed <= -fall)
    }

    /// How much the altitude has grown, m. Only that tells of a vehicle whose depth is exactly the same: it is stuck, perhaps.
    fn climbed_since(&self, before: Deep) -> Option<f64> {
        let altitudes = self.altitude.zip(before.altitude).filter(|_| self.depth == before.depth);
        altitudes.map(|(now, before)| now - before)
    }
}

impl Lift {
    /// Whether there is nothing to be done, or not yet.
    pub fn is_patient(self) -> bool {
        matches!(self, Lift::Clear | Lift::Deep(..))
    }

    /// A vehicle makes way from a tick on that is so deep.
    fn lifted(now: Deep, tick: u64) -> Lift {
        Lift::Lifted { from: now, since: tick, deepest: now }
    }

    fn is_lifted(self) -> bool {
        matches!(self, Lift::Lifted { .. })
    }

    /// The same where others have driven since.
    fn anew(self, tick: u64, now: Deep) -> Lift {
        match self {
            Lift::Clear | Lift::Deep(..) => self,
            Lift::Lifted { .. } => Lift::lifted(now, tick),
            Lift::InVain(_) => Lift::Clear,
        }
    }

    fn after(self, tick: u64, now: Deep) -> Lift {
        let lasts = |since: u64| tick.saturating_sub(since) as f64 * TICK_S;
        match (self, now.patience()) {
            (Lift::Lifted { .. } | Lift::InVain(_), _) if now.by <= LIFTED_M => Lift::Clear,
            (Lift::Lifted { from, deepest, .. }, _) if now.has_risen_since(from, RISEN_M) => {
                Lift::Lifted { from: now, since: tick, deepest }
            }
            // A hull sinks on until its fins bite: it has to rise from where it is deepest, and has its time from then. What goes up and
            // down, as a gauge does in waves, is deepest once.
            (Lift::Lifted { deepest, .. }, _) if now.is_deeper_than(deepest, LIFTED_M) => Lift::lifted(now, tick),
            (Lift::Lifted { from, since, deepest }, _) if lasts(since) > IN_VAIN_S => {
                match now.has_risen_since(from, LIFTED_M) {
                    true => Lift::Lifted { from: now, since: tick, deepest },
                    false => Lift::InVain(now),
                }
            }
            (Lift::Lifted { .. }, _) => self,
            (Lift::InVain(before), _) if !now.has_sunk_since(before) => self,
            (Lift::Deep(before, since), Some(patience)) if now.by > before.by - RISEN_M => {
                if lasts(since) > patience {
                    Lift::lifted(now, tick)
                } else {
                    self
                }
            }
            (_, Some(_)) => Lift::Deep(now, tick),
            (_, None) => Lift::Clear,
        }
    }
}
