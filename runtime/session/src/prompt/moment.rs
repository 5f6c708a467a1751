//! A moment of the prompt's vehicle, all of it one value; and the moments that were.

use super::saved::reported;
use super::vehicle::{LinkedVehicle, PastVehicle, PromptVehicle};
use crate::control_claim::ControlClaim;
use albacore_geometry::Heading;
use albacore_lang::prompt::{Left, Named};
use albacore_machine::{Event, Machine, Outcome};
use albacore_navigation::Trust;
use albacore_program::{ReportSite, number, senses};
use albacore_sim::Simulator;
use albacore_trace::{BehaviorTrace, Header};
use albacore_vehicle::{Command, Control, Sample, Snapshot, TICK_S, VehicleError, Vertical};
use std::collections::{BTreeMap, VecDeque};

/// What was sensed in so many ticks is kept for what begins later: 20 s, longer than any sensor is silent.
pub(super) const RECENT_TICKS: usize = 200;
/// Ticks between the moments that are kept, at first: a minute. What lies between is computed anew.
const KEPT_EVERY_TICKS: u64 = 600;
/// So many of them are kept; then every other goes, and their distance doubles.
const KEPT_MAX: usize = 64;
/// So many moments are kept in which something was begun or ended; of a vehicle at the end of a link, which is no world, more.
const PINNED_MAX: usize = 64;
const PINNED_ON_LINK_MAX: usize = 1000;

/// The vehicle and what it is doing, with a tick that is sensed and not yet commanded.
#[derive(Clone)]
pub struct Moment {
    pub vehicle: PromptVehicle,
    pub snapshot: Snapshot,
    /// The tick of the snapshot.
    pub tick: u64,
    pub task: Option<Task>,
    /// The mission of the script that has ended last: its trace, and how.
    pub ended: Option<Ended>,
    /// The values that have got a name by `let` and `var`.
    names: Vec<Named>,
    recent: VecDeque<(u64, Vec<Sample>)>,
    /// What a run that is over has left has been gone through, to its last tick.
    pub is_over: bool,
    /// What the vehicle was last told.
    command: Option<Command>,
    trust: Trust,
    /// Of a vehicle at the end of a link: whether it was asked to let us drive.
    claim: ControlClaim,
    /// ... what it is told while nothing is under way,
    still: Option<Command>,
    /// ... and whether what is done in this tick has been decided: its time goes on while nobody types.
    is_decided: bool,
    /// What the vehicle gave notice of and what was noticed of it, with its tick, and is not told yet.
    notices: Vec<(u64, String)>,
}

/// A mission of the script that has ended.
#[derive(Clone)]
pub struct Ended {
    pub outcome: Outcome,
    pub trace: BehaviorTrace,
    /// The ticks in which it began, and ended.
    pub began: u64,
    pub at: u64,
    /// The places that report in it.
    pub sites: Vec<ReportSite>,
    /// What was reported: which of them, and its words.
    pub reported: Vec<(u32, Vec<f64>)>,
}

/// What is under way: a line, or the mission of the script.
#[derive(Clone)]
pub struct Task {
    pub machine: Machine,
    /// What a line leaves at its end; none for the script's mission.
    pub left: Option<Left>,
    /// Where a line has the `var`s of the prompt, which it reads and assigns.
    vars: Vec<Left>,
    /// The line, or the mission's name.
    pub text: String,
    /// What happened in it.
    pub trace: BehaviorTrace,
    /// The tick in which it began.
    pub began: u64,
    /// What it has reported: from which place of the program, and the words.
    reported: Vec<(u32, Vec<f64>)>,
}

impl Task {
    /// The mission of the script, called by its name.
    pub fn mission(machine: Machine, name: &str) -> Self {
        Task::new(machine, None, Vec::new(), name)
    }

    /// Whether it is the mission of the script.
    pub fn is_mission(&self) -> bool {
        self.left.is_none()
    }

    /// A line, and the `var`s that it may assign.
    pub fn line(machine: Machine, left: Left, vars: Vec<Left>, text: &str) -> Self {
        Task::new(machine, Some(left), vars, text)
    }

    /// A `var` has been assigned at the prompt.
    fn put(&mut self, assigned: &Named) {
        if let Some(var) = self.vars.iter().find(|var| var.name.as_ref() == Some(&assigned.name)) {
            self.machine.put(var.slot, &assigned.words);
        }
    }

    /// What the line has made of the `var`s.
    fn assign(&self, names: &mut [Named]) {
        for var in &self.vars {
            if let Some(named) = names.iter_mut().find(|named| var.name.as_ref() == Some(&named.name)) {
                named.words.clear();
                named.words.extend_from_slice(var.of(&self.machine.state().words));
            }
        }
    }

    /// From here on a name is no concern of this line: it is another value's.
    fn leave_alone(&mut self, name: &str) {
        self.vars.retain(|var| var.name.as_deref() != Some(name));
    }

    fn new(machine: Machine, left: Option<Left>, vars: Vec<Left>, text: &str) -> Self {
        let header = Header { mission: String::new(), scenario: String::new(), seed: 0, tick_s: TICK_S };
        let trace = BehaviorTrace::new(machine.program(), &header);
        let began = machine.state().tick;
        Task { machine, left, vars, text: text.to_string(), trace, began, reported: Vec::new() }
    }

    /// What happened in a tick, as lines. That a line of the prompt is a mission is nobody's concern.
    fn print_events(&mut self, tick: u64, say: &mut dyn FnMut(&str)) {
        let own = self.machine.program().mission.activity;
        let is_line = self.left.is_some();
        // Who has written a statement knows that it begins.
        let is_single = matches!(&self.machine.program().statements[..], [only] if only.loops.is_empty());
        let events: Vec<Event> = self
            .machine
            .events()
            .iter()
            .filter(|event| match event {
                Event::Entered(id) | Event::Left(id, _) => !(is_line && *id == own),
                Event::Ended(Outcome::Completed) => !is_line,
                Event::Began(..) => !(is_line && is_single),
                _ => true,
            })
            .cloned()
            .collect();
        self.reported.extend(events.iter().filter_map(reported));
        let told = self.trace.len();
        self.trace.tick(tick, self.machine.position(), &events);
        self.trace.since(told).for_each(say);
    }

    /// The value that a line leaves under a name, now that it has come to its end.
    fn left(&self) -> Option<Named> {
        let left = self.left.as_ref().filter(|left| left.name.is_some());
        left.filter(|_| self.machine.outcome() == Some(Outcome::Completed))
            .map(|left| left.taken(&self.machine.state().words))
    }
}

impl Moment {
    /// The first moment in which the vehicle is ours.
    pub fn first(vehicle: Simulator) -> Result<Self, VehicleError> {
        let mut moment = Moment::at_start(PromptVehicle::Simulated(Box::new(vehicle)))?;
        moment.note();
        moment.sense()?;
        Ok(moment)
    }

    /// The first tick of a run that is over, in which its mission is about to begin.
    pub fn of_past(vehicle: PastVehicle, machine: Machine) -> Result<Self, VehicleError> {
        let mut moment = Moment::at_start(PromptVehicle::Past(vehicle))?;
        moment.note();
        let name = machine.program().mission.name.clone();
        moment.task = Some(Task::mission(machine, &name));
        Ok(moment)
    }

    /// The first tick that is heard of a vehicle at the end of a link, which drives itself.
    pub fn of_link(vehicle: LinkedVehicle) -> Result<Self, VehicleError> {
        let mut moment = Moment::at_start(PromptVehicle::Linked(vehicle))?;
        moment.note();
        Ok(moment)
    }

    fn at_start(mut vehicle: PromptVehicle) -> Result<Self, VehicleError> {
        let mut snapshot = Snapshot::default();
        vehicle.sense(&mut snapshot)?;
        if !vehicle.is_linked() {
            vehicle.take_over()?;
        }
        Ok(Moment {
            vehicle,
            snapshot,
            tick: 0,
            task: None,
            ended: None,
            names: Vec::new(),
            recent: VecDeque::new(),
            is_over: false,
            command: None,
            trust: Trust::default(),
            claim: ControlClaim::default(),
            still: None,
            is_decided: false,
            notices: Vec::new(),
        })
    }

    /// Waits for the vehicle's next tick, and senses it.
    pub fn sense(&mut self) -> Result<(), VehicleError> {
        self.recent.push_back((self.tick, self.snapshot.samples.clone()));
        if self.recent.len() > RECENT_TICKS {
            self.recent.pop_front();
        }
        self.vehicle.sense(&mut self.snapshot)?;
        self.tick += 1;
        self.is_decided = false;
        self.note();
        Ok(())
    }

    /// Notes what this tick gives notice of, as a run does.
    fn note(&mut self) {
        // What a run has left was looked at in the run, and holds what was found.
        let doubts = match self.vehicle.is_past() {
            true => Vec::new(),
            false => self.trust.look(self.tick, &mut self.snapshot, self.command.as_ref()),
        };
        let notices = self.vehicle.notices().into_iter().chain(doubts);
        self.notices.extend(notices.map(|notice| (self.tick, notice)));
    }

    /// What was sensed lately, this tick left out.
    pub fn recent(&self) -> impl Iterator<Item = (u64, &[Sample])> {
        self.recent.iter().map(|(tick, samples)| (*tick, samples.as_slice()))
    }

    /// What has got a name at the prompt.
    pub fn names(&self) -> &[Named] {
        &self.names
    }

    /// Gives a value its name, which may have been another's. A `var` is one value: the line that is under way has it too.
    pub fn name(&mut self, value: Named) {
        let is_assigned = self.names.iter().any(|named| named.is_same_var(&value));
        match &mut self.task {
            Some(task) if is_assigned => task.put(&value),
            Some(task) => task.leave_alone(&value.name),
            None => {}
        }
        self.names.retain(|named| named.name != value.name);
        self.names.push(value);
    }

    /// Takes over the names of a later moment. A `var` that is here already keeps the value that it has here.
    pub fn keep_names(&mut self, later: Vec<Named>) {
        for named in later {
            if !self.names.iter().any(|here| here.is_same_var(&named)) {
                self.name(named);
            }
        }
    }

    /// Lets a tick go by; or, when what is under way ends in it, tells so: the tick then belongs to what comes next.
    pub fn step(&mut self, say: &mut dyn FnMut(&str)) -> Result<bool, VehicleError> {
        if self.decide(say)? {
            return Ok(true);
        }
        if self.vehicle.is_at_end() {
            self.is_over = true;
            return Ok(false);
        }
        self.sense()?;
        Ok(false)
    }

    /// Decides what is done in this tick, and commands it; or, when what is under way ends in it, tells so.
    pub fn decide(&mut self, say: &mut dyn FnMut(&str)) -> Result<bool, VehicleError> {
        for (tick, notice) in self.notices.drain(..) {
            say(&format!("{}  vehicle  {notice}", number::seconds(tick)));
        }
        let mut command = None;
        if let Some(task) = &mut self.task {
            command = task.machine.step(&self.snapshot);
            for (id, action) in task.machine.requests() {
                self.vehicle.ask(id, action)?;
            }
            if self.vehicle.is_linked()
                && let Some(vehicle) = self.vehicle.port()
            {
                self.claim.ask_anew(&task.machine, vehicle)?;
                self.claim.follow(&task.machine, vehicle)?;
            }
            task.print_events(self.tick, say);
            task.assign(&mut self.names);
            if task.machine.outcome().is_some() {
                self.still = None;
                let left = task.left();
                if let Some(task) = self.task.take()
                    && task.left.is_none()
                    && let Some(outcome) = task.machine.outcome()
                {
                    let Task { machine, trace, began, reported, .. } = task;
                    let sites = machine.program().reports.clone();
                    self.ended = Some(Ended { outcome, trace, began, at: self.tick, sites, reported });
                }
                left.into_iter().for_each(|left| self.name(left));
                return Ok(true);
            }
        }
        self.is_decided = true;
        // One that has taken control back, for a leak, does as it likes.
        if self.snapshot.control == Control::InControl
            && let Some(command) = command.or_else(|| self.still())
        {
            self.vehicle.command(&command)?;
            self.command = Some(command);
        }
        Ok(false)
    }

    /// Nothing to do: neither ahead nor up nor down. The place of a vehicle at the end of a link is that in which what it did ended, as far
    /// as it tells it; one that something is under way for is left alone.
    fn still(&mut self) -> Option<Command> {
        if !self.vehicle.is_linked() {
            let truth = self.vehicle.truth().unwrap_or_default();
            return Some(Command::still(truth.heading, truth.depth));
        }
        if self.task.is_some() || !self.claim.is_asked() {
            return None;
        }
        if self.still.is_none() {
            let number = |name| self.sensed(name).map(|reading| reading[0]);
            let told = self.command.as_ref();
            let heading = number(senses::HEADING).map(Heading::from_radians).or(told.map(|told| told.heading))?;
            let vertical = number(senses::DEPTH).map(Vertical::Depth).or(told.map(|told| told.vertical))?;
            self.still = Some(Command::new(heading, 0.0, vertical));
        }
        self.still
    }

    /// Whether a vehicle at the end of a link is ours and cannot be told to lie still: it tells too little, and was told nothing yet.
    pub fn is_adrift(&mut self) -> bool {
        let is_idle = self.vehicle.is_linked() && self.task.is_none() && self.claim.is_asked();
        is_idle && self.snapshot.control == Control::InControl && self.still().is_none()
    }

    /// Whether what is done in this tick has been decided.
    pub fn is_decided(&self) -> bool {
        self.is_decided
    }

    /// Something else is under way from this tick on, or nothing: what is done in it is decided anew.
    pub fn put(&mut self, task: Option<Task>) {
        self.task = task;
        self.still = None;
        self.is_decided = false;
    }

    /// Whether a vehicle at the end of a link was asked to let us drive, and not given back since.
    pub fn is_asked(&self) -> bool {
        self.claim.is_asked()
    }

    /// Whether a vehicle at the end of a link has taken itself back, or would not let us drive.
    pub fn has_left(&self) -> bool {
        self.claim.is_asked() && matches!(self.snapshot.control, Control::Released | Control::Refused)
    }

    /// Gives a vehicle at the end of a link back, and listens on; whether it was ours to give.
    pub fn give_back(&mut self) -> Result<bool, VehicleError> {
        let was_asked = self.claim.is_asked();
        if let Some(vehicle) = self.vehicle.port() {
            self.claim.give_back(vehicle)?;
        }
        self.still = None;
        if was_asked {
            self.snapshot.control = Control::Monitoring;
        }
        Ok(was_asked)
    }

    /// What was sensed last by this name.
    fn sensed(&self, name: &str) -> Option<[f64; 4]> {
        let measurement = self.vehicle.measurements().iter().position(|c| c.name == name)?;
        let last = |samples: &[Sample]| {
            samples.iter().rev().find(|s| s.input_measurement() as usize == measurement).map(|s| s.reading)
        };
        last(&self.snapshot.samples).or_else(|| self.recent.iter().rev().find_map(|(_, samples)| last(samples)))
    }

    /// Where the vehicle believes to be, and when: a line as in a trace.
    pub fn place(&self) -> String {
        let [north, east, ..] = self.sensed(senses::POSITION).unwrap_or([f64::NAN; 4]);
        let heading = number::heading(self.sensed(senses::HEADING).map_or(f64::NAN, |r| r[0]));
        let depth = number::metres(self.sensed(senses::DEPTH).map_or(f64::NAN, |r| r[0]));
        let place = number::point(albacore_geometry::Point::new(north, east));
        format!("{}  at {place}  heading {heading}  depth {depth}", number::seconds(self.tick))
    }
}

/// The moments that were: some of them, from which the others are computed.
#[derive(Clone)]
pub struct Past {
    every: u64,
    kept: Vec<Moment>,
    pinned: Vec<Moment>,
    /// What has got a name, or a value, from a tick on, where no moment was pinned.
    named: BTreeMap<u64, Vec<Named>>,
}

impl Past {
    pub fn beginning_with(moment: &Moment) -> Self {
        Past { every: KEPT_EVERY_TICKS, kept: Vec::new(), pinned: vec![moment.clone()], named: BTreeMap::new() }
    }

    /// Keeps a moment now and then.
    pub fn note(&mut self, moment: &Moment) {
        if !moment.tick.is_multiple_of(self.every) {
            return;
        }
        self.kept.push(moment.clone());
        if self.kept.len() > KEPT_MAX {
            self.every *= 2;
            self.kept.retain(|m| m.tick.is_multiple_of(self.every));
        }
    }

    /// Keeps a moment in which something is begun or has ended: computing on from an earlier one would not know of it.
    pub fn pin(&mut self, moment: &Moment) {
        self.pinned.retain(|m| m.tick != moment.tick);
        // A moment noted in the same tick is as it was before.
        self.kept.retain(|m| m.tick != moment.tick);
        self.pinned.push(moment.clone());
        let most = if moment.vehicle.is_linked() { PINNED_ON_LINK_MAX } else { PINNED_MAX };
        if self.pinned.len() > most {
            let forgotten = self.pinned.remove(0).tick;
            // What follows from the forgotten one alone cannot be told from what follows from the next.
            let next = self.pinned.first().map_or(forgotten, |m| m.tick);
            self.kept.retain(|m| m.tick > next);
        }
    }

    /// Something has got a name, or a value, from a tick on.
    pub fn note_name(&mut self, tick: u64, named: Named) {
        self.named.entry(tick).or_default().push(named);
    }

    /// Lets a tick go by in a moment that was.
    pub fn go_on(&self, moment: &mut Moment) -> Result<bool, VehicleError> {
        let has_ended = moment.step(&mut |_| {})?;
        self.named.get(&moment.tick).into_iter().flatten().for_each(|named| moment.name(named.clone()));
        Ok(has_ended)
    }

    /// The latest moment that is kept up to a tick.
    pub fn before(&self, tick: u64) -> Option<Moment> {
        let until = self.kept.iter().chain(&self.pinned).filter(|m| m.tick <= tick);
        until.max_by_key(|m| m.tick).cloned()
    }

    /// The moment of a tick, if something was begun or ended in it, or got a name.
    pub fn pinned_at(&self, tick: u64) -> Option<&Moment> {
        self.pinned.iter().find(|moment| moment.tick == tick)
    }

    /// The earliest tick that can be gone back to.
    pub fn earliest(&self) -> u64 {
        self.kept.iter().chain(&self.pinned).map(|m| m.tick).min().unwrap_or_default()
    }

    /// What lay before is not known any more.
    pub fn forget_before(&mut self, tick: u64) {
        self.kept.retain(|m| m.tick >= tick);
        self.pinned.retain(|m| m.tick >= tick);
        self.named.retain(|of, _| *of >= tick);
    }

    /// What lay ahead has not been.
    pub fn forget_after(&mut self, tick: u64) {
        self.kept.retain(|m| m.tick <= tick);
        self.pinned.retain(|m| m.tick <= tick);
    }
}
