//! NetCDF classic, a trajectory by the CF conventions, 1.8: one dimension for the ticks, coordinates that are held from one sample to the
//! next, and the columns as they came. What was reported has a dimension of its own, and so have the areas in it and their corners.

mod classic;

use crate::exported::{Column, Exported, Place, Reported, Values};
use crate::text;
use albacore_vehicle::seconds;
use classic::{Attribute, Dimension, File, Variable};

/// What stands where nothing came: NC_FILL_DOUBLE.
const FILL: f64 = 9.969_209_968_386_869e36;
/// No text has more bytes.
const TEXT_BYTES_MAX: usize = 1024;
/// Seconds since then, where a moment is no tick.
const UNIX: &str = "seconds since 1970-01-01T00:00:00Z";
/// Names that no column can have.
const TAKEN: [&str; 19] = [
    "time",
    "lat",
    "lon",
    "z",
    "x",
    "y",
    "trajectory",
    "report_time",
    "report_name",
    "report_text",
    "report_lat",
    "report_lon",
    "area_name",
    "area_report",
    "area_corners",
    "corner_lat",
    "corner_lon",
    "corner_y",
    "corner_x",
];

/// The file.
pub fn make(run: &Exported) -> Vec<u8> {
    let mut file = File::new(about(run));
    let ticks = file.dimension("time", run.ticks.len());
    coordinates(&mut file, run, ticks);
    let placed = if run.about.is_on_globe { "time lat lon z" } else { "time y x z" };
    for (column, name) in run.columns.iter().zip(run.names_in_programs(&TAKEN)) {
        variable(&mut file, column, name, ticks, placed);
    }
    if !run.reports.is_empty() {
        reports(&mut file, run);
        reported_areas(&mut file, run);
    }
    file.bytes()
}

fn about(run: &Exported) -> Vec<(&'static str, Attribute)> {
    let text = |text: &str| Attribute::Text(text.to_string());
    let mut attributes = vec![
        ("Conventions", text("CF-1.8")),
        ("featureType", text("trajectory")),
        ("cdm_data_type", text("Trajectory")),
        ("title", Attribute::Text(format!("Mission {} of an autonomous underwater vehicle", run.about.mission))),
        ("source", text(if run.truth.is_some() { "simulation" } else { "vehicle" })),
    ];
    attributes
        .push(("history", Attribute::Text(format!("exported from its journal by Albacore {}", run.about.version))));
    attributes.extend(run.about.facts().into_iter().map(|(name, fact)| (name, Attribute::Text(fact))));
    attributes
}

/// The name of the trajectory, time, and where the vehicle is.
fn coordinates<'a>(file: &mut File<'a>, run: &'a Exported, ticks: Dimension) {
    let mission = cut(&run.about.mission);
    let length = file.dimension("trajectory_length", mission.len().max(1));
    let mut trajectory = Variable::texts("trajectory".into(), vec![length], vec![mission], mission.len().max(1));
    trajectory.says("cf_role", "trajectory_id");
    trajectory.says("long_name", "the mission");
    file.variables.push(trajectory);

    let since_first = run.ticks.iter().map(|tick| seconds(*tick)).collect();
    let mut time = Variable::numbers("time".into(), ticks, since_first);
    time.says("standard_name", "time");
    time.says("long_name", "time since the first tick");
    time.says("units", &format!("seconds since {}", text::moment(run.about.moment_ms(0))));
    time.says("calendar", "standard");
    time.says("axis", "T");
    file.variables.push(time);

    let mut place = |name: &str, of: fn(&Place) -> f64, says: &[(&'static str, &str)]| {
        let numbers = run.believed.0.iter().map(|place| filled(of(place))).collect();
        let mut variable = Variable::numbers(name.into(), ticks, numbers);
        says.iter().for_each(|(attribute, text)| variable.says(attribute, text));
        variable.says("comment", "where the mission believes the vehicle to be, held from one sample to the next");
        variable.attributes.push(("_FillValue", Attribute::Double(FILL)));
        file.variables.push(variable);
    };
    if run.about.is_on_globe {
        let says =
            [("standard_name", "latitude"), ("long_name", "latitude"), ("units", "degrees_north"), ("axis", "Y")];
        place("lat", |place| place.latitude, &says);
        let says =
            [("standard_name", "longitude"), ("long_name", "longitude"), ("units", "degrees_east"), ("axis", "X")];
        place("lon", |place| place.longitude, &says);
    } else {
        let says =
            [("standard_name", "projection_y_coordinate"), ("long_name", "north"), ("units", "m"), ("axis", "Y")];
        place("y", |place| place.north, &says);
        let says = [("standard_name", "projection_x_coordinate"), ("long_name", "east"), ("units", "m"), ("axis", "X")];
        place("x", |place| place.east, &says);
    }
    let says = [
        ("standard_name", "depth"),
        ("long_name", "depth below the surface"),
        ("units", "m"),
        ("positive", "down"),
        ("axis", "Z"),
    ];
    place("z", |place| place.depth, &says);
}

fn variable<'a>(file: &mut File<'a>, column: &'a Column, name: String, ticks: Dimension, placed: &str) {
    let mut variable = match &column.values {
        Values::Numbers(numbers) | Values::Dates(numbers) => {
            let numbers = numbers.iter().map(|number| filled(*number)).collect();
            let mut variable = Variable::numbers(name, ticks, numbers);
            variable.says("units", units(column));
            variable.attributes.push(("_FillValue", Attribute::Double(FILL)));
            variable
        }
        Values::Texts(texts, rows) => {
            let width = texts.iter().map(|text| cut(text).len()).max().unwrap_or(0).max(1);
            let length = file.dimension(&format!("{name}_length"), width);
            let text = |row: &u32| texts.get(*row as usize).map_or("", |text| cut(text));
            Variable::texts(name, vec![ticks, length], rows.iter().map(text).collect(), width)
        }
    };
    variable.says("long_name", &column.meaning);
    if let Some(name) = column.standard_name {
        variable.says("standard_name", name);
        if name == "depth" {
            variable.says("positive", "down");
        }
    }
    variable.says("coordinates", placed);
    file.variables.push(variable);
}

/// The unit of a column, as UDUNITS writes it.
fn units(column: &Column) -> &'static str {
    match (&column.values, column.standard_name, column.unit) {
        (Values::Dates(_), ..) => UNIX,
        (_, Some("latitude"), _) => "degrees_north",
        (_, Some("longitude"), _) => "degrees_east",
        (.., "deg") => "degree",
        (.., "degC") => "degree_Celsius",
        (.., "m/s") => "m s-1",
        (.., "%") => "percent",
        // Practical salinity has no unit.
        (.., "" | "psu") => "1",
        (.., unit) => unit,
    }
}

fn reports<'a>(file: &mut File<'a>, run: &'a Exported) {
    let report = file.dimension("report", run.reports.len());
    let moment = |report: &Reported| run.about.moment_ms(report.tick) as f64 / 1000.0;
    let mut time = Variable::numbers("report_time".into(), report, run.reports.iter().map(moment).collect());
    time.says("units", UNIX);
    time.says("standard_name", "time");
    time.says("long_name", "when it was reported");
    file.variables.push(time);
    let mut texts = |name: &str, long_name: &str, texts: Vec<&'a str>| {
        let width = texts.iter().map(|text| text.len()).max().unwrap_or(0).max(1);
        let length = file.dimension(&format!("{name}_length"), width);
        let mut variable = Variable::texts(name.into(), vec![report, length], texts, width);
        variable.says("long_name", long_name);
        file.variables.push(variable);
    };
    texts("report_name", "what it is called", run.reports.iter().map(|report| cut(&report.name)).collect());
    texts("report_text", "what was reported", run.reports.iter().map(|report| cut(&report.told)).collect());
    if run.about.is_on_globe {
        let mut place = |name: &str, of: fn(&Place) -> f64, standard_name: &str, units: &str| {
            let numbers = run.reports.iter().map(|report| filled(report.place.as_ref().map_or(f64::NAN, of)));
            let mut variable = Variable::numbers(name.into(), report, numbers.collect());
            variable.says("standard_name", standard_name);
            variable.says("long_name", "where it was reported to be");
            variable.says("units", units);
            variable.attributes.push(("_FillValue", Attribute::Double(FILL)));
            file.variables.push(variable);
        };
        place("report_lat", |place| place.latitude, "latitude", "degrees_north");
        place("report_lon", |place| place.longitude, "longitude", "degrees_east");
    }
}

/// The corners of all areas that were reported, one area after the other.
fn reported_areas<'a>(file: &mut File<'a>, run: &'a Exported) {
    let numbered = run.reports.iter().zip(0u32..);
    let areas = numbered.flat_map(|(report, number)| report.areas.iter().map(move |area| (number, area)));
    let areas: Vec<_> = areas.filter(|(_, area)| !area.corners.is_empty()).collect();
    if areas.is_empty() {
        return;
    }
    let area = file.dimension("area", areas.len());
    let names: Vec<&str> = areas.iter().map(|(_, area)| cut(&area.name)).collect();
    let width = names.iter().map(|name| name.len()).max().unwrap_or(0).max(1);
    let length = file.dimension("area_name_length", width);
    let mut name = Variable::texts("area_name".into(), vec![area, length], names, width);
    name.says("long_name", "what an area that was reported is called");
    file.variables.push(name);
    let mut numbers = |name: &str, along: Dimension, numbers: Vec<f64>, long_name: &str, units: &str| {
        let mut variable = Variable::numbers(name.into(), along, numbers);
        variable.says("long_name", long_name);
        variable.says("units", units);
        file.variables.push(variable);
    };
    let of = areas.iter().map(|(number, _)| f64::from(*number)).collect();
    numbers("area_report", area, of, "the report that it is in, from 0", "1");
    let counts = areas.iter().map(|(_, area)| area.corners.len() as f64).collect();
    numbers("area_corners", area, counts, "how many of the corners are of it, in order", "1");
    let corners: Vec<&Place> = areas.iter().flat_map(|(_, area)| &area.corners).collect();
    let corner = file.dimension("corner", corners.len());
    let mut place = |name: &str, of: fn(&Place) -> f64, long_name: &str, units: &str| {
        let places = corners.iter().map(|corner| filled(of(corner))).collect();
        let mut variable = Variable::numbers(name.into(), corner, places);
        variable.says("long_name", long_name);
        variable.says("units", units);
        file.variables.push(variable);
    };
    if run.about.is_on_globe {
        place("corner_lat", |place| place.latitude, "latitude of a corner", "degrees_north");
        place("corner_lon", |place| place.longitude, "longitude of a corner", "degrees_east");
    } else {
        place("corner_y", |place| place.north, "north of a corner", "m");
        place("corner_x", |place| place.east, "east of a corner", "m");
    }
}

fn filled(x: f64) -> f64 {
    if x.is_finite() { x } else { FILL }
}

/// The beginning of a text that has too many bytes.
fn cut(text: &str) -> &str {
    let end = (0..=TEXT_BYTES_MAX.min(text.len())).rev().find(|at| text.is_char_boundary(*at));
    text.get(..end.unwrap_or(0)).unwrap_or_default()
}
