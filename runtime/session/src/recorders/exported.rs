//! All that a run was, for other programs: a row for each tick, the way, what was reported and the lines of the trace. Every sample is
//! in it, those that were withheld and those that others of the same tick came after too, each in columns of its own.

mod columns;
mod navigation;
mod sensed;

use super::Recorder;
use super::results::Results;
use super::trace::Trace;
use crate::plan::Plan;
use crate::summary::Report;
use albacore_export::{About, Exported, Happened, Outline, Place, Reported, Track};
use albacore_geometry::{Point, TangentFrame};
use albacore_program::seen::one_line;
use albacore_trace::journal::JournalHeader;
use albacore_trace::{Step, TickRecord};
use albacore_vehicle::{Measurement, TICK_S, measurements, seconds};
use sensed::Sensed;
use serde_json::{Map, Value, json};

/// Gathers all of it.
pub(crate) struct ForExport {
    frame: Option<TangentFrame>,
    results: Results,
    trace: Trace,
    /// How many of its lines were taken: its head is none.
    lines: usize,
    events: Vec<Happened>,
    ticks: Vec<u64>,
    sensed: Sensed,
    believed: Vec<Place>,
    truth: Vec<Place>,
    /// The number of the vehicle's depth, and its latest.
    depth_sensor: Option<usize>,
    depth: f64,
}

impl ForExport {
    pub fn new(plan: &Plan, header: &JournalHeader) -> Self {
        let trace = Trace::new(plan, header.seed, &header.measurements);
        let is_depth = |measurement: &Measurement| measurement.name == measurements::name(measurements::DEPTH);
        ForExport {
            frame: plan.frame(),
            results: Results::new(plan, header.seed, header.start),
            lines: trace.lines().len(),
            trace,
            events: Vec::new(),
            ticks: Vec::new(),
            sensed: Sensed::new(plan, &header.measurements),
            believed: Vec::new(),
            truth: Vec::new(),
            depth_sensor: header.measurements.iter().position(is_depth),
            depth: f64::NAN,
        }
    }

    /// How many samples there was no column for.
    pub fn left_out(&self) -> u64 {
        self.sensed.columns.left_out
    }

    /// How many reports there were beside those that are listed.
    pub fn more_reports(&self) -> u64 {
        self.results.reports.more
    }

    /// All of it; `epoch_ms` is when the first tick was.
    pub fn exported(self, epoch_ms: Option<i64>) -> Exported {
        let summary = self.results.summary(0.0);
        let frame = self.frame;
        let outline = |(name, corners): (&str, &[Point])| outline(frame, name, corners);
        let areas = &self.results.plan.program.mission.areas;
        let area_name = areas.first().map_or("area", |area| area.name.as_str());
        let regions = self.results.regions.iter().map(|(name, corners)| (name.as_str(), corners.as_slice()));
        let area = (!self.results.area.is_empty()).then_some((area_name, self.results.area.as_slice()));
        let slicks = self.results.slicks.iter().filter(|_| !self.truth.is_empty());
        let end = self.ticks.last().copied().map_or(0.0, seconds);
        let true_outlines = slicks.filter_map(|slick| Some((slick.name(), slick.outline(end)?)));
        Exported {
            about: About {
                version: env!("CARGO_PKG_VERSION").to_string(),
                mission: one_line(&summary.mission),
                scenario: one_line(&summary.scenario),
                seed: summary.seed,
                outcome: if self.results.ending.is_some() { summary.outcome.to_string() } else { String::new() },
                reason: one_line(&summary.reason),
                digest: summary.digest,
                epoch_ms,
                is_on_globe: frame.is_some(),
            },
            outlines: area.into_iter().chain(regions).map(outline).collect(),
            true_outlines: true_outlines.map(|(name, area)| outline((name, area.corners()))).collect(),
            reports: summary.reports.iter().map(|report| reported(report, frame)).collect(),
            columns: self.sensed.columns.finish(self.ticks.len()),
            ticks: self.ticks,
            believed: Track(self.believed),
            truth: (!self.truth.is_empty()).then_some(Track(self.truth)),
            events: self.events,
        }
    }

    /// Takes the lines that the trace has got.
    fn hear(&mut self, tick: u64) {
        let lines = self.trace.lines();
        for line in lines.since(self.lines) {
            // Its time stands before what happened.
            let said = line.split_once(" s  ").map_or(line, |(_, said)| said);
            let (verb, text) = said.split_once(' ').unwrap_or((said, ""));
            self.events.push(Happened { tick, verb: verb.to_string(), text: text.trim().to_string() });
        }
        self.lines = lines.len();
    }

    fn row(&mut self, record: &TickRecord) {
        self.ticks.push(record.tick);
        let row = self.ticks.len() - 1;
        for sample in &record.snapshot.samples {
            if !sample.is_withheld() && Some(usize::from(sample.origin())) == self.depth_sensor {
                self.depth = sample.reading[0];
            }
        }
        self.sensed.take(row, record, &self.results.plan.program);
        let here = record.believed.map_or(Place::UNKNOWN, |here| place(self.frame, here, self.depth));
        self.believed.push(Place { depth: self.depth, ..here });
        if let Some(truth) = &record.truth {
            self.truth.resize(row, Place::UNKNOWN);
            self.truth.push(place(self.frame, truth.position, truth.depth));
        } else if let Some(last) = self.truth.last().copied() {
            self.truth.push(last);
        }
    }
}

impl Recorder for ForExport {
    fn take(&mut self, record: &TickRecord) {
        self.results.take(record);
        self.trace.take(record);
        self.hear(record.tick);
        let is_row = match record.step {
            Step::Wait => false,
            Step::Tick => true,
            // What ended it from outside may be more than its end.
            Step::End(_) => !record.events.is_empty(),
        };
        // A journal tells ticks in order: another would be no run's.
        if is_row && self.ticks.last().is_none_or(|last| *last < record.tick) {
            self.row(record);
        }
    }

    fn miss(&mut self, steps: u64, tick: u64) {
        self.results.miss(steps, tick);
        let text = format!("{steps} ticks before this are not in the journal");
        self.events.push(Happened { tick, verb: "missing".to_string(), text });
    }
}

/// Where something is, with degrees where the frame lies on the globe.
fn place(frame: Option<TangentFrame>, at: Point, depth: f64) -> Place {
    let globe = frame.map(|frame| frame.to_geodetic(at));
    Place {
        north: at.north,
        east: at.east,
        latitude: globe.map_or(f64::NAN, |globe| globe.latitude_deg()),
        longitude: globe.map_or(f64::NAN, |globe| globe.longitude_deg()),
        depth,
    }
}

fn outline(frame: Option<TangentFrame>, name: &str, corners: &[Point]) -> Outline {
    Outline { name: one_line(name), corners: corners.iter().map(|corner| place(frame, *corner, f64::NAN)).collect() }
}

fn reported(report: &Report, frame: Option<TangentFrame>) -> Reported {
    let at = report.north_m.zip(report.east_m).map(|(north, east)| Point::new(north, east));
    let mut value = Map::new();
    value.insert("value".to_string(), seen(&report.value));
    value.extend(report.labelled.iter().map(|(label, labelled)| (one_line(label), seen(labelled))));
    value.extend(report.error_m.map(|error| ("error_m".to_string(), json!(error))));
    value.extend(report.true_surface_m2.map(|surface| ("true_surface_m2".to_string(), json!(surface))));
    Reported {
        tick: (report.t_s / TICK_S).round() as u64,
        name: one_line(&report.name),
        told: one_line(&report.told),
        place: at.map(|at| place(frame, at, f64::NAN)),
        areas: report.areas.iter().map(|(name, corners)| outline(frame, name, corners)).collect(),
        value: Value::Object(value),
    }
}

/// A value whose texts are fit to be seen.
fn seen(value: &Value) -> Value {
    match value {
        Value::String(text) => Value::String(one_line(text)),
        Value::Array(values) => Value::Array(values.iter().map(seen).collect()),
        Value::Object(members) => {
            Value::Object(members.iter().map(|(name, value)| (one_line(name), seen(value))).collect())
        }
        other => other.clone(),
    }
}
