//! The way that a run took and how deep it was, where the rounds of its loops began, and where it detected chemical: what its picture shows.

use super::{Recorder, Sensor};
use crate::plan::Plan;
use albacore_geometry::Point;
use albacore_machine::Event;
use albacore_program::{ActivityId, Body, Program};
use albacore_trace::{Profile, Sounding, Step, TickRecord};
use albacore_vehicle::{Measurement, measurements, seconds};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::RangeInclusive;
use std::sync::Arc;

/// Ticks between the points of the track.
const TRACK_EVERY_TICKS: u64 = 5;
/// Detections: readings at or above this share of full scale, the papers' threshold.
pub(crate) const DETECTION: f64 = 0.04;

/// What was sensed longer ago than this is not known any more.
const SENSED_TICKS: u64 = 100;

/// Gathers the track, the depths and the detections.
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
    /// How deep the vehicle was over time.
    pub profile: Profile,
    /// Where it was at the end, if that is shown.
    pub end: Option<Point>,
    /// Where it was last.
    last: Option<Point>,
    depth: Sensor,
    altitude: Sensor,
    /// The depth and the bottom that were sensed last, and when.
    sensed: [Option<(u64, f64)>; 2],
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
            profile: Profile::default(),
            end: None,
            last: None,
            depth: Sensor::new(delivered, measurements::name(measurements::DEPTH)),
            altitude: Sensor::new(delivered, measurements::name(measurements::ALTITUDE)),
            sensed: [None; 2],
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

    /// Takes down what the depth is, and the bottom beneath.
    fn sense(&mut self, record: &TickRecord) {
        let latest = |sensor: &Sensor| sensor.latest(&record.snapshot).filter(|x| x.is_finite());
        if let Some(depth) = latest(&self.depth) {
            self.sensed[0] = Some((record.tick, depth));
        }
        if let Some((altitude, (_, depth))) = latest(&self.altitude).zip(self.sensed[0]) {
            self.sensed[1] = Some((record.tick, depth + altitude));
        }
    }

    /// A point of the profile, where the depth is known.
    fn sound(&mut self, record: &TickRecord, behavior: u16) {
        let fresh = self
            .sensed
            .map(|sensed| sensed.filter(|(tick, _)| record.tick.saturating_sub(*tick) <= SENSED_TICKS).map(|(_, x)| x));
        let [Some(depth), bottom] = fresh else { return };
        self.profile.is_bottom_true |= record.truth.is_some();
        let bottom = record.truth.map(|truth| truth.depth + truth.altitude).or(bottom);
        let bottom = bottom.unwrap_or(f64::NAN);
        self.profile.soundings.push(Sounding { t_s: seconds(record.tick), depth, bottom, behavior });
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
        let is_shown = |tick: u64| self.zoom.as_ref().is_none_or(|ticks| ticks.contains(&tick));
        // The end stands at the tick that would have come next.
        if record.ending().is_some() && is_shown(record.tick.saturating_sub(1)) {
            self.end = record.believed.or(record.here()).or(self.last);
        }
        if !is_shown(record.tick) {
            return;
        }
        self.sense(record);
        let happened = !record.events.is_empty();
        match record.step {
            Step::Tick => {}
            Step::End(_) if happened => {}
            _ => return,
        }
        let Some(at) = record.believed.or(record.here()) else { return };
        self.last = Some(at);
        if (record.tick.is_multiple_of(TRACK_EVERY_TICKS) || happened)
            && let Some(behavior) = self.shown(&record.active)
        {
            let index = self.index_of(behavior);
            self.points.push((at, index));
            self.sound(record, index);
        }
        self.mark(record, at);
        let mut samples = record.snapshot.samples.iter();
        let detected = samples.any(|s| Some(s.measurement as usize) == self.chemical && s.reading[0] >= DETECTION);
        if detected && (record.truth.is_none() || self.has_plume) {
            self.detections.push(at);
        }
    }
}
