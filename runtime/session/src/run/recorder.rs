//! What is kept of a run in memory, folded from its records: trace, reports, the way driven, and what the picture shows.

use super::record::{Step, TickRecord};
use super::report::Reports;
use crate::craft::Odometer;
use crate::picture::Sketch;
use crate::plan::Plan;
use albacore_geometry::{Area, Heading, Point};
use albacore_machine::{Event, Outcome};
use albacore_program::{ActivityId, Body};
use albacore_trace::{BehaviorTrace, Header, Release};
use albacore_vehicle::{Channel, Snapshot, TICK_S};

/// Ticks between the points of the track that the picture draws.
const TRACK_EVERY_TICKS: u64 = 5;
/// Notices of a link that wait to be taken; the oldest are dropped.
const NOTICES_MAX: usize = 64;
/// Detections in the picture: readings at or above this share of full scale, the papers' threshold.
const DETECTION: f64 = 0.04;

/// Keeps what records tell.
pub(crate) struct Recorder {
    pub(super) plan: Plan,
    channels: Vec<Channel>,
    pub trace: BehaviorTrace,
    pub reports: Reports,
    pub switches: u64,
    pub odometer: Odometer,
    pub sketch: Sketch,
    /// The corners of the mission's area, once it has one.
    pub area: Vec<Point>,
    /// The deepest point of that, once it has one; none where the water is equally deep everywhere.
    pub deepest: Option<Point>,
    /// Where the vehicle was first, for the picture.
    pub start: Option<Point>,
    /// How the run ended, once it has.
    pub outcome: Option<Outcome>,
    /// Why, in words.
    pub reason: String,
    /// Whether the vehicle has not said that it took control back at the end.
    pub release_failed: bool,
    notices: Vec<String>,
}

impl Recorder {
    /// Of a run with a seed, on a vehicle with these channels.
    pub fn new(plan: &Plan, seed: u64, channels: &[Channel], odometer: Odometer, start: Option<Point>) -> Self {
        let header = Header {
            mission: plan.program.mission.name.clone(),
            scenario: plan.scenario_name.clone(),
            seed,
            tick_s: TICK_S,
        };
        Recorder {
            trace: BehaviorTrace::new(&plan.program, &header),
            plan: plan.clone(),
            channels: channels.to_vec(),
            reports: Reports::default(),
            switches: 0,
            odometer,
            sketch: Sketch::default(),
            area: Vec::new(),
            deepest: None,
            start,
            outcome: None,
            reason: String::new(),
            release_failed: false,
            notices: Vec::new(),
        }
    }

    /// Takes in a step.
    pub fn take(&mut self, record: &TickRecord) {
        if self.area.is_empty() && !record.area.is_empty() {
            self.area.clone_from(&record.area);
            let (bottom, area) = (&self.plan.scenario.bottom, Area::polygon(&self.area).ok());
            self.deepest = area.filter(|_| !bottom.is_level()).map(|area| bottom.deepest(&area));
        }
        match &record.step {
            Step::Wait => self.hear(record),
            Step::Tick => {
                self.hear(record);
                self.note(record);
            }
            Step::End(ending) => {
                if !record.events.is_empty() {
                    self.note(record);
                }
                self.hear(record);
                self.notices.extend(ending.trouble.clone());
                self.release_failed = ending.release == Release::Failed;
                self.trace.finish(ending.outcome, ending.release, record.tick, &ending.digest);
                self.outcome = Some(ending.outcome);
                self.reason.clone_from(&ending.reason);
            }
        }
    }

    /// So many steps before a tick were not taken in.
    pub fn miss(&mut self, steps: u64, tick: u64) {
        if steps > 0 {
            let notice = format!("{steps} ticks before this are not in trace and picture: the host was too slow");
            self.trace.vehicle(tick, &notice);
            self.notices.push(notice);
        }
    }

    /// What a person should hear of the link; taken once.
    pub fn take_notices(&mut self) -> Vec<String> {
        std::mem::take(&mut self.notices)
    }

    /// The deepest point, where that is what is sought: there are hollows to be found, and no sources.
    pub fn deepest_sought(&self) -> Option<Point> {
        let world = &self.plan.scenario;
        self.deepest.filter(|_| world.sources.is_empty() && world.bottom.has_hollows())
    }

    fn hear(&mut self, record: &TickRecord) {
        for notice in &record.notices {
            self.trace.vehicle(record.tick, notice);
            self.notices.push(notice.clone());
        }
        let surplus = self.notices.len().saturating_sub(NOTICES_MAX);
        self.notices.drain(..surplus);
    }

    /// Takes down what happened in a tick.
    fn note(&mut self, record: &TickRecord) {
        let (tick, truth, believed, events) = (record.tick, record.truth, record.believed, record.events.as_slice());
        let here = record.here();
        self.start = self.start.or(here);
        if let Some(here) = here {
            self.odometer.reach(here);
        }
        for event in events {
            match event {
                Event::Switched { .. } => self.switches += 1,
                Event::Reported(site, words) => self.report(tick, *site, words),
                _ => {}
            }
        }
        self.trace.tick(tick, believed, events);
        let sensed = |channel| self.sensed(&record.snapshot, channel).map(|reading| reading[0]);
        let heading = truth.map(|truth| truth.heading).or_else(|| sensed("heading").map(Heading::from_radians));
        let depth = truth.map(|truth| truth.depth).or_else(|| sensed("depth"));
        self.trace.sample(tick, believed, heading, depth);
        if (tick.is_multiple_of(TRACK_EVERY_TICKS) || !events.is_empty())
            && let Some(behavior) = self.shown_behavior(&record.active)
            && let Some(at) = believed.or(here)
        {
            self.sketch.track(at, behavior);
        }
        let chemical = self.channels.iter().position(|c| c.name == "chemical");
        let mut samples = record.snapshot.samples.iter();
        let detected = samples.any(|s| Some(s.channel as usize) == chemical && s.reading[0] >= DETECTION);
        // A simulated world without a plume has nothing to detect; of a real one we know no better.
        if detected
            && (truth.is_none() || self.plan.scenario.has_plume())
            && let Some(at) = believed.or(here)
        {
            self.sketch.detection(at);
        }
    }

    /// The latest numbers of a channel in a tick.
    fn sensed(&self, snapshot: &Snapshot, channel: &str) -> Option<[f64; 4]> {
        let index = self.channels.iter().position(|c| c.name == channel)?;
        snapshot.samples.iter().rev().find(|s| usize::from(s.input_channel()) == index).map(|s| s.reading)
    }

    /// What the track is coloured by: the innermost behavior of a table, else the outermost activity inside the mission.
    fn shown_behavior(&self, active: &[ActivityId]) -> Option<String> {
        let program = &self.plan.program;
        let in_table = |id: &ActivityId| {
            program.activities.iter().any(|a| match &a.body {
                Body::Table(table) => table.behaviors.iter().any(|b| b.activity == *id),
                _ => false,
            })
        };
        let id = active.iter().rev().find(|id| in_table(id)).or(active.get(1)).or(active.first())?;
        Some(program.activities[*id as usize].name.clone())
    }
}
