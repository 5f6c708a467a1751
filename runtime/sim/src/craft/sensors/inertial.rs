//! The instruments of inertial navigation together: what they tell in a tick, and what a navigator is given of it.

use super::attitude::AttitudeGauge;
use super::dvl::Dvl;
use super::imu::InertialUnit;
use super::pressure::Pressure;
use super::raw::{RawSample, RawSensor};
use super::receivers::ReceiverArray;
use super::velocity_model::VelocityModel;
use super::{AttitudeSensor, Compass, Imu, InstrumentSetup};
use crate::craft::hull::{StartPose, State, Track, attitude_of};
use crate::craft::setup::HullSetup;
use crate::noise::Noise;
use crate::scenario::{ScenarioIssues, number};
use crate::world::World;
use crate::world::sound::sound_speed;
use crate::world::transponder::Transponder;
use albacore_geometry::{Attitude, Point, Vector, wrap_angle};
use albacore_navigation::ukf::{Aiding, Ins15Setup, InsState, Velocity};
use albacore_navigation::{Departure, Inertial, InertialSettings, Navigator, Raw};
use albacore_vehicle::rate::is_due;
use albacore_vehicle::{NAVIGATION_STATES, NavigationErrors, TICK_S};
use std::ops::RangeInclusive;

/// What is measured without noise counts as measured this well, m of water and m/s: a filter has to weigh it.
const DEPTH_SIGMA_MIN: f64 = 0.005;
const VELOCITY_SIGMA_MIN: f64 = 0.005;
/// A bias is not known better than this when a run begins, rad/s and m/s2.
const GYRO_BIAS_SIGMA_MIN: f64 = 1e-3;
const ACCELEROMETER_BIAS_SIGMA_MIN: f64 = 1e-2;
/// How well depth and velocity are known when a run begins, m and m/s.
const START_DEPTH_SIGMA: f64 = 0.1;
const START_VELOCITY_SIGMA: f64 = 0.5;
/// Sound in water is this fast, m/s: what a CTD tells otherwise is wrong.
const SOUND_SPEEDS: RangeInclusive<f64> = 1300.0..=1700.0;
/// A current is no faster than this where a vehicle swims, m/s.
const CURRENT_MAX: f64 = 1.0;
/// The velocity is bounded when nothing has told it for so many ticks, once in so many, and stays alike for so long, s.
const UNTOLD_TICKS: u64 = 50;
const BOUND_TICKS: u64 = 10;
const BOUND_STEADY_S: f64 = 100.0;

/// The instruments of a run.
#[derive(Clone, Debug)]
pub struct InertialSuite {
    unit: InertialUnit,
    attitude: AttitudeGauge,
    pressure: Pressure,
    pressure_noise: Noise,
    dvl: Dvl,
    dvl_noise: Noise,
    receivers: Option<ReceiverArray>,
    /// Whether sound is taken to be as fast as the CTD tells it.
    hears_by_ctd: bool,
    /// What a metre of water weighs on a square metre, Pa, and where the gauge is aboard, m, body.
    weight: f64,
    gauge: [f64; 3],
    /// What gives a velocity where the log is silent.
    model: Option<VelocityModel>,
    /// What bounds the velocity while nothing tells it, m/s.
    bound: Option<f64>,
    /// Ticks since something told it.
    untold: u64,
}

/// What the filter is told of the instruments of a scenario.
fn filter_setup(setup: &InstrumentSetup, world: &World, start: &StartPose) -> Ins15Setup {
    let told = Ins15Setup::default();
    let weight = told.density * told.gravity;
    let receivers = setup.inverted_usbl.as_ref();
    Ins15Setup {
        gyro_sigma: setup.imu.gyro_noise,
        accelerometer_sigma: setup.imu.accelerometer_noise,
        attitude_sigma: setup.attitude.sigma(),
        pressure_sigma: weight * setup.pressure.noise.max(DEPTH_SIGMA_MIN),
        arrival_sigma: receivers.map_or(told.arrival_sigma, |receivers| receivers.sigma()),
        // Without a CTD a vehicle goes by what was measured where and when it was launched.
        sound_speed: receivers.and_then(|receivers| receivers.sound_speed).unwrap_or_else(|| {
            let launched = |transponder: &Transponder| {
                transponder.sound_speed(world.stratification(), start.position, start.depth, 0.0)
            };
            world.transponder().map_or(told.sound_speed, launched)
        }),
        transponder: world.transponder().map_or(told.transponder, |transponder| transponder.place(0.0)),
        ..told
    }
}

/// What a navigator begins with: the start of a run as it is known, and the instruments. The errors of the start are drawn.
pub fn departure(setup: &InstrumentSetup, world: &World, start: &StartPose, start_sigma: f64, seed: u64) -> Departure {
    let imu = &setup.imu;
    let sigma = InsState {
        attitude: setup.attitude.sigma(),
        gyro_bias: [imu.gyro_bias.abs().max(GYRO_BIAS_SIGMA_MIN); 3],
        position: [start_sigma, start_sigma, START_DEPTH_SIGMA],
        velocity: [START_VELOCITY_SIGMA; 3],
        accelerometer_bias: [imu.accelerometer_bias.abs().max(ACCELEROMETER_BIAS_SIGMA_MIN); 3],
    };
    let noise = Noise::named(seed, "inertial start");
    let off = |truth: [f64; 3], sigma: [f64; 3], index: u64| {
        std::array::from_fn(|i| truth[i] + sigma[i] * noise.gaussian(index + i as u64))
    };
    let Point { north, east } = start.position;
    let state = InsState {
        attitude: off([0.0, 0.0, start.heading.radians()], sigma.attitude, 0),
        position: off([north, east, start.depth], sigma.position, 3),
        ..InsState::default()
    };
    Departure {
        position: start.position,
        state,
        sigma,
        setup: filter_setup(setup, world, start),
        exact_pressure: setup.pressure.noise == 0.0,
        exact_velocity: setup.dvl.noise == 0.0,
    }
}

impl InertialSuite {
    /// Those of a run.
    pub fn new(setup: &InstrumentSetup, hull: &HullSetup, settings: &InertialSettings, seed: u64) -> Self {
        let told = Ins15Setup::default();
        InertialSuite {
            unit: InertialUnit::new(&setup.imu, seed),
            attitude: AttitudeGauge::new(&setup.attitude, seed),
            pressure: setup.pressure.clone(),
            pressure_noise: Noise::named(seed, "raw pressure"),
            dvl: setup.dvl.clone(),
            dvl_noise: Noise::named(seed, "raw velocity"),
            receivers: setup.inverted_usbl.as_ref().map(|own| ReceiverArray::new(own, told.receivers, seed)),
            hears_by_ctd: setup.ctd.is_some()
                && setup.inverted_usbl.as_ref().is_some_and(|receivers| receivers.sound_speed.is_none()),
            weight: told.density * told.gravity,
            gauge: told.pressure_sensor,
            model: VelocityModel::new(hull).filter(|_| settings.model),
            bound: settings.bounded.then(|| hull.speed_max() + CURRENT_MAX),
            untold: 0,
        }
    }

    /// Adds what they tell in a tick in which the hull moved so and came to an altitude, m.
    pub fn measure(&self, tick: u64, track: &Track, altitude: f64, world: &World, raw: &mut Vec<RawSample>) {
        self.unit.measure(tick, track, raw);
        let Some(state) = track.states.last() else { return };
        let step = self.unit.samples().0.saturating_sub(1) as u16;
        self.attitude.measure(tick, state, step, raw);
        self.measure_depth(tick, state, step, altitude, world, raw);
        self.measure_velocity(tick, state, step, altitude, raw);
        if let Some(receivers) = &self.receivers {
            receivers.measure(tick, state, step, world, raw);
        }
    }

    /// Eq. (8), as metres of water.
    fn measure_depth(
        &self,
        tick: u64,
        state: &State,
        step: u16,
        altitude: f64,
        world: &World,
        raw: &mut Vec<RawSample>,
    ) {
        let s = &self.pressure;
        if !is_due(s.rate, tick) {
            return;
        }
        let [north, east, depth, _, _, _] = state.pose.into();
        let [_, _, below] = attitude_of(&state.pose).to_ned(self.gauge);
        let waves = world.wave_head(Point::new(north, east), altitude, tick as f64 * TICK_S);
        let told = depth + below + waves + s.bias + s.noise * self.pressure_noise.gaussian(tick);
        raw.push(RawSample::new(RawSensor::Pressure, step, [told]));
    }

    /// Eq. (9).
    fn measure_velocity(&self, tick: u64, state: &State, step: u16, altitude: f64, raw: &mut Vec<RawSample>) {
        let s = &self.dvl;
        if !is_due(s.rate, tick) || s.range.is_some_and(|range| altitude > range) {
            return;
        }
        let bias = [s.bias, 0.0, 0.0];
        let told = |i: usize| state.velocity[i] + bias[i] + s.noise * self.dvl_noise.gaussian(3 * tick + i as u64);
        raw.push(RawSample::new(RawSensor::DopplerLog, step, std::array::from_fn::<f64, 3, _>(told)));
    }

    /// Has a navigator go by the water that its CTD tells of, temperature (degrees Celsius) and practical salinity, where it goes by that.
    pub fn hear(&self, navigator: &mut Inertial, temperature: f64, salinity: f64) {
        let sound = sound_speed(temperature, salinity, navigator.state().position[2]);
        if self.hears_by_ctd && SOUND_SPEEDS.contains(&sound) {
            navigator.hear_at(sound);
        }
    }

    /// How far a navigator is off, of a hull in a state.
    pub fn errors(&self, navigator: &Inertial, state: &State) -> NavigationErrors {
        let (gyro_bias, accelerometer_bias) = self.unit.biases();
        let [north, east, down, roll, pitch, yaw] = state.pose.into();
        let [u, v, w, ..] = std::array::from_fn::<f64, 6, _>(|i| state.velocity[i]);
        let truth = InsState {
            attitude: [roll, pitch, yaw],
            gyro_bias: [gyro_bias; 3],
            position: [north, east, down],
            velocity: [u, v, w],
            accelerometer_bias: [accelerometer_bias; 3],
        };
        let (believed, sigma) = (numbers(&navigator.state()), numbers(&navigator.sigma()));
        let truth = numbers(&truth);
        let mut error = std::array::from_fn(|i| believed[i] - truth[i]);
        error[2] = wrap_angle(error[2]);
        let nis = navigator.nis();
        NavigationErrors {
            error,
            sigma,
            north_east: navigator.filter().place_covariance()[2],
            nees: navigator.nees(&error) / NAVIGATION_STATES as f64,
            nis: [nis.attitude, nis.pressure, nis.velocity, nis.arrival],
            doubted: navigator.is_doubted(),
        }
    }

    /// Once a second, when the velocity has not been told for a while: that the vehicle is no faster than it can be. It is the same for long,
    /// and so each time tells little.
    fn bounded(&self, tick: u64) -> Option<Velocity> {
        let bound = self.bound.filter(|_| self.untold > UNTOLD_TICKS && tick.is_multiple_of(BOUND_TICKS))?;
        let variance = bound * bound / 3.0 * BOUND_STEADY_S;
        Some(Velocity { value: [0.0; 3], noise: diagonal(variance) })
    }

    /// Gives a navigator the samples of a tick as they came, in which the hull moved so.
    pub fn feed(&mut self, tick: u64, samples: &[RawSample], track: &Track, navigator: &mut dyn Navigator) {
        let (steps, time) = self.unit.samples();
        for step in 0..steps {
            let of = |sensor| samples.iter().find(|s| s.sensor == sensor && usize::from(s.step) == step);
            let gyro = of(RawSensor::Gyroscope).map(RawSample::array);
            let accelerometer = of(RawSensor::Accelerometer).map(RawSample::array);
            navigator.sense(&Raw::Inertial { gyro, accelerometer, time });
        }
        let last = |sensor| samples.iter().rfind(|s| s.sensor == sensor);
        let sigma = self.dvl.noise.max(VELOCITY_SIGMA_MIN);
        let variance = sigma * sigma;
        let noise = diagonal(variance);
        let measured = last(RawSensor::DopplerLog).map(|sample| Velocity { value: sample.array(), noise });
        let modelled = match (&mut self.model, navigator.inertial()) {
            (Some(model), Some(inertial)) => {
                model.step(track, inertial, measured.is_some());
                model.velocity(tick, inertial)
            }
            _ => None,
        };
        self.untold = if measured.or(modelled).is_some() { 0 } else { self.untold + 1 };
        let aiding = Aiding {
            attitude: last(RawSensor::Attitude).map(RawSample::array),
            pressure: last(RawSensor::Pressure).map(|sample| self.weight * sample.array::<1>()[0]),
            velocity: measured,
            modelled,
            bounded: self.bounded(tick),
            arrival: self.receivers.as_ref().and_then(|receivers| {
                last(RawSensor::Receivers).map(|sample| sample.array::<5>().map(|told| receivers.expected(told)))
            }),
        };
        navigator.sense(&Raw::Aiding(&aiding));
    }
}

/// What of them cannot be, aboard a hull.
pub(super) fn check(setup: &InstrumentSetup, has_transponder: bool, hull: &HullSetup, issues: &mut ScenarioIssues) {
    let steps = hull.steps();
    let receivers = setup.inverted_usbl.is_some();
    issues.of("inverted_usbl").unless(
        None,
        !receivers || has_transponder,
        "these receivers hear nothing: the scenario has no `transponder`",
        "add `transponder(at: …)` to the scenario, or leave `inverted_usbl` out",
    );
    if setup.inertial().is_none() {
        let mend = "write `navigation(inertial())`, or leave this out";
        issues.of("inverted_usbl").unless(None, !receivers, "no navigator takes what these receivers hear", mend);
        issues.of("imu").unless(None, setup.imu == Imu::default(), "no navigator takes what this unit feels", mend);
        let is_there = setup.attitude != AttitudeSensor::default();
        issues.of("attitude").unless(None, !is_there, "no navigator takes what this sensor tells", mend);
        return;
    }
    let samples = setup.imu.samples();
    issues.of("imu").unless(
        Some("rate"),
        (steps as usize).is_multiple_of(samples) && (setup.imu.rate * TICK_S - samples as f64).abs() < 1e-9,
        format!(
            "the hull moves in {steps} steps a tick of 100 ms: an inertial unit of {} Hz does not go into them",
            number(setup.imu.rate)
        ),
        "take a rate such as 10, 50 or 100 Hz, or another `step` of the hull",
    );
    let models = setup.inertial().is_some_and(|inertial| inertial.model);
    issues.of("navigation").unless(
        None,
        !models || VelocityModel::new(hull).is_some(),
        "a `kinematic` vehicle has no equations that could give a velocity",
        "leave `model` of `inertial` out, or let the vehicle be a `fossen` or a `prestero`",
    );
    issues.of("compass").unless(
        None,
        setup.compass == Compass::default(),
        "an inertial navigator has no use for a compass: its heading is that of the `attitude` sensor",
        "write `attitude(yaw_noise: …)` instead",
    );
}

/// The covariance of three independent errors of one variance.
fn diagonal(variance: f64) -> [[f64; 3]; 3] {
    [[variance, 0.0, 0.0], [0.0, variance, 0.0], [0.0, 0.0, variance]]
}

/// The states in the order of [`NavigationErrors`].
fn numbers(state: &InsState) -> [f64; NAVIGATION_STATES] {
    let parts = [state.attitude, state.gyro_bias, state.position, state.velocity, state.accelerometer_bias];
    std::array::from_fn(|i| parts[i / 3][i % 3])
}

/// The velocity over ground that an inertial navigator believes, m/s toward.
pub fn ground_velocity(state: &InsState) -> Vector {
    let [roll, pitch, yaw] = state.attitude;
    let [north, east, _] = Attitude::of(roll, pitch, yaw).to_ned(state.velocity);
    Vector::new(north, east)
}
