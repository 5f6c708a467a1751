//! The reference series: `README.md` beside them.

use albacore_geometry::math::{cos, sin};
use albacore_navigation::ukf::{
    Aiding, Component, Imu, Ins15, Ins15Gates, Ins15Setup, InsState, Measurement, Spread, Ukf, Velocity,
};
use nalgebra::{SMatrix, SVector};
use serde_json::Value;
use std::path::PathBuf;

/// A row of measurements: step, kind, values.
type Row = (usize, String, Vec<f64>);

fn path(name: &str) -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "tests", "ukf", name].iter().collect()
}

fn text(name: &str) -> String {
    std::fs::read_to_string(path(name)).unwrap()
}

fn rows(name: &str) -> Vec<Vec<f64>> {
    text(name).lines().skip(1).map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect()).collect()
}

fn measurements(name: &str) -> Vec<Row> {
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let values = cells[2..].iter().filter(|cell| !cell.is_empty()).map(|cell| cell.parse().unwrap());
        (cells[0].parse().unwrap(), cells[1].to_string(), values.collect())
    };
    text(name).lines().skip(1).map(row).collect()
}

struct Params(Value);

impl Params {
    fn of(case: &str) -> Self {
        Params(serde_json::from_str(&text(&format!("{case}_params.json"))).unwrap())
    }

    fn number(&self, name: &str) -> f64 {
        self.0[name].as_f64().unwrap()
    }

    fn list<const N: usize>(&self, name: &str) -> [f64; N] {
        list(&self.0[name])
    }

    fn spread(&self) -> Spread {
        let [alpha, beta, kappa] = ["alpha", "beta", "kappa"].map(|name| self.number(name));
        Spread { alpha, beta, kappa }
    }
}

fn list<const N: usize>(value: &Value) -> [f64; N] {
    std::array::from_fn(|i| value[i].as_f64().unwrap())
}

/// The greatest difference of any.
fn apart(worst: f64, ours: impl IntoIterator<Item = f64>, theirs: &[f64]) -> f64 {
    ours.into_iter().zip(theirs).fold(worst, |worst, (ours, theirs)| worst.max((ours - theirs).abs()))
}

/// The greatest differences of a state and of an entry of the covariance over a whole series of 5 states.
fn turning(case: &str, kinds: [Component; 5]) -> (f64, f64) {
    let params = Params::of(case);
    let dt = params.number("dt");
    let process = |x: &SVector<f64, 5>| {
        let [n, e, psi, v, omega] = (*x).into();
        SVector::from([n + dt * v * cos(psi), e + dt * v * sin(psi), psi + dt * omega, v, omega])
    };
    let beacon: [f64; 2] = params.list("beacon_ne");
    let diagonal = |name: &str| SMatrix::from_diagonal(&params.list::<5>(name).into());
    let noise = diagonal("Q_diag");
    let mut filter = Ukf::new(params.list("x0").into(), &diagonal("P0_diag"), params.spread(), kinds).unwrap();
    let all = measurements(&format!("{case}_meas.csv"));
    let mut rest = all.iter().peekable();
    let mut worst: (f64, f64) = (0.0, 0.0);
    for row in rows(&format!("{case}_expected.csv")) {
        filter.predict(process, &noise).unwrap();
        while let Some((_, kind, value)) = rest.next_if(|(step, ..)| *step == row[0] as usize) {
            let components = [if kind == "heading" { Component::Circle } else { Component::Line }];
            let variance = params.number(&format!("R_{kind}"));
            let measurement =
                Measurement { value: [value[0]].into(), noise: [[variance]].into(), components, gate: None };
            let expected = |x: &SVector<f64, 5>| match kind.as_str() {
                "heading" => [x[2]].into(),
                "speed" => [x[3]].into(),
                _ => {
                    [((x[0] - beacon[0]) * (x[0] - beacon[0]) + (x[1] - beacon[1]) * (x[1] - beacon[1])).sqrt()].into()
                }
            };
            assert!(!filter.update(&measurement, expected).unwrap().gated);
        }
        let covariance = filter.covariance();
        let upper = (0..5).flat_map(|i| (i..5).map(move |j| covariance[(i, j)]));
        let unwrapped = filter
            .state()
            .iter()
            .zip(&row[2..])
            .zip(kinds)
            .map(|((x, expected), kind)| expected + kind.reduced(x - expected));
        worst.0 = apart(worst.0, unwrapped, &row[2..7]);
        worst.1 = apart(worst.1, upper, &row[7..22]);
    }
    assert!(rest.next().is_none());
    worst
}

#[test]
fn turns_are_followed_to_a_billionth() {
    for case in ["ct5_a", "ct5_b"] {
        let (states, covariance) = turning(case, [Component::Line; 5]);
        println!("{case}: {states:.1e} states, {covariance:.1e} covariance");
        assert!(states < 1e-9 && covariance < 1e-9, "{case}: {states:e}, {covariance:e}");
    }
}

#[test]
fn a_heading_within_half_a_turn_gives_the_same() {
    let mut kinds = [Component::Line; 5];
    kinds[2] = Component::Circle;
    for case in ["ct5_a", "ct5_b"] {
        let (states, covariance) = turning(case, kinds);
        assert!(states < 1e-9 && covariance < 1e-9, "{case}: {states:e}, {covariance:e}");
    }
}

fn ins_state(values: &[f64]) -> InsState {
    let part = |i: usize| values[i..i + 3].try_into().unwrap();
    InsState {
        attitude: part(0),
        gyro_bias: part(3),
        position: part(6),
        velocity: part(9),
        accelerometer_bias: part(12),
    }
}

fn ins_setup(params: &Params) -> Ins15Setup {
    let root = |name: &str| params.number(name).sqrt();
    Ins15Setup {
        spread: params.spread(),
        yaw: Component::Line,
        gyro_sigma: params.number("sigma_g"),
        accelerometer_sigma: params.number("sigma_a"),
        velocity_sigma: params.number("sigma_u"),
        attitude_sigma: params.list("R_attitude_diag").map(f64::sqrt),
        pressure_sigma: root("R_pressure"),
        arrival_sigma: root("R_range") / params.number("V_s"),
        density: params.number("rho"),
        gravity: params.number("g"),
        sound_speed: params.number("V_s"),
        pressure_sensor: params.list("l_pr"),
        receivers: std::array::from_fn(|i| list(&params.0["l_r"][i])),
        transponder: params.list("transponder"),
        gates: Ins15Gates::default(),
        ..Ins15Setup::default()
    }
}

#[test]
fn inertial_navigation_is_followed_to_a_millionth() {
    let params = Params::of("ins15_a");
    let sigma = params.list::<15>("P0_diag").map(f64::sqrt);
    let start = ins_state(&params.list::<15>("x0"));
    let mut filter = Ins15::new(ins_setup(&params), &start, &ins_state(&sigma)).unwrap();
    let all = measurements("ins15_a_meas.csv");
    let mut rest = all.iter().peekable();
    let expected = rows("ins15_a_expected.csv");
    let mut expected = expected.iter().peekable();
    let variance = params.number("R_dvl");
    let mut worst: (f64, f64) = (0.0, 0.0);
    for row in rows("ins15_a_imu.csv") {
        let imu = Imu { gyro: row[1..4].try_into().ok(), accelerometer: row[4..7].try_into().ok() };
        filter.predict(&imu, params.number("dt")).unwrap();
        let mut aiding = Aiding::default();
        while let Some((_, kind, value)) = rest.next_if(|(step, ..)| *step as f64 == row[0]) {
            let three = || value[..3].try_into().unwrap();
            match kind.as_str() {
                "attitude" => aiding.attitude = Some(three()),
                "pressure" => aiding.pressure = Some(value[0]),
                "dvl" => {
                    let noise = SMatrix::<f64, 3, 3>::from_diagonal_element(variance).into();
                    aiding.velocity = Some(Velocity { value: three(), noise });
                }
                _ => aiding.arrival = Some(std::array::from_fn(|i| value[i] / params.number("V_s"))),
            }
        }
        let aided = filter.aid(&aiding);
        assert!(aided.arrival.is_none_or(|taken| taken.is_ok()));
        if let Some(row) = expected.next_if(|expected| expected[0] == row[0]) {
            worst.0 = apart(worst.0, filter.filter().state().iter().copied(), &row[2..17]);
            worst.1 = apart(worst.1, (0..15).map(|i| filter.filter().variance(i)), &row[17..32]);
        }
    }
    assert!(rest.next().is_none() && expected.next().is_none());
    println!("ins15_a: {:.1e} states, {:.1e} variances", worst.0, worst.1);
    assert!(worst.0 < 1e-6 && worst.1 < 1e-6, "{worst:?}");
}
