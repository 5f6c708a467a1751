//! What a mission requires: it waits for the first samples, and is held while they are too old.

use crate::activity::Status;
use crate::state::{Phase, Requirement, Run};
use crate::{Event, Outcome};
use albacore_program::{Input, LIMIT_FRESH_S, Program, Slot, senses};
use albacore_vehicle::measurements::{DEPTH, info};
use albacore_vehicle::{Command, TICK_S};

impl Run {
    /// Begins once every required input has come that has no `at first`. One that never came is as old as the mission: what
    /// is to be done when it is stale is done, and the mission's time runs.
    pub fn await_inputs(&mut self, p: &Program) -> Option<Command> {
        let lived = (self.state.tick - self.state.began) as f64;
        let mut waits = false;
        for (i, require) in p.mission.requires.iter().enumerate() {
            let input = &p.inputs[require.input as usize];
            if require.at_first.is_some() || self.has_sample(input) {
                continue;
            }
            waits = true;
            let Requirement { fresh, patience, .. } = self.state.requires[i];
            if !std::mem::replace(&mut self.state.requires[i].stale, true) {
                self.events.push(Event::Awaited(require.input));
            }
            if lived > fresh + patience.unwrap_or(0.0) {
                self.events.push(Event::Aborted(format!("`{}` has never come", input.name)));
                return self.over(p, Outcome::Aborted);
            }
        }
        if !waits {
            self.start(p);
            return self.after_step(p, Status::Running);
        }
        if self.time_is_up() {
            self.tell_time_is_up();
            return self.over(p, Outcome::TimedOut);
        }
        if self.is_stranded() {
            self.tell_stranded();
            return self.over(p, Outcome::Aground);
        }
        if p.mission.guest {
            return None;
        }
        // Rule 6: at the very start the present heading and depth, speed 0, once they are known. What is present is taken once:
        // a depth that is told otherwise than it is held would lead further and further down.
        self.compare_depth();
        if !self.state.stands {
            let knows = |at: Option<Slot>| at.is_some_and(|at| self.get(at + Input::STAMP) >= 0.0);
            let is_late = lived * TICK_S > LIMIT_FRESH_S;
            let knows_depth = knows(self.senses.depth) && (self.state.depth_agrees || is_late);
            let knows_both = knows(self.senses.heading) && knows_depth;
            // Limits of depth and altitude do not wait for them: of what is not known it is north, and the surface.
            let limits_wait = !(self.bounds_vertical() && is_late);
            if !knows_both && limits_wait {
                return None;
            }
            self.stand();
        }
        self.command_if_ours(p)
    }

    /// The first depth may be wrong, and nothing tells it but the next one: it is held once two agree, and anew where one contradicts it.
    fn compare_depth(&mut self) {
        let stamp = self.senses.depth.map_or(-1.0, |at| self.get(at + Input::STAMP));
        if stamp < 0.0 {
            return;
        }
        let now = self.depth();
        match self.state.depth_before {
            Some((_, then)) if stamp <= then => return,
            Some((before, then)) => {
                let reading = |depth| [depth, 0.0, 0.0, 0.0];
                let time = (stamp - then) * TICK_S;
                self.state.depth_agrees = info(DEPTH).can_follow(reading(now), reading(before), time);
                self.state.stands &= self.state.depth_agrees;
            }
            None => {}
        }
        self.state.depth_before = Some((now, stamp));
    }

    /// The numbers of the requirements and of the time limit.
    pub fn take_requirements(&mut self, p: &Program) {
        let mut requires = Vec::new();
        self.state.echo_fresh = LIMIT_FRESH_S / TICK_S;
        for require in &p.mission.requires {
            let fresh = self.number(p, &require.fresh);
            let patience = require.hold_for.as_ref().map(|code| self.number(p, code));
            if matches!(&*p.inputs[require.input as usize].name, senses::ALTITUDE | senses::WATER_DEPTH) {
                self.state.echo_fresh = self.state.echo_fresh.min(fresh);
            }
            requires.push(Requirement { fresh, patience, stale: false, since: 0 });
        }
        self.state.requires = requires;
        self.state.within = p.mission.within.as_ref().map(|code| self.number(p, code));
        if let Some(code) = &p.mission.limits.latency_max {
            self.state.link.fresh = self.number(p, code);
        }
    }

    /// Required inputs that are too old suspend the mission; too long, and they abort it. Gives the command of a mission that
    /// is held.
    pub fn hold_while_stale(&mut self, p: &Program, time_is_up: bool) -> Option<Option<Command>> {
        let tick = self.state.tick;
        let lagging = self.lagging();
        if lagging.is_none() && self.are_fresh(p) && !matches!(self.state.phase, Phase::Holding(_)) {
            return None;
        }
        let (mut any_stale, mut lost) = (lagging.is_some(), self.lost_link(lagging.as_deref()));
        for (i, require) in p.mission.requires.iter().enumerate() {
            let input = &p.inputs[require.input as usize];
            // Before its first sample the `at first` value holds.
            let stale = self.has_sample(input) && self.age_ticks(input) > self.state.requires[i].fresh;
            if stale != self.state.requires[i].stale {
                self.state.requires[i].stale = stale;
                self.state.requires[i].since = tick;
                self.events.push(if stale { Event::Stale(require.input) } else { Event::Fresh(require.input) });
            }
            // Each has a patience of its own, which counts from when it became stale.
            let Requirement { patience, since, .. } = self.state.requires[i];
            if stale && (tick - since) as f64 >= patience.unwrap_or(0.0) {
                let cause = lagging.as_ref().map(|lagging| format!(": {lagging}")).unwrap_or_default();
                lost = lost.or_else(|| Some(format!("no fresh `{}`{cause}", input.name)));
            }
            any_stale |= stale;
        }
        if !any_stale {
            if matches!(self.state.phase, Phase::Holding(_)) {
                self.state.phase = Phase::Running;
            }
            return None;
        }
        let since = match self.state.phase {
            Phase::Holding(since) => since,
            _ => self.state.tick,
        };
        self.state.phase = Phase::Holding(since);
        if let Some(why) = lost {
            self.events.push(Event::Aborted(why));
            return Some(self.recover(p, Outcome::Aborted));
        }
        if time_is_up {
            return Some(self.time_out(p));
        }
        Some(self.drives().then(|| self.still_command(p)))
    }

    /// Whether all that is required is as fresh as it was in the tick before: so it is almost always.
    fn are_fresh(&self, p: &Program) -> bool {
        let (now, round_trip) = (self.state.tick as f64, self.state.lag.round_trip as f64);
        p.mission.requires.iter().zip(&self.state.requires).all(|(require, known)| {
            let stamp = self.get(p.inputs[require.input as usize].at + Input::STAMP);
            !known.stale && (stamp < 0.0 || now - stamp + round_trip <= known.fresh)
        })
    }
}
