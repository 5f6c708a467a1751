//! Folds the records of a run into what its page shows.

use super::data::ActivityName;
use super::happenings::{Happening, HappeningFold};
use super::series::{Column, Keep, SECONDS_END, SLOTS_MAX, Series, packed};
use super::spans::{NewSpans, SpanFold, Spans};
use super::world::Extent;
use crate::plan::Plan;
use crate::recorders::Recorder;
use crate::recorders::track::DETECTION;
use albacore_geometry::Heading;
use albacore_program::seen::one_line;
use albacore_program::{ActivityId, Body, Program};
use albacore_trace::journal::JournalHeader;
use albacore_trace::{Step, TickRecord};
use albacore_vehicle::measurements::{self, CHEMICAL};
use albacore_vehicle::{COMMANDED, Quantity};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// Ticks in a second.
const TICKS: u64 = 10;

/// Columns of what is known beside the measurements, in the order of [`Known`].
const KNOWN: [(&str, &str, u8); Known::COUNT] = [
    ("north", "m", 1),
    ("east", "m", 1),
    ("true_north", "m", 1),
    ("true_east", "m", 1),
    ("true_depth", "m", 2),
    ("true_bottom", "m", 2),
    ("true_water_speed", "m/s", 2),
];

#[derive(Clone, Copy)]
enum Known {
    North,
    East,
    TrueNorth,
    TrueEast,
    TrueDepth,
    TrueBottom,
    TrueWaterSpeed,
}

impl Known {
    const COUNT: usize = Known::TrueWaterSpeed as usize + 1;
}

/// What a measurement is shown as: its columns, and how its numbers are made of a reading.
struct Shown {
    columns: Vec<Column>,
    quantity: Quantity,
}

/// Gathers all of it.
pub(super) struct Fold {
    program: Arc<Program>,
    known: Vec<Column>,
    /// What was commanded, in the order of [`COMMANDED`].
    asked: Vec<Column>,
    /// By the number of each measurement.
    measured: Vec<Option<Shown>>,
    detection: Option<f64>,
    spans: SpanFold,
    happenings: HappeningFold,
    names: Names,
    colours: Vec<Option<usize>>,
    /// Seconds between two numbers of a series: twice as many whenever there are too many.
    every_s: u64,
    /// The last second that was taken in.
    last_second: Option<u64>,
    reach: Option<Extent>,
    in_tables: BTreeSet<ActivityId>,
}

/// The activities that have a name on the page.
#[derive(Default)]
struct Names {
    places: BTreeMap<ActivityId, usize>,
    ids: Vec<ActivityId>,
}

impl Names {
    fn of(&mut self, id: ActivityId) -> usize {
        *self.places.entry(id).or_insert_with(|| {
            self.ids.push(id);
            self.ids.len() - 1
        })
    }
}

/// All that was gathered.
pub(super) struct Folded {
    pub every_s: u64,
    pub series: Vec<Series>,
    pub colours: Vec<Option<i64>>,
    pub activities: Vec<ActivityName>,
    pub spans: Spans,
    pub happenings: Vec<Happening>,
    pub left_out: u64,
    pub detection: Option<f64>,
    /// Where the vehicle was.
    pub reach: Option<Extent>,
    /// The strategies with tables that ran, with the indices of their names and of their behaviors'.
    pub tables: Vec<RunTable>,
}

/// A strategy with a table, the index of its name, and those of its behaviors'.
pub(super) type RunTable = (ActivityId, usize, Vec<Option<usize>>);

/// How far everything has come: what is known of it to somebody.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Counts {
    /// Seconds between two numbers of a series.
    pub every_s: u64,
    /// The last slot that has numbers.
    pub slot: usize,
    pub names: usize,
    pub spans: usize,
    pub closed: usize,
    pub lines: usize,
}

/// What has come since then.
#[derive(Clone, Debug, Serialize)]
pub struct NewParts {
    /// What was sensed, commanded and true, from a slot on.
    pub series: Vec<Series>,
    /// What the track is coloured by, from that slot on, packed.
    pub colours: Vec<Option<i64>>,
    /// Names of what was active.
    pub activities: Vec<ActivityName>,
    /// When each was active.
    pub spans: NewSpans,
    /// Lines of the trace.
    pub happenings: Vec<Happening>,
    /// How many lines there were in all beside those that are kept.
    pub happenings_left_out: u64,
}

impl Fold {
    pub fn new(plan: &Plan, header: &JournalHeader) -> Self {
        let program = Arc::clone(&plan.program);
        let behaviors = |body: &Body| match body {
            Body::Table(table) => table.behaviors.iter().map(|entry| entry.activity).collect(),
            _ => Vec::new(),
        };
        let has_plume = plan.scenario.has_plume() || matches!(header.world, albacore_trace::journal::World::Link);
        Fold {
            in_tables: program.activities.iter().flat_map(|activity| behaviors(&activity.body)).collect(),
            program,
            known: KNOWN.map(|(name, unit, decimals)| Column::new(name, unit, decimals)).into(),
            asked: COMMANDED
                .iter()
                .map(|part| Column::new(format!("asked_{}", part.name), part.unit, part.digits))
                .collect(),
            measured: header.measurements.iter().map(|measurement| shown(&measurement.name)).collect(),
            detection: has_plume.then_some(DETECTION),
            spans: SpanFold::default(),
            happenings: HappeningFold::new(plan, header.seed),
            names: Names::default(),
            colours: Vec::new(),
            every_s: 1,
            last_second: None,
            reach: None,
        }
    }

    pub fn finish(self, ticks: u64) -> Folded {
        let (activities, tables) = (self.activities(0), self.tables());
        let mut columns = self.known;
        columns.extend(self.asked);
        columns.extend(self.measured.into_iter().flatten().flat_map(|shown| shown.columns));
        columns.retain(Column::is_there);
        let (happenings, left_out) = self.happenings.finish();
        Folded {
            every_s: self.every_s,
            series: columns.into_iter().map(Column::finish).collect(),
            colours: packed(self.colours.iter().map(|colour| colour.map(|colour| colour as i64))),
            activities,
            spans: self.spans.finish(ticks),
            happenings,
            left_out,
            detection: self.detection,
            reach: self.reach,
            tables,
        }
    }

    /// The activities that have got a name after the first so many.
    pub fn activities(&self, known: usize) -> Vec<ActivityName> {
        let activity = |id: &ActivityId| self.program.activities.get(*id as usize);
        let name = |id: &ActivityId| ActivityName {
            name: one_line(activity(id).map_or("?", |of| &of.name)),
            place: one_line(activity(id).map_or("", |of| &of.place)),
        };
        self.names.ids.iter().skip(known).map(name).collect()
    }

    /// The strategies with tables that have run.
    pub fn tables(&self) -> Vec<RunTable> {
        let table = |(index, id): (usize, &ActivityId)| {
            let Body::Table(table) = &self.program.activities.get(*id as usize)?.body else { return None };
            let place = |entry: &albacore_program::Entry| self.names.places.get(&entry.activity).copied();
            Some((*id, index, table.behaviors.iter().map(place).collect()))
        };
        self.names.ids.iter().enumerate().filter_map(table).collect()
    }

    /// Where the vehicle was so far.
    pub fn reach(&self) -> Option<Extent> {
        self.reach
    }

    /// How far everything has come.
    pub fn counts(&self) -> Counts {
        let (spans, closed) = self.spans.counts();
        Counts {
            every_s: self.every_s,
            slot: self.last_second.map_or(0, |second| second.div_ceil(self.every_s) as usize),
            names: self.names.ids.len(),
            spans,
            closed,
            lines: self.happenings.count(),
        }
    }

    /// What has come since that. The last slot may have become other, and is told again.
    pub fn since(&self, known: &Counts) -> NewParts {
        let measured = self.measured.iter().flatten().flat_map(|shown| &shown.columns);
        let columns =
            self.known.iter().chain(&self.asked).chain(measured).filter(|column| column.is_there_since(known.slot));
        let colours = self.colours.iter().skip(known.slot);
        let (happenings, left_out) = self.happenings.since(known.lines);
        NewParts {
            series: columns.map(|column| column.since(known.slot)).collect(),
            colours: packed(colours.map(|colour| colour.map(|colour| colour as i64))),
            activities: self.activities(known.names),
            spans: self.spans.since(known.spans, known.closed),
            happenings,
            happenings_left_out: left_out,
        }
    }

    /// From which share of full scale on chemical is detected.
    pub fn detection(&self) -> Option<f64> {
        self.detection
    }

    /// Half as many numbers of everything.
    fn halve(&mut self) {
        let measured = self.measured.iter_mut().flatten().flat_map(|shown| &mut shown.columns);
        self.known.iter_mut().chain(&mut self.asked).chain(measured).for_each(Column::halve);
        // As of the series: the first stands for 0 alone, and of two seconds the later one.
        let (first, rest) = self.colours.split_at(self.colours.len().min(1));
        let later = rest.chunks(2).filter_map(|pair| pair.last());
        self.colours = first.iter().chain(later).copied().collect();
        self.every_s *= 2;
    }

    /// What was sensed, commanded and true in a tick.
    fn measure(&mut self, record: &TickRecord) {
        // A second is up to its last tick: what a page shows at 7 s is of 6.1 s to 7.0 s.
        let second = record.tick.div_ceil(TICKS);
        if second >= SECONDS_END {
            return;
        }
        while second.div_ceil(self.every_s) as usize >= SLOTS_MAX {
            self.halve();
        }
        let slot = second.div_ceil(self.every_s) as usize;
        let known = &mut self.known;
        let mut set = |known_as: Known, x: f64| {
            if let Some(column) = known.get_mut(known_as as usize) {
                column.set(slot, x);
            }
        };
        if let Some(at) = record.believed {
            set(Known::North, at.north);
            set(Known::East, at.east);
        }
        if let Some(truth) = &record.truth {
            set(Known::TrueNorth, truth.position.north);
            set(Known::TrueEast, truth.position.east);
            set(Known::TrueDepth, truth.depth);
            set(Known::TrueBottom, truth.depth + truth.altitude);
            let over_ground = truth.speed_over_ground * truth.course.unit();
            set(Known::TrueWaterSpeed, (over_ground - truth.flow).length());
        }
        if let Some(command) = &record.command {
            let parts = self.asked.iter_mut().zip(&COMMANDED);
            parts.for_each(|(column, part)| (part.value)(command).into_iter().for_each(|x| column.set(slot, x)));
        }
        for sample in &record.snapshot.samples {
            let Some(Some(shown)) = self.measured.get_mut(usize::from(sample.input_measurement())) else { continue };
            let numbers = match shown.quantity {
                Quantity::Direction => [Heading::from_radians(sample.reading[0]).degrees(), 0.0],
                Quantity::Ratio => [100.0 * sample.reading[0]; 2],
                Quantity::Flow => [sample.reading[0], sample.reading[1]],
                _ => [sample.reading[0]; 2],
            };
            shown.columns.iter_mut().zip(numbers).for_each(|(column, x)| column.set(slot, x));
        }
        self.colour(slot, record);
        if self.last_second.is_none_or(|last| second > last) {
            self.last_second = Some(second);
            self.reach = record.here().and_then(Extent::at_point).map_or(self.reach, |at| Some(at.with(self.reach)));
        }
    }

    /// What the track is coloured by: the innermost behavior of a table, else the outermost activity inside the mission.
    fn colour(&mut self, slot: usize, record: &TickRecord) {
        let active = &record.active;
        let in_table = active.iter().rev().find(|id| self.in_tables.contains(id));
        let shown = in_table.or(active.get(1)).or(active.first()).copied();
        let shown = shown.map(|id| self.names.of(id));
        if self.colours.len() <= slot {
            self.colours.resize(slot + 1, None);
        }
        if let Some(colour) = self.colours.get_mut(slot) {
            *colour = shown;
        }
    }
}

impl Recorder for Fold {
    fn take(&mut self, record: &TickRecord) {
        let names = &mut self.names;
        self.happenings.take(record, &mut |id| names.of(id));
        match record.step {
            Step::Wait => {}
            Step::Tick => {
                self.spans.take(record, &mut |id| names.of(id));
                self.measure(record);
            }
            Step::End(_) => self.spans.lose(record.tick),
        }
    }

    fn miss(&mut self, steps: u64, tick: u64) {
        self.spans.lose(tick.saturating_sub(steps));
        self.happenings.miss(steps, tick);
    }
}

/// How a measurement is shown; none of a place, a date, a word, and of what stands on a data sheet.
fn shown(name: &str) -> Option<Shown> {
    let number = measurements::number(name)?;
    let info = measurements::info(number);
    if info.is_of_data_sheet() || !info.quantity.is_measured() {
        return None;
    }
    let one = |unit, decimals| vec![Column::new(name, unit, decimals)];
    let columns = match info.quantity {
        Quantity::Position | Quantity::Word | Quantity::Date => return None,
        Quantity::Direction => one("deg", 1),
        Quantity::Speed => one("m/s", 2),
        Quantity::Height => one("m", 2),
        Quantity::Flow => ["north", "east"].map(|toward| Column::new(format!("{name}_{toward}"), "m/s", 3)).into(),
        Quantity::Ratio if number == CHEMICAL => vec![
            Column::new(name, "%", 2).keeping(Keep::Greatest),
            Column::new(format!("{name}_least"), "%", 2).keeping(Keep::Least),
        ],
        Quantity::Ratio => one("%", 1),
        Quantity::Temperature => one("°C", 2),
        Quantity::Salinity => one("", 3),
    };
    Some(Shown { columns, quantity: info.quantity })
}
