//! Inertial navigation with the filter of 15 states, which watches whether its instruments agree with it.

mod agreement;
mod ellipse;
mod liveliness;

pub use ellipse::ErrorEllipse;

use super::Departure;
use crate::navigator::{Estimate, Fix, Navigator, Raw, Sensed};
use crate::ukf::{Aiding, Imu, Innovation, Ins15, Ins15Gates, Ins15Setup, InsState, UkfError};
use agreement::{Agreement, Turn};
use albacore_geometry::Point;
use liveliness::Liveliness;
use serde::Deserialize;

/// 99.9 % of the chi-square distribution, for 1, 2, 3 and 5 degrees of freedom: what is beyond is held back.
const GATE_1: f64 = 10.83;
const GATE_2: f64 = 13.82;
const GATE_3: f64 = 16.27;
const GATE_5: f64 = 20.52;
/// So many fixes in a row confirm the position.
const CONFIRMED_FIXES: u32 = 5;
/// No vehicle of ours turns faster, rad/s, nor feels more, m/s2.
const TURN_MAX: f64 = 5.0;
const FORCE_MAX: f64 = 50.0;
/// Silence is told of after so long, s: of the inertial unit, and of the Doppler log.
const UNIT_SILENT_S: f64 = 1.0;
const LOG_SILENT_S: f64 = 10.0;
/// When no velocity was told for so long, s, ranges are believed to this at best, m.
const UNTOLD_S: f64 = 2.0;
const UNTOLD_RANGE_SIGMA: f64 = 0.003;
/// A fix is never believed to less than this, m.
const FIX_SIGMA_MIN: f64 = 0.01;

/// Where an instrument goes on disagreeing the filter may be the one that is wrong, in anything: it becomes so unsure.
const DOUBT: InsState = InsState {
    attitude: [0.1, 0.1, 0.5],
    gyro_bias: [0.03; 3],
    position: [10.0, 10.0, 1.0],
    velocity: [0.5; 3],
    accelerometer_bias: [0.1; 3],
};
/// What is told of an instrument that does.
const DISAGREES: &str = "disagrees";
/// Where it is the transponder's place that disagrees, its next signal finds that anew, m.
const LOST: f64 = 1000.0;

/// The instruments that the filter takes, as they are told of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Source {
    Attitude,
    Pressure,
    Velocity,
    Model,
    Receivers,
    Fixes,
}

impl Source {
    const ALL: [Source; 6] =
        [Source::Attitude, Source::Pressure, Source::Velocity, Source::Model, Source::Receivers, Source::Fixes];

    /// Numbers of a sample.
    const fn freedoms(self) -> u8 {
        match self {
            Source::Pressure => 1,
            Source::Fixes => 2,
            Source::Attitude | Source::Velocity | Source::Model => 3,
            Source::Receivers => 5,
        }
    }

    const fn name(self) -> &'static str {
        match self {
            Source::Attitude => "attitude",
            Source::Pressure => "pressure",
            Source::Velocity => "Doppler log",
            Source::Model => "model",
            Source::Receivers => "transponder",
            Source::Fixes => "fixes",
        }
    }
}

/// Normalised innovations squared of what came last, each a mean over its numbers: 1 on average where the filter is right. None where
/// nothing came.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Nis {
    /// Of the attitude, 3 numbers.
    pub attitude: Option<f64>,
    /// Of the pressure, 1.
    pub pressure: Option<f64>,
    /// Of the velocity, 3.
    pub velocity: Option<f64>,
    /// Of the times of arrival, 5.
    pub arrival: Option<f64>,
}

/// What it is told beside its instruments.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Settings {
    /// How well the start is known, m an axis: a standard deviation, more than 0.
    pub start: f64,
    /// What ranges to a transponder may be off beside the noise of the receivers, m: a standard deviation.
    pub range_error: f64,
    /// Whether the hull's own equations give the velocity while the Doppler log is silent.
    pub model: bool,
    /// Whether the velocity is known to be one of which the hull is capable, while nothing tells it.
    pub bounded: bool,
}

/// The navigator of a vehicle with an inertial unit, and with what aids it: attitude, pressure, velocity, a transponder, fixes.
///
/// A sample whose normalised innovation squared is beyond 99.9 % of what is to be expected is held back. An instrument whose samples are
/// held back for 5 s, or scatter more than they may over a minute, is told of. If its samples are held back the filter becomes unsure of itself
/// and gives way, for it may be the one that is wrong. That the instrument agrees then proves nothing: the doubt stays until fixes confirm the
/// position. An instrument that tells the same to the bit is stuck, and is not heard.
#[derive(Clone, Debug)]
pub struct Inertial {
    filter: Ins15,
    /// s since the beginning.
    time: f64,
    /// Rates of turn without their bias, rad/s, body; none while nothing tells them.
    rates: Option<[f64; 3]>,
    gyro: Liveliness<3>,
    accelerometer: Liveliness<3>,
    lively: Lively,
    /// Of each source, in their order.
    agreements: [Agreement; Source::ALL.len()],
    /// When a velocity was told last, s.
    moved: f64,
    /// Of a time of arrival, while a velocity is told, s.
    arrival_sigma: f64,
    /// So many fixes in a row were believed.
    confirmed: u32,
    nis: Nis,
    notices: Vec<String>,
}

impl Inertial {
    /// Begins with a state, and the standard deviations of its errors.
    ///
    /// # Errors
    ///
    /// Those of [`Ins15::new`].
    pub fn new(departure: &Departure, settings: &Settings) -> Result<Self, UkfError> {
        let Departure { state, sigma, setup, .. } = departure;
        let doubted = settings.range_error / setup.sound_speed;
        let arrival_sigma = (setup.arrival_sigma * setup.arrival_sigma + doubted * doubted).sqrt();
        let gates = Ins15Gates {
            attitude: Some(GATE_3),
            pressure: Some(GATE_1),
            velocity: Some(GATE_3),
            arrival: Some(GATE_5),
        };
        Ok(Inertial {
            filter: Ins15::new(
                Ins15Setup { gates, arrival_sigma, finds: true, complete_noise: true, ..*setup },
                state,
                sigma,
            )?,
            time: 0.0,
            rates: None,
            gyro: Liveliness::of("gyroscope", false, Some(UNIT_SILENT_S)),
            accelerometer: Liveliness::of("accelerometer", false, Some(UNIT_SILENT_S)),
            lively: Lively::new(departure),
            agreements: Source::ALL.map(|source| Agreement::of(source.freedoms())),
            moved: 0.0,
            arrival_sigma,
            confirmed: 0,
            nis: Nis::default(),
            notices: Vec::new(),
        })
    }

    /// What it believes.
    pub fn state(&self) -> InsState {
        self.filter.state()
    }

    /// The standard deviations of the errors to expect.
    pub fn sigma(&self) -> InsState {
        self.filter.sigma()
    }

    /// The ellipse of standard deviations about the position north and east.
    pub fn ellipse(&self) -> ErrorEllipse {
        let [north, east, both] = self.filter.place_covariance();
        ErrorEllipse::of(north, east, both)
    }

    /// The error of a state by the covariance: 15 on average where the filter is right.
    pub fn nees(&self, error: &[f64; 15]) -> f64 {
        self.filter.filter().normalised(&(*error).into())
    }

    /// Rates of turn without their bias, rad/s, body; none while nothing tells them.
    pub fn rates(&self) -> Option<[f64; 3]> {
        self.rates
    }

    /// Of what came in the last step.
    pub fn nis(&self) -> &Nis {
        &self.nis
    }

    /// Whether an instrument disagrees now or did so until the filter gave way.
    pub fn is_contradicted(&self) -> bool {
        self.agreements.iter().any(Agreement::is_doubtful)
    }

    /// The same, or whether one is stuck, or tells nothing that it is needed for.
    pub fn is_doubted(&self) -> bool {
        self.is_contradicted() || self.gyro.is_told_of() || self.accelerometer.is_told_of() || self.lively.is_told_of()
    }

    /// The filter itself.
    pub fn filter(&self) -> &Ins15 {
        &self.filter
    }

    /// How fast sound is, m/s, from now on.
    pub fn hear_at(&mut self, sound_speed: f64) {
        self.filter.setup_mut().sound_speed = sound_speed;
    }

    /// A sample of the inertial unit, of some seconds.
    fn go_on(&mut self, gyro: Option<[f64; 3]>, accelerometer: Option<[f64; 3]>, time: f64) {
        self.time += time;
        let (gyro, accelerometer) = (possible(gyro, TURN_MAX), possible(accelerometer, FORCE_MAX));
        let gyro = self.gyro.believed(gyro, self.time, &mut self.notices);
        let accelerometer = self.accelerometer.believed(accelerometer, self.time, &mut self.notices);
        if self.filter.predict(&Imu { gyro, accelerometer }, time).is_err() {
            // A state that runs away: without what was measured it stays where it is.
            let _ = self.filter.predict(&Imu::default(), time);
        }
        let bias = self.filter.state().gyro_bias;
        self.rates = gyro.map(|gyro| std::array::from_fn(|i| gyro[i] - bias[i]));
    }

    /// What aids it at the moment to which it has gone on.
    fn aid(&mut self, aiding: &Aiding) {
        let aiding = self.lively.believed(aiding, self.time, &mut self.notices);
        self.weigh_ranges(&aiding);
        let told = self.filter.aid(&aiding);
        self.nis = Nis {
            attitude: told.attitude.and_then(|told| self.judge(Source::Attitude, told)),
            pressure: told.pressure.and_then(|told| self.judge(Source::Pressure, told)),
            velocity: told.velocity.and_then(|told| self.judge(Source::Velocity, told)),
            arrival: told.arrival.and_then(|told| self.judge(Source::Receivers, told)),
        };
        if let Some(told) = told.modelled {
            // Its noise is no white one, and its innovations tell nothing of the filter.
            self.judge(Source::Model, told);
        }
    }

    /// Without a velocity, ranges are believed less: taken for what they are, to a millimetre, they turn the estimate about the transponder, which
    /// nothing in them can tell.
    fn weigh_ranges(&mut self, aiding: &Aiding) {
        if aiding.velocity.or(aiding.modelled).is_some() {
            self.moved = self.time;
        }
        let is_told = self.time - self.moved <= UNTOLD_S;
        let doubt = if is_told { 0.0 } else { UNTOLD_RANGE_SIGMA / self.filter.setup_mut().sound_speed };
        self.filter.setup_mut().arrival_sigma = (self.arrival_sigma * self.arrival_sigma + doubt * doubt).sqrt();
    }

    /// What a measurement tells of its instrument and of the filter; its normalised innovation squared, of each number.
    fn judge<const M: usize>(&mut self, source: Source, told: Result<Innovation<M>, UkfError>) -> Option<f64> {
        let (time, nis) = (self.time, told.ok().map(|innovation| innovation.nis));
        let held_back = told.is_ok_and(|innovation| innovation.gated) || told.is_err();
        let agreement = &mut self.agreements[source as usize];
        let turn = agreement.take(time, nis, held_back);
        let gives_way = held_back && agreement.has_persisted();
        match turn {
            Turn::Same => {}
            Turn::Disagrees => self.notices.push(notice(true, source.name(), DISAGREES)),
            Turn::Agrees => self.notices.push(format!(
                "navigation: {} agrees again; which was wrong is not known, and the position is doubtful until fixes confirm it",
                source.name()
            )),
        }
        if gives_way {
            let [_, _, down] = DOUBT.position;
            let lost = InsState { position: [LOST, LOST, down], ..DOUBT };
            let _ = self.filter.doubt(if source == Source::Receivers { &lost } else { &DOUBT });
        }
        nis.map(|nis| nis / M as f64)
    }

    /// Fixes, which come from elsewhere, agree with all: what was doubtful is not any more.
    fn confirm(&mut self) {
        for (agreement, source) in self.agreements.iter_mut().zip(Source::ALL) {
            if agreement.confirm() {
                self.notices.push(notice(false, source.name(), DISAGREES));
            }
        }
    }
}

/// The instruments that aid, as far as they live.
#[derive(Clone, Debug)]
struct Lively {
    attitude: Liveliness<3>,
    pressure: Liveliness<1>,
    velocity: Liveliness<3>,
    receivers: Liveliness<5>,
}

impl Lively {
    fn new(departure: &Departure) -> Self {
        Lively {
            attitude: Liveliness::of(Source::Attitude.name(), false, None),
            pressure: Liveliness::of(Source::Pressure.name(), departure.exact_pressure, None),
            velocity: Liveliness::of(Source::Velocity.name(), departure.exact_velocity, Some(LOG_SILENT_S)),
            receivers: Liveliness::of(Source::Receivers.name(), false, None),
        }
    }

    /// Whether one is stuck.
    fn is_told_of(&self) -> bool {
        self.attitude.is_told_of()
            || self.pressure.is_told_of()
            || self.velocity.is_told_of()
            || self.receivers.is_told_of()
    }

    /// What of it can be believed.
    fn believed(&mut self, aiding: &Aiding, now: f64, notices: &mut Vec<String>) -> Aiding {
        let Aiding { attitude, pressure, velocity, arrival, .. } = *aiding;
        let value = self.velocity.believed(velocity.map(|told| told.value), now, notices);
        Aiding {
            attitude: self.attitude.believed(attitude, now, notices),
            pressure: self.pressure.believed(pressure.map(|told| [told]), now, notices).map(|[told]| told),
            velocity: velocity.filter(|_| value.is_some()),
            arrival: self.receivers.believed(arrival, now, notices),
            ..*aiding
        }
    }
}

/// A sample of which no number is beyond what can be.
fn possible(sample: Option<[f64; 3]>, most: f64) -> Option<[f64; 3]> {
    sample.filter(|sample| sample.iter().all(|x| x.abs() <= most))
}

/// What is told of an instrument of the navigation.
fn notice(begins: bool, what: &str, how: &str) -> String {
    format!("{}: navigation: {what} {how}", if begins { "detected" } else { "again well" })
}

impl Navigator for Inertial {
    /// Its way comes from its own instruments.
    fn predict(&mut self, _: &Sensed, _: f64) {}

    fn update(&mut self, fix: &Fix) -> bool {
        let told =
            self.filter.take_fix([fix.position.north, fix.position.east], fix.sigma.max(FIX_SIGMA_MIN), Some(GATE_2));
        self.judge(Source::Fixes, told);
        let is_believed = told.is_ok_and(|innovation| !innovation.gated);
        self.confirmed = if is_believed { self.confirmed + 1 } else { 0 };
        if self.confirmed >= CONFIRMED_FIXES {
            self.confirm();
        }
        is_believed
    }

    fn sense(&mut self, raw: &Raw<'_>) {
        match *raw {
            Raw::Inertial { gyro, accelerometer, time } => self.go_on(gyro, accelerometer, time),
            Raw::Aiding(aiding) => self.aid(aiding),
        }
    }

    fn estimate(&self) -> Estimate {
        let [north, east, _] = self.filter.state().position;
        let [a, b, _] = self.filter.sigma().position;
        Estimate { position: Point::new(north, east), sigma: (0.5 * (a * a + b * b)).sqrt() }
    }

    fn inertial(&self) -> Option<&Inertial> {
        Some(self)
    }

    fn inertial_mut(&mut self) -> Option<&mut Inertial> {
        Some(self)
    }

    fn take_notices(&mut self) -> Vec<String> {
        std::mem::take(&mut self.notices)
    }

    fn boxed(&self) -> Box<dyn Navigator> {
        Box::new(self.clone())
    }
}
