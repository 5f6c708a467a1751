//! What holds of single steps: angles, gates, failures, and what comes late.

use super::random::Random;
use albacore_geometry::math::{PI, atan2, cos, sin};
use albacore_geometry::wrap_angle;
use albacore_navigation::ukf::{
    Aiding, Component, History, Imu, Ins15, Ins15Setup, InsState, Measurement, Spread, Ukf, UkfError,
};
use nalgebra::{Matrix1, Matrix3, Vector1, Vector3};

/// North, east and heading, of which the heading goes round.
const POSE: [Component; 3] = [Component::Line, Component::Line, Component::Circle];

fn pose(heading: f64, components: [Component; 3]) -> Ukf<3> {
    let covariance = Matrix3::from_diagonal(&Vector3::new(0.5, 0.5, 0.3));
    Ukf::new(Vector3::new(0.0, 0.0, heading), &covariance, Spread::default(), components).unwrap()
}

/// An angle with a variance of 0.04.
fn angle(value: f64, kind: Component, gate: Option<f64>) -> Measurement<1> {
    Measurement { value: Vector1::new(value), noise: Matrix1::new(0.04), components: [kind], gate }
}

/// A vehicle that turns, and sees a beacon by its bearing from the nose; in a world that is turned by `turned`. What is believed
/// afterwards, in the world as it was.
fn turning(turned: f64, kind: Component) -> ([f64; 3], [f64; 3]) {
    let mut filter = pose(wrap_angle(turned), POSE);
    let beacon = (20.0 * cos(turned + 0.4), 20.0 * sin(turned + 0.4));
    let noise = Matrix3::from_diagonal(&Vector3::new(0.01, 0.01, 0.01));
    for step in 0..50 {
        let ahead =
            |x: &Vector3<f64>| Vector3::new(x[0] + 0.2 * cos(x[2]), x[1] + 0.2 * sin(x[2]), wrap_angle(x[2] + 0.3));
        filter.predict(ahead, &noise).unwrap();
        let seen = wrap_angle(0.4 - 0.3 * f64::from(step + 1));
        let bearing = |x: &Vector3<f64>| Vector1::new(wrap_angle(atan2(beacon.1 - x[1], beacon.0 - x[0]) - x[2]));
        filter.update(&angle(seen, kind, None), bearing).unwrap();
        assert!(filter.state()[2].abs() <= PI);
    }
    let (state, (c, s)) = (filter.state(), (cos(turned), sin(turned)));
    let back = [c * state[0] + s * state[1], c * state[1] - s * state[0], wrap_angle(state[2] - turned)];
    (back, std::array::from_fn(|i| filter.variance(i)))
}

#[test]
fn a_world_that_is_turned_gives_the_same_turned() {
    // Not to the bit: the factor's columns, along which points are drawn, are not turned with it.
    let (state, variance) = turning(0.0, Component::Circle);
    for turned in [1.0, 2.0, 3.0, PI, -3.0, -1.5, 40.0] {
        let (other, other_variance) = turning(turned, Component::Circle);
        (0..3).for_each(|i| assert!((other[i] - state[i]).abs() < 1e-5, "{turned}: {other:?}, {state:?}"));
        assert!((other_variance[2] - variance[2]).abs() < 1e-6, "{turned}");
    }
}

#[test]
fn means_and_residuals_of_angles_are_those_of_the_circle() {
    // Sigma points of the heading lie on both sides of the half turn; what is measured lies across it.
    for beyond in [-0.1, -0.01, 0.0, 0.01, 0.1] {
        let mut filter = pose(wrap_angle(PI + beyond), POSE);
        filter.predict(|x| Vector3::new(x[0], x[1], wrap_angle(x[2])), &Matrix3::zeros()).unwrap();
        assert!((filter.variance(2) - 0.3).abs() < 1e-12, "{beyond}");
        let told =
            filter.update(&angle(-PI + 0.2, Component::Circle, None), |x| Vector1::new(wrap_angle(x[2]))).unwrap();
        assert!((told.residual[0] - (0.2 - beyond)).abs() < 1e-12 && (told.covariance[0] - 0.34).abs() < 1e-12);
        let expected = wrap_angle(PI + beyond + 0.3 / 0.34 * (0.2 - beyond));
        assert!((filter.state()[2] - expected).abs() < 1e-12 && (filter.variance(2) - 0.3 * 0.04 / 0.34).abs() < 1e-12);
    }
}

#[test]
fn plain_numbers_are_not_wrapped() {
    let mut filter = pose(3.0, [Component::Line; 3]);
    filter.predict(|x| Vector3::new(x[0], x[1], x[2] + 1.0), &Matrix3::zeros()).unwrap();
    assert!((filter.state()[2] - 4.0).abs() < 1e-12);
    let told = filter.update(&angle(-2.0, Component::Line, None), |x| Vector1::new(x[2])).unwrap();
    assert!((told.residual[0] + 6.0).abs() < 1e-12);
}

#[test]
fn a_gate_holds_back_what_is_beyond_it_and_says_so() {
    let begin = pose(0.0, POSE);
    let heading = |x: &Vector3<f64>| Vector1::new(x[2]);
    // The variance of the innovation is 0.34, so that this is three deviations off.
    let value = 3.0 * 0.34_f64.sqrt();
    for (gate, gated) in [(None, false), (Some(9.1), false), (Some(8.9), true), (Some(0.0), true)] {
        let mut filter = begin.clone();
        let told = filter.update(&angle(value, Component::Circle, gate), heading).unwrap();
        assert!((told.nis - 9.0).abs() < 1e-10 && told.gated == gated);
        assert_eq!(filter == begin, gated);
    }
}

#[test]
fn a_step_that_fails_leaves_the_filter_as_it_was() {
    let begin = pose(0.0, POSE);
    let mut filter = begin.clone();
    let heading = |x: &Vector3<f64>| Vector1::new(x[2]);
    for bad in [f64::NAN, f64::INFINITY] {
        let told = filter.update(&angle(bad, Component::Circle, None), heading);
        assert_eq!(told, Err(UkfError::NotFinite));
        assert_eq!(filter.update(&angle(0.0, Component::Line, None), |_| Vector1::new(bad)), Err(UkfError::NotFinite));
        let mut noise = Matrix3::zeros();
        assert_eq!(filter.predict(|x| x * bad, &noise), Err(UkfError::NotFinite));
        noise[(2, 1)] = bad;
        assert_eq!(filter.predict(|x| *x, &noise), Err(UkfError::Covariance));
    }
    assert_eq!(filter.predict(|_| Vector3::zeros(), &Matrix3::zeros()), Err(UkfError::Covariance));
    assert_eq!(filter.predict(|x| *x, &-Matrix3::identity()), Err(UkfError::Covariance));
    for variance in [0.0, -1.0, f64::NAN] {
        let noise = Matrix1::new(variance);
        let told = filter.update(&Measurement { noise, ..angle(0.0, Component::Circle, None) }, heading);
        assert_eq!(told, Err(UkfError::Noise));
    }
    // So sure that nothing would be left of the variance.
    let noise = Matrix1::new(1e-300);
    let told =
        filter.update(&Measurement { noise, ..angle(0.0, Component::Circle, None) }, |x| Vector1::new(x[0] + x[2]));
    assert_eq!(told, Err(UkfError::Covariance));
    assert_eq!(filter, begin);
}

#[test]
fn it_begins_only_with_what_can_be() {
    let begin =
        |spread, variance| Ukf::new(Vector1::new(0.0), &Matrix1::new(variance), spread, [Component::Line]).err();
    let spread = Spread::default();
    assert_eq!(begin(spread, 1.0), None);
    assert_eq!(begin(spread, 0.0), Some(UkfError::Covariance));
    assert_eq!(begin(spread, f64::NAN), Some(UkfError::Covariance));
    for (alpha, beta, kappa) in
        [(0.0, 2.0, 0.0), (-1.0, 2.0, 0.0), (1.0, 2.0, -1.0), (1.0, 2.0, -3.0), (1.0, f64::NAN, 0.0)]
    {
        assert_eq!(begin(Spread { alpha, beta, kappa }, 1.0), Some(UkfError::Spread));
    }
}

/// A sample of the inertial unit, and what came with it.
#[derive(Clone, Copy)]
#[expect(clippy::large_enum_variant, reason = "a history keeps copies of both")]
enum Event {
    Imu(Imu),
    Aiding(Aiding),
}

#[test]
fn what_comes_late_gives_the_same_to_the_bit() {
    let sigma = InsState {
        attitude: [0.1; 3],
        gyro_bias: [0.02; 3],
        position: [3.0; 3],
        velocity: [0.3; 3],
        accelerometer_bias: [0.1; 3],
    };
    let start = InsState { position: [40.0, 30.0, 10.0], ..InsState::default() };
    let filter = Ins15::new(Ins15Setup::default(), &start, &sigma).unwrap();
    let run = |filter: &mut Ins15, event: &Event| match event {
        Event::Imu(imu) => filter.predict(imu, 0.01).is_ok(),
        Event::Aiding(aiding) => filter.aid(aiding).arrival.is_none_or(|taken| taken.is_ok_and(|told| !told.gated)),
    };
    let (mut in_time, mut late) = (History::new(filter.clone(), 1), History::new(filter, 100));
    let mut random = Random(3);
    let mut on_the_way = None;
    for step in 0_u32..500 {
        let time = 0.01 * f64::from(step);
        let gyro = std::array::from_fn(|_| 0.005 * random.gaussian());
        let imu = Event::Imu(Imu { gyro: Some(gyro), accelerometer: Some([0.0, 0.0, -9.81]) });
        assert_eq!([&mut in_time, &mut late].map(|history| history.apply(time, imu, run)), [Some(true); 2]);
        if step % 100 == 20 {
            let arrival = Some(std::array::from_fn(|_| (50.6 + 0.001 * random.gaussian()) / 1500.0));
            let aiding = Event::Aiding(Aiding { arrival, ..Aiding::default() });
            assert_eq!(in_time.apply(time, aiding, run), Some(true));
            on_the_way = Some((time, aiding));
        }
        // 0.7 s later.
        if step % 100 == 90
            && let Some((time, aiding)) = on_the_way.take()
        {
            assert_ne!(late.filter(), in_time.filter());
            assert_eq!(late.apply(time, aiding, run), Some(true));
            assert_eq!(late.filter(), in_time.filter());
        }
    }
    assert_eq!(late.filter(), in_time.filter());
}
