//! What stands in the columns of a tick: what the vehicle sensed and was told, what was active, and what is so. Units are those of
//! `recorded.csv`: degrees and shares in percent, all else SI.

use super::columns::{Columns, Head, Key, Kind};
use crate::plan::Plan;
use albacore_export::Role;
use albacore_geometry::math::degrees;
use albacore_geometry::{Heading, Point, TangentFrame};
use albacore_program::{ActivityId, Program, Shape};
use albacore_trace::{TickRecord, control_name};
use albacore_vehicle::measurements::{self, info, number};
use albacore_vehicle::{COMMANDED, Command, Commanded, Measurement, Quantity, Reading, Sample, Truth};
use std::collections::BTreeMap;
use std::sync::Arc;

/// So many samples of a measurement in one tick have columns.
const SAMPLES_A_TICK_MAX: usize = 4;
/// Between the names of what is active.
const WITHIN: &str = " > ";

/// What other programs call a number of a measurement: its part, its standard name by the CF conventions, its role.
const CALLED: [(u16, usize, Option<&str>, Option<Role>); 15] = [
    (measurements::POSITION, NORTH, None, Some(Role::North)),
    (measurements::POSITION, EAST, None, Some(Role::East)),
    (measurements::POSITION, LATITUDE, Some("latitude"), Some(Role::Latitude)),
    (measurements::POSITION, LONGITUDE, Some("longitude"), Some(Role::Longitude)),
    (measurements::COURSE, 0, Some("platform_course"), None),
    (measurements::HEADING, 0, Some("platform_orientation"), Some(Role::Heading)),
    (measurements::SPEED, 0, Some("platform_speed_wrt_ground"), Some(Role::Speed)),
    (measurements::DEPTH, 0, Some("depth"), Some(Role::Depth)),
    (measurements::ALTITUDE, 0, Some("height_above_sea_floor"), Some(Role::Altitude)),
    (measurements::WATER_DEPTH, 0, Some("sea_floor_depth_below_sea_surface"), None),
    (measurements::FLOW, NORTH, Some("northward_sea_water_velocity"), None),
    (measurements::FLOW, EAST, Some("eastward_sea_water_velocity"), None),
    (measurements::TEMPERATURE, 0, Some("sea_water_temperature"), None),
    (measurements::SALINITY, 0, Some("sea_water_practical_salinity"), None),
    (measurements::UTC, 0, Some("time"), None),
];

/// The parts of a place: what follows from the first two stands between them and the standard deviation of both.
const NORTH: usize = 0;
const EAST: usize = 1;
const LATITUDE: usize = 2;
const LONGITUDE: usize = 3;
const SIGMA: usize = 4;
/// ... and what they are called.
const PLACE: [(&str, &str); 5] =
    [("north", "m"), ("east", "m"), ("latitude", "deg"), ("longitude", "deg"), ("sigma", "m")];

/// What other programs make of a part of the command, by its name.
const COMMANDED_ROLES: [(&str, Role); 4] = [
    ("heading", Role::CommandedHeading),
    ("speed", Role::CommandedSpeed),
    ("depth", Role::CommandedDepth),
    ("altitude", Role::CommandedAltitude),
];

/// What is so: name, unit, standard name, and the value.
type TrueColumn = (&'static str, &'static str, Option<&'static str>, fn(&Truth) -> f64);
const TRUE: [TrueColumn; 12] = [
    ("north", "m", None, |truth| truth.position.north),
    ("east", "m", None, |truth| truth.position.east),
    ("depth", "m", Some("depth"), |truth| truth.depth),
    ("altitude", "m", Some("height_above_sea_floor"), |truth| truth.altitude),
    ("heading", "deg", Some("platform_orientation"), |truth| truth.heading.degrees()),
    ("pitch", "deg", Some("platform_pitch_fore_up"), |truth| degrees(truth.pitch)),
    ("roll", "deg", Some("platform_roll_starboard_down"), |truth| degrees(truth.roll)),
    ("course", "deg", Some("platform_course"), |truth| truth.course.degrees()),
    ("speed", "m/s", Some("platform_speed_wrt_ground"), |truth| truth.speed_over_ground),
    ("flow.north", "m/s", Some("northward_sea_water_velocity"), |truth| truth.flow.north),
    ("flow.east", "m/s", Some("eastward_sea_water_velocity"), |truth| truth.flow.east),
    ("concentration", "%", None, |truth| 100.0 * truth.concentration),
];
/// What follows from the first two of these.
const TRUE_GLOBE: [&str; 2] = ["latitude", "longitude"];

/// A measurement of the vehicle.
struct Sensor {
    name: String,
    /// Its number in the table of measurements, if it has one.
    number: Option<u16>,
    width: usize,
    /// What the places of its words mean, where it is one.
    words: Option<Arc<[String]>>,
}

/// All of them, and the columns for what they and others tell.
pub struct Sensed {
    sensors: Vec<Sensor>,
    frame: Option<TangentFrame>,
    pub columns: Columns,
}

impl Sensed {
    pub fn new(plan: &Plan, delivered: &[Measurement]) -> Self {
        let words = |name: &str| {
            let input = plan.program.inputs.iter().find(|input| input.name == name)?;
            if let Shape::Enum(words) = &input.shape { Some(Arc::clone(words)) } else { None }
        };
        let sensor = |measurement: &Measurement| Sensor {
            name: measurement.name.clone(),
            number: number(&measurement.name),
            width: measurement.width.min(Reading::default().len()),
            words: words(&measurement.name),
        };
        let frame = plan.frame();
        let mut sensed = Sensed { sensors: delivered.iter().map(sensor).collect(), frame, columns: Columns::default() };
        // What a vehicle can tell has its columns in every run, and so has what it is told.
        for (at, sensor) in (0u16..).zip(&sensed.sensors).filter(|(_, sensor)| !sensor.name.is_empty()) {
            for part in sensor.parts(frame.is_some()) {
                sensed.columns.declare(Key::Sensed(at, false, 0, part), || sensor.head(false, 0, part));
            }
        }
        (0..COMMANDED.len()).for_each(|at| sensed.columns.declare(Key::Commanded(at), || commanded(at)));
        sensed.columns.declare(Key::Behavior, behavior);
        sensed
    }

    /// All that a tick tells.
    pub fn take(&mut self, row: usize, record: &TickRecord, program: &Program) {
        self.samples(row, &record.snapshot.samples);
        if record.snapshot.aground {
            self.columns.number(Key::Aground, row, 1.0, || plain("aground", "1 where the vehicle lies on the bottom"));
        }
        self.command(row, record.command.as_ref());
        self.columns.text(Key::Control, row, control_name(record.snapshot.control), || Head {
            kind: Kind::Text,
            ..plain("control", "who drives")
        });
        let name = |id: &ActivityId| program.activities.get(*id as usize).map_or("?", |activity| &activity.name);
        let chain = record.active.iter().map(name).collect::<Vec<_>>().join(WITHIN);
        if !chain.is_empty() {
            self.columns.text(Key::Behavior, row, &chain, behavior);
        }
        record.truth.iter().for_each(|truth| self.truth(row, truth));
        if let Some(errors) = &record.navigation {
            self.navigation(row, errors);
        }
    }

    fn samples(&mut self, row: usize, samples: &[Sample]) {
        // The last of a tick is what a mission reads; what came before it stands beside it.
        let mut later: BTreeMap<(u16, bool), usize> = BTreeMap::new();
        for sample in samples.iter().rev() {
            let (at, is_withheld) = (sample.origin(), sample.is_withheld());
            let nth = later.entry((at, is_withheld)).or_insert(0);
            let sensor = self.sensors.get(usize::from(at)).filter(|sensor| !sensor.name.is_empty());
            let Some(sensor) = sensor.filter(|_| *nth < SAMPLES_A_TICK_MAX) else {
                self.columns.left_out += 1;
                continue;
            };
            for part in sensor.parts(self.frame.is_some()) {
                let (key, head) = (Key::Sensed(at, is_withheld, *nth, part), || sensor.head(is_withheld, *nth, part));
                let number = sensor.shown(part, sample.reading, self.frame);
                match sensor.words.as_ref().map(|words| words.get(sample.reading[0] as usize)) {
                    Some(word) => self.columns.text(key, row, word.map_or("?", String::as_str), head),
                    None => self.columns.number(key, row, number, head),
                }
            }
            if sample.is_doubted() && !is_withheld && *nth == 0 {
                let name = format!("{}.doubted", sensor.name);
                self.columns.number(Key::Doubted(at), row, 1.0, || plain(&name, "1 where no limit goes by it"));
            }
            *nth += 1;
        }
    }

    fn command(&mut self, row: usize, command: Option<&Command>) {
        let Some(command) = command else { return };
        let values = COMMANDED.iter().map(|part| (part.value)(command)).enumerate();
        for (at, value) in values.filter_map(|(at, value)| Some((at, value?))) {
            self.columns.number(Key::Commanded(at), row, value, || commanded(at));
        }
    }

    fn truth(&mut self, row: usize, truth: &Truth) {
        for (at, (name, unit, standard_name, value)) in TRUE.into_iter().enumerate() {
            self.columns.number(Key::True(at), row, value(truth), || Head {
                unit,
                standard_name,
                ..plain(&format!("truth.{name}"), &format!("true {name}, known in simulation alone"))
            });
        }
        let Some(globe) = self.frame.map(|frame| frame.to_geodetic(truth.position)) else { return };
        for (at, value) in [globe.latitude_deg(), globe.longitude_deg()].into_iter().enumerate() {
            let name = TRUE_GLOBE[at];
            self.columns.number(Key::True(TRUE.len() + at), row, value, || Head {
                unit: "deg",
                standard_name: Some(name),
                ..plain(&format!("truth.{name}"), &format!("true {name}, known in simulation alone"))
            });
        }
    }
}

impl Sensor {
    fn quantity(&self) -> Option<Quantity> {
        self.number.map(|number| info(number).quantity)
    }

    /// The numbers that stand in columns.
    fn parts(&self, is_on_globe: bool) -> impl Iterator<Item = usize> + use<> {
        let (count, globe) = match self.quantity() {
            Some(Quantity::Position) => (PLACE.len(), is_on_globe),
            Some(Quantity::Flow) => (2, true),
            Some(_) => (1, true),
            None => (self.width, true),
        };
        (0..count).filter(move |part| globe || ![LATITUDE, LONGITUDE].contains(part))
    }

    fn head(&self, is_withheld: bool, nth: usize, part: usize) -> Head {
        let before = match nth {
            0 => String::new(),
            1 => ".before".to_string(),
            more => format!(".before_{more}"),
        };
        let is_plain = !is_withheld && nth == 0;
        let base = format!("{}{}{before}", self.name, if is_withheld { ".withheld" } else { "" });
        let is_place = self.number == Some(measurements::POSITION) && is_plain && part != SIGMA;
        let (name, unit, kind) = match self.quantity() {
            Some(Quantity::Position) if is_place => (PLACE[part].0.to_string(), PLACE[part].1, Kind::Number),
            Some(Quantity::Position) => (format!("{base}.{}", PLACE[part].0), PLACE[part].1, Kind::Number),
            Some(Quantity::Flow) => (format!("{base}.{}", PLACE[part].0), "m/s", Kind::Number),
            Some(Quantity::Direction) => (base, "deg", Kind::Number),
            Some(Quantity::Speed) => (base, "m/s", Kind::Number),
            Some(Quantity::Height) => (base, "m", Kind::Number),
            Some(Quantity::Ratio) => (base, "%", Kind::Number),
            Some(Quantity::Temperature) => (base, "degC", Kind::Number),
            Some(Quantity::Salinity) => (base, "psu", Kind::Number),
            Some(Quantity::Date) => (base, "", Kind::Date),
            Some(Quantity::Word) => (base, "", if self.words.is_some() { Kind::Text } else { Kind::Number }),
            None if self.width > 1 => (format!("{base}.{}", part + 1), "", Kind::Number),
            None => (base, "", Kind::Number),
        };
        let mut said = format!("{} as the vehicle told it", name.replace(['.', '_'], " "));
        said.push_str(if is_withheld { ", which was not believed" } else { "" });
        said.push_str(if nth > 0 { ", before another of the same tick" } else { "" });
        let called = CALLED.iter().find(|(number, of, ..)| is_plain && Some(*number) == self.number && *of == part);
        let (standard_name, role) = called.map_or((None, None), |(.., standard_name, role)| (*standard_name, *role));
        Head { unit, role, standard_name, kind, ..plain(&name, &said) }
    }

    /// A number in the unit of its column.
    fn shown(&self, part: usize, reading: Reading, frame: Option<TangentFrame>) -> f64 {
        let globe = || frame.map(|frame| frame.to_geodetic(Point::new(reading[0], reading[1])));
        match (self.quantity(), part) {
            (Some(Quantity::Position), LATITUDE) => globe().map_or(f64::NAN, |globe| globe.latitude_deg()),
            (Some(Quantity::Position), LONGITUDE) => globe().map_or(f64::NAN, |globe| globe.longitude_deg()),
            (Some(Quantity::Position), SIGMA) => reading[2],
            (Some(Quantity::Direction), _) => Heading::from_radians(reading[0]).degrees(),
            (Some(Quantity::Ratio), _) => 100.0 * reading[0],
            _ => reading.get(part).copied().unwrap_or(f64::NAN),
        }
    }
}

/// A column of numbers without a unit.
fn plain(name: &str, meaning: &str) -> Head {
    Head {
        name: name.to_string(),
        unit: "",
        meaning: meaning.to_string(),
        role: None,
        standard_name: None,
        kind: Kind::Number,
    }
}

fn commanded(at: usize) -> Head {
    let Commanded { name, unit, .. } = COMMANDED[at];
    let said = format!("the {name} that the vehicle was told");
    let role = COMMANDED_ROLES.into_iter().find(|(of, _)| *of == name).map(|(_, role)| role);
    Head { unit, role, ..plain(&format!("commanded.{name}"), &said) }
}

fn behavior() -> Head {
    let said = "the mission, strategies and behaviors that are active, from outside in";
    Head { role: Some(Role::Behavior), kind: Kind::Text, ..plain("behavior", said) }
}
