//! A table as CSV (RFC 4180), with a row for each tick. Units stand in its head, as in `recorded.csv`; a cell is empty where nothing came.

use crate::exported::{Column, Exported, Reported, Role, Values};
use crate::text;
use albacore_program::calendar;

/// The column of what was reported.
const REPORTED: &str = "reported";

/// The file.
pub fn make(run: &Exported) -> Vec<u8> {
    let mut out = String::from("time (s)");
    for column in &run.columns {
        out.push(',');
        out.push_str(&cell(&column.head()));
    }
    out.push(',');
    out.push_str(REPORTED);
    out.push('\n');
    run.each_moment(|moment| {
        let Some(row) = moment.row else { return };
        out.push_str(&text::seconds(moment.tick));
        for column in &run.columns {
            out.push(',');
            out.push_str(&value(column, row));
        }
        out.push(',');
        out.push_str(&cell(&moment.reports.iter().map(told).collect::<Vec<_>>().join(" | ")));
        out.push('\n');
    });
    out.into_bytes()
}

fn value(column: &Column, row: usize) -> String {
    let number = column.values.number(row);
    match (&column.values, column.role) {
        (Values::Texts(..), _) => column.values.text(row).map(cell).unwrap_or_default(),
        (Values::Dates(_), _) => number.map(calendar::written_to_tenths).unwrap_or_default(),
        (Values::Numbers(_), Some(Role::Latitude | Role::Longitude)) => number.map(text::degrees).unwrap_or_default(),
        (Values::Numbers(_), _) => number.and_then(text::number).unwrap_or_default(),
    }
}

/// A report, as a person reads it.
pub(crate) fn told(report: &Reported) -> String {
    let place = report.place.map(|place| match place.is_on_globe() {
        true => format!("({}, {})", text::degrees(place.latitude), text::degrees(place.longitude)),
        false => {
            let metres = |x: f64| text::number(x).unwrap_or_default();
            format!("({} m, {} m)", metres(place.north), metres(place.east))
        }
    });
    let told = Some(report.told.clone()).filter(|told| !told.is_empty());
    let parts: Vec<String> = place.into_iter().chain(told).collect();
    if parts.is_empty() { report.name.clone() } else { format!("{}: {}", report.name, parts.join(", ")) }
}

/// A text as a cell.
fn cell(text: &str) -> String {
    let text = text::no_formula(text);
    if text.contains([',', '"', '\n', '\r']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text }
}
