//! One run of a mission, tick by tick, with its journal, trace, digest and picture: in a simulated world or on a link.
//!
//! A driver decides what is commanded and hands on a record of each step; recorders fold over the records.

mod driver;
mod live;
mod page;
mod queue;

use crate::plan::{Plan, PlanError};
use crate::recorders::journal::Journal;
use crate::recorders::{InMemory, RUN_FILES, Recorder, RunFile, WorldAtEnd};
use crate::report::live::LiveReport;
use crate::run_vehicle::RunVehicle;
use crate::summary::Summary;
use albacore_geometry::Point;
use albacore_lang::Script;
use albacore_machine::Outcome;
use albacore_program::PROGRAM_VERSION;
use albacore_trace::journal::JournalHeader;
use albacore_trace::{BehaviorTrace, TickRecord};
use albacore_vehicle::{TICK_S, Vehicle, VehicleError};
use page::Kept;
use std::io;
use std::ops::RangeInclusive;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

pub(crate) use driver::Driver;
pub use live::{LiveOptions, LiveRun, LiveUpdate, WAITING_BYTES};

/// A run under way.
pub struct Run {
    driver: Driver,
    memory: InMemory,
    journal: Journal,
    /// The way to the thread that keeps a page, if one is wanted.
    page: Option<Kept>,
    record: TickRecord,
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
        let (driver, start) = Driver::simulated(plan, seed)?;
        Ok(Run::with(plan, seed, driver, Some(start)))
    }

    /// A run on a vehicle at the end of a link, at its first tick; the seed only names it.
    pub fn on_link(plan: &Plan, seed: u64, vehicle: Box<dyn Vehicle + Send>) -> Result<Self, PlanError> {
        Ok(Run::with(plan, seed, Driver::new(plan, RunVehicle::Linked(vehicle))?, None))
    }

    fn with(plan: &Plan, seed: u64, driver: Driver, start: Option<Point>) -> Self {
        let memory = InMemory::new(plan, seed, driver.vehicle().measurements(), start);
        Run { driver, memory, journal: Journal::default(), page: None, record: TickRecord::default() }
    }

    /// Keeps a journal from here on: one write call a tick, as it ends. `set` are the texts of the parameters changed for
    /// this run. A sink that fails is given up, and the run goes on without it: see [`Run::journal_failure`].
    pub fn with_journal(&mut self, sink: Box<dyn io::Write + Send>, set: &[String]) {
        let header = self.header(set);
        self.journal.begin(sink, &header);
    }

    /// Keeps a report of it from here on, on a thread of its own, for who wants to look at it as it goes. `set` are the texts of the parameters
    /// changed for this run. An error tells that there is no such thread to be had.
    pub fn watched(&mut self, script: &Script, set: &[String]) -> io::Result<Arc<LiveReport>> {
        let plan = self.memory.results.plan.clone();
        let report = Arc::new(LiveReport::new(script, &plan, &self.header(set)));
        self.page = Some(page::begin(Arc::clone(&report))?);
        Ok(report)
    }

    /// Lets the picture show nothing but a time of the run, in ticks.
    pub fn zoom(&mut self, ticks: RangeInclusive<u64>) {
        self.memory.track.zoom = Some(ticks);
    }

    fn header(&self, set: &[String]) -> JournalHeader {
        let plan = &self.memory.results.plan;
        JournalHeader {
            program_version: PROGRAM_VERSION,
            mission: plan.program.mission.name.clone(),
            scenario: plan.scenario_name.clone(),
            seed: self.memory.results.seed,
            tick_s: TICK_S,
            sources: plan.sources_from_script(),
            set: set.to_vec(),
            measurements: self.driver.vehicle().measurements().to_vec(),
            start: self.memory.results.start,
            scripts: plan.scripts.to_vec(),
            world: (*plan.world).clone(),
        }
    }

    /// Why the journal was given up, if it was; told once.
    pub fn journal_failure(&mut self) -> Option<io::Error> {
        self.journal.failure()
    }

    /// The tick that comes next.
    pub fn tick(&self) -> u64 {
        self.driver.tick()
    }

    /// How the mission ended, once it has.
    pub fn outcome(&self) -> Option<Outcome> {
        self.memory.results.outcome()
    }

    /// The active activities, from outside in, and the statement that is under way.
    pub fn under_way(&self) -> Vec<String> {
        self.memory.trace.lines().under_way()
    }

    /// How it stands, on one line.
    pub fn status_line(&self) -> String {
        self.memory.status.line(&self.under_way())
    }

    /// Where the vehicle truly is; on a link, where it believes to be.
    pub fn true_position(&self) -> Point {
        let truth = self.driver.vehicle().truth().map(|truth| truth.position);
        truth.or_else(|| self.driver.machine().position()).unwrap_or(Point::ORIGIN)
    }

    /// What a person should hear of the link; taken once.
    pub fn take_notices(&mut self) -> Vec<String> {
        self.memory.notices.take_all()
    }

    /// Whether the vehicle has not said that it took control back at the end.
    pub fn release_failed(&self) -> bool {
        self.memory.results.release_failed()
    }

    /// Where the vehicle started.
    pub fn start(&self) -> Point {
        self.memory.results.start.unwrap_or(Point::ORIGIN)
    }

    /// How deep the water truly is at a point, in metres; no number where the truth is not known.
    pub fn water_depth(&self, at: Point) -> f64 {
        self.driver.vehicle().water_depth(at).unwrap_or(f64::NAN)
    }

    /// Lets one tick go by. On a link the vehicle's time may not have come to it yet: then only some hundredths of a second of
    /// ours go by, so that who steps can look at other things.
    pub fn step(&mut self) -> Running {
        loop {
            let running = self.driver.step(&mut self.record);
            self.memory.take(&self.record);
            self.journal.take(&self.record);
            if let Some(page) = &mut self.page {
                page.hand_copy(&self.record);
            }
            if !self.driver.is_ending() {
                return running;
            }
        }
    }

    /// Waits before the first tick until the vehicle is heard, which nothing is asked of yet. `false`: it was interrupted.
    pub fn hear(&mut self, interrupted: &AtomicBool) -> Result<bool, VehicleError> {
        while !interrupted.load(Ordering::Relaxed) {
            if self.driver.is_heard()? {
                return Ok(true);
            }
        }
        Ok(false)
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
        self.end_because("interrupted")
    }

    /// Ends the run, for a reason that no mission knows.
    pub fn end_because(&mut self, why: &str) -> Running {
        self.driver.interrupt(why);
        self.step()
    }

    /// The result; `wall_s` is measured by who ran it.
    pub fn summary(&self, wall_s: f64) -> Summary {
        let summary = self.memory.summary(wall_s);
        Summary { digest: format!("{:016x}", self.driver.digest()), ..summary }
    }

    /// The behavior trace so far.
    pub fn trace(&self) -> &BehaviorTrace {
        self.memory.trace.lines()
    }

    /// The files that it leaves, in the order in which they are written.
    pub fn files(&self) -> impl Iterator<Item = &'static RunFile> {
        RUN_FILES.iter().filter(|file| (file.is_left)(&self.memory))
    }

    /// One of the files that a run leaves, of the run so far.
    pub fn file(&self, file: &RunFile) -> String {
        let vehicle = self.driver.vehicle();
        (file.make)(&self.memory, &WorldAtEnd { in_simulation: vehicle.truth().is_some(), plume: vehicle.filaments() })
    }
}
