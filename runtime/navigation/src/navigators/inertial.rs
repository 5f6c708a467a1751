//! Inertial navigation with the filter of 15 states, which watches whether its instruments agree with it.

mod agreement;

use super::Departure;
use crate::navigator::{Estimate, Fix, Navigator, Raw, Sensed};
use crate::ukf::{Aiding, Imu, Innovation, Ins15, Ins15Gates, Ins15Setup, InsState, UkfError};
use agreement::{Agreement, Turn};
use albacore_geometry::Point;
use albacore_geometry::math::PI;
use serde::Deserialize;

/// 99.9 % of the chi-square distribution, for 1, 2, 3 and 5 degrees of freedom: what is beyond is held back.
const GATE_1: f64 = 10.83;
const GATE_2: f64 = 13.82;
const GATE_3: f64 = 16.27;
const GATE_5: f64 = 20.52;
/// So many samples of an inertial unit that are the same to the bit: it is stuck. White noise never is.
const STUCK_SAMPLES: u32 = 5;
/// A unit that tells nothing, or the same, for so long is told of, s.
const SILENT_S: f64 = 1.0;
/// Another position counts as told lately for so long, s.
const LATELY_S: f64 = 30.0;
/// A fix is never believed to less than this, m.
const FIX_SIGMA_MIN: f64 = 0.01;

/// What an instrument that goes on disagreeing may be right in: the filter becomes so unsure of it.
const ATTITUDE_DOUBT: InsState = InsState { attitude: [0.3, 0.3, PI / 4.0], gyro_bias: [0.05; 3], ..NO_DOUBT };
const DEPTH_DOUBT: InsState = InsState { position: [0.0, 0.0, 2.0], ..NO_DOUBT };
const VELOCITY_DOUBT: InsState = InsState { velocity: [0.5; 3], accelerometer_bias: [0.1; 3], ..NO_DOUBT };
const PLACE_DOUBT: InsState = InsState { position: [30.0, 30.0, 0.0], ..NO_DOUBT };
/// Its next signal finds the place anew.
const LOST_DOUBT: InsState = InsState { position: [1000.0, 1000.0, 0.0], ..NO_DOUBT };
const NO_DOUBT: InsState = InsState {
    attitude: [0.0; 3],
    gyro_bias: [0.0; 3],
    position: [0.0; 3],
    velocity: [0.0; 3],
    accelerometer_bias: [0.0; 3],
};

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
/// held back for 5 s, or scatter more than they may over a minute, is told of; then the filter becomes less sure of what that instrument
/// measures, so that it can follow if it was wrong itself. It tells when they agree again.
#[derive(Clone, Debug)]
pub struct Inertial {
    filter: Ins15,
    /// s since the beginning.
    time: f64,
    /// Rates of turn without their bias, rad/s, body, as they were believed last.
    rates: [f64; 3],
    gyro: Unit,
    accelerometer: Unit,
    attitude: Agreement,
    pressure: Agreement,
    velocity: Agreement,
    model: Agreement,
    receivers: Agreement,
    fixes: Agreement,
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
            filter: Ins15::new(Ins15Setup { gates, arrival_sigma, finds: true, complete_noise: true, ..*setup }, state, sigma)?,
            time: 0.0,
            rates: [0.0; 3],
            gyro: Unit::new("gyroscope"),
            accelerometer: Unit::new("accelerometer"),
            attitude: Agreement::of(3),
            pressure: Agreement::of(1),
            velocity: Agreement::of(3),
            model: Agreement::of(3),
            receivers: Agreement::of(5),
            fixes: Agreement::of(2),
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

    /// The error of a state by the covariance: 15 on average where the filter is right.
    pub fn nees(&self, error: &[f64; 15]) -> f64 {
        self.filter.filter().normalised(&(*error).into())
    }

    /// Rates of turn without their bias, rad/s, body.
    pub fn rates(&self) -> [f64; 3] {
        self.rates
    }

    /// Of what came in the last step.
    pub fn nis(&self) -> &Nis {
        &self.nis
    }

    /// Whether an instrument disagrees now, or the inertial unit tells nothing.
    pub fn is_doubted(&self) -> bool {
        let disagrees = [&self.attitude, &self.pressure, &self.velocity, &self.model, &self.receivers, &self.fixes];
        disagrees.into_iter().any(Agreement::disagrees) || self.gyro.is_silent || self.accelerometer.is_silent
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
        let gyro = self.gyro.believed(gyro, self.time, time, &mut self.notices);
        let accelerometer = self.accelerometer.believed(accelerometer, self.time, time, &mut self.notices);
        if self.filter.predict(&Imu { gyro, accelerometer }, time).is_err() {
            // A state that runs away: without what was measured it stays where it is.
            let _ = self.filter.predict(&Imu::default(), time);
        }
        let bias = self.filter.state().gyro_bias;
        if let Some(gyro) = gyro {
            self.rates = std::array::from_fn(|i| gyro[i] - bias[i]);
        }
    }

    /// What aids it at the moment to which it has gone on.
    fn aid(&mut self, aiding: &Aiding) {
        let told = self.filter.aid(aiding);
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

    fn agreement(&mut self, source: Source) -> &mut Agreement {
        match source {
            Source::Attitude => &mut self.attitude,
            Source::Pressure => &mut self.pressure,
            Source::Velocity => &mut self.velocity,
            Source::Model => &mut self.model,
            Source::Receivers => &mut self.receivers,
            Source::Fixes => &mut self.fixes,
        }
    }

    /// What a measurement tells of its instrument and of the filter; its normalised innovation squared, of each number.
    fn judge<const M: usize>(&mut self, source: Source, told: Result<Innovation<M>, UkfError>) -> Option<f64> {
        let (time, nis) = (self.time, told.ok().map(|innovation| innovation.nis));
        let held_back = told.is_ok_and(|innovation| innovation.gated) || told.is_err();
        let is_placed = self.receivers.agrees_lately(time, LATELY_S) || self.fixes.agrees_lately(time, LATELY_S);
        let agreement = self.agreement(source);
        let turn = agreement.take(time, nis, held_back);
        let is_lost = held_back && agreement.has_persisted();
        match turn {
            Turn::Same => {}
            Turn::Disagrees => self.tell(true, source.name(), "disagrees"),
            Turn::Agrees => self.tell(false, source.name(), "disagrees"),
        }
        if is_lost {
            let doubt = match source {
                Source::Attitude => ATTITUDE_DOUBT,
                Source::Pressure => DEPTH_DOUBT,
                // A log that disagrees while positions agree is the one that is wrong.
                Source::Velocity | Source::Model if is_placed => NO_DOUBT,
                Source::Velocity | Source::Model => VELOCITY_DOUBT,
                Source::Receivers => LOST_DOUBT,
                Source::Fixes => PLACE_DOUBT,
            };
            let _ = self.filter.doubt(&doubt);
        }
        nis.map(|nis| nis / M as f64)
    }

    fn tell(&mut self, begins: bool, what: &str, how: &str) {
        self.notices.push(notice(begins, what, how));
    }
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
        told.is_ok_and(|innovation| !innovation.gated)
    }

    fn sense(&mut self, raw: &Raw) {
        match *raw {
            Raw::Inertial { gyro, accelerometer, time } => self.go_on(gyro, accelerometer, time),
            Raw::Aiding(ref aiding) => self.aid(aiding),
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

/// Three gyroscopes or three accelerometers.
#[derive(Clone, Debug)]
struct Unit {
    name: &'static str,
    last: [f64; 3],
    /// How often the last sample has come again.
    same: u32,
    /// When something came last that can be believed, s.
    heard: f64,
    is_silent: bool,
}

impl Unit {
    fn new(name: &'static str) -> Self {
        Unit { name, last: [f64::NAN; 3], same: 0, heard: 0.0, is_silent: false }
    }

    /// A sample that can be believed, at a time, s.
    fn believed(
        &mut self,
        sample: Option<[f64; 3]>,
        now: f64,
        step: f64,
        notices: &mut Vec<String>,
    ) -> Option<[f64; 3]> {
        let sample = sample.filter(|sample| sample.iter().all(|x| x.is_finite()));
        if let Some(sample) = sample {
            self.same = if sample == self.last { self.same.saturating_add(1) } else { 0 };
            self.last = sample;
        }
        let believed = sample.filter(|_| self.same < STUCK_SAMPLES);
        if believed.is_some() {
            // What comes now and then is silent between.
            let was_away = now - self.heard > 2.0 * step + SILENT_S;
            self.heard = now;
            if self.is_silent && !was_away {
                self.is_silent = false;
                notices.push(notice(false, self.name, "silent"));
            }
        } else if !self.is_silent && now - self.heard > SILENT_S {
            self.is_silent = true;
            let how = if self.same >= STUCK_SAMPLES { "stuck" } else { "silent" };
            notices.push(notice(true, self.name, how));
        }
        believed
    }
}
