//! One run of a mission, tick by tick, with its journal, trace, digest and picture: in a simulated world or on a link.
//!
//! A driver decides what is commanded and hands on a record of each step; recorders fold over the records.

mod driver;
mod live;
mod queue;
mod record;
mod recorder;
mod report;

use crate::craft::{Craft, Odometer};
use crate::journal::Keeper;
use crate::picture;
use crate::plan::{Plan, PlanError};
use crate::summary::Summary;
use crate::world;
use albacore_geometry::Point;
use albacore_machine::Outcome;
use albacore_program::PROGRAM_VERSION;
use albacore_sim::Simulator;
use albacore_trace::journal::JournalHeader;
use albacore_trace::{BehaviorTrace, Depths, Picture};
use albacore_vehicle::{TICK_S, Vehicle, VehicleError};
use driver::Driver;
use recorder::Recorder;
use report::Reports;
use std::io;
use std::sync::atomic::{AtomicBool, Ordering};

pub use live::{Lived, Means, Told, WAITING_BYTES};
pub use record::{Ending, Step, TickRecord};

/// A run under way.
pub struct Run {
    seed: u64,
    driver: Driver,
    recorder: Recorder,
    journal: Keeper,
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
        let simulator = Simulator::new(&plan.scenario, seed).map_err(|error| world::cannot_be(&error))?;
        let start = simulator.truth().position;
        Run::with(plan, seed, Craft::Simulated(Box::new(simulator)), Some(start))
    }

    /// A run on a vehicle at the end of a link, at its first tick; the seed only names it.
    pub fn on_link(plan: &Plan, seed: u64, vehicle: Box<dyn Vehicle + Send>) -> Result<Self, PlanError> {
        Run::with(plan, seed, Craft::Linked(vehicle), None)
    }

    fn with(plan: &Plan, seed: u64, vehicle: Craft, start: Option<Point>) -> Result<Self, PlanError> {
        let recorder = Recorder::new(plan, seed, vehicle.channels(), Odometer::new(&vehicle), start);
        let driver = Driver::new(plan, vehicle)?;
        Ok(Run { seed, driver, recorder, journal: Keeper::default(), record: TickRecord::default() })
    }

    /// Keeps a journal from here on: one write call a tick, as it ends. `set` are the texts of the parameters changed for
    /// this run. A sink that fails is given up, and the run goes on without it: see [`Run::journal_failure`].
    pub fn with_journal(&mut self, sink: Box<dyn io::Write + Send>, set: &[String]) {
        let header = self.header(set);
        self.journal.begin(sink, &header);
    }

    fn header(&self, set: &[String]) -> JournalHeader {
        let plan = &self.recorder.plan;
        JournalHeader {
            program_version: PROGRAM_VERSION,
            mission: plan.program.mission.name.clone(),
            scenario: plan.scenario_name.clone(),
            seed: self.seed,
            tick_s: TICK_S,
            sources: plan.sources.clone(),
            set: set.to_vec(),
            channels: self.driver.vehicle().channels().to_vec(),
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
        self.recorder.outcome
    }

    /// What has been reported so far.
    pub(crate) fn reports(&self) -> &Reports {
        &self.recorder.reports
    }

    /// The names of the active activities, from outside in.
    pub fn active(&self) -> Vec<&str> {
        let machine = self.driver.machine();
        let name = |id: u32| machine.program().activities[id as usize].name.as_str();
        machine.active().into_iter().map(name).collect()
    }

    /// Where the vehicle truly is; on a link, where it believes to be.
    pub fn true_position(&self) -> Point {
        let truth = self.driver.vehicle().truth().map(|truth| truth.position);
        truth.or_else(|| self.driver.machine().position()).unwrap_or(Point::ORIGIN)
    }

    /// What a person should hear of the link; taken once.
    pub fn take_notices(&mut self) -> Vec<String> {
        self.recorder.take_notices()
    }

    /// Whether the vehicle has not said that it took control back at the end.
    pub fn release_failed(&self) -> bool {
        self.recorder.release_failed
    }

    /// The place of a true source that is nearest to another.
    pub fn nearest_source(&self, to: Point) -> Option<Point> {
        self.recorder.nearest_source(to)
    }

    /// Where the vehicle started.
    pub fn start(&self) -> Point {
        self.recorder.start.unwrap_or(Point::ORIGIN)
    }

    /// How deep the water truly is at a point, in metres; no number where the truth is not known.
    pub fn water_depth(&self, at: Point) -> f64 {
        self.driver.vehicle().water_depth(at).unwrap_or(f64::NAN)
    }

    /// The deepest point of the mission's area, once it has one; none where the water is equally deep everywhere.
    pub fn deepest(&self) -> Option<Point> {
        self.recorder.deepest
    }

    /// The words of the mission's area, once it has one.
    pub(crate) fn area_words(&self) -> Option<&[f64]> {
        driver::area_words(self.driver.machine())
    }

    /// Lets one tick go by. On a link the vehicle's time may not have come to it yet: then only some hundredths of a second of
    /// ours go by, so that who steps can look at other things.
    pub fn step(&mut self) -> Running {
        loop {
            let running = self.driver.step(&mut self.record);
            self.recorder.take(&self.record);
            self.journal.take(&self.record);
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
        self.driver.interrupt();
        self.step()
    }

    /// The result; `wall_s` is measured by who ran it.
    pub fn summary(&self, wall_s: f64) -> Summary {
        let (plan, kept) = (&self.recorder.plan, &self.recorder);
        Summary {
            mission: plan.program.mission.name.clone(),
            scenario: plan.scenario_name.clone(),
            seed: self.seed,
            outcome: kept.outcome.map_or("running", Outcome::name),
            reason: kept.reason.clone(),
            ticks: self.tick(),
            sim_time_s: self.tick() as f64 / (1.0 / TICK_S),
            wall_s,
            path_length_m: kept.odometer.length(),
            switches: kept.switches,
            reports: kept.reports.listed.clone(),
            more_reports: kept.reports.more,
            digest: self.driver.digest().to_string(),
        }
    }

    /// The behavior trace so far.
    pub fn trace(&self) -> &BehaviorTrace {
        &self.recorder.trace
    }

    /// The picture of the run so far, as SVG.
    pub fn svg(&self) -> String {
        let summary = self.summary(0.0);
        let scenario = &self.recorder.plan.scenario;
        let (area, deepest) = (self.recorder.area.clone(), self.recorder.deepest_sought());
        let sounded = if deepest.is_some() { area.as_slice() } else { &[] };
        let world = Picture {
            depths: Depths::sound(sounded, |p| self.water_depth(p)),
            area,
            plume: self.driver.vehicle().filaments(),
            deepest,
            start: self.recorder.start,
            ..picture::of_world(scenario, scenario.flow.mean)
        };
        self.recorder.sketch.svg(&summary, world, self.recorder.plan.program.mission.origin)
    }
}
