//! A linear system, of which all is known: a body that drifts along a line under random accelerations, and its measured position.

use super::random::Random;
use albacore_navigation::ukf::{Component, Measurement, Spread, Ukf};
use nalgebra::{Matrix1, Matrix1x2, Matrix2, Vector1, Vector2};

/// Deviation of a measured position, m.
const SIGMA: f64 = 0.5;
const STEPS: usize = 100;

fn transition() -> Matrix2<f64> {
    Matrix2::new(1.0, 0.1, 0.0, 1.0)
}

/// The factor of the process noise.
fn unknown() -> Matrix2<f64> {
    Matrix2::new(0.01, 0.0, 0.02, 0.03)
}

fn start() -> (Vector2<f64>, Matrix2<f64>) {
    (Vector2::new(1.0, -0.5), Matrix2::new(4.0, 0.5, 0.5, 1.0))
}

fn filter(spread: Spread) -> Ukf<2> {
    let (state, covariance) = start();
    Ukf::new(state, &covariance, spread, [Component::Line; 2]).unwrap()
}

fn measured(value: f64) -> Measurement<1> {
    let noise = Matrix1::new(SIGMA * SIGMA);
    Measurement { value: Vector1::new(value), noise, components: [Component::Line], gate: None }
}

fn predict(filter: &mut Ukf<2>) {
    filter.predict(|x| transition() * x, &(unknown() * unknown().transpose())).unwrap();
}

#[test]
fn it_is_the_filter_of_kalman() {
    for (alpha, beta, kappa) in [(0.1, 2.0, 0.0), (1.0, 2.0, 1.0), (0.5, 0.0, -1.0)] {
        let mut ours = filter(Spread { alpha, beta, kappa });
        let (mut x, mut p) = start();
        let (h, mut random) = (Matrix1x2::new(1.0, 0.0), Random(1));
        for _ in 0..STEPS {
            let value = 3.0 * random.gaussian();
            predict(&mut ours);
            let told = ours.update(&measured(value), |x| Vector1::new(x[0])).unwrap();
            (x, p) =
                (transition() * x, transition() * p * transition().transpose() + unknown() * unknown().transpose());
            let innovation = (h * p * h.transpose())[0] + SIGMA * SIGMA;
            let (gain, residual) = (p * h.transpose() / innovation, value - x[0]);
            (x, p) = (x + gain * residual, p - gain * innovation * gain.transpose());
            assert!((ours.state() - x).amax() < 1e-11 && (ours.covariance() - p).amax() < 1e-11);
            assert!((told.nis - residual * residual / innovation).abs() < 1e-10);
            assert!((told.covariance[0] - innovation).abs() < 1e-10);
        }
    }
}

#[test]
fn errors_are_as_great_as_is_told() {
    const RUNS: usize = 400;
    let (mut nees, mut nis, mut beyond) = (0.0, 0.0, 0);
    for run in 0..RUNS {
        let mut random = Random(run as u64 * 7919);
        let mut draw = || Vector2::new(random.gaussian(), random.gaussian());
        let (state, covariance) = start();
        let mut truth = state + covariance.cholesky().unwrap().l() * draw();
        let mut filter = filter(Spread::default());
        for _ in 0..STEPS {
            truth = transition() * truth + unknown() * draw();
            predict(&mut filter);
            let told = filter.update(&measured(truth[0] + SIGMA * draw()[0]), |x| Vector1::new(x[0])).unwrap();
            nis += told.nis;
            // 5 % of a chi-square distribution with one degree of freedom.
            beyond += usize::from(told.nis > 3.841);
        }
        let error = truth - filter.state();
        nees += (error.transpose() * filter.covariance().try_inverse().unwrap() * error)[0];
    }
    let (runs, all) = (RUNS as f64, (RUNS * STEPS) as f64);
    let (nees, nis, beyond) = (nees / runs, nis / all, beyond as f64 / all);
    println!("mean NEES {nees:.3} of 2, mean NIS {nis:.4} of 1, {beyond:.4} beyond the 0.05 bound");
    // Four standard deviations of each mean.
    assert!((nees - 2.0).abs() < 4.0 * (4.0 / runs).sqrt());
    assert!((nis - 1.0).abs() < 4.0 * (2.0 / all).sqrt());
    assert!((beyond - 0.05).abs() < 4.0 * (0.05 * 0.95 / all).sqrt());
}
