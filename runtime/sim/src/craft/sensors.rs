//! The vehicle's instruments: what a scenario says of each, what of that cannot be, and what it makes of the truth. A file for each, and
//! this is their register.

mod abilities;
mod adcp;
mod attitude;
mod battery;
mod clock;
mod compass;
mod ctd;
mod delay;
mod dvl;
mod fluorometer;
mod imu;
mod inertial;
mod onboard;
mod played;
mod positioning;
mod pressure;
mod raw;
mod receivers;
mod sounder;
mod usbl;
mod velocity_model;

pub use abilities::Abilities;
pub use adcp::{Adcp, Looks, LowerAdcp};
pub use attitude::AttitudeSensor;
pub use battery::Battery;
pub use clock::Date;
pub use compass::Compass;
pub use ctd::Ctd;
pub use dvl::Dvl;
pub use fluorometer::Fluorometer;
pub use imu::Imu;
pub(crate) use onboard::Step;
pub use played::{Played, PlayedSample};
pub use positioning::{Gps, Lbl, Navigation};
pub use pressure::Pressure;
pub(crate) use raw::{RawSample, RawSensor};
pub use receivers::InvertedUsbl;
pub use sounder::Sounder;
pub(crate) use sounder::water_depth;
pub use usbl::Usbl;

use crate::craft::fault::Faults;
use crate::craft::hull::{Misjudged, Motion, StartPose, State};
use crate::craft::setup::HullSetup;
use crate::scenario::ScenarioIssues;
use crate::world::World;
use abilities::DataSheet;
use adcp::Profiler;
use albacore_geometry::{Heading, Point, Vector};
use albacore_navigation::{Estimate, InertialSettings};
use albacore_vehicle::measurements::MeasurementInfo;
use albacore_vehicle::{Limits, Measurement, NavigationErrors, Sample, Snapshot, TICK_S, Truth, measurements};
use battery::BatteryGauge;
use clock::Clock;
use ctd::CtdProbe;
use fluorometer::ChemicalSensor;
use onboard::OnboardNavigation;
use played::Player;
use pressure::PressureGauge;
use serde::Deserialize;
use sounder::EchoSounder;
use usbl::UsblReceiver;

/// Samples a second of what is read at every tick.
const EVERY_TICK: f64 = 1.0 / TICK_S;

/// What a scenario says of its vehicle's instruments. They are perfect where it says nothing, but for the chemical sensor and the profiler.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InstrumentSetup {
    /// How the vehicle knows its position; none: perfectly.
    pub navigation: Option<Navigation>,
    /// The receiver of satellite fixes; none: it has none. It needs a [`Navigation`].
    pub gps: Option<Gps>,
    /// The compass.
    pub compass: Compass,
    /// The Doppler log.
    pub dvl: Dvl,
    /// The pressure gauge.
    pub pressure: Pressure,
    /// The echo sounder.
    pub sounder: Sounder,
    /// The flow sensor.
    pub adcp: Adcp,
    /// The chemical sensor.
    pub fluorometer: Fluorometer,
    /// The sensor of temperature and salinity; none: the vehicle has none.
    pub ctd: Option<Ctd>,
    /// The battery and its gauge.
    pub battery: Battery,
    /// The date on which runs begin; none: the vehicle tells none.
    pub date: Option<Date>,
    /// The receiver of beacons; none: the vehicle has none.
    pub usbl: Option<Usbl>,
    /// What the profiler sees below the vehicle, told apart; none: it is not.
    pub lower_adcp: Option<LowerAdcp>,
    /// What the vehicle tells of itself; none: nothing.
    pub abilities: Option<Abilities>,
    /// The inertial unit, which an inertial navigator goes by.
    pub imu: Imu,
    /// The attitude sensor, which aids it.
    pub attitude: AttitudeSensor,
    /// The receivers of a transponder; none: the vehicle has none.
    pub inverted_usbl: Option<InvertedUsbl>,
    /// What is told as it was recorded, whatever the instruments would tell.
    pub played: Vec<Played>,
}

/// Whether a vehicle has an instrument: one that it may lack is an `Option`.
macro_rules! is_there {
    ($field:expr) => {
        true
    };
    ($field:expr, Some) => {
        $field.is_some()
    };
}

/// The clauses of instruments, by their names in a script, and where each goes.
macro_rules! clauses {
    ($($name:literal $clause:ident => $field:ident $(in $wrap:ident)?;)*) => {
        /// A clause of a scenario that says how an instrument is.
        #[derive(Clone, Debug, Deserialize)]
        #[allow(missing_docs, reason = "the standard library says what each clause is")]
        pub enum InstrumentSetting { $(#[serde(rename = $name)] $clause($clause)),* }

        impl InstrumentSetting {
            /// The names of the clauses.
            pub const NAMES: [&str; [$($name),*].len()] = [$($name),*];
        }

        impl InstrumentSetup {
            /// Whether a vehicle has the instrument of a clause.
            fn has(&self, clause: &str) -> bool {
                match clause {
                    $($name => is_there!(self.$field $(, $wrap)?),)*
                    _ => false,
                }
            }

            /// Takes in a clause.
            pub(crate) fn set(&mut self, setting: InstrumentSetting) {
                match setting {
                    $(InstrumentSetting::$clause(setting) => self.$field = $($wrap)?(setting),)*
                }
            }
        }
    };
}

clauses! {
    "navigation" Navigation => navigation in Some;
    "fluorometer" Fluorometer => fluorometer;
    "adcp" Adcp => adcp;
    "sounder" Sounder => sounder;
    "compass" Compass => compass;
    "pressure" Pressure => pressure;
    "dvl" Dvl => dvl;
    "gps" Gps => gps in Some;
    "ctd" Ctd => ctd in Some;
    "battery" Battery => battery;
    "date" Date => date in Some;
    "usbl" Usbl => usbl in Some;
    "abilities" Abilities => abilities in Some;
    "lower_adcp" LowerAdcp => lower_adcp in Some;
    "imu" Imu => imu;
    "attitude" AttitudeSensor => attitude;
    "inverted_usbl" InvertedUsbl => inverted_usbl in Some;
}

impl InstrumentSetup {
    /// What a vehicle tells that has them.
    pub fn measurements(&self) -> Vec<Measurement> {
        let is_told = |row: &MeasurementInfo| match row.instrument {
            _ if row.is_of_inertial() => self.inertial().is_some(),
            instrument => instrument.is_none_or(|clause| self.has(clause)),
        };
        measurements::delivered(|row| is_told(row) || self.is_played(row.name))
    }

    /// Why a vehicle that lies still tells no sample of a measurement; `None` where nothing keeps it from that.
    pub(crate) fn silence(&self, measurement: &str, lies: &AtRest) -> Option<String> {
        if self.is_played(measurement) {
            return None;
        }
        let at = measurements::ALL.iter().position(|row| row.name == measurement)?;
        match u16::try_from(at).ok()? {
            measurements::FLOW => self.adcp.silence(lies),
            measurements::FLOW_BELOW => self.lower_adcp.as_ref()?.silence(lies),
            measurements::ALTITUDE | measurements::WATER_DEPTH => self.sounder.silence(lies),
            measurements::TEMPERATURE | measurements::SALINITY => self.ctd.as_ref()?.silence(lies),
            _ => None,
        }
    }

    /// What its inertial navigator is told, where it has one.
    pub fn inertial(&self) -> Option<&InertialSettings> {
        self.navigation.as_ref().and_then(|navigation| navigation.navigator.inertial())
    }

    /// Whether a vehicle with this navigation has a use for an instrument: what is said of another is in force nowhere.
    pub fn uses(&self, clause: &str) -> bool {
        match clause {
            "imu" | "attitude" => self.inertial().is_some(),
            "compass" => self.inertial().is_none(),
            _ => true,
        }
    }

    /// What a sensor needs that a navigator takes as it measures, where that is missing, and the mend.
    pub(crate) fn lacks(&self, sensor: RawSensor) -> Option<(&'static str, &'static str)> {
        let is_inertial = self.inertial().is_some();
        let has_fixes = self.navigation.as_ref().is_some_and(|navigation| navigation.lbl.is_some());
        match sensor {
            RawSensor::AcousticFixes => {
                (!has_fixes).then_some(("the vehicle has no acoustic fixes", "write `navigation(…, lbl())`"))
            }
            RawSensor::SatelliteFixes => {
                self.gps.is_none().then_some(("the vehicle has no satellite fixes", "add `gps()` to the scenario"))
            }
            RawSensor::Receivers => self
                .inverted_usbl
                .is_none()
                .then_some(("the vehicle has no receivers", "add `inverted_usbl()` to the scenario")),
            _ => (!is_inertial).then_some(("the vehicle has no inertial navigator", "write `navigation(inertial())`")),
        }
    }

    fn is_played(&self, measurement: &str) -> bool {
        self.played.iter().any(|played| played.name() == measurement)
    }

    /// What of them cannot be, in a world with a transponder or without one, aboard a hull.
    pub(crate) fn check(&self, has_transponder: bool, hull: &HullSetup, issues: &mut ScenarioIssues) {
        positioning::check(self, issues);
        inertial::check(self, has_transponder, hull, issues);
        fluorometer::check(self, issues);
        sounder::check(self, issues);
        played::check(self, issues);
    }
}

/// Where a vehicle lies that nobody drives.
pub(crate) struct AtRest {
    /// Below the surface, m.
    pub depth: f64,
    /// Above the bottom, m.
    pub altitude: f64,
    /// It drifts no faster than this, m/s.
    pub drift: f64,
}

/// The instruments of a vehicle in a run.
#[derive(Clone, Debug)]
pub(crate) struct Instruments {
    navigation: OnboardNavigation,
    /// What tells the depth; none where an inertial navigator does.
    pressure: Option<PressureGauge>,
    sounder: EchoSounder,
    adcp: Profiler,
    fluorometer: ChemicalSensor,
    ctd: Option<CtdProbe>,
    battery: BatteryGauge,
    clock: Option<Clock>,
    usbl: Option<UsblReceiver>,
    data_sheet: Option<DataSheet>,
    lower_adcp: Option<Profiler>,
    player: Player,
}

impl Instruments {
    /// Those of a run that begins so in a world, aboard a hull with limits of its own.
    pub fn new(
        (setup, hull): (&InstrumentSetup, &HullSetup),
        limits: &Limits,
        world: &World,
        start: &StartPose,
        seed: u64,
    ) -> Self {
        Instruments {
            navigation: OnboardNavigation::new(setup, hull, world, start, seed),
            pressure: setup.inertial().is_none().then(|| PressureGauge::new(&setup.pressure, seed)),
            sounder: EchoSounder::new(&setup.sounder, seed),
            adcp: Profiler::new(&setup.adcp, seed),
            fluorometer: ChemicalSensor::new(&setup.fluorometer, seed),
            ctd: setup.ctd.as_ref().map(|ctd| CtdProbe::new(ctd, seed)),
            battery: BatteryGauge::new(&setup.battery, seed),
            clock: setup.date.clone().map(Clock),
            usbl: setup.usbl.as_ref().map(|usbl| UsblReceiver::new(usbl, seed)),
            data_sheet: setup.abilities.as_ref().map(|abilities| DataSheet::new(abilities, limits)),
            lower_adcp: setup.lower_adcp.as_ref().map(|adcp| Profiler::below(adcp, seed)),
            player: Player::new(&setup.played),
        }
    }

    /// All of them, in the order in which a snapshot holds what they tell: a part of every recorded run.
    fn in_order(&mut self) -> [&mut dyn Instrument; 11] {
        [
            &mut self.navigation,
            &mut self.pressure,
            &mut self.sounder,
            &mut self.adcp,
            &mut self.fluorometer,
            &mut self.ctd,
            &mut self.battery,
            &mut self.clock,
            &mut self.usbl,
            &mut self.data_sheet,
            &mut self.lower_adcp,
        ]
    }

    /// Lets one tick go by.
    pub fn step(&mut self, step: &Step, world: &World, faults: &mut Faults) {
        self.navigation.step(step, world, faults);
    }

    /// Has the navigation hear what the vehicle is told at a tick, faults and all.
    pub fn hear(&mut self, told: &[Sample]) {
        self.navigation.hear(told);
    }

    /// How far it is off, of a hull in a state.
    pub fn navigation_errors(&self, state: &State) -> Option<NavigationErrors> {
        self.navigation.errors(state)
    }

    /// What the autopilot of a hull in a state goes by, where that is not the truth.
    pub fn misjudged(&self, state: &State) -> Option<Misjudged> {
        self.navigation.misjudged(state)
    }

    /// What the navigation has noticed since this was last asked.
    pub fn take_notices(&mut self) -> Vec<String> {
        self.navigation.take_notices()
    }

    /// Adds what they tell at a tick.
    pub fn measure(&mut self, around: &mut Surroundings, snapshot: &mut Snapshot) {
        around.compass = self.navigation.compass(around.tick, around.truth.heading);
        around.believed = self.navigation.belief(around.truth.position);
        self.in_order().into_iter().for_each(|instrument| instrument.measure(around, snapshot));
        self.player.play(around.tick, &mut snapshot.samples);
    }

    /// Where the vehicle believes to be when it is at a place.
    pub fn position(&self, truth: Point) -> Point {
        self.navigation.belief(truth).position
    }

    /// The flow that the vehicle knows of, m/s toward.
    pub fn flow(&self) -> Vector {
        self.adcp.last_sample()
    }

    /// Where the chemical sensor's intake is on a vehicle that moves so, and its height above the bottom (m).
    pub fn intake(&self, motion: &Motion, world: &World) -> (Point, f64) {
        self.fluorometer.intake(motion.position, motion.heading, motion.depth, world)
    }
}

/// What tells something of its surroundings.
trait Instrument {
    /// Adds to a snapshot what it tells at a tick.
    fn measure(&mut self, around: &mut Surroundings, snapshot: &mut Snapshot);
}

/// One that a vehicle may not have.
impl<T: Instrument> Instrument for Option<T> {
    fn measure(&mut self, around: &mut Surroundings, snapshot: &mut Snapshot) {
        if let Some(instrument) = self {
            instrument.measure(around, snapshot);
        }
    }
}

/// What there is to be measured at a tick.
pub(crate) struct Surroundings<'a> {
    pub tick: u64,
    pub world: &'a mut World,
    pub truth: &'a Truth,
    /// Where the chemical sensor's intake is, and its height above the bottom, m.
    pub intake: (Point, f64),
    /// The vehicle's velocity over ground, m/s.
    pub ground_velocity: Vector,
    /// What a fault adds to the flow, m/s toward.
    pub current: Vector,
    /// The battery's charge, share of a full one.
    pub charge: f64,
    /// Where the compass says that the nose points: others turn by it.
    pub compass: Heading,
    /// Where the vehicle believes to be.
    pub believed: Estimate,
}

impl Surroundings<'_> {
    /// Seconds since tick 0.
    fn time_s(&self) -> f64 {
        self.tick as f64 * TICK_S
    }
}
