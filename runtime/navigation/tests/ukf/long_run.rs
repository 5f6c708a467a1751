//! The filter of 15 states under way for long, with instruments that fall silent for long: on a circle, in waves.

use super::random::Random;
use albacore_geometry::math::{PI, cos, sin, sin_cos};
use albacore_geometry::wrap_angle;
use albacore_navigation::ukf::{Aided, Aiding, Imu, Ins15, Ins15Setup, InsState, Velocity};
use nalgebra::{Matrix3, Rotation3, SVector, Vector3};

/// A step, s.
const DT: f64 = 0.01;
/// Biases of gyroscopes and accelerometers, rad/s and m/s2 on each axis: the paper's.
const BIASES: (f64, f64) = (0.01, 0.05);
/// Of the Doppler log, m/s.
const VELOCITY_SIGMA: f64 = 0.05;
/// Of a time of arrival before it is counted, s, and the clock that counts, Hz.
const ARRIVAL: (f64, f64) = (0.577e-6, 500e3);

/// Roll, pitch and yaw (not wrapped), and the place, at a step.
fn pose(step: u64) -> (Vector3<f64>, Vector3<f64>) {
    let t = step as f64 * DT;
    let turn = 0.005 * t;
    let attitude = Vector3::new(0.05 * sin(0.9 * t), 0.06 * cos(0.21 * t), turn + 0.02 * sin(0.5 * t));
    (attitude, Vector3::new(300.0 * sin(turn), -300.0 * cos(turn), 15.0 + 5.0 * sin(0.02 * t)))
}

fn body(attitude: &Vector3<f64>) -> Rotation3<f64> {
    let ((sr, cr), (sp, cp), (sy, cy)) = (sin_cos(attitude.x), sin_cos(attitude.y), sin_cos(attitude.z));
    Rotation3::from_matrix_unchecked(Matrix3::new(
        cy * cp,
        cy * sp * sr - sy * cr,
        cy * sp * cr + sy * sr,
        sy * cp,
        sy * sp * sr + cy * cr,
        sy * sp * cr - cy * sr,
        -sp,
        cp * sr,
        cp * cr,
    ))
}

/// The truth at a step, such that Euler's method leads from each to the next; and what the inertial unit feels without noise.
fn truth(step: u64) -> (InsState, Imu) {
    let [(now, place), (next, next_place), (_, after_place)] = [0, 1, 2].map(|ahead| pose(step + ahead));
    let to_body = body(&now).inverse();
    let velocity = to_body * (next_place - place) / DT;
    let next_velocity = body(&next).inverse() * (after_place - next_place) / DT;
    let rates = (next - now) / DT;
    let ((sr, cr), (sp, cp)) = (sin_cos(now.x), sin_cos(now.y));
    let turn = Vector3::new(rates.x - sp * rates.z, cr * rates.y + sr * cp * rates.z, cr * cp * rates.z - sr * rates.y);
    let force = (next_velocity - velocity) / DT + turn.cross(&velocity) + to_body * Vector3::new(0.0, 0.0, -9.81);
    let state = InsState {
        attitude: now.into(),
        gyro_bias: [BIASES.0; 3],
        position: place.into(),
        velocity: velocity.into(),
        accelerometer_bias: [BIASES.1; 3],
    };
    let imu =
        Imu { gyro: Some(turn.add_scalar(BIASES.0).into()), accelerometer: Some(force.add_scalar(BIASES.1).into()) };
    (state, imu)
}

/// An instrument that falls silent and comes back, each for minutes.
struct Silence {
    silent: bool,
    until: u64,
}

impl Silence {
    fn at(&mut self, step: u64, random: &mut Random) -> bool {
        if step >= self.until {
            self.silent = !self.silent;
            self.until = step + (random.unit() * 20_000.0) as u64 + 1;
        }
        self.silent
    }
}

/// What comes at a step, at the rates of the paper's Table 1.
fn aiding(step: u64, state: &InsState, setup: &Ins15Setup, silent: [bool; 4], random: &mut Random) -> Aiding {
    let due = |period: u64, silent: bool| step.is_multiple_of(period) && !silent;
    let to_ned = body(&state.attitude.into());
    let place = Vector3::from(state.position);
    let mut aiding = Aiding::default();
    if due(10, silent[0]) {
        let noisy = |i: usize| state.attitude[i] + setup.attitude_sigma[i] * random.gaussian();
        let [roll, pitch, yaw] = std::array::from_fn(noisy);
        aiding.attitude = Some([roll, pitch, wrap_angle(yaw)]);
    }
    if due(20, silent[1]) {
        let depth = (place + to_ned * Vector3::from(setup.pressure_sensor)).z;
        aiding.pressure = Some(setup.density * setup.gravity * depth + setup.pressure_sigma * random.gaussian());
    }
    if due(20, silent[2]) {
        let value = state.velocity.map(|v| v + VELOCITY_SIGMA * random.gaussian());
        let noise = Matrix3::from_diagonal_element(VELOCITY_SIGMA * VELOCITY_SIGMA).into();
        aiding.velocity = Some(Velocity { value, noise });
    }
    if due(100, silent[3]) {
        let counted = |receiver: [f64; 3]| {
            let range = (place + to_ned * Vector3::from(receiver) - Vector3::from(setup.transponder)).norm();
            let time = range / setup.sound_speed + ARRIVAL.0 * random.gaussian();
            ((time * ARRIVAL.1).floor() + 0.5) / ARRIVAL.1
        };
        aiding.arrival = Some(setup.receivers.map(counted));
    }
    aiding
}

fn numbers(state: &InsState) -> SVector<f64, 15> {
    let parts = [state.attitude, state.gyro_bias, state.position, state.velocity, state.accelerometer_bias];
    SVector::from_fn(|i, _| parts[i / 3][i % 3])
}

/// Nothing failed.
fn sound(aided: &Aided) -> bool {
    aided.attitude.is_none_or(|told| told.is_ok())
        && aided.pressure.is_none_or(|told| told.is_ok())
        && aided.velocity.is_none_or(|told| told.is_ok())
        && aided.arrival.is_none_or(|told| told.is_ok())
}

#[test]
fn covariances_stay_symmetric_and_positive_over_a_long_run_with_dropouts() {
    let steps = std::env::var("UKF_STEPS").map_or(60_000, |steps| steps.parse().unwrap());
    // Eleven times what the clock gives: `Ins15Setup::arrival_sigma`.
    let setup = Ins15Setup { arrival_sigma: 9e-6, ..Ins15Setup::default() };
    let mut random = Random(5);
    let sigma = InsState {
        attitude: [0.05, 0.05, 0.2],
        gyro_bias: [0.02; 3],
        position: [3.0; 3],
        velocity: [0.3; 3],
        accelerometer_bias: [0.1; 3],
    };
    let begin = numbers(&truth(0).0) + numbers(&sigma).map(|sigma| sigma * random.gaussian());
    let part = |i: usize| [begin[i], begin[i + 1], begin[i + 2]];
    let begin = InsState { attitude: part(0), position: part(6), velocity: part(9), ..InsState::default() };
    let mut filter = Ins15::new(setup, &begin, &sigma).unwrap();
    let mut silences = [(); 4].map(|()| Silence { silent: true, until: 0 });
    let (mut least, mut greatest, mut inside, mut looks, mut position) =
        (f64::MAX, 0.0_f64, [0_u64; 15], 0_u64, 0.0_f64);
    for step in 0..steps {
        let (state, mut imu) = truth(step);
        let silent: [bool; 4] = std::array::from_fn(|i| silences[i].at(step, &mut random));
        assert!(sound(&filter.aid(&aiding(step, &state, &setup, silent, &mut random))), "step {step}");
        let covariance = filter.filter().covariance();
        assert_eq!(covariance, covariance.transpose(), "step {step}");
        let pivots = filter.filter().factor().diagonal();
        (least, greatest) = (least.min(pivots.min()), greatest.max(pivots.max()));
        if step % 100 == 0 {
            let mut error = numbers(&state) - filter.filter().state();
            error[2] = wrap_angle(error[2]);
            looks += 1;
            (0..15).for_each(|i| inside[i] += u64::from(error[i] * error[i] < 9.0 * covariance[(i, i)]));
            position = position.max(error.fixed_rows::<2>(6).norm());
            assert!(filter.filter().state()[2].abs() <= PI);
        }
        imu.gyro.iter_mut().flatten().for_each(|rate| *rate += setup.gyro_sigma * random.gaussian());
        imu.accelerometer
            .iter_mut()
            .flatten()
            .for_each(|force| *force += setup.accelerometer_sigma * random.gaussian());
        assert_eq!(filter.predict(&imu, DT), Ok(()), "step {step}");
    }
    let inside = inside.map(|inside| inside as f64 / looks as f64);
    println!(
        "{steps} steps: diagonal of the factor {least:.1e} to {greatest:.1e}, horizontal error up to {position:.1} m"
    );
    println!("share within three standard deviations: {inside:.3?}");
    // In a day the filter is surer of the biases, which it takes for constant, with every sample: one of them is beyond for an hour.
    assert!(least > 0.0 && inside.iter().all(|inside| *inside > 0.9));
}
