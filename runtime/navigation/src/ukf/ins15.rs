//! Inertial navigation with 15 states, aided by what comes at other rates: the filter of Jayasiri et al. 2016.
//!
//! Frames: north-east-down, and the body's own, x forward, y to starboard, z down. Of the paper's frames none makes its Eq. (4) and
//! Eq. (8) both true; here z is down in both, so that gravity as the accelerometers feel it at rest is (0, 0, -g), and pressure grows
//! with z. Prediction is Euler's method on Eq. (14), once for each sample of the inertial unit.

mod attitude;
mod bearing;
mod kinematics;
mod setup;

pub use setup::{Ins15Gates, Ins15Setup};

use super::component::Component;
use super::filter::{Innovation, Measurement, Ukf, UkfError};
use attitude::Trigonometry;
use bearing::Bearing;
use kinematics::{ATTITUDE, POSITION, StepSigmas, VELOCITY, add_turned, at_rest, derivative, part, process_noise};
use nalgebra::{SMatrix, SVector, Vector3};

/// The 15 states, Eq. (15); also the standard deviations of their errors.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct InsState {
    /// Roll, pitch and yaw (zyx), rad.
    pub attitude: [f64; 3],
    /// What the gyroscopes tell at rest, rad/s, body.
    pub gyro_bias: [f64; 3],
    /// North, east and down, m.
    pub position: [f64; 3],
    /// Over ground, m/s, body.
    pub velocity: [f64; 3],
    /// What the accelerometers tell too much, m/s2, body.
    pub accelerometer_bias: [f64; 3],
}

/// A sample of the inertial unit, Eq. (4) and (6). Without one of its parts the filter goes on as if the vehicle did not turn, or kept its
/// velocity in the body's frame, and grows less sure: by the `unmeasured` ones of [`Ins15Setup`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Imu {
    /// Rates of turn, rad/s, body.
    pub gyro: Option<[f64; 3]>,
    /// Specific force, m/s2, body: (0, 0, -g) at rest and level.
    pub accelerometer: Option<[f64; 3]>,
}

/// A velocity over ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Velocity {
    /// m/s, body.
    pub value: [f64; 3],
    /// The covariance of its noise, m2/s2.
    pub noise: [[f64; 3]; 3],
}

/// What came at one moment besides the inertial unit's sample; what did not come is left out.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Aiding {
    /// Roll, pitch and yaw, rad, Eq. (7).
    pub attitude: Option<[f64; 3]>,
    /// Pressure above the atmosphere's, Pa, Eq. (8).
    pub pressure: Option<f64>,
    /// Of a Doppler log, Eq. (9).
    pub velocity: Option<Velocity>,
    /// Of the hull's equations, Eq. (10), with the noise of Eq. (11).
    pub modelled: Option<Velocity>,
    /// What the velocity is known to be by nothing but what the hull can do: about 0.
    pub bounded: Option<Velocity>,
    /// How long the transponder's signal took to each receiver, s, Eq. (12): of all five, or none. A clock that counts down has half
    /// its period added.
    pub arrival: Option<[f64; 5]>,
}

/// What became of each measurement: none where there was none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Aided {
    /// Of the attitude, rad.
    pub attitude: Option<Result<Innovation<3>, UkfError>>,
    /// Of the pressure, Pa.
    pub pressure: Option<Result<Innovation<1>, UkfError>>,
    /// Of the velocity, m/s.
    pub velocity: Option<Result<Innovation<3>, UkfError>>,
    /// Of the modelled one, m/s.
    pub modelled: Option<Result<Innovation<3>, UkfError>>,
    /// Of the times of arrival, as ranges, m.
    pub arrival: Option<Result<Innovation<5>, UkfError>>,
}

/// For how long errors of attitude stay alike, s: some 30 s by Table 1, whose attitude sensor forgets what gyroscopes miss in that time.
const ALIKE_S: f64 = 30.0;
/// The place is not known where its standard deviation is more than this share of the range to the transponder.
const LOST: f64 = 0.1;

/// The filter of Sec. 3: Algorithm 1, lines 4 to 18.
#[derive(Clone, Debug, PartialEq)]
pub struct Ins15 {
    filter: Ukf<15>,
    setup: Ins15Setup,
}

impl Ins15 {
    /// Begins with a state, and the standard deviations of its errors.
    ///
    /// # Errors
    ///
    /// A spread that draws no points, a state that is not finite, deviations of 0.
    pub fn new(setup: Ins15Setup, start: &InsState, sigma: &InsState) -> Result<Self, UkfError> {
        let mut components = [Component::Line; 15];
        components[ATTITUDE + 2] = setup.yaw;
        let variances = sigma.to_vector().map(|sigma| sigma * sigma);
        let covariance = SMatrix::from_diagonal(&variances);
        Ok(Ins15 { filter: Ukf::new(start.to_vector(), &covariance, setup.spread, components)?, setup })
    }

    /// What the filter believes.
    pub fn state(&self) -> InsState {
        InsState::from_vector(self.filter.state())
    }

    /// The standard deviations of the errors to expect.
    pub fn sigma(&self) -> InsState {
        InsState::from_vector(&SVector::from_fn(|i, _| self.filter.variance(i).sqrt()))
    }

    /// The filter itself, with its states in the order of [`InsState`]'s fields.
    pub fn filter(&self) -> &Ukf<15> {
        &self.filter
    }

    /// The variances of north and of east, and the covariance of both, m2.
    pub fn place_covariance(&self) -> [f64; 3] {
        let covariance = self.filter.covariance();
        let (north, east) = (POSITION, POSITION + 1);
        [covariance[(north, north)], covariance[(east, east)], covariance[(north, east)]]
    }

    /// Goes on by the time, s, of which the sample is, Eq. (14) with the noise of Eq. (16) at the mean.
    ///
    /// # Errors
    ///
    /// A sample that is not finite, a covariance that is not positive definite. The filter is as it was.
    pub fn predict(&mut self, imu: &Imu, time: f64) -> Result<(), UkfError> {
        let (gyro, force) = (imu.gyro.map(Vector3::from), imu.accelerometer.map(Vector3::from));
        let setup = &self.setup;
        let mut angles = Trigonometry::default();
        let turn_sigma = if gyro.is_some() { [setup.gyro_sigma; 3] } else { setup.unmeasured_turn };
        let force_sigma = if force.is_some() { setup.accelerometer_sigma } else { setup.unmeasured_acceleration };
        let sigmas = StepSigmas { turn: turn_sigma, velocity: setup.velocity_sigma, acceleration: force_sigma };
        let mut noise = process_noise(angles.of(self.filter.state()), &sigmas, time);
        if setup.complete_noise {
            add_turned(
                &mut noise,
                angles.of(self.filter.state()),
                &part(self.filter.state(), VELOCITY),
                turn_sigma,
                time,
            );
            let unseen = self.unseen_way();
            (0..3).for_each(|axis| noise[(POSITION + axis, POSITION + axis)] += 2.0 * ALIKE_S * time * unseen[axis]);
        }
        let at_rest = at_rest(setup.gravity).into();
        let process = |state: &SVector<f64, 15>| {
            let angles = angles.of(state);
            let force = force.map(|force| force - Vector3::from(angles.to_body(at_rest)));
            state + derivative(state, angles, gyro.as_ref(), force.as_ref()) * time
        };
        self.filter.predict(process, &noise)
    }

    /// The variances of what errors of attitude and velocity make of each other in the velocity north, east and down, m2/s2: their products,
    /// which sigma points that lie on the axes of both do not see. They matter where the velocity is not known well, and the depth is told to a
    /// centimetre or a range to a millimetre.
    fn unseen_way(&self) -> [f64; 3] {
        let variance = |state: usize| self.filter.variance(state);
        let [ahead, aside] = [0, 1].map(|axis| variance(VELOCITY + axis));
        let level = variance(ATTITUDE + 2) * (ahead + aside);
        [level, level, variance(ATTITUDE + 1) * ahead + variance(ATTITUDE) * aside]
    }

    /// Becomes less sure of each state by a standard deviation: of one that measurements have contradicted.
    ///
    /// # Errors
    ///
    /// A deviation that is not finite. The filter is as it was.
    pub fn doubt(&mut self, sigma: &InsState) -> Result<(), UkfError> {
        let variances = sigma.to_vector().map(|sigma| sigma * sigma);
        self.filter.predict(|state| *state, &SMatrix::from_diagonal(&variances))
    }

    /// Takes a position, m north and east, with the standard deviation of its error, m an axis.
    ///
    /// # Errors
    ///
    /// A position that is not finite, or a covariance that is not positive definite. The filter is as it was.
    pub fn take_fix(&mut self, position: [f64; 2], sigma: f64, gate: Option<f64>) -> Result<Innovation<2>, UkfError> {
        let measurement =
            Measurement { value: position.into(), noise: diagonal([sigma; 2]), components: [Component::Line; 2], gate };
        self.filter.update(&measurement, |state| [state[POSITION], state[POSITION + 1]].into())
    }

    /// What the filter is told of the instruments, to be told otherwise: of a transponder whose signal another is heard from, say.
    pub fn setup_mut(&mut self) -> &mut Ins15Setup {
        &mut self.setup
    }

    /// Takes what came, one after the other in the order of [`Aiding`]'s fields. One that fails or is held back leaves the others theirs.
    pub fn aid(&mut self, aiding: &Aiding) -> Aided {
        let told = self.aid_by_instruments(aiding);
        if let Some(bounded) = &aiding.bounded {
            // It tells nothing of the filter: what goes wrong leaves it as it is.
            let _ = self.take_velocity(bounded);
        }
        told
    }

    fn aid_by_instruments(&mut self, aiding: &Aiding) -> Aided {
        Aided {
            attitude: aiding.attitude.map(|value| self.take_attitude(value)),
            pressure: aiding.pressure.map(|value| self.take_pressure(value)),
            velocity: aiding.velocity.map(|value| self.take_velocity(&value)),
            modelled: aiding.modelled.map(|value| self.take_velocity(&value)),
            arrival: aiding.arrival.map(|value| self.take_arrival(value)),
        }
    }

    /// Eq. (7): the attitude itself.
    fn take_attitude(&mut self, value: [f64; 3]) -> Result<Innovation<3>, UkfError> {
        let measurement = Measurement {
            value: value.into(),
            noise: diagonal(self.setup.attitude_sigma),
            // Roll and yaw go round; pitch does not.
            components: [Component::Circle, Component::Line, Component::Circle],
            gate: self.setup.gates.attitude,
        };
        self.filter.update(&measurement, |state| part(state, ATTITUDE))
    }

    /// Eq. (8): the weight of the water above the sensor.
    fn take_pressure(&mut self, value: f64) -> Result<Innovation<1>, UkfError> {
        let setup = &self.setup;
        let measurement = Measurement {
            value: [value].into(),
            noise: diagonal([setup.pressure_sigma]),
            components: [Component::Line],
            gate: setup.gates.pressure,
        };
        let (weight, lever) = (setup.density * setup.gravity, setup.pressure_sensor);
        let mut angles = Trigonometry::default();
        self.filter.update(&measurement, |state| {
            let depth = state[POSITION + 2] + angles.of(state).to_ned(lever)[2];
            [weight * depth].into()
        })
    }

    /// Eq. (9) and (10): the velocity itself.
    fn take_velocity(&mut self, velocity: &Velocity) -> Result<Innovation<3>, UkfError> {
        let measurement = Measurement {
            value: velocity.value.into(),
            noise: velocity.noise.into(),
            components: [Component::Line; 3],
            gate: self.setup.gates.velocity,
        };
        self.filter.update(&measurement, |state| part(state, VELOCITY))
    }

    /// Eq. (12) and (13) without the counting of the clock, as ranges: in metres all numbers are of a size.
    ///
    /// Ranges to a millimetre are no straight function of a place that is hardly known. With [`Ins15Setup::finds`], where the place is not
    /// known to a tenth of the range, the signal itself is turned into a place ([`Bearing`]), as well as that is known by it and the
    /// attitude.
    fn take_arrival(&mut self, times: [f64; 5]) -> Result<Innovation<5>, UkfError> {
        let setup = &self.setup;
        let sigma = setup.arrival_sigma * setup.sound_speed;
        let measurement = Measurement {
            value: times.map(|time| time * setup.sound_speed).into(),
            noise: diagonal([sigma; 5]),
            components: [Component::Line; 5],
            gate: setup.gates.arrival,
        };
        let ranges: [f64; 5] = measurement.value.into();
        let is_lost = self.horizontal_variance().sqrt() > LOST * ranges[0];
        match Bearing::of(&ranges, &setup.receivers, sigma).filter(|_| setup.finds && is_lost) {
            Some(bearing) => self.find(&bearing, &measurement),
            None => self.take_ranges(&measurement),
        }
    }

    /// Takes the place from which a transponder bears so. What comes of it is told as of the ranges that it is made of: two of their five
    /// numbers are what they disagree in.
    fn find(&mut self, bearing: &Bearing, ranges: &Measurement<5>) -> Result<Innovation<5>, UkfError> {
        // A look at what was expected: nothing is below this gate.
        let look = self.take_ranges(&Measurement { gate: Some(-1.0), ..*ranges })?;
        let gated = ranges.gate.is_some_and(|gate| bearing.residual > gate);
        if !gated {
            let attitude = Trigonometry::default().of(self.filter.state());
            let place = Vector3::from(self.setup.transponder) - Vector3::from(attitude.to_ned(bearing.way.into()));
            let turned = (0..3).map(|i| self.filter.variance(ATTITUDE + i)).fold(0.0, f64::max);
            let variance = bearing.across() + turned * bearing.way.norm_squared();
            self.take_fix([place.x, place.y], variance.sqrt(), None)?;
        }
        Ok(Innovation { nis: bearing.residual * 2.5, gated, ..look })
    }

    /// The greater of the variances of north and east, m2.
    fn horizontal_variance(&self) -> f64 {
        self.filter.variance(POSITION).max(self.filter.variance(POSITION + 1))
    }

    /// Ranges to the receivers.
    fn take_ranges(&mut self, measurement: &Measurement<5>) -> Result<Innovation<5>, UkfError> {
        let setup = &self.setup;
        let transponder = Vector3::from(setup.transponder);
        let receivers = setup.receivers;
        let mut angles = Trigonometry::default();
        self.filter.update(measurement, |state| {
            let (angles, centre) = (angles.of(state), part(state, POSITION) - transponder);
            receivers.map(|receiver| (centre + Vector3::from(angles.to_ned(receiver))).norm()).into()
        })
    }
}

/// The covariance of independent noises.
fn diagonal<const M: usize>(sigma: [f64; M]) -> SMatrix<f64, M, M> {
    SMatrix::from_diagonal(&sigma.map(|sigma| sigma * sigma).into())
}

impl InsState {
    /// In the order of the fields.
    fn to_vector(self) -> SVector<f64, 15> {
        let parts = [self.attitude, self.gyro_bias, self.position, self.velocity, self.accelerometer_bias];
        SVector::from_fn(|i, _| parts[i / 3][i % 3])
    }

    /// The reverse.
    fn from_vector(state: &SVector<f64, 15>) -> Self {
        let [attitude, gyro_bias, position, velocity, accelerometer_bias] =
            std::array::from_fn(|i| part(state, 3 * i).into());
        InsState { attitude, gyro_bias, position, velocity, accelerometer_bias }
    }
}
