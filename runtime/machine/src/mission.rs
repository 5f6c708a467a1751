//! The machine: a mission from its first tick to its release.

use crate::activity::Status;
use crate::allowance::Allowance;
use crate::bottom::{Bottom, Chart};
use crate::inputs::{MissingInput, senses, wiring};
use crate::state::{Asked, Declared, Limits, Overridden, Phase, Requirement, Run, State, Wish};
use crate::trig::Trig;
use crate::{Event, Outcome};
use albacore_geometry::{Heading, Point};
use albacore_program::{Cause, Code, Input, Program, Slot, header};
use albacore_vehicle::{Channel, Command, Control, Lag, Sample, Snapshot, TICK_S, Vertical};
use std::sync::Arc;

/// A mission whose vehicle has lain on the bottom for so long, s, is aborted: its recovery leads up.
const AGROUND_MAX_S: f64 = 30.0;

/// Executes one mission.
#[derive(Clone)]
pub struct Machine {
    program: Arc<Program>,
    wiring: Vec<Option<u32>>,
    run: Run,
}

impl Run {
    /// A run that has not begun.
    pub fn new(p: &Program) -> Self {
        let mut words = vec![0.0; p.words as usize];
        for input in &p.inputs {
            words[(input.at + Input::STAMP) as usize] = -1.0;
        }
        let constants_at = p.mission.base as usize - p.constants.len();
        words[constants_at..p.mission.base as usize].copy_from_slice(&p.constants);
        let state = State {
            words,
            tick: 0,
            phase: Phase::Waiting,
            asked: Asked { course: Heading::NORTH, over_ground: false, speed: 0.0, vertical: Vertical::Depth(0.0) },
            wish: if p.mission.guest { Wish::Listen } else { Wish::Drive },
            command: None,
            filtered: Heading::NORTH,
            control: Control::Disconnected,
            limits: Limits::NONE,
            declared: Declared::default(),
            bottom: Bottom::default(),
            aground: None,
            limited: [false; 3],
            requires: Vec::new(),
            link: Requirement::LINK,
            lagged: 0,
            lag: Lag::default(),
            within: None,
            began: 0,
            host_began: 0,
            overridden: Overridden::default(),
            way_back: None,
            allowance: Allowance::new(p.reports.len()),
        };
        Run {
            state,
            events: Vec::new(),
            in_overlay: false,
            abort: None,
            deserted: None,
            senses: senses(p),
            chart: None,
            trig: Trig::new(),
        }
    }

    fn number(&mut self, p: &Program, code: &Code) -> f64 {
        self.execute(p, code.entry, p.mission.base);
        self.get(p.mission.base + code.value)
    }
}

impl Machine {
    /// A machine for a mission on a vehicle that delivers these channels.
    pub fn new(program: Arc<Program>, channels: &[Channel]) -> Result<Self, MissingInput> {
        let wiring = wiring(&program, channels)?;
        let run = Run::new(&program);
        Ok(Machine { program, wiring, run })
    }

    /// The same with a chart, for where the vehicle hears no echo of the bottom.
    pub fn with_chart(mut self, chart: Option<Chart>) -> Self {
        self.run.chart = chart;
        self
    }

    /// The program.
    pub fn program(&self) -> &Arc<Program> {
        &self.program
    }

    /// The whole state.
    pub fn state(&self) -> &State {
        &self.run.state
    }

    /// Goes back, or on, to a state of the same program.
    pub fn restore(&mut self, state: State) {
        self.run.state = state;
        self.run.events.clear();
        self.run.abort = None;
        self.run.deserted = None;
    }

    /// What the mission wants of its vehicle from here on.
    pub fn wish(&self) -> Wish {
        self.run.state.wish
    }

    /// Lets a mission that has not begun begin at a later tick, in control, and know what was sensed before: ticks and their
    /// samples, in order.
    pub fn begin_at<'a>(&mut self, tick: u64, past: impl IntoIterator<Item = (u64, &'a [Sample])>) {
        for (then, samples) in past {
            self.run.state.tick = then;
            self.run.take_in(&self.program, &self.wiring, samples);
        }
        self.run.state.tick = tick;
        self.run.hear_control(Control::InControl);
        self.run.events.clear();
    }

    /// Puts a value in place.
    pub fn put(&mut self, at: Slot, words: &[f64]) {
        if let Some(place) = self.run.state.words.get_mut(at as usize..at as usize + words.len()) {
            place.copy_from_slice(words);
        }
    }

    /// Whether an input, by its index in the program, has had a sample.
    pub fn has_sample(&self, input: u32) -> bool {
        self.program.inputs.get(input as usize).is_some_and(|input| self.run.has_sample(input))
    }

    /// The active activities from outside in, with the bases of their frames.
    pub fn frames(&self) -> Vec<(u32, Slot)> {
        let mut frames = Vec::new();
        self.run.chain(&self.program, &mut |id, base| frames.push((id, base)));
        frames
    }

    /// What happened in the last tick, in order.
    pub fn events(&self) -> &[Event] {
        &self.run.events
    }

    /// How the mission ended, once it has.
    pub fn outcome(&self) -> Option<Outcome> {
        match self.run.state.phase {
            Phase::Over(outcome) => Some(outcome),
            _ => None,
        }
    }

    /// The active activities from outside in.
    pub fn active(&self) -> Vec<u32> {
        self.frames().into_iter().map(|(id, _)| id).collect()
    }

    /// Where the mission believes the vehicle to be; `None` before the first sample.
    pub fn position(&self) -> Option<Point> {
        let at = self.run.senses.position?;
        (self.run.get(at + Input::STAMP) >= 0.0).then(|| self.run.position())
    }

    /// One tick: takes in what was sensed, gives what to command. After the end there is nothing to command: release.
    pub fn step(&mut self, snapshot: &Snapshot) -> Option<Command> {
        let Machine { program, wiring, run } = self;
        let p = program.as_ref();
        run.events.clear();
        run.state.overridden = Overridden::default();
        run.state.way_back = None;
        run.events.extend(run.state.allowance.tick());
        run.state.lag = snapshot.lag;
        run.take_in(p, wiring, &snapshot.samples);
        run.hear_control(snapshot.control);
        run.state.aground = snapshot.aground.then(|| run.state.aground.unwrap_or(run.state.tick));
        let command = run.live(p);
        run.state.tick += 1;
        command
    }

    /// Ends the mission because the person or the host says so; gives what happened.
    pub fn end(&mut self, outcome: Outcome) -> &[Event] {
        let program = Arc::clone(&self.program);
        self.run.events.clear();
        if self.outcome().is_none() {
            self.run.over(&program, outcome);
        }
        &self.run.events
    }
}

impl Run {
    /// One tick of whatever phase the mission is in.
    fn live(&mut self, p: &Program) -> Option<Command> {
        let began = self.state.phase != Phase::Waiting;
        let guest = p.mission.guest && !matches!(self.state.phase, Phase::Recovering(..));
        match self.state.control {
            Control::InControl => {}
            // Whoever drives, a guest lives on: its overrides hear of it.
            Control::Monitoring
            | Control::Offered
            | Control::Requesting
            | Control::Released
            | Control::Refused
            | Control::Suspended
                if guest => {}
            Control::Refused => return self.over(p, Outcome::Refused),
            Control::Released if began => return self.over(p, Outcome::ReleasedByVehicle),
            Control::TimedOut => return self.over(p, Outcome::LinkLost),
            Control::Disconnected if began => return self.over(p, Outcome::LinkLost),
            _ => return self.stand_by(p),
        }
        match self.state.phase {
            Phase::Over(_) => None,
            Phase::Waiting => {
                self.state.phase = Phase::Awaiting;
                self.begin_to_count();
                self.execute(p, p.mission.params, p.mission.base);
                self.take_requirements(p);
                self.await_inputs(p)
            }
            Phase::Awaiting => self.await_inputs(p),
            Phase::Running | Phase::Holding(_) => {
                // The time limit bounds the run: it does not stand still while the mission is held.
                let time_is_up = self.time_is_up();
                if self.is_stranded() {
                    self.events.push(Event::Aborted(format!("aground for {AGROUND_MAX_S} s")));
                    return self.recover(p, Outcome::Aground);
                }
                if let Some(held) = self.hold_while_stale(p, time_is_up) {
                    return held;
                }
                let status = self.step(p, p.mission.activity, p.mission.base);
                // Its own end on the very tick of the cut counts as such (rule 5).
                if time_is_up && status == Status::Running && self.abort.is_none() {
                    return self.time_out(p);
                }
                self.after_step(p, status)
            }
            Phase::Recovering(outcome, _) => self.step_recovery(p, outcome),
        }
    }

    /// The vehicle does not listen, for a while: the mission stands still. Its time limit does not, for that bounds the run. A
    /// vehicle that is not ours cannot be recovered.
    fn stand_by(&mut self, p: &Program) -> Option<Command> {
        if !self.time_is_up() {
            return None;
        }
        match (self.state.phase, p.mission.recovery) {
            (Phase::Waiting | Phase::Over(_), _) => None,
            (Phase::Recovering(outcome, _), Some(recovery)) => {
                self.end_recovery(p, recovery.activity, outcome, Cause::TimedOut)
            }
            _ => {
                self.tell_time_is_up();
                self.over(p, Outcome::TimedOut)
            }
        }
    }

    /// Begins once every required input has come that has no `at first`. One that never came is as old as the mission: what
    /// is to be done when it is stale is done, and the mission's time runs.
    fn await_inputs(&mut self, p: &Program) -> Option<Command> {
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
        if p.mission.guest {
            return None;
        }
        // Rule 6: at the very start the present heading and depth, speed 0, as far as they are known.
        let knows = |at: Option<Slot>| at.is_some_and(|at| self.get(at + Input::STAMP) >= 0.0);
        (knows(self.senses.heading) && knows(self.senses.depth)).then(|| Command {
            heading: self.heading(),
            speed: 0.0,
            vertical: Vertical::Depth(self.depth()),
        })
    }

    /// The numbers of the requirements and of the time limit.
    fn take_requirements(&mut self, p: &Program) {
        let mut requires = Vec::new();
        for require in &p.mission.requires {
            let fresh = self.number(p, &require.fresh);
            let patience = require.hold_for.as_ref().map(|code| self.number(p, code));
            requires.push(Requirement { fresh, patience, stale: false, since: 0 });
        }
        self.state.requires = requires;
        self.state.within = p.mission.within.as_ref().map(|code| self.number(p, code));
        if let Some(code) = &p.mission.limits.latency_max {
            self.state.link.fresh = self.number(p, code);
        }
    }

    fn start(&mut self, p: &Program) {
        let base = p.mission.base;
        self.state.phase = Phase::Running;
        self.stand();
        for require in &p.mission.requires {
            let input = &p.inputs[require.input as usize];
            if let Some(at_first) = &require.at_first
                && !self.has_sample(input)
            {
                self.execute(p, at_first.entry, base);
                let words = input.shape.words();
                self.copy(input.at + Input::VALUE, base + at_first.value, words);
                let first = self.get(input.at + Input::VALUE);
                self.set(input.at + Input::PEAK, first);
            }
        }
        self.enter(p, p.mission.activity, base, None);
        self.take_requirements(p);
        self.compute_limits(p);
    }

    fn time_out(&mut self, p: &Program) -> Option<Command> {
        self.tell_time_is_up();
        self.recover(p, Outcome::TimedOut)
    }

    /// Required inputs that are too old suspend the mission; too long, and they abort it. Gives the command of a mission that
    /// is held.
    fn hold_while_stale(&mut self, p: &Program, time_is_up: bool) -> Option<Option<Command>> {
        let tick = self.state.tick;
        let lagging = self.lagging();
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
        let before = self.state.asked;
        self.state.asked.speed = 0.0;
        let command = self.command_if_ours(p);
        self.state.asked = before;
        Some(command)
    }

    fn after_step(&mut self, p: &Program, status: Status) -> Option<Command> {
        if let Some(why) = self.abort.take() {
            self.events.push(Event::Aborted(why));
            return match self.deserted.take() {
                Some(outcome) => self.over(p, outcome),
                None => self.recover(p, Outcome::Aborted),
            };
        }
        if status == Status::Ended {
            return self.over(p, Outcome::Completed);
        }
        self.command_if_ours(p)
    }

    /// Leaves all that is inside the mission and begins the recovery; without one the mission is over, and so is that of a
    /// guest while its vehicle runs its own plan.
    fn recover(&mut self, p: &Program, outcome: Outcome) -> Option<Command> {
        self.abort = None;
        let wish = self.state.wish;
        let cause = if outcome == Outcome::TimedOut { Cause::TimedOut } else { Cause::Aborted };
        let (id, base) = (p.mission.activity, p.mission.base);
        let at = base + p.activities[id as usize].header;
        self.leave_body(p, cause);
        let Some(recovery) = p.mission.recovery.filter(|_| wish == Wish::Drive) else { return self.over(p, outcome) };
        self.state.wish = wish;
        // Frozen now, as every time limit is (rule 4).
        self.begin_to_count();
        self.state.within = recovery.within.as_ref().map(|code| self.number(p, code));
        self.state.phase = Phase::Recovering(outcome, self.state.tick);
        self.enter(p, recovery.activity, base, Some(at + header::SETPOINTS));
        if self.abort.take().is_some() {
            return self.end_recovery(p, recovery.activity, outcome, Cause::Aborted);
        }
        self.command_if_ours(p)
    }

    fn step_recovery(&mut self, p: &Program, outcome: Outcome) -> Option<Command> {
        let Some(recovery) = p.mission.recovery else { return self.over(p, outcome) };
        let base = p.mission.base;
        let mission = &p.activities[p.mission.activity as usize];
        // Overlays stay in force; their aborts do not: there is nothing left to abort.
        self.execute(p, mission.refresh, base);
        self.step_overlays(p, mission, base);
        self.abort = None;
        let time_is_up = self.time_is_up();
        let status = self.step(p, recovery.activity, base);
        // Its own end on the very tick of the cut counts as such (rule 5). What it calls may say `abort`: that ends it too.
        let ended = match (self.abort.take(), status) {
            (Some(_), _) => Some(Cause::Aborted),
            (None, Status::Ended) => Some(Cause::Done),
            (None, Status::Running) => time_is_up.then_some(Cause::TimedOut),
        };
        if let Some(cause) = ended {
            return self.end_recovery(p, recovery.activity, outcome, cause);
        }
        Some(self.give_command(p))
    }

    fn end_recovery(&mut self, p: &Program, recovery: u32, outcome: Outcome, cause: Cause) -> Option<Command> {
        self.leave(p, recovery, p.mission.base, cause);
        self.over(p, outcome)
    }

    /// Whether the vehicle that we drive has lain on the bottom for too long: what the mission asks for does not free it.
    fn is_stranded(&self) -> bool {
        let lain = self.state.aground.map_or(0, |since| self.state.tick.saturating_sub(since));
        self.state.wish == Wish::Drive && lain as f64 * TICK_S >= AGROUND_MAX_S
    }

    /// The end: everything is left, nothing more is commanded. A mission that leaves its vehicle on the bottom has not come to
    /// its own end, whatever it says.
    fn over(&mut self, p: &Program, outcome: Outcome) -> Option<Command> {
        if matches!(self.state.phase, Phase::Over(_)) {
            return None;
        }
        let ended_by_us = matches!(outcome, Outcome::Completed | Outcome::TimedOut | Outcome::Aborted);
        let stranded = ended_by_us && self.state.aground.is_some();
        if stranded && outcome == Outcome::Completed {
            self.events.push(Event::Aborted(String::from("the vehicle lies on the bottom")));
        }
        let cause = match outcome {
            Outcome::Completed => Cause::Done,
            Outcome::TimedOut => Cause::TimedOut,
            _ => Cause::Aborted,
        };
        let base = p.mission.base;
        if let Some(recovery) = p.mission.recovery {
            self.leave(p, recovery.activity, base, Cause::Preempted);
        }
        self.leave(p, p.mission.activity, base, cause);
        self.events.extend(self.state.allowance.end());
        let outcome = if stranded { Outcome::Aground } else { outcome };
        self.state.phase = Phase::Over(outcome);
        self.events.push(Event::Ended(outcome));
        None
    }
}
