//! Surveys as text. A head line tells where the corners are, then come the rows:
//!
//! ```text
//! # lon 140.0..144.9 n=60 lat 10.0..14.0 n=49 metres
//! -1989,-2890,-2576,…
//! ```
//!
//! The head begins with `#`. It gives two axes, `lon` and `lat` in degrees or `east` and `north` in metres, each as
//! `FIRST..LAST n=COUNT`, and the word `metres`. Rows run from south to north, cells from west to east, separated by commas.
//! They are elevations, negative below the surface; where the head says `depth in metres` they are depths, positive down. With
//! `nodata=VALUE` cells of that value are known to hold nothing, and with `nodata=none` all cells to hold depths. Other words of
//! the head are remarks, as are further lines that begin with `#`; blank lines count for nothing.

use crate::fault::{Fault, Faults, counted, shortened};
use crate::survey::axis::Axis;
use crate::survey::grid::{Kind, Survey, check_size, check_water, going_on, is_on_earth, on_a_plane, on_the_globe};
use crate::survey::marks;

/// What a head line looks like, for who has none.
const HEAD: &str = "begin it with a line such as `# lon 140.0..144.9 n=60 lat 10.0..14.0 n=49 metres`, or with \
     `# east 0..500 n=51 north 0..300 n=31 metres`";
/// The mend of cells that hold nothing.
const FILL: &str = "fill it, such as with `gdal_fillnodata`, or cut out a part without such cells";
/// The unit that is read.
const METRES: [&str; 5] = ["metres", "meters", "metre", "meter", "m"];
/// Units of length that are not read, in one and in many; those of metres come with what stands before these.
const OTHER_UNITS: [&str; 20] = [
    "feet", "foot", "ft", "fathom", "fathoms", "fm", "yard", "yards", "yd", "yds", "inch", "inches", "mile", "miles",
    "nmi", "mm", "cm", "dm", "hm", "km",
];
/// What makes another unit of a metre.
const PREFIXES: [&str; 6] = ["milli", "centi", "deci", "deca", "hecto", "kilo"];

/// What a head line says.
#[derive(Default)]
struct Head<'a> {
    north: Option<Side<'a>>,
    east: Option<Side<'a>>,
    in_metres: bool,
    is_depth: bool,
    nodata: Nodata,
}

/// What a head says of cells that hold nothing.
#[derive(Clone, Copy, Default, PartialEq)]
enum Nodata {
    #[default]
    Unsaid,
    /// There are none.
    None,
    Value(f64),
}

/// The cells of a text, row after row. What is no depth, and is told, is not a number.
#[derive(Default)]
struct Cells {
    depths: Vec<f64>,
    /// The lines of whole rows.
    lines: Vec<usize>,
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
    if text.contains('\r') && !text.contains('\n') {
        faults.add(
            "the file is one line: it ends its lines with carriage returns alone",
            "mend it with `tr '\\r' '\\n'`",
        );
        return None;
    }
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
    let depths = Vec::with_capacity((cells as usize).min(bytes.len() / 2 + 1));
    let mut cells = Cells { depths, ..Cells::default() };
    let mut count = 0;
    for (i, row) in rows {
        count += 1;
        if count <= north.count {
            head.row(i + 1, row, east.count, &mut cells, faults);
        }
    }
    if count != north.count {
        let (are, rows) = (if count == 1 { "is" } else { "are" }, counted(u64::from(count), "row"));
        let message = format!("there {are} {rows}, and the head says n={}", north.count);
        faults.add(message, "give a row for each place from south to north, or correct the head's `n=`");
    }
    head.check_marks(&cells, east.count, faults);
    let turned = match head.is_depth {
        true => "write `metres` alone in the head, without `depth`",
        false => "write `depth in metres` in the head",
    };
    check_water(&cells.depths, head.is_depth, turned, faults);
    Some(Survey { kind, north, east, depths: cells.depths })
}

impl<'a> Head<'a> {
    fn read(words: &'a str, faults: &mut Faults) -> Option<Head<'a>> {
        let mut head = Head::default();
        let before = faults.count();
        let mut words = words.split([' ', '\t', ',', ';']).filter(|word| !word.is_empty()).peekable();
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
                word if METRES.contains(&word) => head.in_metres = true,
                "depth" | "depths" => {
                    // In a remark the word must not turn the bottom upside down.
                    words.next_if(|next| next.eq_ignore_ascii_case("in"));
                    if words.peek().is_some_and(|next| is_unit(&next.to_ascii_lowercase())) {
                        head.is_depth = true;
                    } else {
                        faults.add(
                            format!("line 1 says `{word}`, but not of what"),
                            "if the cells are depths, write `depth in metres`; a remark can stand on a line of its own that \
                             begins with `#`",
                        );
                    }
                }
                "north->south" => {
                    faults
                        .add("line 1 says `north->south`: rows run from south to north", "turn them round with `tac`");
                }
                "east->west" => {
                    faults.add("line 1 says `east->west`: cells run from west to east", "turn each row round");
                }
                other if is_other_unit(other) => {
                    faults.add(format!("line 1 says `{word}`: depths are read in metres"), "convert them to metres");
                }
                other => {
                    if let Some(value) = other.strip_prefix("nodata=") {
                        if head.nodata != Nodata::Unsaid {
                            faults.add(
                                format!("line 1 says `nodata=` twice, then `{}`", shortened(word)),
                                "leave one of them out",
                            );
                        }
                        head.nodata = match value.parse() {
                            _ if value == "none" => Nodata::None,
                            Ok(value) => Nodata::Value(value),
                            Err(_) => {
                                let message = format!("line 1 says `{}`, which is no number", shortened(word));
                                faults.add(message, "write it such as `nodata=-9999`, or `nodata=none`");
                                Nodata::None
                            }
                        };
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
        let between = |side: &Side| {
            let mut ends = [side.first, side.last];
            if side.name.to_ascii_lowercase().starts_with("lon") {
                going_on(&mut ends);
            }
            Axis::between(side.name, ends[0], ends[1], side.count)
        };
        let (rows, columns) = (faults.take(between(north)), faults.take(between(east)));
        let (rows, columns) = (rows?, columns?);
        let is_geodetic = |side: &Side| !matches!(side.name.to_ascii_lowercase().as_str(), "north" | "east");
        match (is_geodetic(north), is_geodetic(east)) {
            (true, true) => on_the_globe(rows, columns, faults).map(|(rows, columns)| (Kind::Geodetic, rows, columns)),
            (false, false) => on_a_plane(rows, columns, faults).map(|(rows, columns)| (Kind::Local, rows, columns)),
            _ => {
                let message = format!("line 1 mixes degrees and metres: `{}` and `{}`", north.name, east.name);
                faults.add(message, "give `lat` and `lon` in degrees, or `north` and `east` in metres");
                None
            }
        }
    }

    /// Reads a row of the file; each cell's faults are told.
    fn row(&self, line: usize, row: &str, columns: u32, cells: &mut Cells, faults: &mut Faults) {
        let count = row.split(',').count() as u64;
        if count != u64::from(columns) {
            let message = format!("line {line} has {}, and the head says n={columns}", counted(count, "cell"));
            return faults.add(message, "give a cell for each place from west to east, separated by commas");
        }
        cells.lines.push(line);
        for (i, cell) in row.split(',').enumerate() {
            let cell = cell.trim();
            let depth = faults.take(self.depth(cell, || format!("line {line}, cell {}", i + 1)));
            cells.depths.push(depth.unwrap_or(f64::NAN));
        }
    }

    /// The depth in a cell.
    fn depth(&self, cell: &str, place: impl Fn() -> String) -> Result<f64, Fault> {
        let short = || shortened(cell);
        match cell.parse::<f64>() {
            Ok(value) if value.is_finite() && Nodata::Value(value) != self.nodata => {
                let depth = self.turned(value);
                if is_on_earth(depth) {
                    return Ok(depth);
                }
                let help = "if it stands for no data, fill the cell; if the unit is not metres, convert it";
                Err(Fault::new(format!("{}: {} m is neither water nor land on earth", place(), short()), help))
            }
            Ok(_) => Err(Fault::new(format!("{}: `{}` is no data", place(), short()), FILL)),
            Err(_) if cell.is_empty() => Err(Fault::new(format!("{} is empty", place()), FILL)),
            Err(_) => Err(Fault::new(
                format!("{}: `{}` is no number", place(), short()),
                "write metres with a point, such as `-12.5`; cells are separated by commas",
            )),
        }
    }

    /// A depth from what a cell says, or the other way.
    fn turned(&self, value: f64) -> f64 {
        if self.is_depth { value } else { 0.0 - value }
    }

    /// Where the head does not say what stands for nothing, the cells may.
    fn check_marks(&self, cells: &Cells, columns: u32, faults: &mut Faults) {
        if self.nodata == Nodata::None {
            return;
        }
        let columns = columns as usize;
        let apart = marks::undeclared(&cells.depths, columns, |cell| marks::is_mark(cells.depths[cell]));
        for (i, depth) in cells.depths.iter().enumerate().filter(|(i, _)| apart[*i]) {
            let (row, cell) = (i / columns, i % columns + 1);
            let (line, value) = (cells.lines.get(row).copied().unwrap_or_default(), self.turned(*depth));
            faults.add(
                format!(
                    "line {line}, cell {cell}: {value} lies far from the cells about it, as a mark for no data does"
                ),
                format!(
                    "if it is one, say `nodata={value}` in the head and fill the cell, or cut out a part without such \
                         cells; if the water is so deep, say `nodata=none`"
                ),
            );
        }
    }
}

/// Whether a word is a unit of depth.
fn is_unit(word: &str) -> bool {
    METRES.contains(&word) || is_other_unit(word)
}

/// Whether a word of small letters is a unit of length that is not read: `cm`, `[feet]`, `decimeters`.
fn is_other_unit(word: &str) -> bool {
    let word = word.trim_matches(|c: char| !c.is_alphanumeric());
    let of_metres =
        |prefix: &&str| word.strip_prefix(*prefix).is_some_and(|unit| unit != "m" && METRES.contains(&unit));
    OTHER_UNITS.contains(&word) || PREFIXES.iter().any(of_metres)
}

impl<'a> Side<'a> {
    fn read(name: &'a str, range: Option<&str>, count: Option<&str>) -> Result<Side<'a>, Fault> {
        let ends = range.and_then(|range| {
            // `0...5` may be meant to end at 5 or at 0.5.
            let (first, last) = range.split_once("..").filter(|(_, last)| !last.starts_with('.'))?;
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
