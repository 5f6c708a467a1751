//! What a sensor tells as a scenario lists it: times, and for each a number in the unit of the input.

use super::Wrong;
use crate::recorders::recorded::cells;
use albacore_geometry::math::degrees;
use albacore_lang::{ScenarioClause, ScenarioValue};
use albacore_program::{Shape, number};

/// In what a share is recorded. It can be listed as a number, too.
const SHARE: &str = "%";

/// The samples of an input, each its time in s and its number in SI units.
pub fn samples(
    clause: &ScenarioClause,
    (name, shape): (&str, &Shape),
    (times, values): (&[f64], &[f64]),
    can_be: impl Fn(f64) -> bool,
) -> Result<Vec<(f64, f64)>, Wrong> {
    let (wanted, written) = (cells::unit(shape), unit_written(clause).unwrap_or_default());
    if times.len() != values.len() {
        let message = format!("there are {} of `times`, and {} of `values`", times.len(), values.len());
        return Err(Wrong::with(message, "list a value for each time").at("values"));
    }
    if written != wanted && !(wanted == SHARE && written.is_empty()) {
        let have = if written.is_empty() { "these have no unit".into() } else { format!("these are in `{written}`") };
        let message = format!("`{name}` is in `{wanted}`, and {have}");
        return Err(Wrong::with(message, format!("write them in `{wanted}`")).at("values"));
    }
    // A heading beyond a turn is told as it is written.
    let told = |shape: &Shape, x: f64| match shape {
        Shape::Heading => format!("{} deg", number::digits(degrees(x))),
        shape => number::brief(&[], shape, &[x]),
    };
    if let Some(early) = times.iter().find(|time| **time < 0.0) {
        let message = format!("{early} s is before the run begins");
        return Err(Wrong::with(message, "count times from the beginning of the run, `0 s`").at("times"));
    }
    if let Some(pair) = times.windows(2).find(|pair| pair[1] <= pair[0]) {
        let message = format!("{} s is not later than {} s before it", pair[1], pair[0]);
        return Err(Wrong::with(message, "list each time once, the earliest first, and its value with it").at("times"));
    }
    if let Some(x) = values.iter().find(|x| !can_be(**x)) {
        return Err(
            Wrong::with(format!("no `{name}` is {}", told(shape, *x)), "correct it, or leave it out").at("values")
        );
    }
    Ok(times.iter().copied().zip(values.iter().copied()).collect())
}

/// The unit in which the values are written.
fn unit_written(clause: &ScenarioClause) -> Option<&str> {
    let values = clause.args.iter().find(|arg| arg.name == "values")?;
    match &values.value {
        ScenarioValue::Words(_, Shape::List(element, _)) => Some(cells::unit(element)),
        _ => None,
    }
}
