//! Entering, stepping and leaving activities: the heart of the rules of time.

use crate::Event;
use crate::execute::Stop;
use crate::state::{Declared, Phase, Run};
use crate::tried::Condition;
use albacore_program::{
    Activity, ActivityId, ActivityKind, Addr, Body, Cause, Entry, Exit, Op, Program, Slot, Table, Target, header,
    setpoints,
};

/// What became of an activity in a tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Status {
    /// It goes on.
    Running,
    /// It came to its own end.
    Ended,
}

impl Run {
    fn head(&self, activity: &Activity, base: Slot, word: u32) -> f64 {
        self.get(base + activity.header + word)
    }

    fn set_head(&mut self, activity: &Activity, base: Slot, word: u32, value: f64) {
        self.set(base + activity.header + word, value);
    }

    /// Rule 9: declarations in textual order, reactions, body. `inherited` is where the setpoints of the caller are.
    pub fn enter(&mut self, p: &Program, id: ActivityId, base: Slot, inherited: Option<Slot>) {
        let activity = &p.activities[id as usize];
        let at = base + activity.header;
        self.set(at + header::PC, header::ENDED);
        self.set(at + header::AGE, 0.0);
        self.set(at + header::STATE, header::ACTIVE);
        self.set(at + header::CHILD, 0.0);
        self.set(at + header::BACK_TO, 0.0);
        self.set(at + header::AMENDING, 0.0);
        match inherited {
            Some(from) => self.copy(at + header::SETPOINTS, from, setpoints::WORDS),
            None => {
                for (word, none) in (at + header::SETPOINTS..).zip(setpoints::NONE) {
                    self.set(word, none);
                }
            }
        }
        self.events.push(Event::Entered(id));
        self.execute(p, activity.entry, base);
        if activity.kind == ActivityKind::Mission {
            self.remember_declared(p, activity, base);
            self.compute_turn_rate(p, base);
        }
        self.execute(p, activity.reactions, base);
        match &activity.body {
            // A body that ends without having taken time ends on the next tick (rule 6).
            Body::Sequence(entry) => _ = self.run_body(p, activity, base, *entry),
            Body::Table(table) => self.enter_behavior(p, activity, table, base, table.start, None),
            Body::Amend { .. } => {}
        }
    }

    /// Runs a body until it gives the tick away; tells whether it came to its end.
    fn run_body(&mut self, p: &Program, activity: &Activity, base: Slot, from: Addr) -> Status {
        let (pc, status) = match self.execute(p, from, base) {
            Stop::Yield(pc) => (f64::from(pc), Status::Running),
            Stop::Abort => return Status::Running,
            Stop::End | Stop::Return => (header::ENDED, Status::Ended),
        };
        self.set_head(activity, base, header::PC, pc);
        status
    }

    /// Rule 2: signals and timers; aborts; rules; reactions; body.
    pub fn step(&mut self, p: &Program, id: ActivityId, base: Slot) -> Status {
        let activity = &p.activities[id as usize];
        self.live_a_tick(p, activity, base);
        if self.aborts(p, id, base) {
            return Status::Running;
        }
        self.step_overlays(p, activity, base);
        if self.abort.is_some() {
            return Status::Running;
        }
        let mut switched = false;
        if let Body::Table(table) = &activity.body {
            match self.try_rules(p, activity, table, base, false) {
                Switch::None => {}
                Switch::Entered => switched = true,
                Switch::Finished => return Status::Ended,
            }
            if self.abort.is_some() {
                return Status::Running;
            }
        }
        self.execute(p, activity.reactions, base);
        match &activity.body {
            Body::Sequence(_) => {
                let pc = self.head(activity, base, header::PC);
                if pc < 0.0 { Status::Ended } else { self.run_body(p, activity, base, pc as Addr) }
            }
            Body::Table(_) if switched => Status::Running,
            Body::Table(table) => self.step_table(p, activity, table, base),
            Body::Amend { .. } => Status::Running,
        }
    }

    /// A tick older, with signals and timers of this tick.
    pub fn live_a_tick(&mut self, p: &Program, activity: &Activity, base: Slot) {
        let age = self.head(activity, base, header::AGE);
        self.set_head(activity, base, header::AGE, age + 1.0);
        self.execute(p, activity.refresh, base);
    }

    fn aborts(&mut self, p: &Program, id: ActivityId, base: Slot) -> bool {
        let activity = &p.activities[id as usize];
        // Rule 17: the recovery runs without them.
        if matches!(self.state.phase, Phase::Recovering(..)) {
            return false;
        }
        for (at, abort) in activity.aborts.iter().enumerate() {
            self.execute(p, abort.condition.entry, base);
            let holds = self.get(base + abort.condition.value) != 0.0;
            if self.tried.is_some() {
                self.note_tried(p, Condition::Abort(id, at as u32), false, holds, base);
            }
            if holds {
                self.abort = Some(self.filled(&p.texts[abort.why as usize], base, p));
                return true;
            }
        }
        false
    }

    /// The active behavior of a table, and when it is done the rules that mention `done` (rule 8). Without such a rule the
    /// behavior that waits goes on in this same tick (rule 12), and may itself be done in it.
    fn step_table(&mut self, p: &Program, activity: &Activity, table: &Table, base: Slot) -> Status {
        while let Some(active) = self.active_behavior(activity, base) {
            let entry = &table.behaviors[active as usize];
            if self.step(p, entry.activity, base) == Status::Running || self.abort.is_some() {
                return Status::Running;
            }
            match self.try_rules(p, activity, table, base, true) {
                Switch::Finished => return Status::Ended,
                Switch::Entered => return Status::Running,
                Switch::None if self.go_back(p, activity, table, base, active) => {}
                Switch::None => return Status::Running,
            }
        }
        Status::Running
    }

    fn active_behavior(&self, activity: &Activity, base: Slot) -> Option<u32> {
        let child = self.head(activity, base, header::CHILD);
        (child > 0.0).then(|| child as u32 - 1)
    }

    /// Rule 12: a behavior that is done makes room for the one that waits, if one does.
    fn go_back(&mut self, p: &Program, activity: &Activity, table: &Table, base: Slot, done: u32) -> bool {
        let behavior = &p.activities[table.behaviors[done as usize].activity as usize];
        let waiting = self.head(behavior, base, header::BACK_TO);
        if waiting == 0.0 {
            return false;
        }
        let waiting = waiting as u32 - 1;
        self.set_head(behavior, base, header::BACK_TO, 0.0);
        self.leave(p, table.behaviors[done as usize].activity, base, Cause::Done);
        let id = table.behaviors[waiting as usize].activity;
        self.set_head(&p.activities[id as usize], base, header::STATE, header::ACTIVE);
        self.set_head(activity, base, header::CHILD, f64::from(waiting + 1));
        self.events.push(Event::Resumed(id));
        // It lives this tick, and so do the timers of its rules: it may be done in it.
        self.watch(p, &table.behaviors[waiting as usize], base);
        true
    }

    /// Tries the rules of the active behavior; `done` tells whether its body came to its end in this tick.
    fn try_rules(&mut self, p: &Program, activity: &Activity, table: &Table, base: Slot, done: bool) -> Switch {
        let Some(active) = self.active_behavior(activity, base) else { return Switch::None };
        let entry = &table.behaviors[active as usize];
        if !done {
            self.watch(p, entry, base);
        }
        for (i, exit) in entry.exits.iter().enumerate() {
            let guard = if done { exit.guard_done } else { Some(exit.guard) };
            let Some(guard) = guard else { continue };
            self.execute(p, guard.entry, base);
            let holds = self.get(base + guard.value) != 0.0;
            if self.tried.is_some() {
                self.note_tried(p, Condition::Exit(entry.activity, i as u32), done, holds, base);
            }
            if holds {
                return self.switch(p, activity, table, base, active, i as u32, done);
            }
        }
        Switch::None
    }

    /// The timers of the rules that may leave a behavior live a tick. They come before its own step, and count by the age that it
    /// will have in this tick.
    fn watch(&mut self, p: &Program, entry: &Entry, base: Slot) {
        if matches!(p.ops.get(entry.watch as usize), Some(Op::Return)) {
            return;
        }
        let behavior = &p.activities[entry.activity as usize];
        let age = self.head(behavior, base, header::AGE);
        self.set_head(behavior, base, header::AGE, age + 1.0);
        self.execute(p, entry.watch, base);
        self.set_head(behavior, base, header::AGE, age);
    }

    #[allow(
        clippy::too_many_arguments,
        reason = "a switch has this many sides: who, where, from what, by which rule, when"
    )]
    fn switch(
        &mut self,
        p: &Program,
        activity: &Activity,
        table: &Table,
        base: Slot,
        from: u32,
        exit_index: u32,
        done: bool,
    ) -> Switch {
        let entry: &Entry = &table.behaviors[from as usize];
        let exit: &Exit = &entry.exits[exit_index as usize];
        let rule = &p.rules[exit.rule as usize];
        let mut values = self.values(p, &exit.watched, base);
        let back = rule.back && rule.target != Target::Behavior(from);
        if back && exit.guard_done.is_some() {
            values.push(f64::from(u8::from(done)));
        }
        self.events.push(Event::Switched { rule: exit.rule, from: entry.activity, exit: exit_index, values });
        // The result is of the tick as it was when the rule was tried.
        if let Target::Finish(Some(code)) = rule.target {
            self.execute(p, code, base);
        }
        if back {
            self.events.push(Event::Suspended(entry.activity));
            let mut waiting = Vec::new();
            self.chain_from(p, entry.activity, base, &mut |id, base| waiting.push((id, base)));
            self.pause_overlays(p, &waiting);
            self.set_head(&p.activities[entry.activity as usize], base, header::STATE, header::SUSPENDED);
        } else {
            self.leave_with_waiting(p, table, base, from, if done { Cause::Done } else { Cause::Rule });
        }
        self.set_head(activity, base, header::CHILD, 0.0);
        if let Some(effect) = rule.effect {
            self.execute(p, effect, base);
        }
        match rule.target {
            Target::Behavior(to) => {
                // Entering a suspended behavior afresh leaves it first; what waits for it now waits for the one that
                // interrupted it.
                let id = table.behaviors[to as usize].activity;
                if self.head(&p.activities[id as usize], base, header::STATE) == header::SUSPENDED {
                    self.pass_on_waiting(p, table, base, to);
                    self.leave(p, id, base, Cause::Rule);
                }
                let back_to = back.then_some(from);
                self.enter_behavior(p, activity, table, base, to, back_to);
                Switch::Entered
            }
            Target::Finish(_) => Switch::Finished,
            Target::Abort(why) => {
                self.abort = Some(self.filled(&p.texts[why as usize], base, p));
                Switch::Entered
            }
        }
    }

    /// Leaves a behavior, and those that wait for it to be done.
    fn leave_with_waiting(&mut self, p: &Program, table: &Table, base: Slot, from: u32, cause: Cause) {
        let mut next = Some((from, cause));
        while let Some((behavior, cause)) = next {
            let id = table.behaviors[behavior as usize].activity;
            let waiting = self.head(&p.activities[id as usize], base, header::BACK_TO);
            self.set_head(&p.activities[id as usize], base, header::BACK_TO, 0.0);
            self.leave(p, id, base, cause);
            next = (waiting > 0.0).then(|| (waiting as u32 - 1, outer_cause(cause)));
        }
    }

    /// Takes a suspended behavior out of the row of those that wait for one another.
    fn pass_on_waiting(&mut self, p: &Program, table: &Table, base: Slot, suspended: u32) {
        let behavior = |which: u32| &p.activities[table.behaviors[which as usize].activity as usize];
        let waiting = self.head(behavior(suspended), base, header::BACK_TO);
        for which in 0..table.behaviors.len() as u32 {
            if self.head(behavior(which), base, header::BACK_TO) == f64::from(suspended + 1) {
                self.set_head(behavior(which), base, header::BACK_TO, waiting);
            }
        }
        self.set_head(behavior(suspended), base, header::BACK_TO, 0.0);
    }

    fn enter_behavior(
        &mut self,
        p: &Program,
        owner: &Activity,
        table: &Table,
        base: Slot,
        which: u32,
        back_to: Option<u32>,
    ) {
        let entry = &table.behaviors[which as usize];
        self.set_head(owner, base, header::CHILD, f64::from(which + 1));
        // The rules' timers watch from here: the age they count by begins with the behavior.
        let behavior = &p.activities[entry.activity as usize];
        self.set_head(behavior, base, header::AGE, 0.0);
        self.execute(p, entry.arm, base);
        self.enter(p, entry.activity, base, Some(base + owner.header + header::SETPOINTS));
        if let Some(waiting) = back_to {
            self.set_head(behavior, base, header::BACK_TO, f64::from(waiting + 1));
        }
    }

    /// Leaves an activity, innermost first.
    pub fn leave(&mut self, p: &Program, id: ActivityId, base: Slot, cause: Cause) {
        let activity = &p.activities[id as usize];
        if self.head(activity, base, header::STATE) == header::IDLE {
            return;
        }
        // What is inside did not choose to end.
        self.leave_inside(p, activity, base, outer_cause(cause));
        for &overlay in &activity.overlays {
            self.take_off(p, overlay, base, outer_cause(cause));
        }
        self.set_head(activity, base, header::STATE, header::IDLE);
        self.set_head(activity, base, header::CHILD, 0.0);
        self.set_head(activity, base, header::PC, header::ENDED);
        if let (Cause::Done, Some(result)) = (cause, &activity.result) {
            self.events.push(Event::Finished(id, self.slice(base + result.slot, result.shape.words()).to_vec()));
        }
        self.events.push(Event::Left(id, cause));
        // However it ends (rule 18).
        if activity.kind == ActivityKind::Override {
            self.give_back(p);
        }
    }

    /// Leaves what a body has called, or the behaviors of a table.
    fn leave_inside(&mut self, p: &Program, activity: &Activity, base: Slot, cause: Cause) {
        let child = self.head(activity, base, header::CHILD);
        if child > 0.0 {
            let child = child as u32 - 1;
            match &activity.body {
                Body::Table(table) => self.leave_with_waiting(p, table, base, child, cause),
                _ => {
                    let site = &p.calls[child as usize];
                    self.leave(p, site.activity, base + site.base, cause);
                }
            }
        }
    }

    /// Leaves all that the mission's body has entered and put in force; the mission itself stays for the recovery, and what
    /// its declarations have put in force (rule 17).
    pub fn leave_body(&mut self, p: &Program, cause: Cause) {
        let (activity, base) = (&p.activities[p.mission.activity as usize], p.mission.base);
        if self.head(activity, base, header::STATE) != header::ACTIVE {
            return;
        }
        self.leave_inside(p, activity, base, outer_cause(cause));
        self.set_head(activity, base, header::CHILD, 0.0);
        self.set_head(activity, base, header::PC, header::ENDED);
        let Declared { setpoints, overlays } = self.state.declared;
        for &overlay in &activity.overlays[..activity.overlays.len() - overlays] {
            self.take_off(p, overlay, base, outer_cause(cause));
        }
        let at = (base + activity.header + header::SETPOINTS) as usize;
        self.state.words[at..at + setpoints.len()].copy_from_slice(&setpoints);
    }

    fn remember_declared(&mut self, p: &Program, activity: &Activity, base: Slot) {
        let mut setpoints = [0.0; setpoints::WORDS as usize];
        setpoints.copy_from_slice(self.slice(base + activity.header + header::SETPOINTS, setpoints::WORDS));
        let is_worn = |overlay: &&u32| {
            let site = &p.overlays[**overlay as usize];
            let state = base + site.base + p.activities[site.activity as usize].header + header::STATE;
            self.get(state) == header::ACTIVE
        };
        let overlays = activity.overlays.iter().filter(is_worn).count();
        self.state.declared = Declared { setpoints, overlays };
    }

    pub fn enter_call(&mut self, p: &Program, call: u32, base: Slot) {
        let site = &p.calls[call as usize];
        self.set_caller(p, call, base, f64::from(call + 1));
        self.enter(p, site.activity, base + site.base, Some(base + site.setpoints));
    }

    /// Steps what a body has called; tells whether it came to its end.
    pub fn step_call(&mut self, p: &Program, call: u32, base: Slot) -> bool {
        let site = &p.calls[call as usize];
        let over = self.step(p, site.activity, base + site.base) == Status::Ended && self.abort.is_none();
        if over {
            self.set_caller(p, call, base, 0.0);
            self.leave(p, site.activity, base + site.base, Cause::Done);
        }
        over
    }

    pub fn cut_call(&mut self, p: &Program, call: u32, base: Slot, cause: Cause) {
        let site = &p.calls[call as usize];
        self.leave(p, site.activity, base + site.base, cause);
        self.set_caller(p, call, base, 0.0);
    }

    fn set_caller(&mut self, p: &Program, call: u32, base: Slot, child: f64) {
        self.set(base + p.calls[call as usize].caller + header::CHILD, child);
    }

    pub fn put_on(&mut self, p: &Program, overlay: u32, base: Slot) {
        let site = &p.overlays[overlay as usize];
        let outer = std::mem::replace(&mut self.in_overlay, true);
        self.enter(p, site.activity, base + site.base, None);
        self.in_overlay = outer;
    }

    pub fn take_off(&mut self, p: &Program, overlay: u32, base: Slot, cause: Cause) {
        let site = &p.overlays[overlay as usize];
        self.fall_silent(p, overlay, base);
        self.leave(p, site.activity, base + site.base, cause);
    }

    /// Steps the overlays that an activity wears.
    pub fn step_overlays(&mut self, p: &Program, activity: &Activity, base: Slot) {
        for &overlay in &activity.overlays {
            let site = &p.overlays[overlay as usize];
            let at = base + site.base;
            if self.head(&p.activities[site.activity as usize], at, header::STATE) == header::ACTIVE {
                let outer = std::mem::replace(&mut self.in_overlay, true);
                self.step(p, site.activity, at);
                self.in_overlay = outer;
                // What is later in the order of the tick is not reached any more.
                if self.abort.is_some() {
                    return;
                }
            }
        }
    }
}

/// Why what is inside is left when something outside is left for a cause.
fn outer_cause(cause: Cause) -> Cause {
    if cause == Cause::Aborted { Cause::Aborted } else { Cause::Preempted }
}

/// What trying the rules led to.
enum Switch {
    None,
    Entered,
    Finished,
}
