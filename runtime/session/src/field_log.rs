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
/// So many heads of a log are named in a message.
const HEADS_TOLD: usize = 12;
/// How exact a place is.
const SIGMA: &str = "position.sigma (m)";
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
    let mut names = Names::new();
    for (line, text) in lines {
        let (ours, theirs) = match text.split_once(" = ").or_else(|| text.split_once('=')) {
            Some((ours, theirs)) if !ours.trim().is_empty() && !theirs.trim().is_empty() => {
                (ours.trim(), theirs.trim())
            }
            _ => {
                let help = "write what it is, and what the log calls it: `depth (m) = Depth_m`";
                return Err(Fault::new(format!("line {line} names no column: `{}`", text.trim()), help));
            }
        };
        if names.insert(ours.to_string(), theirs.to_string()).is_some() {
            return Err(Fault::new(format!("line {line} names `{ours}` once more"), "leave one of the two out"));
        }
    }
    Ok(names)
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
        let table = match self.is_alog {
            true => Table::of_alog(self).map_err(wrong)?,
            false => Table::Csv(self.bytes, self.names.clone()),
        };
        self.check_names(&table)?;
        let mut samples: BTreeMap<u64, Vec<(u16, Reading)>> = BTreeMap::new();
        let mut sensed: Vec<(u16, Vec<(f64, Reading)>)> = Vec::new();
        for (number, row) in (0..).zip(&measurements::ALL) {
            let readings = match number {
                POSITION => self.position(&table, plan).map_err(wrong)?,
                _ => readings(&table, row.name, row.quantity).map_err(wrong)?,
            };
            if !readings.is_empty() {
                sensed.push((number, readings));
            }
        }
        // The run begins with the first of them, whatever the log's own clock says then.
        let times = sensed.iter().flat_map(|(_, readings)| readings).map(|(time, _)| *time);
        let first = times.fold(f64::INFINITY, f64::min);
        for (number, readings) in &sensed {
            for (time, mut reading) in readings.iter().copied() {
                if measurements::info(*number).quantity == Quantity::Direction {
                    reading[0] = Heading::from_radians(reading[0]).radians();
                }
                samples.entry(((time - first) / TICK_S).round() as u64).or_default().push((*number, reading));
            }
        }
        let Some(end) = samples.keys().next_back().map(|last| last + 1) else {
            let help = "name its columns as `record` does, such as `depth (m)`, or give `--columns` a file that tells what they are";
            return Err(Fault::new("it holds nothing that a vehicle senses", help));
        };
        let measurements = measurements::delivered(|row| {
            measurements::number(row.name).is_some_and(|number| sensed.iter().any(|(known, _)| *known == number))
        });
        Ok(LoggedVehicle { measurements, samples, tick: 0, end, is_over: Arc::default() })
    }

    /// Looks for names that lead nowhere: a column that is none of ours, or that the log does not have.
    fn check_names(&self, table: &Table) -> Result<(), Fault> {
        let mut ours: Vec<String> =
            GLOBE.iter().map(|head| (*head).to_string()).chain([cells::TIME.to_string()]).collect();
        for row in measurements::ALL.iter().filter(|row| row.quantity.is_measured()) {
            let parts = played::parts(row.name).unwrap_or_default();
            let columns = parts.iter().flat_map(|part| played::columns(row.name, part)).map(|(column, _)| column.head);
            ours.extend(columns);
        }
        for (name, theirs) in &self.names {
            if !ours.contains(name) {
                let near = albacore_wording::nearest(name, ours.iter().map(String::as_str));
                let help = near
                    .map_or_else(|| format!("there is {}", ours.join(", ")), |near| format!("did you mean `{near}`?"));
                return Err(Fault::new(format!("`{name}` is no column that a vehicle senses"), help));
            }
            if !table.heads().contains(theirs) {
                let help =
                    format!("it has {}", table.heads().into_iter().take(HEADS_TOLD).collect::<Vec<_>>().join(", "));
                return Err(Fault::new(format!("it has no `{theirs}`, which is to be `{name}`"), help));
            }
        }
        Ok(())
    }

    /// Where the vehicle believed to be: on the globe where the log tells that and the mission lies there, else in the plane.
    fn position(&self, table: &Table, plan: &Plan) -> Result<Vec<(f64, Reading)>, Unreadable> {
        if let (Some(frame), true) = (plan.frame(), table.has(&GLOBE)) {
            let column = |head: &str, otherwise| series::Column { head: head.into(), otherwise, is_standing: false };
            let columns = [column(GLOBE[0], None), column(GLOBE[1], None), column(SIGMA, Some(0.0))];
            let is_place = |n: Numbers| n[0].abs() <= 90.0 && n[1].abs() <= 360.0 && n[2] >= 0.0;
            let places = table.rows("position", &columns, is_place)?;
            let in_plane = |(time, [latitude, longitude, sigma, _]): (f64, Numbers)| {
                let place = frame.to_point(Geodetic::from_degrees(latitude, longitude));
                (time, [place.north, place.east, sigma, 0.0])
            };
            return Ok(places.into_iter().map(in_plane).collect());
        }
        readings(table, measurements::name(POSITION), Quantity::Position)
    }
}

/// A log as columns.
enum Table<'a> {
    /// Its bytes, and what it calls a column of ours.
    Csv(&'a [u8], Names),
    Alog(Variables),
}

impl Table<'_> {
    fn of_alog(log: &FieldLog) -> Result<Self, Unreadable> {
        let mut variables = alog::read(log.bytes)?;
        let mut names: Names = MOOS.iter().map(|(ours, theirs)| ((*ours).into(), (*theirs).into())).collect();
        names.extend(log.names.clone());
        let columns = names.into_iter().filter_map(|(ours, theirs)| Some((ours, variables.get(&theirs)?.clone())));
        let columns: Variables = columns.collect();
        variables.extend(columns);
        Ok(Table::Alog(variables))
    }

    /// What its columns are called.
    fn heads(&self) -> Vec<String> {
        match self {
            Table::Csv(bytes, _) => {
                let head = bytes.split(|byte| *byte == b'\n').find(|line| !line.trim_ascii().is_empty());
                let head = String::from_utf8_lossy(head.unwrap_or_default());
                let cells = head.trim_start_matches('\u{feff}').trim_end().split(',');
                cells.map(|cell| cell.trim().trim_matches('"').to_string()).collect()
            }
            Table::Alog(variables) => variables.keys().cloned().collect(),
        }
    }

    /// What it calls a column of ours.
    fn head(&self, ours: &str) -> String {
        match self {
            Table::Csv(_, names) => names.get(ours).cloned().unwrap_or_else(|| ours.to_string()),
            Table::Alog(_) => ours.to_string(),
        }
    }

    /// Whether it has all of these columns.
    fn has(&self, ours: &[&str]) -> bool {
        let heads = self.heads();
        ours.iter().all(|head| heads.contains(&self.head(head)))
    }

    /// The samples of some columns, each its time and its numbers in their units.
    fn rows(
        &self,
        name: &str,
        columns: &[series::Column],
        can_be: impl Fn(Numbers) -> bool,
    ) -> Result<Vec<(f64, Numbers)>, Unreadable> {
        match self {
            Table::Csv(bytes, _) => {
                let theirs =
                    |column: &series::Column| series::Column { head: self.head(&column.head), ..column.clone() };
                let numbers: Vec<series::Column> = columns.iter().map(theirs).collect();
                series::read(bytes, Columns { time: &self.head(cells::TIME), name, numbers: &numbers }, can_be)
            }
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
