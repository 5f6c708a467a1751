//! The way that a run took, where the rounds of its loops began, and where it detected chemical: what its picture shows.

use super::Recorder;
use crate::plan::Plan;
use albacore_geometry::Point;
use albacore_machine::Event;
use albacore_program::{ActivityId, Body, Program};
use albacore_trace::{Step, TickRecord};
use albacore_vehicle::{Measurement, measurements};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::RangeInclusive;
use std::sync::Arc;

/// Ticks between the points of the track.
const TRACK_EVERY_TICKS: u64 = 5;
/// Detections: readings at or above this share of full scale, the papers' threshold.
pub(crate) const DETECTION: f64 = 0.04;

/// Gathers the track and the detections.
pub(crate) struct Track {
    program: Arc<Program>,
    /// The behaviors of all tables.
    in_tables: BTreeSet<ActivityId>,
    chemical: Option<usize>,
    /// A simulated world without a plume has nothing to detect; of a real one we know no better.
    has_plume: bool,
    /// The ticks that are shown, where not all are.
    pub zoom: Option<RangeInclusive<u64>>,
    /// The points of the track, each with the index of its behavior.
    pub points: Vec<(Point, u16)>,
    /// The names of the behaviors.
    pub behaviors: Vec<String>,
    /// Where each stands among them.
    places: BTreeMap<String, u16>,
    /// Where the rounds of loops began that walk something, such as `row 7`.
    pub rounds: Vec<(String, Point)>,
    /// Where something was detected.
    pub detections: Vec<Point>,
}

impl Track {
    pub fn new(plan: &Plan, delivered: &[Measurement]) -> Self {
        let program = Arc::clone(&plan.program);
        let of_table = |body: &Body| match body {
            Body::Table(table) => table.behaviors.iter().map(|behavior| behavior.activity).collect(),
            _ => Vec::new(),
        };
        Track {
            in_tables: program.activities.iter().flat_map(|activity| of_table(&activity.body)).collect(),
            program,
            chemical: delivered
                .iter()
                .position(|measurement| measurement.name == measurements::name(measurements::CHEMICAL)),
            has_plume: plan.scenario.has_plume(),
            zoom: None,
            points: Vec::new(),
            behaviors: Vec::new(),
            places: BTreeMap::new(),
            rounds: Vec::new(),
            detections: Vec::new(),
        }
    }

    /// What the track is coloured by: the innermost behavior of a table, else the outermost activity inside the mission.
    fn shown(&self, active: &[ActivityId]) -> Option<ActivityId> {
        let in_table = active.iter().rev().find(|id| self.in_tables.contains(id));
        in_table.or(active.get(1)).or(active.first()).copied()
    }

    /// Where the rounds of a survey begin. What a behavior of a table calls is too small to be told on a chart.
    fn mark(&mut self, record: &TickRecord, at: Point) {
        for event in &record.events {
            let Event::Began(statement, words) = event else { continue };
            let Some(statement) = self.program.statements.get(*statement as usize) else { continue };
            let inside = 1 + usize::from(statement.is_call);
            let outside = record.active.len().saturating_sub(inside);
            let is_small = record.active.iter().take(outside).any(|id| self.in_tables.contains(id));
            let round = statement.walked(words).filter(|_| !is_small);
            let is_new = |round: &String| self.rounds.last().is_none_or(|(last, _)| last != round);
            self.rounds.extend(round.filter(is_new).map(|round| (round, at)));
        }
    }

    fn index_of(&mut self, behavior: ActivityId) -> u16 {
        // A journal may be of a script that has changed since.
        let name = self.program.activities.get(behavior as usize).map_or("?", |activity| &activity.name);
        if let Some(known) = self.places.get(name) {
            return *known;
        }
        let place = self.behaviors.len() as u16;
        self.behaviors.push(name.to_string());
        self.places.insert(name.to_string(), place);
        place
    }
}

impl Recorder for Track {
    fn take(&mut self, record: &TickRecord) {
        if self.zoom.as_ref().is_some_and(|ticks| !ticks.contains(&record.tick)) {
            return;
        }
        let happened = !record.events.is_empty();
        match record.step {
            Step::Tick => {}
            Step::End(_) if happened => {}
            _ => return,
        }
        let Some(at) = record.believed.or(record.here()) else { return };
        if (record.tick.is_multiple_of(TRACK_EVERY_TICKS) || happened)
            && let Some(behavior) = self.shown(&record.active)
        {
            let index = self.index_of(behavior);
            self.points.push((at, index));
        }
        self.mark(record, at);
        let mut samples = record.snapshot.samples.iter();
        let detected = samples.any(|s| Some(s.measurement as usize) == self.chemical && s.reading[0] >= DETECTION);
        if detected && (record.truth.is_none() || self.has_plume) {
            self.detections.push(at);
        }
    }
}
