//! The machine: a mission from its first tick to its release.

use crate::activity::Status;
use crate::aground::Aground;
use crate::allowance::Allowance;
use crate::bottom::{Bottom, Chart};
use crate::bound::Bound;
use crate::inputs::{MissingInput, Wiring, senses, wiring};
use crate::lift::Lift;
use crate::rest::Rest;
use crate::sinking::Sinking;
use crate::state::{Asked, ControlRequest, Declared, Limits, Overridden, Phase, Requirement, Run, State};
use crate::tried::Tried;
use crate::trig::Trig;
use crate::{Event, Outcome};
use albacore_geometry::{Heading, Point};
use albacore_program::{Cause, Code, Input, LIMIT_FRESH_S, Program, Slot, header};
use albacore_vehicle::{Command, Control, Lag, Measurement, Sample, Snapshot, TICK_S};
use std::sync::Arc;

/// Executes one mission.
#[derive(Clone)]
pub struct Machine {
    program: Arc<Program>,
    wiring: Wiring,
    run: Run,
}

/// What was heard of an input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeardInput<'a> {
    /// Its place among the program's inputs.
    pub at: usize,
    /// Ticks since its latest sample; none before the first.
    pub age: Option<f64>,
    /// The words of that sample.
    pub words: &'a [f64],
    /// How many ticks old it may be, where the mission requires it.
    pub fresh: Option<f64>,
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
            asked: Asked::still(Heading::NORTH, 0.0),
            wish: if p.mission.guest { ControlRequest::Listen } else { ControlRequest::Drive },
            command: None,
            filtered: Heading::NORTH,
            control: Control::Disconnected,
            limits: Limits::NONE,
            declared: Declared::default(),
            bottom: Bottom::default(),
            lift: Lift::default(),
            lift_tick: 0,
            sinking: Sinking::default(),
            aground: Aground::default(),
            stands: false,
            depth_before: None,
            depth_agrees: false,
            limited: Default::default(),
            requires: Vec::new(),
            echo_fresh: LIMIT_FRESH_S / TICK_S,
            link: Requirement::LINK,
            lagged: 0,
            lag: Lag::default(),
            within: None,
            began: 0,
            drives_since: None,
            host_began: 0,
            overridden: Overridden::default(),
            way_back: None,
            allowance: Allowance::new(p.reports.len()),
            rest: Rest::default(),
            questions: Vec::new(),
        };
        Run {
            state,
            events: Vec::new(),
            peaks_differ: true,
            in_overlay: false,
            is_lost: false,
            abort: None,
            deserted: None,
            asks: false,
            requests: Vec::new(),
            tried: None,
            amenders: Vec::new(),
            amenders_known: false,
            senses: senses(p),
            chart: None,
            trig: Trig::new(),
            bound: Bound::default(),
        }
    }

    /// Forgets what it knows of its words: they were put in place.
    fn forget(&mut self) {
        self.peaks_differ = true;
        self.amenders_known = false;
    }

    pub fn number(&mut self, p: &Program, code: &Code) -> f64 {
        self.execute(p, code.entry, p.mission.base);
        self.get(p.mission.base + code.value)
    }
}

impl Machine {
    /// A machine for a mission on a vehicle that delivers these measurements.
    pub fn new(program: Arc<Program>, measurements: &[Measurement]) -> Result<Self, MissingInput> {
        let wiring = wiring(&program, measurements)?;
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
        self.run.forget();
        self.run.events.clear();
        self.run.abort = None;
        self.run.deserted = None;
        self.run.asks = false;
        self.run.requests.clear();
    }

    /// What the mission wants of its vehicle from here on.
    pub fn wish(&self) -> ControlRequest {
        self.run.state.wish
    }

    /// Whether an override has begun in the last tick to ask for control that the vehicle has not given by then: whatever it has
    /// answered is the answer to another.
    pub fn asks_anew(&self) -> bool {
        self.run.asks && !matches!(self.run.state.control, Control::InControl | Control::Suspended)
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
        self.run.tell_elapsed();
        self.run.events.clear();
    }

    /// What is asked of payloads in the last tick: the number of each question, and the action.
    pub fn requests(&self) -> impl Iterator<Item = (u64, &str)> {
        let name = |action: u32| self.program.asks.get(action as usize).map_or("", String::as_str);
        self.run.requests.iter().map(move |request| (request.id, name(request.action)))
    }

    /// Puts a value in place.
    pub fn put(&mut self, at: Slot, words: &[f64]) {
        if let Some(place) = self.run.state.words.get_mut(at as usize..at as usize + words.len()) {
            place.copy_from_slice(words);
            self.run.forget();
        }
    }

    /// Whether an input, by its index in the program, has had a sample.
    pub fn has_sample(&self, input: u32) -> bool {
        self.program.inputs.get(input as usize).is_some_and(|input| self.run.has_sample(input))
    }

    /// What was heard of each input by the last tick, in the order of the program.
    pub fn heard(&self) -> impl Iterator<Item = HeardInput<'_>> {
        let heard = |(at, input): (usize, &'_ Input)| {
            let age = self.run.has_sample(input).then(|| self.run.age_ticks(input) - 1.0);
            let requires = self.program.mission.requires.iter().position(|require| require.input as usize == at);
            let required = requires.and_then(|at| self.run.state.requires.get(at));
            let words = self.run.slice(input.at + Input::VALUE, input.width);
            HeardInput { at, age, words, fresh: required.map(|required| required.fresh) }
        };
        self.program.inputs.iter().enumerate().map(heard)
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
        run.amenders_known &= run.events.is_empty();
        run.events.clear();
        run.asks = false;
        run.requests.clear();
        run.state.overridden = Overridden::default();
        run.state.way_back = None;
        run.events.extend(run.state.allowance.tick());
        run.state.lag = snapshot.lag;
        run.take_in(p, wiring, &snapshot.samples);
        run.hear_control(snapshot.control);
        run.hear_answers(&snapshot.answers);
        run.tell_elapsed();
        run.feel_bottom(snapshot.aground);
        let command = run.live(p);
        if !matches!(run.state.phase, Phase::Over(_)) {
            run.events.extend(run.state.rest.tick(&run.events));
        }
        run.state.tick += 1;
        command
    }

    /// A tick as any other, and every condition that decided in it: the rules and aborts that were tried, in their order.
    pub fn step_asked(&mut self, snapshot: &Snapshot) -> (Option<Command>, Vec<Tried>) {
        self.run.tried = Some(Vec::new());
        let command = self.step(snapshot);
        (command, self.run.tried.take().unwrap_or_default())
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

    /// The vehicle has said since the mission's end, and before it was released, that it lies on the bottom: what the mission has ended
    /// as by that, with the events that say it, if as something else.
    pub fn end_aground(&mut self) -> Option<Outcome> {
        self.run.events.clear();
        let ended = self.outcome()?;
        self.run.feel_bottom(true);
        let outcome = self.run.counts_as(ended);
        if outcome == ended {
            return None;
        }
        self.run.state.phase = Phase::Over(outcome);
        self.run.events.push(Event::Ended(outcome));
        Some(outcome)
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
                self.state.drives_since = Some(self.state.tick);
                self.begin_to_count();
                self.execute(p, p.mission.params, p.mission.base);
                self.take_requirements(p);
                // They hold from the first command on; what they are made of may be known better when all has come.
                self.compute_limits(p);
                self.await_inputs(p)
            }
            Phase::Awaiting => self.await_inputs(p),
            Phase::Running | Phase::Holding(_) => {
                // The time limit bounds the run: it does not stand still while the mission is held.
                let time_is_up = self.time_is_up();
                if self.is_stranded() {
                    self.tell_stranded();
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

    pub fn start(&mut self, p: &Program) {
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

    pub fn time_out(&mut self, p: &Program) -> Option<Command> {
        self.tell_time_is_up();
        self.recover(p, Outcome::TimedOut)
    }

    pub fn after_step(&mut self, p: &Program, status: Status) -> Option<Command> {
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
    /// guest while its vehicle runs its own plan, or has suspended it. A vehicle may be ours for which an override still waits.
    pub fn recover(&mut self, p: &Program, outcome: Outcome) -> Option<Command> {
        self.abort = None;
        let (is_ours, drives) = (self.is_ours(), self.drives());
        let cause = if outcome == Outcome::TimedOut { Cause::TimedOut } else { Cause::Aborted };
        let (id, base) = (p.mission.activity, p.mission.base);
        let at = base + p.activities[id as usize].header;
        self.leave_body(p, cause);
        let Some(recovery) = p.mission.recovery.filter(|_| is_ours) else {
            return self.over(p, outcome);
        };
        self.state.wish = ControlRequest::Drive;
        if !drives {
            self.stand();
        }
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
        // The mission lives on around it, and the time that its signals count by. Overlays stay in force; their aborts do not: there
        // is nothing left to abort.
        self.live_a_tick(p, mission, base);
        self.step_overlays(p, mission, base);
        self.is_lost = false;
        let is_lagging = self.lagging().is_some();
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
        // Nothing aborts a recovery: it goes nowhere by what it does not know.
        Some(if self.is_lost || is_lagging { self.still_command(p) } else { self.give_command(p) })
    }

    fn end_recovery(&mut self, p: &Program, recovery: u32, outcome: Outcome, cause: Cause) -> Option<Command> {
        self.leave(p, recovery, p.mission.base, cause);
        self.over(p, outcome)
    }

    /// The end: everything is left, nothing more is commanded. A mission that leaves its vehicle on the bottom has not come to
    /// its own end, whatever it says.
    pub fn over(&mut self, p: &Program, outcome: Outcome) -> Option<Command> {
        if matches!(self.state.phase, Phase::Over(_)) {
            return None;
        }
        let counted = self.counts_as(outcome);
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
        self.state.phase = Phase::Over(counted);
        self.events.push(Event::Ended(counted));
        None
    }
}
