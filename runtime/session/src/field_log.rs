//! A log from the field, played through a mission: what it would have done, had it sensed that.

use crate::plan::Plan;
use crate::recorders::recorded::cells;
use crate::scenario::played;
use albacore_formats::alog::{self, Variables};
use albacore_formats::series::{self, Columns, Numbers};
use albacore_formats::{Fault, Unreadable};
use albacore_geometry::{Geodetic, Heading};
use albacore_vehicle::measurements::{self, POSITION};
use albacore_vehicle::{Command, Control, Measurement, Quantity, Reading, Snapshot, TICK_S, Vehicle, VehicleError};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A log from the field has so many bytes at most.
pub const LOG_BYTES_MAX: u64 = 1 << 28;
/// Numbers of one sample stand in a log no farther apart than this, s.
const TOGETHER_S: f64 = 0.5;
/// The columns of a place on the globe.
const GLOBE: [&str; 2] = ["latitude (deg)", "longitude (deg)"];

/// What the columns of a table are where nobody says so: what they are called.
type Names = BTreeMap<String, String>;

/// What the variables of MOOS are that every vehicle there has.
const MOOS: [(&str, &str); 8] = [
    (GLOBE[0], "NAV_LAT"),
    (GLOBE[1], "NAV_LONG"),
    ("north (m)", "NAV_Y"),
    ("east (m)", "NAV_X"),
    ("heading (deg)", "NAV_HEADING"),
    ("speed (m/s)", "NAV_SPEED"),
    ("depth (m)", "NAV_DEPTH"),
    ("altitude (m)", "NAV_ALTITUDE"),
];

/// A log of the field: its bytes, and what its columns are called.
pub struct FieldLog<'a> {
    /// Its bytes.
    pub bytes: &'a [u8],
    /// Whether it is an `.alog` of MOOS; else a table, CSV.
    pub is_alog: bool,
    /// For a column of ours, such as `depth (m)`, what the log calls it, where it has another name.
    pub names: Names,
}

/// A vehicle that senses what a log holds, and follows nobody.
pub struct LoggedVehicle {
    measurements: Vec<Measurement>,
    /// What was sensed, by ticks.
    samples: BTreeMap<u64, Vec<(u16, Reading)>>,
    tick: u64,
    /// The tick behind the last sample.
    end: u64,
    is_over: Arc<AtomicBool>,
}

/// Reads which column of a log is which: lines such as `depth (m) = Depth_m`; `#` begins a remark.
pub fn column_names(text: &str) -> Result<Names, Fault> {
    let lines = (1..).zip(text.lines()).filter(|(_, line)| !matches!(line.trim().chars().next(), None | Some('#')));
    let named = lines.map(|(line, text)| match text.split_once(" = ").or_else(|| text.split_once('=')) {
        Some((ours, theirs)) if !ours.trim().is_empty() && !theirs.trim().is_empty() => {
            Ok((ours.trim().to_string(), theirs.trim().to_string()))
        }
        _ => Err(Fault::new(
            format!("line {line} names no column: `{}`", text.trim()),
            "write what it is, and what the log calls it: `depth (m) = Depth_m`",
        )),
    });
    named.collect()
}

impl FieldLog<'_> {
    /// A vehicle that senses all that the log holds of what a vehicle can sense, in the frame of a plan; and what it senses.
    pub fn vehicle(&self, plan: &Plan) -> Result<LoggedVehicle, Fault> {
        let wrong = |unreadable: Unreadable| {
            let mut faults = unreadable.faults.into_iter();
            let first =
                faults.next().unwrap_or_else(|| Fault::new("it cannot be read", "name a table, CSV, or an `.alog`"));
            let message = faults.fold(first.message, |all, fault| format!("{all}; {}", fault.message));
            Fault::new(message, first.help)
        };
        let table = if self.is_alog { Table::of_alog(self).map_err(wrong)? } else { Table::Csv(self.renamed()) };
        let mut samples: BTreeMap<u64, Vec<(u16, Reading)>> = BTreeMap::new();
        let mut sensed = Vec::new();
        for (number, row) in (0..).zip(&measurements::ALL) {
            let readings = match number {
                POSITION => self.position(&table, plan).map_err(wrong)?,
                _ => readings(&table, row.name, row.quantity).map_err(wrong)?,
            };
            if readings.is_empty() {
                continue;
            }
            sensed.push(number);
            for (time, mut reading) in readings {
                if row.quantity == Quantity::Direction {
                    reading[0] = Heading::from_radians(reading[0]).radians();
                }
                samples.entry((time / TICK_S).round() as u64).or_default().push((number, reading));
            }
        }
        let Some(end) = samples.keys().next_back().map(|last| last + 1) else {
            let help = "name its columns as `record` does, such as `depth (m)`, or give `--columns` a file that tells what they are";
            return Err(Fault::new("it holds nothing that a vehicle senses", help));
        };
        let measurements = measurements::delivered(|row| {
            measurements::number(row.name).is_some_and(|number| sensed.contains(&number))
        });
        Ok(LoggedVehicle { measurements, samples, tick: 0, end, is_over: Arc::default() })
    }

    /// The table with its head in our names.
    fn renamed(&self) -> Vec<u8> {
        let text = String::from_utf8_lossy(self.bytes);
        let Some((head, rest)) = text.split_once('\n') else { return self.bytes.to_vec() };
        let ours = |cell: &str| {
            let name = cell.trim().trim_start_matches('\u{feff}').trim_matches('"');
            let named = self.names.iter().find(|(_, theirs)| *theirs == name);
            named.map_or_else(|| cell.trim().to_string(), |(ours, _)| ours.clone())
        };
        let head: Vec<String> = head.trim_end().split(',').map(ours).collect();
        format!("{}\n{rest}", head.join(",")).into_bytes()
    }

    /// Where the vehicle believed to be: on the globe where the log tells that and the mission lies there, else in the plane.
    fn position(&self, table: &Table, plan: &Plan) -> Result<Vec<(f64, Reading)>, Unreadable> {
        if let (Some(frame), true) = (plan.frame(), table.has(&GLOBE)) {
            let columns = GLOBE.map(|head| series::Column { head: head.into(), otherwise: None, is_standing: false });
            let is_place = |n: Numbers| n[0].abs() <= 90.0 && n[1].abs() <= 360.0;
            let places = table.rows("position", &columns, is_place)?;
            let in_plane = |(time, [latitude, longitude, ..]): (f64, Numbers)| {
                let place = frame.to_point(Geodetic::from_degrees(latitude, longitude));
                (time, [place.north, place.east, 0.0, 0.0])
            };
            return Ok(places.into_iter().map(in_plane).collect());
        }
        readings(table, measurements::name(POSITION), Quantity::Position)
    }
}

/// A log as columns.
enum Table {
    Csv(Vec<u8>),
    Alog(Variables),
}

impl Table {
    fn of_alog(log: &FieldLog) -> Result<Self, Unreadable> {
        let mut variables = alog::read(log.bytes)?;
        let mut names: Names = MOOS.iter().map(|(ours, theirs)| ((*ours).into(), (*theirs).into())).collect();
        names.extend(log.names.clone());
        let columns = names.into_iter().filter_map(|(ours, theirs)| Some((ours, variables.get(&theirs)?.clone())));
        let columns: Variables = columns.collect();
        variables.extend(columns);
        Ok(Table::Alog(variables))
    }

    /// Whether it has all of these columns.
    fn has(&self, heads: &[&str]) -> bool {
        match self {
            Table::Csv(bytes) => {
                let head = bytes.split(|byte| *byte == b'\n').next().unwrap_or_default();
                let head = String::from_utf8_lossy(head);
                let cells: Vec<&str> = head.trim_end().split(',').map(|cell| cell.trim().trim_matches('"')).collect();
                heads.iter().all(|head| cells.contains(head))
            }
            Table::Alog(variables) => heads.iter().all(|head| variables.contains_key(*head)),
        }
    }

    /// The samples of some columns, each its time and its numbers in their units.
    fn rows(
        &self,
        name: &str,
        columns: &[series::Column],
        can_be: impl Fn(Numbers) -> bool,
    ) -> Result<Vec<(f64, Numbers)>, Unreadable> {
        match self {
            Table::Csv(bytes) => series::read(bytes, Columns { time: cells::TIME, name, numbers: columns }, can_be),
            Table::Alog(variables) => Ok(together(variables, columns, can_be)),
        }
    }
}

/// The samples of a measurement, in SI units; none where the log lacks a column of it.
fn readings(table: &Table, name: &str, quantity: Quantity) -> Result<Vec<(f64, Reading)>, Unreadable> {
    let Some(parts) = played::parts(name) else { return Ok(Vec::new()) };
    let (columns, shapes): (Vec<_>, Vec<_>) = parts.iter().flat_map(|part| played::columns(name, part)).unzip();
    let needed: Vec<&str> = columns.iter().filter(|c| c.otherwise.is_none()).map(|c| c.head.as_str()).collect();
    if !quantity.is_measured() || !table.has(&needed) {
        return Ok(Vec::new());
    }
    let in_si = |mut numbers: Numbers| {
        numbers.iter_mut().zip(&shapes).for_each(|(number, shape)| *number = cells::in_si(*number, shape));
        numbers
    };
    let can_be = |numbers: Numbers| numbers.iter().all(|x| x.is_finite()) && quantity.can_be(in_si(numbers));
    let rows = table.rows(name, &columns, can_be)?;
    Ok(rows.into_iter().map(|(time, numbers)| (time, in_si(numbers))).collect())
}

/// Numbers of variables that stand together: one for each number of the first, with those of the others that came nearest to it. What
/// cannot be is left out, as a vehicle's sensor leaves it out.
fn together(
    variables: &Variables,
    columns: &[series::Column],
    can_be: impl Fn(Numbers) -> bool,
) -> Vec<(f64, Numbers)> {
    let series: Vec<Option<&Vec<(f64, f64)>>> = columns.iter().map(|column| variables.get(&column.head)).collect();
    let Some(Some(first)) = series.first() else { return Vec::new() };
    let nearest = |series: &[(f64, f64)], time: f64| {
        let after = series.partition_point(|(at, _)| *at < time);
        let around = series.get(after.saturating_sub(1)..(after + 1).min(series.len())).unwrap_or(&[]);
        let near = around.iter().min_by(|a, b| (a.0 - time).abs().total_cmp(&(b.0 - time).abs()));
        near.filter(|(at, _)| (at - time).abs() <= TOGETHER_S).map(|(_, value)| *value)
    };
    let sample = |(time, _): &(f64, f64)| {
        let mut numbers = Numbers::default();
        for ((column, series), number) in columns.iter().zip(&series).zip(&mut numbers) {
            let value = series.and_then(|series| nearest(series, *time));
            *number = value.or(column.otherwise.filter(|_| series.is_none()))?;
        }
        can_be(numbers).then_some((*time, numbers))
    };
    first.iter().filter_map(sample).collect()
}

impl LoggedVehicle {
    /// Raised when no tick of the log is left.
    pub fn is_over(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.is_over)
    }

    /// What it senses.
    pub fn senses(&self) -> impl Iterator<Item = &str> {
        self.measurements.iter().map(|measurement| measurement.name.as_str()).filter(|name| !name.is_empty())
    }
}

impl Vehicle for LoggedVehicle {
    fn measurements(&self) -> &[Measurement] {
        &self.measurements
    }

    fn ready(&mut self) -> Result<bool, VehicleError> {
        let is_over = self.tick >= self.end;
        self.is_over.store(is_over, Ordering::Relaxed);
        Ok(!is_over)
    }

    fn sense(&mut self, snapshot: &mut Snapshot) -> Result<(), VehicleError> {
        for (measurement, reading) in self.samples.get(&self.tick).into_iter().flatten() {
            snapshot.push(*measurement, reading);
        }
        snapshot.control = Control::InControl;
        self.tick += 1;
        Ok(())
    }

    fn take_over(&mut self) -> Result<(), VehicleError> {
        Ok(())
    }

    fn command(&mut self, _: &Command) -> Result<(), VehicleError> {
        Ok(())
    }

    fn give_back(&mut self) -> Result<(), VehicleError> {
        Ok(())
    }

    fn release(&mut self) -> Result<(), VehicleError> {
        Ok(())
    }
}
