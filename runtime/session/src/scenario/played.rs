//! What a sensor tells as it was recorded: a column of a file such as `record` writes.

use super::{Understood, Wrong};
use crate::files::{Files, load_text};
use crate::recorders::recorded::{RECORDED_BYTES_MAX, cells};
use albacore_formats::series::{self, Columns};
use albacore_geometry::Heading;
use albacore_lang::Script;
use albacore_lang::source::Source;
use albacore_program::Shape;
use albacore_sim::{Played, PlayedSample};
use albacore_vehicle::measurements::{self, BEACON, WATER_DEPTH};
use albacore_vehicle::{Quantity, TICK_S};
use albacore_wording::nearest;
use serde::Deserialize;
use std::sync::LazyLock;

/// `played(…)`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlayedClause {
    name: String,
    file: String,
}

/// The inputs that every script knows, and so their units.
static INPUTS: LazyLock<Script> = LazyLock::new(|| load_text(Source { name: "".into(), text: "".into() }));

/// The shape of the input of a name.
pub fn shape(name: &str) -> Option<Shape> {
    INPUTS.input_shape(name)
}

/// Reads what is played.
pub fn played(understood: &mut Understood, clause: PlayedClause, files: &Files) -> Result<(), Wrong> {
    let PlayedClause { name, file: path } = clause;
    let (number, shape) = measured(&name).ok_or_else(|| unplayable(&name))?;
    let bytes = files.data(&path, RECORDED_BYTES_MAX as u64)?;
    let quantity = measurements::info(number).quantity;
    let can_be = |x: f64| quantity.can_be([cells::in_si(x, &shape), 0.0, 0.0, 0.0]);
    let columns = Columns { time: cells::TIME, number: &cells::title(&name, &shape) };
    let rows = series::read(&bytes, columns, can_be).map_err(|wrong| Wrong::in_file(&path, wrong.faults))?;
    let sample = |(time, x): (f64, f64)| {
        let x = cells::in_si(x, &shape);
        let number = if quantity == Quantity::Direction { Heading::from_radians(x).radians() } else { x };
        PlayedSample { tick: (time / TICK_S).round() as u64, number }
    };
    let played = Played::new(number, rows.into_iter().map(sample).collect()).ok_or_else(|| unplayable(&name))?;
    understood.world.instruments.played.push(played);
    understood.note_file(path, &bytes);
    Ok(())
}

/// The measurement of a name and its shape, if it can be played.
fn measured(name: &str) -> Option<(u16, Shape)> {
    let (number, _) =
        (0..).zip(&measurements::ALL).find(|(number, row)| row.name == name && Played::can_be(*number))?;
    Some((number, shape(name)?))
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
    if is(BEACON) {
        let help = "the clause `beacon` lets it go along `points` at `times`";
        return Wrong::with("`beacon` is no single number, and cannot be played", help);
    }
    if shape(name).is_some() {
        return Wrong::with(format!("`{name}` is no single number of a sensor, and cannot be played"), can);
    }
    let help = nearest(name, known.iter().copied()).map_or(can, |near| format!("did you mean `{near}`?"));
    Wrong::with(format!("there is no input `{name}`"), help)
}
