//! Our Fossen plant against time series that other software computed: `tests/reference/remus100`.

use albacore_geometry::{Heading, Vector};
use albacore_sim::hull::{ActuatorLimits, Actuators, Controls, Fossen, State, Surroundings, runge_kutta};
use std::error::Error;
use std::path::Path;

/// Commands are held so long, s.
const HOLD_S: f64 = 0.1;

type Rows = Vec<Vec<f64>>;

fn rows(name: &str) -> Result<Rows, Box<dyn Error>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/remus100").join(name);
    let text = std::fs::read_to_string(path)?;
    text.lines().skip(1).map(|line| Ok(line.split(',').map(str::parse).collect::<Result<_, _>>()?)).collect()
}

/// The largest difference at any time, with so many steps to a command: of the body and its fins, and of the propeller's turns,
/// which the series give to some 5e-7 only.
fn apart(case: &str, current: Vector, steps: usize) -> Result<(f64, f64), Box<dyn Error>> {
    let h = HOLD_S / steps as f64;
    let plant = Fossen::new();
    let around = Surroundings { current, ..Surroundings::default() };
    let mut actuators = Actuators::new(ActuatorLimits::default(), h);
    let mut state = State::default();
    let expected = rows(&format!("{case}_rk4.csv"))?;
    let mut expected = expected.iter().peekable();
    let mut worst: (f64, f64) = (0.0, 0.0);
    for (k, input) in rows(&format!("{case}_inputs.csv"))?.iter().enumerate() {
        let time = k as f64 * HOLD_S;
        if let Some(row) = expected.next_if(|row| (row[0] - time).abs() < 1e-6) {
            let fins = [actuators.now.rudder, actuators.now.stern];
            let states = state.pose.iter().chain(&state.velocity).chain(&fins);
            worst.0 = states.zip(&row[1..15]).fold(worst.0, |worst, (ours, theirs)| worst.max((ours - theirs).abs()));
            worst.1 = worst.1.max((actuators.now.rpm - row[15]).abs());
        }
        let goal = actuators.within_limits(&Controls { rudder: input[1], stern: input[2], rpm: input[3] });
        for _ in 0..steps {
            let controls = actuators.step(&goal);
            state = runge_kutta(&plant, &state, &controls, &around, h);
        }
    }
    // The last row may lie one hold behind the last command.
    assert!(expected.count() <= 1, "{case}: rows are left over");
    Ok(worst)
}

#[test]
fn every_case_is_followed_to_a_millionth_over_its_whole_length() {
    let current = 0.5 * Heading::from_degrees(45.0).unit();
    for (case, current) in [
        ("straight", Vector::ZERO),
        ("depth_step_30m", Vector::ZERO),
        ("turning_circle", Vector::ZERO),
        ("turning_circle_current", current),
    ] {
        let [(fine, fine_rpm), (coarse, coarse_rpm)] = [20, 10].map(|steps| apart(case, current, steps).unwrap());
        println!("{case}: {fine:.1e} with 5 ms, {coarse:.1e} with 10 ms; propeller {fine_rpm:.1e}, {coarse_rpm:.1e}");
        assert!(fine < 1e-6 && coarse < 1e-6, "{case}: {fine:e}, {coarse:e}");
        assert!(fine_rpm < 1e-6 && coarse_rpm < 1e-6, "{case}: {fine_rpm:e}, {coarse_rpm:e} rpm");
    }
}
