//! Section 8: a vehicle that is deeper than its limits allow, and does not rise, makes way.

use super::mission::Evaluator;
use super::sinking::Sinking;
use albacore_program::Channel;
use albacore_vehicle::Vertical;

/// Half a minute.
const VAIN_TICKS: u64 = 300;

/// Where a vehicle is.
#[derive(Clone, Copy)]
struct Place {
    /// By so much too deep, m.
    by: f64,
    depth: f64,
    altitude: Option<f64>,
    is_low: bool,
}

/// The way that it makes: where it has to rise from, since when, and where it was deepest.
struct Way {
    from: Place,
    since: u64,
    deepest: Place,
}

#[derive(Default)]
pub(super) struct Lift {
    /// The last tick in which we drove.
    driven: Option<u64>,
    sinking: Sinking,
    /// Since when it has been too deep, and where it was then.
    waits: Option<(u64, Place)>,
    way: Option<Way>,
    /// Where it was when it had made way in vain.
    vain: Option<Place>,
}

impl Evaluator<'_> {
    /// The speed that a vehicle makes which is asked for one, and is told a depth or an altitude.
    pub(super) fn lift(&mut self, asked: f64, told: Vertical) -> f64 {
        let fastest = self.limits[Channel::Speed as usize].1.min(1.5);
        let (tick, depth, altitude) = (self.w.tick, self.w.depth().unwrap_or(0.0), self.bottom.told(&self.w));
        let others_drove = self.lift.driven.replace(tick).is_none_or(|last| tick - last > 1);
        let is_deeper_than_told = match told {
            Vertical::Depth(told) => depth > told + 1.0,
            Vertical::Altitude(told) => altitude.is_some_and(|altitude| altitude < told - 1.0),
        };
        self.lift.sinking.tell(depth, is_deeper_than_told && !others_drove);
        // As long as nothing is known, or nothing can be done, all stays as it is.
        if let Some(by) = self.too_deep().filter(|_| fastest > 0.0) {
            let by = by + self.lift.sinking.ahead();
            let now = Place { by, depth, altitude, is_low: self.is_low() };
            let made_way = self.lift.way.is_some();
            if others_drove {
                self.lift.begin_anew(tick, now);
            }
            self.lift.look(tick, now);
            match (made_way, &self.lift) {
                (false, Lift { way: Some(_), .. }) => self.w.say(format!("lifted {fastest:?}")),
                (true, Lift { vain: Some(_), .. }) => self.w.say("lifted_in_vain".into()),
                (true, Lift { way: None, .. }) => self.w.say("risen".into()),
                _ => {}
            }
        }
        if self.lift.way.is_some() { asked.max(fastest) } else { asked }
    }
}

impl Lift {
    /// Whether it makes way, or has in vain: its depth may be told wrong.
    pub fn leads_to_the_surface(&self) -> bool {
        self.way.is_some() || self.vain.is_some()
    }

    fn begin_anew(&mut self, tick: u64, now: Place) {
        self.vain = None;
        self.way = self.way.take().map(|_| Way::begin(tick, now));
    }

    fn look(&mut self, tick: u64, now: Place) {
        // It has risen.
        if self.leads_to_the_surface() && now.by <= 0.2 {
            (self.way, self.vain) = (None, None);
            return;
        }
        if let Some(way) = &mut self.way {
            let is_late = tick - way.since > VAIN_TICKS;
            let sinks = now.is_below(way.deepest, 0.2);
            if now.is_above(way.from, 0.5) || is_late && !sinks && now.is_above(way.from, 0.2) {
                (way.from, way.since) = (now, tick);
            } else if sinks {
                *way = Way::begin(tick, now);
            } else if is_late {
                (self.way, self.vain) = (None, Some(now));
            }
            return;
        }
        if let Some(then) = self.vain {
            let further = if now.is_low { 0.5 } else { 1.0 };
            if !now.is_below(then, further) && (then.is_low || !now.is_low) {
                return;
            }
            self.vain = None;
        }
        self.wait(tick, now);
    }

    /// 2 s where the altitude is low, and 5 s where it is 1 m too deep, in which that becomes no 50 cm less.
    fn wait(&mut self, tick: u64, now: Place) {
        let is_too_deep = now.is_low || now.by > 1.0;
        let patience = if now.is_low { 20 } else { 50 };
        let (since, then) = self.waits.filter(|(_, then)| now.by > then.by - 0.5).unwrap_or((tick, now));
        self.waits = is_too_deep.then_some((since, then));
        if is_too_deep && tick - since > patience {
            self.waits = None;
            self.way = Some(Way::begin(tick, now));
        }
    }
}

impl Way {
    fn begin(tick: u64, now: Place) -> Self {
        Way { from: now, since: tick, deepest: now }
    }
}

impl Place {
    /// Whether it is higher than there by so much, m: by what it is too deep, which a bottom that rises may hide, or by its depth.
    fn is_above(&self, there: Place, rise: f64) -> bool {
        self.by <= there.by - rise || self.depth <= there.depth - rise || self.climb(there) >= rise
    }

    fn is_below(&self, there: Place, fall: f64) -> bool {
        self.by > there.by + fall || self.climb(there) <= -fall
    }

    /// Of a depth that is exactly the same the altitude tells, m.
    fn climb(&self, there: Place) -> f64 {
        match (self.altitude, there.altitude) {
            (Some(here), Some(there_was)) if self.depth == there.depth => here - there_was,
            _ => 0.0,
        }
    }
}
