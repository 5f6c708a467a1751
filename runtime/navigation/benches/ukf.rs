//! What a step of the unscented Kalman filter with 15 states costs: `cargo bench -p albacore-navigation --bench ukf`.

#![expect(clippy::print_stdout, reason = "a benchmark tells what it measured")]
#![expect(clippy::unwrap_used, reason = "a filter that fails has nothing to measure")]

#[path = "../../sim/benches/common/mod.rs"]
mod common;

use albacore_navigation::ukf::{Aiding, Imu, Ins15, Ins15Setup, InsState, Velocity};
use common::{cost, stretches};
use std::hint::black_box;

/// Of one prediction, s.
const STEP_S: f64 = 0.01;
/// The states.
const N: u64 = 15;

fn main() {
    let velocity =
        Velocity { value: [1.5, 0.0, 0.0], noise: [[0.0025, 0.0, 0.0], [0.0, 0.0025, 0.0], [0.0, 0.0, 0.0025]] };
    let range = (700.0_f64 * 700.0 + 300.0 * 300.0 + 8.0 * 8.0).sqrt();
    let nothing = Aiding::default();
    let aidings = [
        ("predict", 0, nothing),
        ("and attitude", 3, Aiding { attitude: Some([0.0, 0.0, 0.3]), ..nothing }),
        ("and pressure", 1, Aiding { pressure: Some(1025.0 * 9.81 * 10.0), ..nothing }),
        ("and velocity", 3, Aiding { velocity: Some(velocity), ..nothing }),
        ("and arrival", 5, Aiding { arrival: Some([range / 1500.0; 5]), ..nothing }),
    ];
    println!("{} bytes of filter", size_of::<Ins15>());
    let mut works = aidings.map(|(_, _, aiding)| move || steps(&aiding));
    let [a, b, c, d, e] = &mut works;
    let times = cost([a, b, c, d, e]);
    // Of a second: 100 samples of the inertial unit, and what else comes at the rates of the paper's Table 1.
    let second: f64 = times[1..].iter().zip([10.0, 5.0, 5.0, 1.0]).map(|(ns, rate)| rate * (ns - times[0])).sum();
    let second = second + 100.0 * times[0];
    println!("a second with all of it: {:.3} ms, {:.0} times real time", second / 1e6, 1e9 / second);
    for ((name, measured, _), ns) in aidings.iter().zip(times) {
        let flops = predict_flops() + if *measured > 0 { update_flops(*measured) } else { 0 };
        println!(
            "{name:13} {ns:7.0} ns a step; {flops:6} operations without the functions: {:.1} a ns",
            flops as f64 / ns
        );
    }
}

/// Predictions, each with the same measurement.
fn steps(aiding: &Aiding) -> Vec<f64> {
    let start = InsState {
        attitude: [0.0, 0.0, 0.3],
        position: [700.0, 300.0, 10.0],
        velocity: [1.5, 0.0, 0.0],
        ..InsState::default()
    };
    let sigma = InsState {
        attitude: [0.1; 3],
        gyro_bias: [0.02; 3],
        position: [3.0; 3],
        velocity: [0.3; 3],
        accelerometer_bias: [0.1; 3],
    };
    let mut filter = Ins15::new(Ins15Setup::default(), &start, &sigma).unwrap();
    let imu = Imu { gyro: Some([0.001, -0.002, 0.0]), accelerometer: Some([0.0, 0.0, -9.81]) };
    stretches(10, 200, || {
        filter.predict(black_box(&imu), STEP_S).unwrap();
        black_box(filter.aid(black_box(aiding)));
    })
}

/// Additions, multiplications, divisions and roots of a prediction, as they are done: over whole columns.
fn predict_flops() -> u64 {
    let points_and_differences = 4 * N * N + 8 * N * N;
    let squares = 4 * N * N * N + 3 * N * N;
    points_and_differences + squares + N * N * N
}

/// The same of `m` numbers that are measured.
fn update_flops(m: u64) -> u64 {
    let points_and_differences = 4 * N * N + 8 * N * m;
    let innovation = 4 * N * m * m + 3 * m * m + 2 * m * m * m;
    let gain = 2 * N * N * m + 2 * N * m * m;
    let state_and_columns = 2 * N * m + 2 * N * N * m + 2 * N * m * m;
    let squares = 2 * N * N * (N + m);
    points_and_differences + innovation + gain + state_and_columns + squares + N * N * N
}
