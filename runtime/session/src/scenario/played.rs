//! What a sensor tells as it was recorded, columns of a file such as `record` writes, or as the scenario lists it.

use super::clause::Clause;
use super::{Understood, Wrong, listed};
use crate::files::{Files, load_text};
use crate::recorders::recorded::{RECORDED_BYTES_MAX, cells};
use albacore_formats::series::{self, Column, Columns, Numbers};
use albacore_geometry::Heading;
use albacore_lang::Script;
use albacore_lang::source::Source;
use albacore_program::Shape;
use albacore_sim::{Played, PlayedSample};
use albacore_vehicle::measurements::{self, UTC, WATER_DEPTH};
use albacore_vehicle::{Quantity, Reading, TICK_S};
use albacore_wording::nearest;
use serde::Deserialize;
use std::sync::LazyLock;

/// `played(…)`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlayedClause {
    name: String,
    file: Option<String>,
    times: Vec<f64>,
    values: Vec<f64>,
}

/// The inputs that every script knows, and so their units.
static INPUTS: LazyLock<Script> = LazyLock::new(|| load_text(Source { name: "".into(), text: "".into() }));

/// A part of what an input tells: its value, or a further field.
pub struct Part {
    /// Its label; the value has none.
    pub label: Option<&'static str>,
    /// Its shape.
    pub shape: Shape,
}

/// The parts of the input of a name, in the order in which a sample has their numbers.
pub fn parts(name: &str) -> Option<Vec<Part>> {
    let (value, fields) = INPUTS.input_shapes(name)?;
    let fields = fields.into_iter().map(|(label, shape)| Part { label: Some(label), shape });
    Some(std::iter::once(Part { label: None, shape: value }).chain(fields).collect())
}

/// Reads what is played.
pub fn played(understood: &mut Understood, c: Clause, files: &Files) -> Result<(), Wrong> {
    let PlayedClause { name, file, times, values } = c.read()?;
    let (measurement, parts) = measured(&name).ok_or_else(|| unplayable(&name))?;
    let quantity = measurements::info(measurement).quantity;
    let readings = match (file, parts.as_slice()) {
        (Some(_), _) if !(times.is_empty() && values.is_empty()) => {
            let message = format!("`{name}` is played from a file and from a list");
            return Err(Wrong::with(message, "leave out `file`, or `times` and `values`").at("file"));
        }
        (Some(path), parts) => of_file(understood, path, files, (&name, parts), quantity)?,
        (None, _) if times.is_empty() && values.is_empty() => {
            let help = "write `file: \"dive.csv\"`, or list them: `times: [0 s, 30 s], values: […]`";
            return Err(Wrong::with(format!("nothing says what `{name}` tells"), help));
        }
        (None, [part]) if part.shape.words() == 1 => {
            let can_be = |x| quantity.can_be([x, 0.0, 0.0, 0.0]);
            let samples = listed::samples(c.clause, (&name, &part.shape), (&times, &values), can_be)?;
            samples.into_iter().map(|(time, x)| (time, [x, 0.0, 0.0, 0.0])).collect()
        }
        (None, _) => {
            let message = format!("a sample of `{name}` is more than one number, and none is listed");
            return Err(Wrong::with(message, "play it from a file: `file: \"dive.csv\"`").at("values"));
        }
    };
    let sample = |(time, mut reading): (f64, Reading)| {
        if quantity == Quantity::Direction {
            reading[0] = Heading::from_radians(reading[0]).radians();
        }
        PlayedSample { tick: (time / TICK_S).round() as u64, reading }
    };
    let played =
        Played::new(measurement, readings.into_iter().map(sample).collect()).ok_or_else(|| unplayable(&name))?;
    understood.world.instruments.played.push(played);
    Ok(())
}

/// The samples of a file, each its time in s and its numbers in SI units.
fn of_file(
    understood: &mut Understood,
    path: String,
    files: &Files,
    (name, parts): (&str, &[Part]),
    quantity: Quantity,
) -> Result<Vec<(f64, Reading)>, Wrong> {
    let bytes = files.data(&path, RECORDED_BYTES_MAX as u64)?;
    let (numbers, shapes): (Vec<Column>, Vec<&Shape>) = parts.iter().flat_map(|part| columns(name, part)).unzip();
    let in_si = |mut numbers: Numbers| {
        numbers.iter_mut().zip(&shapes).for_each(|(number, shape)| *number = cells::in_si(*number, shape));
        numbers
    };
    let can_be = |numbers: Numbers| numbers.iter().all(|x| x.is_finite()) && quantity.can_be(in_si(numbers));
    let columns = Columns { time: cells::TIME, name, numbers: &numbers };
    let rows = series::read(&bytes, columns, can_be).map_err(|wrong| Wrong::in_file(&path, wrong.faults))?;
    understood.note_file(path, &bytes);
    Ok(rows.into_iter().map(|(time, numbers)| (time, in_si(numbers))).collect())
}

/// The measurement of a name and its parts, if it can be played.
fn measured(name: &str) -> Option<(u16, Vec<Part>)> {
    let (number, _) =
        (0..).zip(&measurements::ALL).find(|(number, row)| row.name == name && Played::can_be(*number))?;
    Some((number, parts(name)?))
}

/// The columns of a part of an input, each with what its numbers are. A table may lack those of a field, such as a sigma: it is 0 then, as what is
/// exact has it.
pub fn columns<'a>(name: &str, part: &'a Part) -> Vec<(Column, &'a Shape)> {
    let full = part.label.map_or_else(|| name.to_string(), |label| cells::field(name, label));
    let column = |head| Column {
        head,
        otherwise: part.label.map(|_| 0.0),
        is_standing: part.label.is_none() && cells::is_beside(name),
    };
    cells::titles(&full, &part.shape).into_iter().map(|head| (column(head), &part.shape)).collect()
}

/// Why a name cannot be played, and what can.
fn unplayable(name: &str) -> Wrong {
    let known = (0..).zip(&measurements::ALL).filter(|(number, _)| Played::can_be(*number));
    let known: Vec<&str> = known.map(|(_, row)| row.name).collect();
    let can = format!("what can be played is {}", known.join(", "));
    let is = |measurement: u16| name == measurements::name(measurement);
    if is(WATER_DEPTH) {
        return Wrong::with("`water_depth` is the sum of `depth` and `altitude`", "play these");
    }
    if is(UTC) {
        let help = "the clause `date` says on which date the run begins";
        return Wrong::with("`utc` is told by a clock, and cannot be played", help);
    }
    if parts(name).is_some() {
        return Wrong::with(format!("`{name}` is no number of a sensor, and cannot be played"), can);
    }
    let help = nearest(name, known.iter().copied()).map_or(can, |near| format!("did you mean `{near}`?"));
    Wrong::with(format!("no simulated vehicle tells an input `{name}`"), help)
}
