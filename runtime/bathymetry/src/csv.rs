//! Surveys as text. A head line tells where the corners are, then come the rows:
//!
//! ```text
//! # lon 140.0..144.9 n=60 lat 10.0..14.0 n=49 metres
//! -1989,-2890,-2576,…
//! ```
//!
//! The head begins with `#`. It gives two axes, `lon` and `lat` in degrees or `east` and `north` in metres, each as
//! `FIRST..LAST n=COUNT`, and the word `metres`. Rows run from south to north, cells from west to east, separated by commas.
//! They are elevations, negative below the surface; with the word `depth` in the head they are depths, positive down. With
//! `nodata=VALUE` cells of that value are known to hold nothing. Other words of the head are remarks, as are further lines
//! that begin with `#`; blank lines count for nothing.

use crate::axis::Axis;
use crate::fault::{Fault, Faults};
use crate::survey::{Kind, Survey, check_size, is_on_earth, on_the_globe};

/// What a head line looks like, for who has none.
const HEAD: &str = "begin it with a line such as `# lon 140.0..144.9 n=60 lat 10.0..14.0 n=49 metres`, or with \
     `# east 0..500 n=51 north 0..300 n=31 metres`";
/// The mend of cells that hold nothing.
const FILL: &str = "fill it, such as with `gdal_fillnodata`, or cut out a part without such cells";
/// Units of depth that are not read.
const OTHER_UNITS: [&str; 12] = [
    "feet",
    "foot",
    "ft",
    "fathom",
    "fathoms",
    "fm",
    "km",
    "kilometres",
    "kilometers",
    "cm",
    "centimetres",
    "decimetres",
];

/// What a head line says.
#[derive(Default)]
struct Head<'a> {
    north: Option<Side<'a>>,
    east: Option<Side<'a>>,
    in_metres: bool,
    is_depth: bool,
    nodata: Option<f64>,
}

/// One axis of a head line, as it is written.
struct Side<'a> {
    name: &'a str,
    first: f64,
    last: f64,
    count: u64,
}

/// Reads a text.
pub(crate) fn read(bytes: &[u8], faults: &mut Faults) -> Option<Survey> {
    let text = match std::str::from_utf8(bytes) {
        Ok(text) => text.trim_start_matches('\u{feff}'),
        Err(error) => {
            let at = error.valid_up_to();
            let line = 1 + bytes[..at].iter().filter(|byte| **byte == b'\n').count();
            faults.add(
                format!("byte {at}, on line {line}, is no text in UTF-8: neither CSV nor NetCDF"),
                "give a CSV file, or a NetCDF classic file that begins with `CDF`",
            );
            return None;
        }
    };
    let mut lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    let Some((_, first)) = lines.next() else {
        faults.add("the file is empty", HEAD);
        return None;
    };
    let Some(words) = first.trim().strip_prefix('#') else {
        faults.add("line 1 is no head line: nothing tells where the cells lie", HEAD);
        return None;
    };
    let head = Head::read(words, faults)?;
    let (kind, north, east) = head.axes(faults)?;
    let cells = faults.take(check_size(u64::from(north.count), u64::from(east.count)))?;
    let rows = lines.filter(|(_, line)| !line.trim_start().starts_with('#'));
    // Each cell takes two bytes at least.
    let mut depths = Vec::with_capacity((cells as usize).min(bytes.len() / 2 + 1));
    let mut count = 0;
    for (i, row) in rows {
        count += 1;
        if count <= north.count {
            head.row(i + 1, row, east.count, &mut depths, faults);
        }
    }
    if count != north.count {
        let message = format!("there are {count} rows, and the head says n={}", north.count);
        faults.add(message, "give a row for each place from south to north, or correct the head's `n=`");
    }
    Some(Survey { kind, north, east, depths })
}

impl<'a> Head<'a> {
    fn read(words: &'a str, faults: &mut Faults) -> Option<Head<'a>> {
        let mut head = Head::default();
        let before = faults.count();
        let mut words = words.split([' ', '\t', ',', ';']).filter(|word| !word.is_empty());
        while let Some(word) = words.next() {
            match word.to_ascii_lowercase().as_str() {
                name @ ("lat" | "latitude" | "north" | "lon" | "longitude" | "east") => {
                    let side = faults.take(Side::read(word, words.next(), words.next()));
                    let of_north = name.starts_with("lat") || name == "north";
                    let place = if of_north { &mut head.north } else { &mut head.east };
                    if place.is_some() {
                        faults.add(format!("line 1 gives two axes such as `{word}`"), "leave one of them out");
                    }
                    *place = side;
                }
                "metres" | "meters" | "metre" | "meter" | "m" => head.in_metres = true,
                "depth" | "depths" => head.is_depth = true,
                "north->south" => {
                    faults
                        .add("line 1 says `north->south`: rows run from south to north", "turn them round with `tac`");
                }
                "east->west" => {
                    faults.add("line 1 says `east->west`: cells run from west to east", "turn each row round");
                }
                other if OTHER_UNITS.contains(&other) => {
                    faults.add(format!("line 1 says `{word}`: depths are read in metres"), "convert them to metres");
                }
                other => {
                    if let Some(value) = other.strip_prefix("nodata=") {
                        match value.parse() {
                            Ok(value) => head.nodata = Some(value),
                            Err(_) => faults.add(
                                format!("line 1 says `{word}`, which is no number"),
                                "write it such as `nodata=-9999`",
                            ),
                        }
                    }
                }
            }
        }
        if !head.in_metres && faults.count() == before {
            faults.add(
                "line 1 does not say in which unit the depths are",
                "convert them to metres and add the word `metres`",
            );
        }
        (faults.count() == before).then_some(head)
    }

    fn axes(&self, faults: &mut Faults) -> Option<(Kind, Axis, Axis)> {
        let (Some(north), Some(east)) = (&self.north, &self.east) else {
            let missing = if self.north.is_none() { "`lat` or `north`" } else { "`lon` or `east`" };
            faults.add(format!("line 1 gives no {missing}"), HEAD);
            return None;
        };
        let between = |side: &Side| Axis::between(side.name, side.first, side.last, side.count);
        let (rows, columns) = (faults.take(between(north)), faults.take(between(east)));
        let (rows, columns) = (rows?, columns?);
        let is_geodetic = |side: &Side| !matches!(side.name.to_ascii_lowercase().as_str(), "north" | "east");
        match (is_geodetic(north), is_geodetic(east)) {
            (true, true) => on_the_globe(rows, columns, faults).map(|(rows, columns)| (Kind::Geodetic, rows, columns)),
            (false, false) => Some((Kind::Local, rows, columns)),
            _ => {
                let message = format!("line 1 mixes degrees and metres: `{}` and `{}`", north.name, east.name);
                faults.add(message, "give `lat` and `lon` in degrees, or `north` and `east` in metres");
                None
            }
        }
    }

    /// Reads a row of the file; each cell's faults are told.
    fn row(&self, line: usize, row: &str, columns: u32, depths: &mut Vec<f64>, faults: &mut Faults) {
        let cells = row.split(',').count();
        if cells as u64 != u64::from(columns) {
            let message = format!("line {line} has {cells} cells, and the head says n={columns}");
            return faults.add(message, "give a cell for each place from west to east, separated by commas");
        }
        for (i, cell) in row.split(',').enumerate() {
            let cell = cell.trim();
            let place = || format!("line {line}, cell {}", i + 1);
            match cell.parse::<f64>() {
                Ok(value) if value.is_finite() && Some(value) != self.nodata => {
                    let depth = if self.is_depth { value } else { 0.0 - value };
                    if is_on_earth(depth) {
                        depths.push(depth);
                    } else {
                        let message = format!("{}: {cell} m is neither water nor land on earth", place());
                        faults.add(
                            message,
                            "if it stands for no data, fill the cell; if the unit is not metres, convert it",
                        );
                    }
                }
                Ok(_) => faults.add(format!("{}: `{cell}` is no data", place()), FILL),
                Err(_) if cell.is_empty() => faults.add(format!("{} is empty", place()), FILL),
                Err(_) => faults.add(
                    format!("{}: `{}` is no number", place(), shortened(cell)),
                    "write metres with a point, such as `-12.5`; cells are separated by commas",
                ),
            }
        }
    }
}

impl<'a> Side<'a> {
    fn read(name: &'a str, range: Option<&str>, count: Option<&str>) -> Result<Side<'a>, Fault> {
        let ends = range.and_then(|range| {
            let (first, last) = range.split_once("..")?;
            Some((first.parse::<f64>().ok()?, last.parse::<f64>().ok()?))
        });
        let count = count.and_then(|count| count.strip_prefix("n=")?.parse::<u64>().ok());
        match (ends, count) {
            (Some((first, last)), Some(count)) => Ok(Side { name, first, last, count }),
            _ => {
                let message = format!("line 1: `{name}` is not followed by its ends and its count");
                Err(Fault::new(message, format!("write `{name} FIRST..LAST n=COUNT`, such as `{name} 0..49.5 n=100`")))
            }
        }
    }
}

/// The beginning of a text, for a message.
fn shortened(text: &str) -> String {
    const LONGEST: usize = 20;
    if text.chars().count() <= LONGEST { text.to_string() } else { text.chars().take(LONGEST).chain(['…']).collect() }
}
