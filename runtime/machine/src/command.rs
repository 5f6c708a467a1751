//! From what a statement asks to what the vehicle is told: amendments, limits, command filter, flow compensation.

use crate::Event;
use crate::state::{Asked, Limits, Run};
use albacore_geometry::Heading;
use albacore_guidance::{CommandFilter, through_water};
use albacore_program::{ActivityKind, Body, Channel, Code, Program, Slot, TURN_RATE_MIN, header};
use albacore_vehicle::{Command, TICK_S};

/// A course that is amended by no more than this, in radians, is the one that was asked: an overlay that computes it has rounded.
const AMENDMENT_MIN_RAD: f64 = 1e-9;

/// An amendment smaller than this, in radians, is not worth a line of trace; it ends below half of it.
const AMENDMENT_TOLD_RAD: f64 = 0.02;

impl Run {
    /// The command of this tick.
    pub fn give_command(&mut self, p: &Program) -> Command {
        // What an overlay keeps goes on like all that was commanded: through its own `wait`, through a hold, and after it.
        let overridden = self.state.overridden;
        overridden.over(&mut self.state.asked);
        let mut asked = self.state.asked;
        // A place is kept: for this tick only, so that whatever comes after it begins from lying still.
        if let Some((course, speed)) = self.state.way_back {
            asked = Asked { course, speed: overridden.speed.unwrap_or(speed), over_ground: true, ..asked };
        }
        let amended = self.amended(p, asked.course);
        let over_ground = asked.over_ground || amended != asked.course;
        let speed = self.limit(Channel::Speed, asked.speed);
        let below = self.below();
        let vertical = self.limit_vertical(asked.vertical, &below);
        let mut filter = CommandFilter::new(self.state.filtered);
        let course = filter.step(amended, self.state.limits.turn_rate, TICK_S);
        self.state.filtered = course;
        // Flow compensation may ask for more speed through the water than the mission allows.
        let speed_max = self.state.limits.speed.1;
        let (heading, speed) = if over_ground && speed > 0.0 {
            let water = through_water(course, speed, self.flow(), speed_max);
            (water.heading, water.speed)
        } else {
            (course, speed.max(0.0))
        };
        let command = Command { heading, speed: self.lift(speed, vertical, &below), vertical };
        self.state.command = Some(command);
        command
    }

    /// The course after all overlays, from inner to outer.
    fn amended(&mut self, p: &Program, asked: Heading) -> Heading {
        // Where nothing has happened, nothing was entered or left.
        if !self.amenders_known || !self.events.is_empty() {
            self.find_amenders(p);
        }
        let mut course = asked;
        for place in 0..self.amenders.len() {
            let (overlay, base) = self.amenders[place];
            course = self.amend(p, overlay, base, course);
        }
        course
    }

    /// Finds the overlays that amend the course, from inner to outer: those of the recovery, which runs beside the mission's body, come first.
    fn find_amenders(&mut self, p: &Program) {
        let mut wearers = Vec::new();
        self.chain(p, &mut |id, base| wearers.push((&p.activities[id as usize].overlays, base)));
        let worn = wearers.iter().rev().flat_map(|(overlays, base)| overlays.iter().map(|overlay| (*overlay, *base)));
        let amends = |overlay: u32| p.activities[p.overlays[overlay as usize].activity as usize].kind;
        self.amenders.clear();
        self.amenders.extend(worn.filter(|(overlay, _)| amends(*overlay) == ActivityKind::AmendsCourse));
        self.amenders_known = true;
    }

    /// The overlays of some activities, given from outside in, amend nothing until they go on; from inner to outer.
    pub fn pause_overlays(&mut self, p: &Program, chain: &[(u32, Slot)]) {
        for (id, base) in chain.iter().rev() {
            for &overlay in &p.activities[*id as usize].overlays {
                self.fall_silent(p, overlay, *base);
            }
        }
    }

    /// The same without what they keep.
    pub fn end_amendments(&mut self, p: &Program, chain: &[(u32, Slot)]) {
        for (id, base) in chain.iter().rev() {
            for &overlay in &p.activities[*id as usize].overlays {
                self.end_amending(p, overlay, *base);
            }
        }
    }

    /// An overlay is left or paused: it leaves the course alone, and keeps nothing in this tick.
    pub fn fall_silent(&mut self, p: &Program, overlay: u32, base: Slot) {
        self.end_amending(p, overlay, base);
        let site = &p.overlays[overlay as usize];
        let overlay = &p.activities[site.activity as usize];
        let state = self.get(base + site.base + overlay.header + header::STATE);
        if let (ActivityKind::Sets(axis), true) = (overlay.kind, state == header::ACTIVE) {
            self.state.overridden.clear(axis);
        }
    }

    /// An overlay leaves the course alone; told when the trace has heard that it does not.
    fn end_amending(&mut self, p: &Program, overlay: u32, base: Slot) {
        let site = &p.overlays[overlay as usize];
        let told = base + site.base + p.activities[site.activity as usize].header + header::AMENDING;
        if self.get(told) != 0.0 {
            self.set(told, 0.0);
            self.events.push(Event::AmendingEnded(site.activity));
        }
    }

    fn amend(&mut self, p: &Program, overlay: u32, base: Slot, asked: Heading) -> Heading {
        let site = &p.overlays[overlay as usize];
        let activity = &p.activities[site.activity as usize];
        let at = base + site.base;
        let active = self.get(at + activity.header + header::STATE) == header::ACTIVE;
        let (ActivityKind::AmendsCourse, Body::Amend { asked: slot, amended }, true) =
            (activity.kind, &activity.body, active)
        else {
            return asked;
        };
        self.set(at + slot, asked.radians());
        self.execute(p, amended.entry, at);
        let given = Heading::from_radians(self.get(at + amended.value));
        let change = (given - asked).abs();
        let told = at + activity.header + header::AMENDING;
        if self.get(told) == 0.0 && change > AMENDMENT_TOLD_RAD {
            self.set(told, 1.0);
            self.events.push(Event::Amending(site.activity, asked.radians(), given.radians()));
        } else if change < AMENDMENT_TOLD_RAD / 2.0 {
            self.end_amending(p, overlay, base);
        }
        if change > AMENDMENT_MIN_RAD { given } else { asked }
    }

    /// The active activities from outside in, with the bases of their frames.
    pub fn chain(&self, p: &Program, visit: &mut impl FnMut(u32, Slot)) {
        let base = p.mission.base;
        self.chain_from(p, p.mission.activity, base, visit);
        // The recovery runs beside the mission's body, in its frame.
        if let Some(recovery) = p.mission.recovery {
            self.chain_from(p, recovery.activity, base, visit);
        }
    }

    pub fn chain_from(&self, p: &Program, id: u32, base: Slot, visit: &mut impl FnMut(u32, Slot)) {
        let mut next = Some((id, base));
        while let Some((id, base)) = next.filter(|&(id, base)| self.is_active(p, id, base)) {
            visit(id, base);
            next = self.child(p, id, base);
        }
    }

    fn is_active(&self, p: &Program, id: u32, base: Slot) -> bool {
        self.get(base + p.activities[id as usize].header + header::STATE) == header::ACTIVE
    }

    /// What an activity has called, or its active behavior, with the base of its frame.
    fn child(&self, p: &Program, id: u32, base: Slot) -> Option<(u32, Slot)> {
        let activity = &p.activities[id as usize];
        let child = self.get(base + activity.header + header::CHILD);
        (child != 0.0).then(|| match &activity.body {
            Body::Table(table) => (table.behaviors[child as usize - 1].activity, base),
            _ => {
                let site = &p.calls[child as usize - 1];
                (site.activity, base + site.base)
            }
        })
    }

    /// Holds a setpoint within its limits, and says when that begins and when it ends.
    pub fn limit(&mut self, channel: Channel, asked: f64) -> f64 {
        let given = self.within_limits(channel, asked);
        self.tell_limited(channel, (given != asked).then_some((asked, given)));
        given
    }

    /// A setpoint within the limits of its own channel.
    pub fn within_limits(&self, channel: Channel, asked: f64) -> f64 {
        let (low, high) = self.state.limits.within(channel);
        // Standing still is always allowed: it is what a hold asks for.
        let is_free = channel.row().is_free_at_zero && asked == 0.0;
        if is_free { 0.0 } else { asked.max(low).min(high.max(low)) }
    }

    /// Says when it begins that another setpoint is given than is asked for (both, while it is so), and when it ends.
    pub fn tell_limited(&mut self, channel: Channel, held: Option<(f64, f64)>) {
        if held.is_some() != std::mem::replace(&mut self.state.limited[channel as usize], held.is_some()) {
            self.events.push(match held {
                // A zero has no sign.
                Some((asked, given)) => Event::Limited(channel, asked, given + 0.0),
                None => Event::LimitedEnded(channel),
            });
        }
    }

    /// The fastest turn as a number: the first statement plans with it.
    pub fn compute_turn_rate(&mut self, p: &Program, base: Slot) {
        if let Some(code) = &p.mission.limits.turn_rate_max {
            self.execute(p, code.entry, base);
            self.state.limits.turn_rate = self.get(base + code.value).max(TURN_RATE_MIN);
        }
    }

    /// The mission's other limits as numbers.
    pub fn compute_limits(&mut self, p: &Program) {
        let base = p.mission.base;
        let mut number = |code: &Option<Code>, otherwise: f64| match code {
            Some(code) => {
                self.execute(p, code.entry, base);
                self.get(base + code.value)
            }
            None => otherwise,
        };
        let mut computed = Limits::NONE;
        for (channel, bounds) in Channel::ALL.into_iter().zip(&p.mission.limits.setpoints) {
            let (least, greatest) = computed.of(channel);
            (*least, *greatest) = (number(&bounds.least, *least), number(&bounds.greatest, *greatest));
        }
        self.state.limits = Limits { turn_rate: self.state.limits.turn_rate, ..computed };
    }
}
