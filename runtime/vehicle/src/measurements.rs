//! The measurements of the vehicles that we know: simulated ones and those at the end of a link deliver the same, so that a mission
//! runs on either. This is the one table of them: sensors, faults, the watch over samples, and links read it.

use crate::{Measurement, Quantity, Reading};
use albacore_geometry::math::PI;

/// A row of the table.
#[derive(Clone, Copy, Debug)]
pub struct MeasurementInfo {
    /// Its name, which an `input` of the same name reads.
    pub name: &'static str,
    /// What its numbers are.
    pub quantity: Quantity,
    /// What is measured of a vehicle, which is slow, changes by no more than this. None: by any.
    change_max: Option<Change>,
    /// Whether a sample that cannot follow the one before is withheld. What is measured of the water may have any edge.
    pub is_gated: bool,
    /// Whether the watch looks at it.
    pub is_watched: bool,
    /// What the vehicle makes it of: doubtful with any of them.
    pub sources: &'static [u16],
    /// What a `fault` clause calls its sensor, where that can fail: as the measurement, but where an instrument's clause has that name.
    pub fails_as: Option<&'static str>,
    /// The measurement whose sensor it comes from alone, where that is another's: it fails with that.
    pub fails_with: Option<u16>,
    /// The clause of the instrument that it comes from, as a scenario has it, where a vehicle may not have that one.
    pub instrument: Option<&'static str>,
}

/// A greatest change: so much a second, and so much besides.
#[derive(Clone, Copy, Debug)]
struct Change {
    rate: f64,
    step: f64,
}

impl MeasurementInfo {
    const fn of(name: &'static str, quantity: Quantity) -> Self {
        MeasurementInfo {
            name,
            quantity,
            change_max: None,
            is_gated: false,
            is_watched: false,
            sources: &[],
            fails_as: None,
            fails_with: None,
            instrument: None,
        }
    }

    const fn changes(self, rate: f64, step: f64) -> Self {
        MeasurementInfo { change_max: Some(Change { rate, step }), ..self }
    }

    const fn gated(self) -> Self {
        MeasurementInfo { is_gated: true, ..self }
    }

    const fn watched(self) -> Self {
        MeasurementInfo { is_watched: true, ..self }
    }

    const fn can_fail(self) -> Self {
        self.can_fail_as(self.name)
    }

    const fn can_fail_as(self, sensor: &'static str) -> Self {
        MeasurementInfo { fails_as: Some(sensor), ..self }
    }

    const fn failing_with(self, sensor: u16) -> Self {
        MeasurementInfo { fails_with: Some(sensor), ..self }
    }

    const fn of_instrument(self, clause: &'static str) -> Self {
        MeasurementInfo { instrument: Some(clause), ..self }
    }

    const fn made_of(self, sources: &'static [u16]) -> Self {
        MeasurementInfo { sources, ..self }
    }

    /// Whether it is an inertial navigator's.
    pub fn is_of_inertial(&self) -> bool {
        self.instrument == Some(INERTIAL)
    }

    /// Whether it is of the vehicle's data sheet, and no sensor's.
    pub fn is_of_data_sheet(&self) -> bool {
        self.instrument == Some(DATA_SHEET)
    }

    /// Whether one reading can follow another after some seconds.
    #[inline]
    pub fn can_follow(&self, now: Reading, before: Reading, time: f64) -> bool {
        let Some(Change { rate, step }) = self.change_max else { return true };
        let error = if self.quantity == Quantity::Position {
            // A fix may correct what both expect of their errors: six standard deviations. The later is no excuse for itself: its
            // own error is no larger here than that of the one before.
            let own = now[2].min(before[2]);
            6.0 * (own * own + before[2] * before[2]).sqrt()
        } else {
            0.0
        };
        self.quantity.difference(now, before) <= rate * time + error + step
    }
}

/// The rows, and each measurement's number: its place among them.
/// The clause that gives a vehicle its data sheet.
const DATA_SHEET: &str = "abilities";
/// The navigator that knows how well it knows what.
const INERTIAL: &str = "navigation(inertial())";

macro_rules! measurements {
    ($($(#[$doc:meta])* $number:ident: $row:expr;)*) => {
        #[allow(non_camel_case_types, clippy::upper_case_acronyms, reason = "the constants that come of it are its names")]
        enum Number { $($number),* }
        $($(#[$doc])* pub const $number: u16 = Number::$number as u16;)*
        /// All of them, each at the place of its number.
        pub const ALL: [MeasurementInfo; [$(Number::$number as u16),*].len()] = [$($row),*];
    };
}

measurements! {
    /// Where the vehicle believes to be. A fix of who tells no sigma may correct 5 m.
    POSITION: MeasurementInfo::of("position", Quantity::Position).changes(10.0, 5.0).gated().watched().can_fail();
    /// Its direction over ground, turned from its body's with the compass: at rest it is any, and the gate has a rule of its own.
    COURSE: MeasurementInfo::of("course", Quantity::Direction).gated().watched().made_of(&[HEADING]).failing_with(HEADING);
    /// Where its nose points.
    HEADING: MeasurementInfo::of("heading", Quantity::Direction).changes(PI / 3.0, PI / 12.0).gated().watched().can_fail();
    /// Its speed over ground.
    SPEED: MeasurementInfo::of("speed", Quantity::Speed).changes(2.0, 1.0).gated().watched().can_fail();
    /// Its depth.
    DEPTH: MeasurementInfo::of("depth", Quantity::Height).changes(3.0, 1.0).gated().watched().can_fail();
    /// Its height above the bottom.
    ALTITUDE: MeasurementInfo::of("altitude", Quantity::Height).changes(5.0, 1.2).gated().watched().can_fail();
    /// The depth of the water.
    WATER_DEPTH: MeasurementInfo::of("water_depth", Quantity::Height).made_of(&[DEPTH, ALTITUDE]);
    /// The current.
    FLOW: MeasurementInfo::of("flow", Quantity::Flow).changes(0.0, 1.0).watched().can_fail();
    /// The chemical sensor: the edge of a plume is sharp.
    CHEMICAL: MeasurementInfo::of("chemical", Quantity::Ratio).watched().can_fail();
    /// What is left in the battery. A gauge is coarse; a battery that is empty in a quarter of an hour is none of ours.
    BATTERY: MeasurementInfo::of("battery", Quantity::Ratio).changes(0.001, 0.1).gated().can_fail_as("battery_gauge");
    /// What the vehicle's own mission is about: the place in the library's `enum VehicleMode`.
    VEHICLE_MODE: MeasurementInfo::of("vehicle_mode", Quantity::Word);
    /// The temperature of the water.
    TEMPERATURE: MeasurementInfo::of("temperature", Quantity::Temperature).of_instrument("ctd").can_fail();
    /// The practical salinity of the water.
    SALINITY: MeasurementInfo::of("salinity", Quantity::Salinity).of_instrument("ctd").can_fail();
    /// The date, by the vehicle's clock.
    UTC: MeasurementInfo::of("utc", Quantity::Date).of_instrument("date");
    /// Where a beacon is that the vehicle hears: as far from where it believes to be as it hears it.
    BEACON: MeasurementInfo::of("beacon", Quantity::Position).of_instrument("usbl");
    /// The radius of the tightest circle that the vehicle drives.
    TURN_RADIUS: MeasurementInfo::of("turn_radius", Quantity::Height).of_instrument(DATA_SHEET);
    /// How fast it is through the water, at most.
    TOP_SPEED: MeasurementInfo::of("top_speed", Quantity::Speed).of_instrument(DATA_SHEET);
    /// The greatest depth that its own limits allow.
    DEPTH_LIMIT: MeasurementInfo::of("depth_limit", Quantity::Height).of_instrument(DATA_SHEET);
    /// The current below the vehicle.
    FLOW_BELOW: MeasurementInfo::of("flow_below", Quantity::Flow).of_instrument("lower_adcp");
    /// The greater half axis of the ellipse of standard deviations about the believed position.
    SIGMA_MAJOR: MeasurementInfo::of("sigma_major", Quantity::Height).of_instrument(INERTIAL);
    /// The smaller one.
    SIGMA_MINOR: MeasurementInfo::of("sigma_minor", Quantity::Height).of_instrument(INERTIAL);
    /// Where the greater one points, or the other way.
    SIGMA_TOWARD: MeasurementInfo::of("sigma_toward", Quantity::Direction).of_instrument(INERTIAL);
    /// Whether the navigator's instruments agree with it: the place in the library's `enum NavigationState`.
    NAVIGATION_STATE: MeasurementInfo::of("navigation_state", Quantity::Word).of_instrument(INERTIAL);
}

/// A measurement of ours by its number.
///
/// # Panics
///
/// Where there is none of that number: numbers are the constants of this table.
#[inline]
pub fn info(measurement: u16) -> &'static MeasurementInfo {
    &ALL[usize::from(measurement)]
}

/// The number of a measurement by its name.
pub fn number(name: &str) -> Option<u16> {
    (0..).zip(&ALL).find(|(_, row)| row.name == name).map(|(number, _)| number)
}

/// The name of a measurement of ours.
pub const fn name(measurement: u16) -> &'static str {
    ALL[measurement as usize].name
}

/// All of them, as a vehicle delivers them.
pub fn all() -> Vec<Measurement> {
    delivered(|_| true)
}

/// Those that a vehicle tells. A number keeps its place: what is not delivered before others has no name there. A mission that requires
/// what its vehicle does not measure is refused before it begins.
pub fn delivered(is_there: impl Fn(&MeasurementInfo) -> bool) -> Vec<Measurement> {
    let count = ALL.iter().rposition(&is_there).map_or(0, |last| last + 1);
    let name = |row: &MeasurementInfo| if is_there(row) { row.name.to_owned() } else { String::new() };
    ALL[..count].iter().map(|row| Measurement { name: name(row), width: row.quantity.width() }).collect()
}
