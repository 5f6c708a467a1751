//! What a mission records: a table with a row for each moment at which anything is due. It is made of nothing but what came from the
//! vehicle and of what was active, so that it steers nothing, and a journal that is read back gives the same bytes.

pub(crate) mod cells;

use super::Recorder;
use crate::plan::Plan;
use albacore_geometry::{Point, TangentFrame};
use albacore_program::{ActivityId, Input, LIMIT_FRESH_S, Program, calendar, number, senses};
use albacore_trace::{Step, TickRecord};
use albacore_vehicle::{Measurement, Reading, TICK_S, measurements, rate};
use std::sync::Arc;

/// The most that is kept of what a mission records, bytes: some nine days at a row a second.
pub const RECORDED_BYTES_MAX: usize = 64 << 20;
/// Place and depth beside a row are no older than what limits go by.
const PLACE_TICKS: u64 = (LIMIT_FRESH_S / TICK_S) as u64;

/// Gathers the table.
pub(crate) struct Recorded {
    program: Arc<Program>,
    frame: Option<TangentFrame>,
    /// For each measurement of the vehicle the input that takes it.
    inputs: Vec<Option<usize>>,
    /// ... and its latest sample with its tick.
    latest: Vec<Option<(u64, Reading)>>,
    place: Beside,
    clauses: Vec<Clause>,
    columns: Vec<Column>,
    text: String,
    most: usize,
    rows: u64,
    left_out: u64,
    /// Steps are missing: what has become active in them is not known.
    is_blind: bool,
}

/// The measurements that stand beside every row.
struct Beside {
    position: Option<usize>,
    depth: Option<usize>,
    utc: Option<usize>,
}

/// What is recorded together.
struct Clause {
    activity: ActivityId,
    rate: f64,
    /// Places among the columns.
    columns: Vec<usize>,
    /// The first tick after the last on which it was due, active or not: what came before is no news of it.
    since: u64,
}

/// An input, with all that it tells.
struct Column {
    input: usize,
    measurement: Option<usize>,
    /// The first tick after the last row that told it: no sample stands twice.
    told: u64,
    /// How many samples of it stand in the table.
    samples: u64,
}

impl Recorded {
    pub fn new(plan: &Plan, delivered: &[Measurement]) -> Self {
        Recorded::of(Arc::clone(&plan.program), plan.frame(), delivered, RECORDED_BYTES_MAX)
    }

    /// With so many bytes at most.
    fn of(program: Arc<Program>, frame: Option<TangentFrame>, delivered: &[Measurement], most: usize) -> Self {
        let measured = |name: &str| delivered.iter().position(|measurement| measurement.name == name);
        let place = Beside {
            position: measured(senses::POSITION),
            depth: measured(senses::DEPTH),
            utc: measured(measurements::name(measurements::UTC)),
        };
        let mut columns: Vec<Column> = Vec::new();
        let mut labels: Vec<&[String]> = Vec::new();
        let mut clauses = Vec::new();
        for recording in &program.recordings {
            let mut own = Vec::new();
            for (input, fields) in &recording.inputs {
                let input = *input as usize;
                let known = columns.iter().position(|column| column.input == input);
                own.push(known.unwrap_or(columns.len()));
                if known.is_none() {
                    columns.push(Column {
                        input,
                        measurement: measured(&program.inputs[input].name),
                        told: 0,
                        samples: 0,
                    });
                    labels.push(fields);
                }
            }
            clauses.push(Clause { activity: recording.activity, rate: recording.rate, columns: own, since: 0 });
        }
        let mut text = String::new();
        if !clauses.is_empty() {
            text = cells::standing(place.utc.is_some(), frame.is_some());
            for (column, labels) in columns.iter().zip(labels) {
                cells::head(&mut text, &program.inputs[column.input], labels, frame.is_some());
            }
            text.push('\n');
        }
        let taken_by = |measurement: &Measurement| program.inputs.iter().position(|i| i.name == measurement.name);
        Recorded {
            frame,
            inputs: delivered.iter().map(taken_by).collect(),
            latest: vec![None; delivered.len()],
            place,
            clauses,
            columns,
            text,
            most,
            rows: 0,
            left_out: 0,
            is_blind: false,
            program,
        }
    }

    /// Whether anything is recorded.
    pub fn is_wanted(&self) -> bool {
        !self.clauses.is_empty()
    }

    /// The table, as CSV (RFC 4180): units stand in its head, and a cell is empty where nothing was sensed.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// How many rows it has, and how many it would have besides, were it not full.
    pub fn rows(&self) -> (u64, u64) {
        (self.rows, self.left_out)
    }

    /// How many samples of an input it holds.
    pub fn samples(&self, input: &str) -> u64 {
        let of_input =
            |column: &&Column| self.program.inputs.get(column.input).is_some_and(|known| known.name == input);
        self.columns.iter().find(of_input).map_or(0, |column| column.samples)
    }

    fn input(&self, measurement: usize) -> Option<&Input> {
        self.program.inputs.get(*self.inputs.get(measurement)?.as_ref()?)
    }

    /// Takes in what inputs take in.
    fn sense(&mut self, record: &TickRecord) {
        for sample in &record.snapshot.samples {
            let measurement = usize::from(sample.input_measurement());
            let Some(input) = self.input(measurement) else { continue };
            let width = (input.width as usize).min(sample.reading.len());
            if input.admits(&sample.reading[..width]) {
                self.latest[measurement] = Some((record.tick, sample.reading));
            }
        }
    }

    /// The latest sample of a measurement, if it is no older than from a tick on.
    fn since(&self, measurement: Option<usize>, tick: u64) -> Option<(u64, Reading)> {
        self.latest.get(measurement?).copied().flatten().filter(|(then, _)| *then >= tick)
    }

    /// The first tick of which a column tells samples in a row in which clauses are due; `None` where none of them has it.
    fn due_since(&self, column: usize, due: &[usize]) -> Option<u64> {
        let clauses = due.iter().map(|&clause| &self.clauses[clause]).filter(|clause| clause.columns.contains(&column));
        Some(clauses.map(|clause| clause.since).min()?.max(self.columns[column].told))
    }

    /// A row with the columns of some clauses.
    fn row(&mut self, tick: u64, due: &[usize]) {
        if self.left_out > 0 {
            self.left_out += 1;
            return;
        }
        let mut row = cells::seconds(tick);
        if let Some(utc) = self.place.utc {
            // By the vehicle's clock, which goes on between two samples.
            let now = self.since(Some(utc), 0).map(|(then, reading)| reading[0] + (tick - then) as f64 * TICK_S);
            cells::put(&mut row, &now.map(calendar::written_to_tenths).unwrap_or_default());
        }
        let recent = (tick + 1).saturating_sub(PLACE_TICKS);
        let place = self.since(self.place.position, recent).map(|(_, at)| Point::new(at[0], at[1]));
        cells::place(&mut row, place, self.frame);
        // A depth that is recorded has no column besides this one, nor a sigma by which a repeated one is known.
        let recorded = self
            .columns
            .iter()
            .position(|column| column.measurement.is_some() && column.measurement == self.place.depth);
        let from = recorded.and_then(|at| self.due_since(at, due)).unwrap_or(recent);
        let depth = self.since(self.place.depth, from).map(|(_, reading)| number::digits(reading[0]));
        cells::put(&mut row, &depth.unwrap_or_default());
        let mut sampled = Vec::new();
        for (at, column) in self.columns.iter().enumerate() {
            let sample = self.due_since(at, due).and_then(|since| self.since(column.measurement, since));
            let input = &self.program.inputs[column.input];
            sampled.extend(sample.map(|_| at));
            cells::cells(&mut row, input, sample.map(|(_, reading)| reading), self.frame);
        }
        row.push('\n');
        if self.text.len() + row.len() > self.most {
            self.left_out = 1;
        } else {
            self.text.push_str(&row);
            self.rows += 1;
            sampled.into_iter().for_each(|at| self.columns[at].samples += 1);
        }
    }

    /// Whether what a clause belongs to is active. What a mission records it does to the end, through its recovery.
    fn is_active(&self, clause: &Clause, active: &[ActivityId]) -> bool {
        let is_of_mission = clause.activity == self.program.mission.activity;
        active.contains(&clause.activity) || is_of_mission && (self.is_blind || !active.is_empty())
    }
}

impl Recorder for Recorded {
    fn take(&mut self, record: &TickRecord) {
        if !self.is_wanted() || !matches!(record.step, Step::Tick) {
            return;
        }
        self.sense(record);
        let is_due = |clause: &Clause| rate::is_due(clause.rate, record.tick);
        let due: Vec<usize> = (0..self.clauses.len())
            .filter(|&at| is_due(&self.clauses[at]) && self.is_active(&self.clauses[at], &record.active))
            .collect();
        if !due.is_empty() {
            self.row(record.tick, &due);
            for &clause in &due {
                self.clauses[clause].columns.iter().for_each(|&column| self.columns[column].told = record.tick + 1);
            }
        }
        self.clauses.iter_mut().filter(|clause| is_due(clause)).for_each(|clause| clause.since = record.tick + 1);
    }

    fn miss(&mut self, _: u64, _: u64) {
        self.is_blind = true;
    }
}

#[cfg(test)]
mod tests;
