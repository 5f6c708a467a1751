//! The cells of a table of what is recorded: numbers in the units that its head names. None begins with what a spreadsheet would compute.

use albacore_geometry::{Heading, Point, TangentFrame, math};
use albacore_program::{Input, Shape, calendar, number, senses};
use albacore_vehicle::{Reading, measurements};

/// The head of the column of times.
pub const TIME: &str = "time (s)";
/// The heads of the columns of a place that stands beside every row.
const PLACE: [&str; 2] = ["north (m)", "east (m)"];
/// The numbers of a place and of a vector.
const AXES: [&str; 2] = ["north", "east"];
/// Digits of a degree of latitude and longitude behind the point: a centimetre.
const GLOBE_DECIMALS: u8 = 7;
/// Digits of a metre of a position.
const PLACE_DECIMALS: u8 = 2;

/// The head of the columns that every table has.
pub fn standing(has_utc: bool, on_globe: bool) -> String {
    let utc = if has_utc { ",utc" } else { "" };
    let globe = if on_globe { ",latitude (deg),longitude (deg)" } else { "" };
    format!("{TIME}{utc},{}{globe},depth (m)", PLACE.join(","))
}

/// Adds the head of an input's columns; `labels` are those of its further fields. What stands beside every row is not told twice: of a
/// position only its fields are added.
pub fn head(line: &mut String, input: &Input, labels: &[String], on_globe: bool) {
    if !is_beside(&input.name) {
        names(line, &input.name, &input.shape, on_globe);
    }
    for (label, shape) in labels.iter().zip(&input.fields) {
        names(line, &field(&input.name, label), shape, on_globe);
    }
}

/// Adds the cells of an input's columns, which are empty without a sample.
pub fn cells(line: &mut String, input: &Input, sample: Option<Reading>, frame: Option<TangentFrame>) {
    let own = (!is_beside(&input.name)).then_some(&input.shape);
    let mut at = if own.is_some() { 0 } else { input.shape.words() as usize };
    for shape in own.into_iter().chain(&input.fields) {
        let words = sample.as_ref().and_then(|reading| reading.get(at..at + shape.words() as usize));
        values(line, shape, words, frame);
        at += shape.words() as usize;
    }
}

/// Adds a place, where it is known.
pub fn place(line: &mut String, place: Option<Point>, frame: Option<TangentFrame>) {
    let told = |number: Option<f64>, decimals| number.map(|x| number::fixed(x, decimals)).unwrap_or_default();
    put(line, &told(place.map(|p| p.north), PLACE_DECIMALS));
    put(line, &told(place.map(|p| p.east), PLACE_DECIMALS));
    if let Some(frame) = frame {
        let globe = place.map(|p| frame.to_geodetic(p));
        put(line, &told(globe.map(|g| g.latitude_deg()), GLOBE_DECIMALS));
        put(line, &told(globe.map(|g| g.longitude_deg()), GLOBE_DECIMALS));
    }
}

/// Adds a cell that holds no comma.
pub fn put(line: &mut String, cell: &str) {
    line.push(',');
    line.push_str(cell);
}

/// The time of a tick, s.
pub fn seconds(tick: u64) -> String {
    number::seconds(tick).trim_end_matches(" s").trim_start().to_string()
}

/// Whether an input stands beside every row, with its latest sample.
pub fn is_beside(name: &str) -> bool {
    [senses::POSITION, senses::DEPTH, measurements::name(measurements::UTC)].contains(&name)
}

/// What a further field of an input is called.
pub fn field(name: &str, label: &str) -> String {
    format!("{name}.{label}")
}

/// The unit in which the numbers of a value are recorded; empty where they have none.
pub fn unit(shape: &Shape) -> &str {
    match shape {
        Shape::Quantity(display) | Shape::Vector(display) => display.unit.as_str(),
        Shape::Heading => "deg",
        Shape::Depth | Shape::Altitude | Shape::Point => "m",
        _ => "",
    }
}

/// The heads of the columns of a value's numbers, each with its unit if it has one. A place and a vector have two.
pub fn titles(name: &str, shape: &Shape) -> Vec<String> {
    let unit = unit(shape);
    let title = |name: &str| if unit.is_empty() { name.to_string() } else { format!("{name} ({unit})") };
    match shape {
        Shape::Point if is_beside(name) => PLACE.map(str::to_string).to_vec(),
        Shape::Point | Shape::Vector(_) => AXES.map(|axis| title(&format!("{name}.{axis}"))).to_vec(),
        _ => vec![title(name)],
    }
}

/// What a number of such a column is in SI units.
pub fn in_si(number: f64, shape: &Shape) -> f64 {
    match shape {
        Shape::Quantity(display) | Shape::Vector(display) => number::scaled(number, display.scale),
        Shape::Heading => math::radians(number),
        _ => number,
    }
}

fn names(line: &mut String, name: &str, shape: &Shape, on_globe: bool) {
    titles(name, shape).iter().for_each(|title| put(line, title));
    if on_globe && *shape == Shape::Point {
        ["latitude", "longitude"].iter().for_each(|axis| put(line, &format!("{name}.{axis} (deg)")));
    }
}

fn values(line: &mut String, shape: &Shape, words: Option<&[f64]>, frame: Option<TangentFrame>) {
    let count = if matches!(shape, Shape::Vector(_)) { 2 } else { 1 };
    let cells = match (shape, words) {
        (Shape::Point, words) => return place(line, words.map(|words| Point::new(words[0], words[1])), frame),
        (_, None) => vec![String::new(); count],
        (Shape::Quantity(display) | Shape::Vector(display), Some(words)) => {
            words.iter().map(|x| number::digits(x / display.scale)).collect()
        }
        (Shape::Heading, Some(words)) => vec![number::digits(Heading::from_radians(words[0]).degrees())],
        (Shape::Depth | Shape::Altitude | Shape::Int, Some(words)) => vec![number::digits(words[0])],
        (Shape::Date, Some(words)) => vec![calendar::written_to_tenths(words[0])],
        (Shape::Bool | Shape::Enum(_), Some(words)) => vec![number::value(shape, words)],
        (_, Some(words)) => vec![format!("\"{}\"", number::value(shape, words).replace('"', "\"\""))],
    };
    cells.iter().for_each(|cell| put(line, cell));
}
