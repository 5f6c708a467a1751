//! A mission's life: rules 2, 6 and 17, and what section 8 of the reference says of `requires`, `limits` and the recovery.

use super::activation::{Aborted, Activation};
use super::aground::Aground;
use super::bottom::Bottom;
use super::control::{Controlled, Request, is_guest};
use super::expr::{Frame, Scope, number, value};
use super::lift::Lift;
use super::origin;
use super::rest::Rest;
use super::timed::Setpoints;
use super::world::{Asked, FirstDepths, World, ticks};
use albacore_guidance::through_water;
use albacore_lang::hir::{Activity, ActivityId, Expr, Hir, Mission};
use albacore_lang::source::Sources;
use albacore_lang::types::TypeTable;
use albacore_program::{Cause, Channel};
use albacore_vehicle::{Command, Control, Measurement, Snapshot, TICK_S};

/// Where a mission is in its life.
#[derive(Clone, Copy, PartialEq)]
enum Phase {
    Waiting,
    /// It drives, and required inputs have not come yet.
    Awaiting,
    Running,
    /// Since a tick, and with the outcome that there will be.
    Recovering(u64, &'static str),
    Over,
}

/// An input that the mission cannot do without.
pub(super) struct Required {
    pub input: usize,
    pub fresh: u64,
    /// How long it may be stale; none: not at all.
    patience: u64,
    has_at_first: bool,
    awaited: bool,
    stale_since: Option<u64>,
}

/// The naive evaluator of one mission.
pub struct Evaluator<'p> {
    pub w: World<'p>,
    sensors: &'p [Measurement],
    declared: &'p Mission,
    mission: Activation<'p>,
    recovery: Activation<'p>,
    phase: Phase,
    /// The first tick on which it drives, and how long it may last.
    began: u64,
    within: Option<u64>,
    recovery_within: Option<u64>,
    pub(super) required: Vec<Required>,
    /// Least and greatest, by channel.
    pub(super) limits: [(f64, f64); 3],
    pub(super) bottom: Bottom,
    pub(super) lift: Lift,
    pub(super) aground: Aground,
    /// Rule 6: whether the heading and depth of the very start have been taken.
    stands: bool,
    first_depths: FirstDepths,
    rest: Rest,
}

impl<'p> Evaluator<'p> {
    pub fn new(
        (hir, types, id): (&'p Hir, &'p TypeTable, ActivityId),
        sources: &'p Sources,
        (recovery, override_block): (&'p Activity, &'p Activity),
        sensors: &'p [Measurement],
    ) -> Option<Self> {
        let activity = &hir.activities[id];
        let declared = activity.mission.as_ref()?;
        let control = Controlled::new(is_guest(hir, id));
        let w = World::new((hir, types, sources), origin::of(activity), control, override_block);
        let frame = Frame::new(&w, &activity.vars, Vec::new());
        Some(Evaluator {
            sensors,
            declared,
            mission: Activation::new(activity, frame.clone(), Setpoints::default(), false),
            recovery: Activation::new(recovery, frame, Setpoints::default(), false),
            phase: Phase::Waiting,
            began: 0,
            within: None,
            recovery_within: None,
            required: Vec::new(),
            limits: [(0.0, f64::MAX); 3],
            bottom: Bottom::default(),
            lift: Lift::default(),
            aground: Aground::default(),
            stands: false,
            first_depths: FirstDepths::default(),
            rest: Rest::default(),
            w,
        })
    }

    pub fn is_over(&self) -> bool {
        self.phase == Phase::Over
    }

    /// What is asked of the vehicle itself: before the first tick, and after each.
    pub fn requests(&mut self) -> Vec<Request> {
        let is_over = self.is_over();
        self.w.control.requests(is_over)
    }

    /// One tick.
    pub fn step(&mut self, snapshot: &Snapshot) -> Option<Command> {
        self.w.events.clear();
        self.w.steps = 0;
        self.w.kept = Setpoints::default();
        self.w.way_back = None;
        self.w.earn();
        self.w.sense(self.sensors, &snapshot.samples);
        self.w.hear_control(snapshot.control);
        self.w.questions = 0;
        self.w.hear(&snapshot.answers);
        self.w.tell_elapsed(if self.phase == Phase::Waiting { 0 } else { self.w.tick - self.began });
        let asked = self.w.asked.vertical;
        self.bottom.hear(&self.w, asked);
        self.feel_bottom(snapshot.aground);
        let command = self.live();
        if !self.is_over() {
            self.rest.tick(&mut self.w);
        }
        self.w.tick += 1;
        command
    }

    fn live(&mut self) -> Option<Command> {
        let began = self.phase != Phase::Waiting;
        let looks_on = self.w.control.is_guest && !matches!(self.phase, Phase::Recovering(..));
        match self.w.control.shown {
            Control::InControl => {}
            Control::TimedOut => return self.over("link_lost", Cause::Aborted),
            Control::Disconnected if began => return self.over("link_lost", Cause::Aborted),
            // Rule 18: a guest lives on whoever drives; its overrides hear of it.
            control if looks_on && control != Control::Disconnected => {}
            Control::Refused => return self.over("refused", Cause::Aborted),
            Control::Released if began => return self.over("released_by_vehicle", Cause::Aborted),
            _ => return self.stand_by(),
        }
        if self.phase == Phase::Waiting {
            self.phase = Phase::Awaiting;
            self.take_parameters();
        }
        match self.phase {
            Phase::Waiting | Phase::Over => None,
            Phase::Awaiting => self.await_inputs(),
            Phase::Running => self.run(),
            Phase::Recovering(since, outcome) => self.recover(since, outcome),
        }
    }

    /// Rule 18: while the vehicle does not listen the mission stands still, but for its time limit; what is not ours is not
    /// recovered.
    fn stand_by(&mut self) -> Option<Command> {
        match self.phase {
            Phase::Awaiting | Phase::Running if self.time_is_up() => {
                self.w.say("timeout".into());
                self.over("timed_out", Cause::TimedOut)
            }
            Phase::Recovering(since, outcome) if self.recovery_is_late(since) => {
                self.end_recovery(outcome, Cause::TimedOut)
            }
            _ => None,
        }
    }

    fn recovery_is_late(&self, since: u64) -> bool {
        self.recovery_within.is_some_and(|within| self.w.tick - since >= within)
    }

    fn number(&mut self, e: &Expr) -> f64 {
        number(&mut self.w, Scope::of(&self.mission.frame), e)
    }

    /// Nobody calls a mission: its parameters have their defaults.
    fn take_parameters(&mut self) {
        self.began = self.w.tick;
        for (param, default) in self.mission.activity.defaults.iter().enumerate() {
            if let Some(e) = default {
                let value = value(&mut self.w, Scope::of(&self.mission.frame), e);
                self.mission.frame.set(param, value);
            }
        }
        let declared = self.declared;
        for require in &declared.requires {
            let fresh = ticks(self.number(&require.fresh));
            let patience = require.hold_for.as_ref().map_or(0, |e| ticks(self.number(e)));
            let has_at_first = require.at_first.is_some();
            let (input, awaited, stale_since) = (require.input, false, None);
            self.required.push(Required { input, fresh, patience, has_at_first, awaited, stale_since });
        }
        self.within = declared.within.as_ref().map(|e| ticks(self.number(e)));
        self.take_limits();
    }

    fn take_limits(&mut self) {
        for (channel, least, e) in &self.declared.limits {
            let value = number(&mut self.w, Scope::of(&self.mission.frame), e);
            let (low, high) = &mut self.limits[*channel as usize];
            *(if *least { low } else { high }) = value;
        }
        self.w.fastest = self.limits[Channel::Speed as usize].1;
    }

    /// Rule 17: the time limit counts also while the mission waits for a first sample or is held.
    fn time_is_up(&self) -> bool {
        self.within.is_some_and(|within| self.w.tick - self.began >= within)
    }

    /// It begins with the first sample of each required input that has no `at first`; one that has never come is as old as
    /// the mission.
    fn await_inputs(&mut self) -> Option<Command> {
        let lived = self.w.tick - self.began;
        let mut waits = false;
        for required in &mut self.required {
            if required.has_at_first || self.w.inputs[required.input].stamp.is_some() {
                continue;
            }
            waits = true;
            let name = &self.w.hir.inputs[required.input].name;
            if !std::mem::replace(&mut required.awaited, true) {
                self.w.say(format!("wait {name}"));
            }
            if lived > required.fresh + required.patience {
                self.w.say(format!("abort `{name}` has never come"));
                return self.over("aborted", Cause::Aborted);
            }
        }
        if !waits {
            self.phase = Phase::Running;
            return match self.start() {
                Ok(()) => self.command_if_ours(),
                Err(aborted) => self.abort(aborted),
            };
        }
        if self.time_is_up() {
            self.w.say("timeout".into());
            return self.over("timed_out", Cause::TimedOut);
        }
        if self.aground.is_stranded() {
            self.w.say("abort aground for 30 s".into());
            return self.over("aground", Cause::Aborted);
        }
        // Rule 18: it does not drive yet, and keeps no depth.
        if self.w.control.is_guest {
            return None;
        }
        if self.first_depths.are_contradicted(&self.w) {
            self.stands = false;
        }
        if !self.stands {
            let [depth, altitude] = [Channel::Depth, Channel::Altitude].map(|channel| self.limits[channel as usize]);
            let is_bounded = altitude.0 > 0.0 || depth.1 < f64::MAX;
            let is_late = lived > 50;
            let knows_both = self.first_depths.are_known(is_late) && self.w.knows_heading();
            // Limits do not wait for more than 5 s.
            if !(knows_both || is_bounded && is_late) {
                return None;
            }
            self.stands = true;
            self.w.stand();
        }
        self.command_if_ours()
    }

    fn start(&mut self) -> Result<(), Aborted> {
        self.w.stand();
        for require in &self.declared.requires {
            if let (Some(e), None) = (&require.at_first, self.w.inputs[require.input].stamp) {
                let shape = self.w.shape(&e.ty);
                let words = value(&mut self.w, Scope::of(&self.mission.frame), e).words(&shape);
                let sensed = &mut self.w.inputs[require.input];
                sensed.latest[..words.len()].copy_from_slice(&words);
                sensed.peak = words[0];
            }
        }
        let begun = self.mission.begin(&mut self.w);
        self.take_limits();
        begun
    }

    /// Section 8: a recovery stays 2.5 m above where the vehicle has lain on the bottom.
    pub(super) fn shoal(&self) -> Option<f64> {
        self.aground.least.filter(|_| matches!(self.phase, Phase::Recovering(..))).map(|at| (at - 2.5).max(0.0))
    }

    fn run(&mut self) -> Option<Command> {
        let time_is_up = self.time_is_up();
        if self.aground.is_stranded() {
            self.w.say("abort aground for 30 s".into());
            return self.begin_recovery("aground", Cause::Aborted);
        }
        if self.is_stale() {
            return self.hold(time_is_up);
        }
        match self.mission.step(&mut self.w) {
            Err(aborted) => self.abort(aborted),
            Ok(true) => self.over("completed", Cause::Done),
            // Rule 17: its own end on the very tick of the limit comes first.
            Ok(false) if time_is_up => self.time_out(),
            Ok(false) => self.command_if_ours(),
        }
    }

    /// Whether an input is too old, which suspends the mission.
    fn is_stale(&mut self) -> bool {
        for required in &mut self.required {
            let name = &self.w.hir.inputs[required.input].name;
            let age = self.w.inputs[required.input].stamp.map(|stamp| self.w.tick - stamp);
            let stale = age.is_some_and(|age| age > required.fresh);
            if stale != required.stale_since.is_some() {
                self.w.events.push(format!("{} {name}", if stale { "stale" } else { "fresh" }));
                required.stale_since = stale.then_some(self.w.tick);
            }
        }
        self.required.iter().any(|required| required.stale_since.is_some())
    }

    /// It keeps its course at speed 0, and its timers stand still; after the time of `hold for` of any of its stale inputs it
    /// aborts.
    fn hold(&mut self, time_is_up: bool) -> Option<Command> {
        let tick = self.w.tick;
        let lost = |required: &&Required| required.stale_since.is_some_and(|since| tick - since >= required.patience);
        if let Some(required) = self.required.iter().find(lost) {
            return self.abort(Aborted::because(format!("no fresh `{}`", self.w.hir.inputs[required.input].name)));
        }
        if time_is_up {
            return self.time_out();
        }
        self.w.control.drives().then(|| self.still())
    }

    /// The command with speed 0, for this tick alone.
    fn still(&mut self) -> Command {
        self.w.way_back = None;
        let speed = self.w.kept.speed.take().unwrap_or(self.w.asked.speed);
        self.w.asked.speed = 0.0;
        let command = self.command();
        self.w.asked.speed = speed;
        command
    }

    fn time_out(&mut self) -> Option<Command> {
        self.w.say("timeout".into());
        self.begin_recovery("timed_out", Cause::Preempted)
    }

    fn abort(&mut self, Aborted { why, ends_as }: Aborted) -> Option<Command> {
        self.w.say(format!("abort {why}"));
        if let Some(outcome) = ends_as {
            return self.over(outcome, outcome_cause(outcome));
        }
        self.begin_recovery("aborted", Cause::Aborted)
    }

    /// Rule 17: what is inside the mission is left; the recovery runs once, under what the mission's declarations put in force.
    fn begin_recovery(&mut self, outcome: &'static str, inner: Cause) -> Option<Command> {
        // Rule 18: if the vehicle is ours at this moment.
        let is_ours = self.w.control.is_ours();
        let drives = self.w.control.drives();
        self.mission.leave_inside(&mut self.w, inner);
        self.mission.end_withs(&mut self.w, inner);
        let Some((within, _)) = self.declared.recovery.as_ref().filter(|_| is_ours) else {
            return self.over(outcome, outcome_cause(outcome));
        };
        self.recovery_within = within.as_ref().map(|e| ticks(self.number(e)));
        self.phase = Phase::Recovering(self.w.tick, outcome);
        self.w.is_recovering = true;
        self.w.control.go_on_driving();
        if !drives {
            self.w.stand();
        }
        self.recovery.setpoints = self.mission.setpoints;
        match self.recovery.begin(&mut self.w) {
            Ok(()) => self.command_if_ours(),
            Err(_) => self.end_recovery(outcome, Cause::Aborted),
        }
    }

    fn recover(&mut self, since: u64, outcome: &'static str) -> Option<Command> {
        self.mission.age += 1;
        self.mission.refresh(&mut self.w);
        let _ = self.mission.step_overlays(&mut self.w);
        self.w.is_lost = false;
        let time_is_up = self.recovery_is_late(since);
        match self.recovery.step(&mut self.w) {
            // There is nothing left to abort but the recovery itself.
            Err(_) => self.end_recovery(outcome, Cause::Aborted),
            Ok(true) => self.end_recovery(outcome, Cause::Done),
            Ok(false) if time_is_up => self.end_recovery(outcome, Cause::TimedOut),
            Ok(false) if self.w.is_lost => Some(self.still()),
            Ok(false) => Some(self.command()),
        }
    }

    fn end_recovery(&mut self, outcome: &'static str, cause: Cause) -> Option<Command> {
        self.recovery.leave(&mut self.w, cause);
        self.over(outcome, outcome_cause(outcome))
    }

    fn over(&mut self, outcome: &str, cause: Cause) -> Option<Command> {
        if self.phase != Phase::Over {
            let spoilt = self.aground.spoils(outcome);
            if let (Some(how), "completed") = (spoilt, outcome) {
                self.w.say(format!("abort the vehicle {how} the bottom"));
            }
            self.recovery.leave(&mut self.w, Cause::Preempted);
            self.mission.leave(&mut self.w, cause);
            self.phase = Phase::Over;
            self.w.tell_unwritten();
            self.w.say(format!("end {}", if spoilt.is_some() { "aground" } else { outcome }));
        }
        None
    }

    fn command_if_ours(&mut self) -> Option<Command> {
        self.w.control.drives().then(|| self.command())
    }

    /// Rule 2, once a tick: what the innermost statement asks for; overlays; limits; then the command filter and the flow.
    fn command(&mut self) -> Command {
        let kept = self.w.kept;
        self.w.asked.vertical = kept.vertical.unwrap_or(self.w.asked.vertical);
        self.w.asked.speed = kept.speed.unwrap_or(self.w.asked.speed);
        let mut asked = self.w.asked;
        if let Some((course, speed)) = self.w.way_back {
            asked = Asked { course, speed: kept.speed.unwrap_or(speed), over_ground: true, ..asked };
        }
        let amended = self.recovery.amended(&mut self.w, asked.course);
        let amended = self.mission.amended(&mut self.w, amended);
        let speed = self.limit(Channel::Speed, asked.speed);
        let vertical = self.vertical(asked.vertical);
        let course = self.w.filter.step(amended, self.w.turn_rate, TICK_S);
        let fastest = self.limits[Channel::Speed as usize].1;
        let (heading, speed) = if (asked.over_ground || amended != asked.course) && speed > 0.0 {
            let water = through_water(course, speed, self.w.flow(), fastest);
            (water.heading, water.speed)
        } else {
            (course, speed.max(0.0))
        };
        let speed = self.lift(speed, vertical);
        *self.bottom.commanded.insert(Command { heading, speed, vertical })
    }

    pub(super) fn limit(&mut self, channel: Channel, asked: f64) -> f64 {
        let given = self.clamped(channel, asked);
        self.say_limited(channel, (given != asked).then_some((asked, given)));
        given
    }

    pub(super) fn clamped(&self, channel: Channel, asked: f64) -> f64 {
        let (low, high) = self.limits[channel as usize];
        // Speed 0 is always allowed.
        if channel == Channel::Speed && asked == 0.0 { 0.0 } else { asked.max(low).min(high.max(low)) }
    }

    /// Says when a limit begins to hold a setpoint, and when it holds it no more.
    pub(super) fn say_limited(&mut self, channel: Channel, held: Option<(f64, f64)>) {
        if held.is_some() != std::mem::replace(&mut self.w.limited[channel as usize], held.is_some()) {
            let how = held.map_or("no more".into(), |(asked, given)| format!("{asked:?} {:?}", given + 0.0));
            self.w.say(format!("limit {channel:?} {how}"));
        }
    }
}

fn outcome_cause(outcome: &str) -> Cause {
    if outcome == "timed_out" { Cause::TimedOut } else { Cause::Aborted }
}
