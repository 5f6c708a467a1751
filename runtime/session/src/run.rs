//! One run of a mission, tick by tick, with its journal, trace, digest and picture: in a simulated world or on a link.

mod report;

use crate::craft::{Craft, Odometer};
use crate::journal::Keeper;
use crate::picture;
use crate::plan::{Plan, PlanError};
use crate::summary::{Report, Summary};
use crate::world;
use albacore_geometry::{Area, Heading, Point};
use albacore_machine::{Event, Machine, Outcome, Wish};
use albacore_navigation::Vigil;
use albacore_program::{AREA_WORDS, PROGRAM_VERSION};
use albacore_sim::Simulator;
use albacore_trace::journal::{Closing, JournalHeader};
use albacore_trace::{BehaviorTrace, Depths, Digest, Header, Picture, Release};
use albacore_vehicle::{Snapshot, TICK_S, Vehicle, VehicleError, Vertical};
use std::io;
use std::sync::Arc;

/// A run takes this many ticks at most: ten days.
const TICKS_MAX: u64 = 8_640_000;
/// Ticks between the points of the track that the picture draws.
const TRACK_EVERY_TICKS: u64 = 5;
/// Notices of a link that wait to be taken; the oldest are dropped.
const NOTICES_MAX: usize = 64;
/// Detections in the picture: readings at or above this share of full scale, the papers' threshold.
const DETECTION: f64 = 0.04;

/// A run under way.
pub struct Run {
    plan: Plan,
    seed: u64,
    machine: Machine,
    vehicle: Craft,
    snapshot: Snapshot,
    trace: BehaviorTrace,
    digest: Digest,
    journal: Keeper,
    reports: Vec<Report>,
    reason: String,
    switches: u64,
    odometer: Odometer,
    /// The deepest point of the mission's area, once it has one; none where the water is equally deep everywhere.
    deepest: Option<Point>,
    picture: picture::Sketch,
    /// Where the vehicle was first, for the picture.
    start: Option<Point>,
    /// Whether the vehicle has been asked to let us drive, and not been given back since.
    asked_for_control: bool,
    notices: Vec<String>,
    /// What the vehicle or its link gave notice of last.
    last_notice: String,
    vigil: Vigil,
    release_failed: bool,
}

/// Whether a run goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Running {
    /// It goes on.
    On,
    /// It has ended so.
    Over(Outcome),
}

impl Run {
    /// A run in the plan's world with a seed, at its first tick.
    pub fn new(plan: &Plan, seed: u64) -> Result<Self, PlanError> {
        let simulator = Simulator::new(&plan.scenario, seed).map_err(|error| world::cannot_be(&error))?;
        let start = simulator.truth().position;
        Run::with(plan, seed, Craft::Simulated(Box::new(simulator)), Some(start))
    }

    /// A run on a vehicle at the end of a link, at its first tick; the seed only names it.
    pub fn on_link(plan: &Plan, seed: u64, vehicle: Box<dyn Vehicle>) -> Result<Self, PlanError> {
        Run::with(plan, seed, Craft::Linked(vehicle), None)
    }

    fn with(plan: &Plan, seed: u64, vehicle: Craft, start: Option<Point>) -> Result<Self, PlanError> {
        let machine = Machine::new(Arc::clone(&plan.program), vehicle.channels())
            .map_err(|missing| PlanError::Asked(missing.to_string(), None))?;
        let header = Header {
            mission: plan.program.mission.name.clone(),
            scenario: plan.scenario_name.clone(),
            seed,
            tick_s: TICK_S,
        };
        let trace = BehaviorTrace::new(&plan.program, &header);
        let odometer = Odometer::new(&vehicle);
        Ok(Run {
            plan: plan.clone(),
            seed,
            machine,
            vehicle,
            snapshot: Snapshot::default(),
            trace,
            digest: Digest::new(),
            journal: Keeper::default(),
            reports: Vec::new(),
            reason: String::new(),
            switches: 0,
            odometer,
            deepest: None,
            picture: picture::Sketch::default(),
            start,
            asked_for_control: false,
            notices: Vec::new(),
            last_notice: String::new(),
            vigil: Vigil::default(),
            release_failed: false,
        })
    }

    /// Keeps a journal from here on: one write call a tick, as it ends. `set` are the texts of the parameters changed for
    /// this run. A sink that fails is given up, and the run goes on without it: see [`Run::journal_failure`].
    pub fn with_journal(&mut self, sink: Box<dyn io::Write + Send>, set: &[String]) {
        let header = JournalHeader {
            program_version: PROGRAM_VERSION,
            mission: self.plan.program.mission.name.clone(),
            scenario: self.plan.scenario_name.clone(),
            seed: self.seed,
            tick_s: TICK_S,
            sources: self.plan.sources.clone(),
            set: set.to_vec(),
            channels: self.vehicle.channels().to_vec(),
        };
        self.journal.begin(sink, &header);
    }

    /// Why the journal was given up, if it was; told once.
    pub fn journal_failure(&mut self) -> Option<io::Error> {
        self.journal.failure()
    }

    /// The tick that comes next.
    pub fn tick(&self) -> u64 {
        self.machine.state().tick
    }

    /// The names of the active activities, from outside in.
    pub fn active(&self) -> Vec<&str> {
        let program = self.machine.program();
        self.machine.active().into_iter().map(|id| program.activities[id as usize].name.as_str()).collect()
    }

    /// Where the vehicle truly is; on a link, where it believes to be.
    pub fn true_position(&self) -> Point {
        let truth = self.vehicle.truth().map(|truth| truth.position);
        truth.or_else(|| self.machine.position()).unwrap_or(Point::ORIGIN)
    }

    /// What a person should hear of the link; taken once.
    pub fn take_notices(&mut self) -> Vec<String> {
        std::mem::take(&mut self.notices)
    }

    /// Whether the vehicle has not said that it took control back at the end.
    pub fn release_failed(&self) -> bool {
        self.release_failed
    }

    /// The place of a true source that is nearest to another.
    pub fn nearest_source(&self, to: Point) -> Option<Point> {
        let sources = self.plan.scenario.sources.iter().map(|source| source.nearest(to));
        sources.min_by(|a, b| a.distance(to).total_cmp(&b.distance(to)))
    }

    /// Where the vehicle started.
    pub fn start(&self) -> Point {
        self.start.unwrap_or(Point::ORIGIN)
    }

    /// How deep the water truly is at a point, in metres; no number where the truth is not known.
    pub fn water_depth(&self, at: Point) -> f64 {
        self.vehicle.water_depth(at).unwrap_or(f64::NAN)
    }

    /// The deepest point of the mission's area, once it has one; none where the water is equally deep everywhere.
    pub fn deepest(&self) -> Option<Point> {
        self.deepest
    }

    /// The deepest point, where that is what is sought: there are hollows to be found, and no sources.
    fn deepest_sought(&self) -> Option<Point> {
        let world = &self.plan.scenario;
        self.deepest.filter(|_| world.sources.is_empty() && world.bottom.has_hollows())
    }

    /// The corners of the mission's area, once it has one.
    fn area_corners(&self) -> Vec<Point> {
        let Some(words) = self.area_words() else { return Vec::new() };
        let corner = |i: usize| 1 + albacore_program::AREA_CORNER_WORDS as usize * i;
        (0..words[0] as usize).map(|i| Point::new(words[corner(i)], words[corner(i) + 1])).collect()
    }

    /// The words of the mission's area, once it has one.
    pub(crate) fn area_words(&self) -> Option<&[f64]> {
        let program = &self.plan.program;
        let at = (program.mission.base + program.mission.area?) as usize;
        self.machine.state().words.get(at..at + AREA_WORDS as usize)
    }

    /// Lets one tick go by. On a link the vehicle's time may not have come to it yet: then only some hundredths of a second of
    /// ours go by, so that who steps can look at other things.
    pub fn step(&mut self) -> Running {
        if let Some(outcome) = self.machine.outcome() {
            return Running::Over(outcome);
        }
        let tick = self.tick();
        if tick >= TICKS_MAX {
            return self.end(Outcome::Failed, "the run is longer than ten days");
        }
        match self.vehicle.port().ready() {
            Ok(true) => {}
            Ok(false) => {
                self.hear(tick);
                return Running::On;
            }
            Err(error) => return self.end(Outcome::Failed, &error.to_string()),
        }
        if let Err(error) = self.vehicle.port().sense(&mut self.snapshot) {
            return self.end(Outcome::Failed, &error.to_string());
        }
        if let Err(error) = self.follow_wish() {
            return self.end(Outcome::Failed, &error.to_string());
        }
        let sightings = self.vigil.look(tick, &self.snapshot, self.machine.state().command.as_ref());
        let command = self.machine.step(&self.snapshot);
        let sent = command.map_or(Ok(()), |command| self.vehicle.port().command(&command));
        let sent = sent.and_then(|()| self.follow_wish());
        let events = self.machine.events().to_vec();
        self.hear(tick);
        for sighting in sightings {
            self.take_down(tick, sighting.to_string());
        }
        if self.deepest.is_none() && !self.plan.scenario.bottom.is_level() {
            let area = Area::polygon(&self.area_corners()).ok();
            self.deepest = area.map(|area| self.plan.scenario.bottom.deepest(&area));
        }
        self.note(tick, &events);
        self.journal.tick(tick, &self.snapshot, command.as_ref(), &events);
        if let Err(error) = sent {
            return self.end(Outcome::Failed, &error.to_string());
        }
        match self.machine.outcome() {
            Some(outcome) => self.finish(outcome, Vec::new()),
            None => Running::On,
        }
    }

    /// Asks for control when the mission wants it, and gives it back when a guest's override has ended. At the end of the
    /// mission comes the release.
    fn follow_wish(&mut self) -> Result<(), VehicleError> {
        let wants = self.machine.wish() != Wish::Listen;
        if wants == self.asked_for_control || self.machine.outcome().is_some() {
            return Ok(());
        }
        self.asked_for_control = wants;
        if wants { self.vehicle.port().take_over() } else { self.vehicle.port().give_back() }
    }

    /// Runs to the end.
    pub fn to_end(&mut self) -> Outcome {
        loop {
            if let Running::Over(outcome) = self.step() {
                return outcome;
            }
        }
    }

    /// Ends the run because the person says so.
    pub fn interrupt(&mut self) -> Running {
        self.end(Outcome::Interrupted, "interrupted")
    }

    fn end(&mut self, outcome: Outcome, reason: &str) -> Running {
        let tick = self.tick();
        self.reason = reason.to_string();
        let events = self.machine.end(outcome).to_vec();
        // What was sensed last belongs to the tick before, or to none.
        self.snapshot.samples.clear();
        self.note(tick, &events);
        self.finish(outcome, events)
    }

    /// The release is always the last act; then it is only written down.
    fn finish(&mut self, outcome: Outcome, events: Vec<Event>) -> Running {
        if matches!(outcome, Outcome::Refused | Outcome::ReleasedByVehicle | Outcome::LinkLost)
            && self.reason.is_empty()
            && self.vehicle.truth().is_none()
        {
            self.reason.clone_from(&self.last_notice);
        }
        let released = self.vehicle.port().release();
        self.hear(self.tick());
        let release = match released {
            Err(error) => {
                self.notices.push(error.to_string());
                self.release_failed = true;
                Release::Failed
            }
            Ok(()) if self.plan.program.mission.guest && !self.asked_for_control => Release::NotOurs,
            Ok(()) => Release::Done,
        };
        let ticks = self.tick();
        self.trace.finish(outcome, release, ticks, &self.digest);
        let (reason, digest) = (&self.reason, self.digest.value());
        self.journal.close(|| Closing { outcome, reason: reason.clone(), ticks, events, digest });
        Running::Over(outcome)
    }

    /// Takes down what the vehicle gave notice of: no part of the digest, for when it comes is no matter of the run.
    fn hear(&mut self, tick: u64) {
        for notice in self.vehicle.port().notices() {
            self.last_notice.clone_from(&notice);
            self.take_down(tick, notice);
        }
    }

    fn take_down(&mut self, tick: u64, notice: String) {
        self.trace.vehicle(tick, &notice);
        self.notices.push(notice);
        let surplus = self.notices.len().saturating_sub(NOTICES_MAX);
        self.notices.drain(..surplus);
    }

    /// The latest numbers of a channel in this tick.
    fn sensed(&self, channel: &str) -> Option<[f64; 4]> {
        let index = self.vehicle.channels().iter().position(|c| c.name == channel)?;
        self.snapshot.samples.iter().rev().find(|s| usize::from(s.channel) == index).map(|s| s.reading)
    }

    /// Takes down what happened in a tick.
    fn note(&mut self, tick: u64, events: &[Event]) {
        let truth = self.vehicle.truth();
        self.hash(tick, events);
        let believed = self.machine.position();
        let here = truth.map(|truth| truth.position).or(believed);
        self.start = self.start.or(here);
        if let Some(here) = here {
            self.odometer.reach(here);
        }
        for event in events {
            match event {
                Event::Switched { .. } => self.switches += 1,
                Event::Reported(site, words) => self.report(tick, *site, words),
                Event::Aborted(why) => self.reason.clone_from(why),
                Event::TimedOut => self.reason = "time limit".to_string(),
                _ => {}
            }
        }
        self.trace.tick(tick, believed, events);
        let heading = truth
            .map(|truth| truth.heading)
            .or_else(|| self.sensed("heading").map(|reading| Heading::from_radians(reading[0])));
        let depth = truth.map(|truth| truth.depth).or_else(|| self.sensed("depth").map(|reading| reading[0]));
        self.trace.sample(tick, believed, heading, depth);
        if (tick.is_multiple_of(TRACK_EVERY_TICKS) || !events.is_empty())
            && let Some(behavior) = self.shown_behavior()
            && let Some(at) = believed.or(here)
        {
            self.picture.track(at, behavior);
        }
        let chemical = self.vehicle.channels().iter().position(|c| c.name == "chemical");
        let detected =
            self.snapshot.samples.iter().any(|s| Some(s.channel as usize) == chemical && s.reading[0] >= DETECTION);
        // A simulated world without a plume has nothing to detect; of a real one we know no better.
        if detected
            && (truth.is_none() || self.plan.scenario.has_plume())
            && let Some(at) = believed.or(here)
        {
            self.picture.detection(at);
        }
    }

    /// What the track is coloured by: the innermost behavior of a table, else the outermost activity inside the mission.
    fn shown_behavior(&self) -> Option<String> {
        let program = self.machine.program();
        let active = self.machine.active();
        let in_table = |id: &u32| {
            program.activities.iter().any(|a| match &a.body {
                albacore_program::Body::Table(table) => table.behaviors.iter().any(|b| b.activity == *id),
                _ => false,
            })
        };
        let id = active.iter().rev().find(|id| in_table(id)).or(active.get(1)).or(active.first())?;
        Some(program.activities[*id as usize].name.clone())
    }

    /// The full-rate run: every sample, every command, every event.
    fn hash(&mut self, tick: u64, events: &[Event]) {
        let digest = &mut self.digest;
        digest.word(tick);
        for sample in &self.snapshot.samples {
            digest.word(u64::from(sample.channel));
            digest.numbers(&sample.reading);
        }
        if let Some(command) = self.machine.state().command {
            digest.number(command.heading.radians());
            digest.number(command.speed);
            match command.vertical {
                Vertical::Depth(metres) => digest.number(metres),
                Vertical::Altitude(metres) => digest.number(-metres),
            }
        }
        for event in events {
            digest.text(&format!("{event:?}"));
        }
    }

    /// The result; `wall_s` is measured by who ran it.
    pub fn summary(&self, wall_s: f64) -> Summary {
        let outcome = self.machine.outcome().map_or("running", Outcome::name);
        Summary {
            mission: self.plan.program.mission.name.clone(),
            scenario: self.plan.scenario_name.clone(),
            seed: self.seed,
            outcome,
            reason: self.reason.clone(),
            ticks: self.tick(),
            sim_time_s: self.tick() as f64 / (1.0 / TICK_S),
            wall_s,
            path_length_m: self.odometer.length(),
            switches: self.switches,
            reports: self.reports.clone(),
            digest: self.digest.to_string(),
        }
    }

    /// The behavior trace so far.
    pub fn trace(&self) -> &BehaviorTrace {
        &self.trace
    }

    /// The picture of the run so far, as SVG.
    pub fn svg(&self) -> String {
        let summary = self.summary(0.0);
        let scenario = &self.plan.scenario;
        let (area, deepest) = (self.area_corners(), self.deepest_sought());
        let sounded = if deepest.is_some() { area.as_slice() } else { &[] };
        let world = Picture {
            depths: Depths::sound(sounded, |p| self.water_depth(p)),
            area,
            plume: self.vehicle.filaments(),
            deepest,
            start: self.start,
            ..picture::of_world(scenario, scenario.flow.mean)
        };
        self.picture.svg(&summary, world)
    }
}
